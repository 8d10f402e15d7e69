#!/usr/bin/env bash
# scripts/hil/watchdog.sh OUTPUT: inside the machine, the kernel's software watchdog, told to say so instead of resetting: the
# driver; then the flight program, which strokes it as long as its critical rate groups meet their deadlines, and no longer.
set -uo pipefail
source scripts/hil/checks.sh
OUTPUT=$1
W=/sys/class/watchdog/watchdog0
modprobe softdog soft_noboot=1 || exit 1
bites() { dmesg | grep -c 'softdog: Triggered'; }

OMMA_WATCHDOG=/dev/watchdog0 build/release/tests/linux_watchdog_test > /tmp/said 2>&1 && ! says SKIPPED
check $? "time-out, stroke and magic close: $(grep -c '  OK ' /tmp/said) tests"
BEFORE=$(bites)

# A mission whose frames are recorded, in real time, for as long as it takes.
build/release/bin/omma-fsw config/lab.toml --frames build/hil/frames --rounds 10 --real-time --no-dds --watchdog /dev/watchdog0 \
  --watchdog-timeout 2 --log "$OUTPUT/watchdog.mcap" > "$OUTPUT/flight.txt" 2>&1 &
FLIGHT=$!
until [ "$(cat $W/state)" = active ]; do sleep 0.2; kill -0 $FLIGHT 2>/dev/null || break; done
sleep 6
[ "$(cat $W/state)" = active ] && [ "$(bites)" = "$BEFORE" ]
check $? "armed, and stroked for three times its time-out"

# The processor is taken away from the program by something that nothing on board can stop.
echo -1 > /proc/sys/kernel/sched_rt_runtime_us
chrt -f 98 bash -c 'end=$((SECONDS + 5)); while [ $SECONDS -lt $end ]; do :; done'
sleep 1
[ "$(bites)" -gt "$BEFORE" ]
check $? "without the processor for 5 s: it would have reset the computer ($(dmesg | grep 'softdog: Triggered' | tail -1 | cut -c1-60))"
BITTEN=$(bites)
sleep 6
[ "$(bites)" = "$BITTEN" ] && kill -0 $FLIGHT
check $? "stroked again once the groups keep their deadlines"
kill -INT $FLIGHT
wait $FLIGHT
check $? "the flight program ended as it should"
[ "$(cat $W/state)" = inactive ]
check $? "and has disarmed it"
build/release/bin/omma export "$OUTPUT/watchdog.mcap" --out "$OUTPUT/csv" --topic event > /dev/null
grep -q stroke_withheld "$OUTPUT/csv/event.csv"
check $? "strokes withheld are events: $(grep -c stroke_withheld "$OUTPUT/csv/event.csv")"
tail -3 "$OUTPUT/flight.txt"
exit $failed
