#!/usr/bin/env bash
# The demo, after the build: renders the frames (once), flies them while the monitor listens over DDS, and
# compares what was found with the truth. Everything it makes lies in build/demo.
source "$(dirname "$0")/common.sh"
omma=build/release/bin/omma
out=build/demo

say "Rendering the demo's frames: the rig turns under the real sky while a docking card approaches"
$omma simulate config/demo_scenario.toml --out $out/frames

say "omma-fsw replays them; omma monitor listens"
$omma monitor --seconds 6 --plain >$out/monitor.txt 2>&1 &
monitor=$!
build/release/bin/omma-fsw config/demo.toml --frames $out/frames --log $out/demo.mcap
wait $monitor || true
# The last table it printed while samples were coming in.
awk '/frame sets\/s/ { if (table != "" && table !~ /STALE/) last = table; table = "" } { table = table $0 "\n" }
     END { if (table !~ /STALE/) last = table; printf "%s", last }' $out/monitor.txt

say "What was found, beside the truth"
$omma report $out/demo.mcap --frames $out/frames --mission config/demo.toml --output $out/report
