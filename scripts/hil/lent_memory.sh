# Cameras that fill memory of another owner's (DMA-buf): of a DMA heap, of other video devices. And three cameras to disk.
# Sourced by drivers.sh, not run.
rmmod vivid
modprobe vivid n_devs=3 node_types=0x1,0x101,0x1 num_inputs=1,1,1 input_types=0,0,0 num_outputs=0,1,0 allocators=0,0,1 \
  vid_cap_nr=0,2,4 vid_out_nr=-1,3,-1 && modprobe -a dma_heaps vimc && modprobe v4l2loopback video_nr=20 || exit 1
HEAP=/dev/dma_heap/system
VIMC=$(grep -lx 'Raw Capture 0' /sys/class/video4linux/video*/name | head -1 | cut -d/ -f5)
DMA="--memory dma-buf --memory-from"

$OMMA cameras > /tmp/said 2>&1
says "^$HEAP  DMA heap" && [ "$(grep -A1 'driver vivid (V4L2)' /tmp/said | grep -c "memory  mmap, dma-buf, dma-buf of another owner's")" = 3 ]
check $? "omma cameras tells the heap, and what memory a device takes"

# The same picture in whoever's memory: without text, which changes.
v4l2-ctl -d /dev/video0 --set-ctrl=osd_text_mode=2
picture() { # NAME ARGUMENTS...
  local name=$1
  shift
  timeout 60 $OMMA capture $CAM --size 640x360 --rate 30 --frames 3 --output "/tmp/$name" "$@" > /tmp/said 2>&1
}
picture own && cat /tmp/own/cam0/*.png > /tmp/own.png
for owner in $HEAP /dev/video2 /dev/video3 /dev/video4 "/dev/$VIMC"; do
  picture lent $DMA "$owner" && [ -s /tmp/own.png ] && cat /tmp/lent/cam0/*.png | cmp /tmp/own.png
  check $? "memory of $owner: the same picture as in the device's own"
  rm -rf /tmp/lent
  timeout 300 $OMMA capture $CAM --size 320x180 --rate 60 --frames $((FRAMES > 200 ? FRAMES : 60)) $DMA "$owner" > /tmp/said 2>&1
  check $? "memory of $owner: $(head -1 /tmp/said)"
done
rm -rf /tmp/own /tmp/own.png

LENT="$CAM --size 320x180 $DMA"
refused "memory of a heap that is not there" "memory_from: expected a DMA heap or a video device" $LENT /dev/dma_heap/none
refused "memory of what has none" "/dev/null: Inappropriate ioctl" $LENT /dev/null
refused "memory of the device itself" "from /dev/video0, found Device or resource busy" $LENT /dev/video0
refused "memory of a device that exports none" "from /dev/video20, found" $LENT /dev/video20
refused "memory without dma-buf" "--memory-from: expected --memory dma-buf" $CAM --size 320x180 --memory-from $HEAP
refused "memory in pieces, for a device that needs one" "those of /dev/video2: Bad address" --camera cam0=v4l2:/dev/video4 --size 640x360 \
  $DMA /dev/video2

# Who lends is in use; who borrows outlives it, and its own loss.
timeout 200 $OMMA capture $LENT "/dev/$VIMC" --rate 30 --frames 200 --timeout-ms 1000 > /tmp/lent 2>&1 &
CAPTURE=$!
sleep 2
refused "a camera whose memory is lent" "found Device or resource busy" --camera "cam1=v4l2:/dev/$VIMC" --format RGB3 --size 640x480
$OMMA cameras /dev/video0 > /tmp/said 2>&1 && says '  memory  not known while another program uses it'
check $? "omma cameras beside it disturbs nothing"
echo vimc.0 > /sys/bus/platform/drivers/vimc/unbind
wait $CAPTURE
check $? "its memory's owner unplugged: $(head -1 /tmp/lent)"
echo vimc.0 > /sys/bus/platform/drivers/vimc/bind
timeout 200 $OMMA capture $LENT $HEAP --rate 30 --frames 150 --timeout-ms 1000 > /tmp/said 2>&1 &
CAPTURE=$!
sleep 2
unplug_and_plug_in "with memory of the heap, "

timeout 300 $OMMA capture --camera a=v4l2:/dev/video0 --camera b=v4l2:/dev/video2 --camera c=v4l2:/dev/video4 --size 640x360 --rate 20 \
  --frames 100 --output /tmp/three > /tmp/said 2>&1
check $? "three cameras to files at once: $(grep -o '^[abc]: .*Hz; lost: .*times' /tmp/said | sed 's/ frames of 640 x 360 px//' | tr '\n' ' ')"
[ "$(ls /tmp/three/?/*.png | wc -l)" = 300 ]
check $? "$(ls /tmp/three/?/*.png | wc -l) files of 300"
