#!/usr/bin/env bash
# scripts/hil/flight.sh OUTPUT: runs inside the machine (machine.sh). The demo's frames are fed into three video
# devices of the kernel at 10 Hz; the flight program takes them there and publishes over DDS; a second network
# namespace listens on the ground's end of a cable.
set -uo pipefail
source scripts/hil/checks.sh
OUTPUT=$1
BIN=build/release/bin
FRAMES=build/hil/frames
modprobe v4l2loopback devices=3 video_nr=10,11,12 card_label=hdr1,cam0,cam2 max_buffers=4 || exit 1

ip netns add ground
ip link add space0 type veth peer name ground0 netns ground
ip addr add 10.9.0.1/24 dev space0
ip -n ground addr add 10.9.0.2/24 dev ground0
ip link set space0 up
ip -n ground link set ground0 up
ip -n ground link set lo up
dds() { echo "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"$1\"/></Interfaces></General></Domain></CycloneDDS>"; }

# A camera is a machine of its own: nothing on board holds it up.
chrt -f 80 $BIN/omma feed $FRAMES --camera hdr1=/dev/video10 --camera cam0=/dev/video11 --camera cam2=/dev/video12 \
  --rate 10 --frames 100 --log "$OUTPUT/fed.csv" > "$OUTPUT/feed.txt" 2>&1 &
FEED=$!
CYCLONEDDS_URI=$(dds ground0) ip netns exec ground $BIN/omma record "$OUTPUT/heard.mcap" --until-idle 5 --seconds 60 \
  > "$OUTPUT/record.txt" 2>&1 &
RECORD=$!
until [ -s "$OUTPUT/fed.csv" ] || ! kill -0 $FEED 2>/dev/null; do sleep 0.1; done
CYCLONEDDS_URI=$(dds space0) $BIN/omma-fsw config/hil.toml --log "$OUTPUT/flown.mcap" --frame-sets "${FRAME_SETS:-60}" \
  > "$OUTPUT/flight.txt" 2>&1
status=$?
wait $RECORD
kill $FEED 2>/dev/null
wait $FEED
cat "$OUTPUT/feed.txt" "$OUTPUT/flight.txt" "$OUTPUT/record.txt"
exit $status
