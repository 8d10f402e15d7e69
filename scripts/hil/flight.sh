#!/usr/bin/env bash
# scripts/hil/flight.sh OUTPUT: runs inside the machine (machine.sh). The flight program fires the cameras by a GPIO line of
# the kernel at 10 Hz; at each edge the demo's frames are fed into three video devices of the kernel, where the flight
# program takes them; it publishes over DDS, and a second network namespace listens on the ground's end of a cable. Then
# the same with cameras that miss pulses and are late, which has to be told.
set -uo pipefail
source scripts/hil/checks.sh
source scripts/hil/sync_line.sh
OUTPUT=$1
BIN=build/release/bin
SETS=$([ "${HIL_SHORT:-}" ] && echo 30 || echo 60)
FRAMES=build/hil/frames
modprobe v4l2loopback devices=3 video_nr=10,11,12 card_label=hdr1,cam0,cam2 max_buffers=4 || exit 1
sync_line hil-sync

ip netns add ground
ip link add space0 type veth peer name ground0 netns ground
ip addr add 10.9.0.1/24 dev space0
ip -n ground addr add 10.9.0.2/24 dev ground0
ip link set space0 up
ip -n ground link set ground0 up
ip -n ground link set lo up
dds() { echo "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"$1\"/></Interfaces></General></Domain></CycloneDDS>"; }

# A camera is a machine of its own: nothing on board holds it up.
feed() { # LOG OPTIONS...
  chrt -f 80 $BIN/omma feed $FRAMES --camera hdr1=/dev/video10 --camera cam0=/dev/video11 --camera cam2=/dev/video12 \
    --rate 10 --fired-by "$SYNC_VALUE" --log "$@" > "$OUTPUT/feed.txt" 2>&1 &
  FEED=$!
  until [ -s "$1" ] || ! kill -0 $FEED 2> /dev/null; do sleep 0.1; done
}
end_feed() {
  kill $FEED 2> /dev/null
  wait $FEED
  cat "$OUTPUT/feed.txt"
}

feed "$OUTPUT/fed.csv"
CYCLONEDDS_URI=$(dds ground0) ip netns exec ground $BIN/omma record "$OUTPUT/heard.mcap" --until-idle 5 --seconds 60 \
  > "$OUTPUT/record.txt" 2>&1 &
RECORD=$!
CYCLONEDDS_URI=$(dds space0) $BIN/omma-fsw config/hil.toml --log "$OUTPUT/flown.mcap" --frame-sets "$SETS" \
  > "$OUTPUT/flight.txt" 2>&1
check $? "the flight program ended as it should"
wait $RECORD
end_feed
cat "$OUTPUT/flight.txt" "$OUTPUT/record.txt"
rm -f "$OUTPUT/feed.txt"

# Of 30 pulses, number 10, 20 and 30 are missed by all cameras; frames of number 13 and 26 come 40 ms late.
feed "$OUTPUT/fed_badly.csv" --lose-every 10 --late-every 13
$BIN/omma-fsw config/hil.toml --no-dds --log "$OUTPUT/badly.mcap" --frame-sets 31 > "$OUTPUT/badly.txt" 2>&1
check $? "the flight program ended as it should, with cameras that miss pulses"
end_feed
$BIN/omma export "$OUTPUT/badly.mcap" --out "$OUTPUT/csv" --topic event > /dev/null
told() { grep -c "$1" "$OUTPUT/csv/event.csv"; }
[ "$(told frame_of_no_trigger)" = 6 ]
check $? "$(told frame_of_no_trigger) of 6 late frames named"
# Four times three are to be named (that of number 30 only by the next frame); events of one kind are told eight at once and
# one more a second, which is nine by then.
[ "$(told triggers_without_frame)" = 9 ]
check $? "$(told triggers_without_frame) of 9 pulses without a frame named before the limit of an event's rate"
$BIN/omma export "$OUTPUT/badly.mcap" --out "$OUTPUT/csv" --topic frame_set > /dev/null
[ "$(grep -c FRAME_MISSING "$OUTPUT/csv/frame_set.csv")" = 12 ]
check $? "$(grep -c FRAME_MISSING "$OUTPUT/csv/frame_set.csv") of 12 frames told as missing: of 3 pulses and before the first, of 3 cameras"

# Frames that are there two frame sets too late, with the stamp of their exposure: of 30 pulses those of number 10 and 20 (that of
# number 30 comes after the end). A loopback device stamps by itself: these cameras are the simulated ones.
sed 's/^driver = "v4l2"/driver = "simulated"/' config/hil.toml > config/hil_held.toml
chrt -f 80 $BIN/omma feed $FRAMES --camera hdr1=simulated:hdr1 --camera cam0=simulated:cam0 --camera cam2=simulated:cam2 \
  --rate 10 --fired-by "$SYNC_VALUE" --log "$OUTPUT/fed_held.csv" --hold-every 10 > "$OUTPUT/feed.txt" 2>&1 &
FEED=$!
until [ -s "$OUTPUT/fed_held.csv" ] || ! kill -0 $FEED 2> /dev/null; do sleep 0.1; done
$BIN/omma-fsw config/hil_held.toml --no-dds --log "$OUTPUT/held.mcap" --frame-sets 31 > "$OUTPUT/held.txt" 2>&1
check $? "the flight program ended as it should, with frames that are kept back"
end_feed
$BIN/omma export "$OUTPUT/held.mcap" --out "$OUTPUT/csv" --topic event > /dev/null
[ "$(told camera_frames_unmatched)" = 6 ]
check $? "$(told camera_frames_unmatched) of 6 frames kept back named"
[ "$(told triggers_without_frame)" = 6 ] && [ "$(told frame_of_no_trigger)" = 0 ]
check $? "$(told triggers_without_frame) of 6 pulses named whose frames came too late"
$BIN/omma feed $FRAMES --frames 1 --camera cam0=/dev/video11 --hold-every 3 > /tmp/said 2>&1
[ $? = 2 ] && says '--hold-every: expected cameras of the driver simulated'
check $? "refused, to keep back frames that a device stamps: $(tail -1 /tmp/said | cut -c1-150)"
exit $failed
