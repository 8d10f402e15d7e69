#!/usr/bin/env bash
# scripts/hil/drivers.sh: runs inside the machine (machine.sh). Every V4L2 format, a thousand frames, controls,
# injected errors, unplugging and replugging: against the kernel's own test drivers.
set -uo pipefail
source scripts/hil/checks.sh
FRAMES=$([ "${HIL_SHORT:-}" ] && echo 200 || echo 1000)

modprobe vivid n_devs=1 node_types=0x1 num_inputs=1 input_types=0 || exit 1
CAM="--camera cam0=v4l2:/dev/video0"

$OMMA cameras > /tmp/said 2>&1
check $? "omma cameras lists the device"
says 'format  Y12' && says 'control gain ' && says 'driver = "v4l2", device = "/dev/video0"'
check $? "with its formats, controls and lines for a mission"

for format in GREY Y10 Y12 Y16 BA81 GBRG GRBG RGGB BG10 GB10 BA10 RG10 YUYV UYVY RGB3 BGR3; do
  case $format in GREY | Y16 | RG10 | YUYV) memories="mmap dma-buf" ;; *) memories=mmap ;; esac
  for memory in $memories; do
    timeout 60 $OMMA capture $CAM --format $format --memory $memory --size 320x180 --rate 30 --frames 5 > /tmp/said 2>&1
    status=$?
    check $status "$format, $memory: 5 frames ($(grep -o 'at .* Hz' /tmp/said))"
  done
done

timeout 300 $OMMA capture $CAM --size 320x180 --rate 60 --frames "$FRAMES" > /tmp/said 2>&1
check $? "$(head -1 /tmp/said)"

timeout 60 $OMMA capture $CAM --size 320x180 --frames 5 --set gain_automatic=0 --set gain=77 > /tmp/said 2>&1
[ "$(v4l2-ctl -d /dev/video0 --get-ctrl=gain)" = "gain: 77" ]
check $? "gain set"
refused "a size it does not have" "format: expected GREY of 321 x 181 px from /dev/video0, found GREY of" $CAM --size 321x181
refused "a control it does not have" "controls.zoom: expected one of brightness" $CAM --size 320x180 --set zoom=3
refused "a value out of range" "controls.gain: expected 0 to 255, found 300" $CAM --size 320x180 --set gain=300
refused "an unknown format" "format: expected one of GREY" $CAM --format MJPG
refused "no such device" "the video device /dev/video9" --camera cam0=v4l2:/dev/video9

inject() { v4l2-ctl -d /dev/video0 --set-ctrl="$1" 2>/dev/null; }
inject inject_vidioc_streamon_error=1
refused "an injected error at the start" "device: expected a stream from /dev/video0" $CAM --size 320x180

# Errors while it runs; capture goes on until it has all its frames.
capture_beside() {
  timeout 200 $OMMA capture $CAM --size 320x180 --rate 30 --frames "$1" --timeout-ms 1000 > /tmp/said 2>&1 &
  CAPTURE=$!
  sleep 2
}
capture_beside 150
inject percentage_of_dropped_buffers=30
sleep 1
inject percentage_of_dropped_buffers=0
wait $CAPTURE
grep -qE 'lost: [1-9][0-9]* gaps' /tmp/said
check $? "dropped buffers counted: $(head -1 /tmp/said)"
capture_beside 100
for i in 1 2 3; do inject inject_v4l2_buf_flag_error=1; sleep 0.3; done
wait $CAPTURE
grep -qE '[1-9][0-9]* damaged|[1-9] times gone' /tmp/said
check $? "wrong buffers counted: $(grep frames /tmp/said | head -1)"

unplug_and_plug_in() { # PREFIX: beside the capture that runs
  echo vivid.0 > /sys/bus/platform/drivers/vivid/unbind
  sleep 2
  echo vivid.0 > /sys/bus/platform/drivers/vivid/bind
  wait $CAPTURE
  check $(($? == 1 ? 0 : 1)) "$1unplugged and plugged in again: $(grep frames /tmp/said | head -1)"
  says 'cam0: gone or silent' && says 'cam0: delivers again' && says ' 1 times gone'
  check $? "named and counted"
}
capture_beside 150
unplug_and_plug_in ""
source scripts/hil/lent_memory.sh
exit $failed
