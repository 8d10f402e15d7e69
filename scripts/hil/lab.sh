#!/usr/bin/env bash
# scripts/hil/lab.sh OUTPUT: inside the machine, config/lab.toml with trigger and servos switched from simulated to real by
# one word each: the flight program fires a GPIO line of the kernel and moves a board on a USB serial line, is stopped in an
# emergency, and says so in its recording. The cameras' frames are recorded ones.
set -uo pipefail
OUTPUT=$1
BIN=build/release/bin
SETS=${LAB_FRAME_SETS:-24}
T=/sys/kernel/tracing
[ -d $T/events ] || mount -t tracefs none $T

source scripts/hil/checks.sh
source scripts/hil/sync_line.sh
sync_line lab-sync
modprobe dummy_hcd && modprobe cdc_acm &&
  modprobe g_serial idVendor=0x1ffb idProduct=0x008a iManufacturer="Pololu Corporation" || exit 1
for _ in $(seq 100); do [ -e /dev/ttyACM0 ] && break; sleep 0.05; done

cp -r config "$OUTPUT/config"
sed -i -e '/^\[trigger\]/,/^\[/ s/^driver = "simulated"/driver = "gpiod"/' \
  -e 's/^chip = .*/chip = "lab-sync"/' \
  -e '/^\[motion\]/,/^\[/ s/^driver = "simulated"/driver = "maestro"/' "$OUTPUT/config/lab.toml"
$BIN/omma servo-board --device /dev/ttyGS0 --every 2 > "$OUTPUT/board.txt" 2>&1 &
BOARD=$!
sleep 1
echo mono > $T/trace_clock
echo > $T/trace
echo 1 > $T/events/gpio/gpio_value/enable
$BIN/omma-fsw "$OUTPUT/config/lab.toml" --frames build/hil/frames --no-dds --frame-sets "$SETS" --log "$OUTPUT/lab.mcap" \
  > "$OUTPUT/flight.txt" 2>&1 &
FLIGHT=$!
until grep -q '[1-9][0-9][0-9] commands' "$OUTPUT/board.txt"; do sleep 0.2; kill -0 $FLIGHT 2>/dev/null || break; done
sleep 6
kill -USR2 $FLIGHT
wait $FLIGHT
check $? "the flight program ended as it should"
echo 0 > $T/events/gpio/gpio_value/enable
kill $BOARD
wait $BOARD

PULSES=$(grep -c 'gpio_value: .* set 1' $T/trace)
[ "$PULSES" = "$SETS" ]
check $? "$PULSES pulses seen by the kernel for $SETS frame sets"
grep 'gpio_value' $T/trace | sed 's/.* \([0-9.]*\): gpio_value: [0-9]* set \([01]\).*/\1 \2/' | awk '
  $2 == 1 { if (last) { d = ($1 - last) * 1e3; n++; sum += d; if (d > most) most = d; if (least == "" || d < least) least = d } last = $1 }
  $2 == 0 && last { w = ($1 - last) * 1e3; widths++; wide += w; if (w > widest) widest = w }
  END { printf "      period: mean %.3f ms, %.3f to %.3f; width: mean %.3f ms, at most %.3f\n", sum / n, least, most, wide / widths, widest
        exit !(sum / n > 539.9 && sum / n < 540.1 && wide / widths > 0.99) }'
check $? "540 ms apart and 1 ms wide"
tail -1 "$OUTPUT/board.txt" | grep -q 'commands heard, protocol errors: none; last  no pulses'
check $? "the board at the end: $(tail -1 "$OUTPUT/board.txt")"
$BIN/omma export "$OUTPUT/lab.mcap" --out "$OUTPUT/csv" --topic motion --topic event > /dev/null
grep -q MOTION_RUNNING "$OUTPUT/csv/motion.csv" && grep -q MOTION_STOPPED "$OUTPUT/csv/motion.csv"
check $? "telemetry has the axes running, then stopped: $(awk -F, '$5 == "MOTION_RUNNING"' "$OUTPUT/csv/motion.csv" | wc -l) axis angles commanded"
grep -q emergency_stop "$OUTPUT/csv/event.csv"
check $? "and the emergency stop as an event"
cat "$OUTPUT/flight.txt"

# The same frames again with recorded axes: they tell what the real ones were told, but for the time.
sed -i -e '/^\[motion\]/,/^\[/ s/^driver = "maestro"/driver = "recorded"/' \
  -e '/^\[trigger\]/,/^\[/ s/^driver = "gpiod"/driver = "simulated"/' -e "s|^recording = .*|recording = \"$OUTPUT/lab.mcap\"|" \
  "$OUTPUT/config/lab.toml"
$BIN/omma-fsw "$OUTPUT/config/lab.toml" --frames build/hil/frames --no-dds --frame-sets "$SETS" --log "$OUTPUT/again.mcap" \
  > /tmp/said 2>&1
check $? "the flight program ended as it should, with recorded axes"
$BIN/omma export "$OUTPUT/again.mcap" --out "$OUTPUT/again" --topic motion > /dev/null
told() { awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) left_out[i] = $i ~ /^time_ns|^time_s|sample_number/ }
  { line = ""; for (i = 1; i <= NF; i++) if (!left_out[i]) line = line "," $i; print line }' "$1/motion.csv"; }
[ -n "$(told "$OUTPUT/csv")" ] && [ "$(told "$OUTPUT/csv")" = "$(told "$OUTPUT/again")" ]
check $? "recorded axes tell the same: $(told "$OUTPUT/again" | wc -l) lines of the telemetry"
exit $failed
