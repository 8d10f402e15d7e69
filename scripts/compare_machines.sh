#!/usr/bin/env bash
# compare_machines.sh arm64|armhf [FRAME_SETS]: flies the demo with build/release and, emulated, with the cross-built
# program: the two recordings must be the same bytes. Prints the instructions of a frame set there.
source "$(dirname "$0")/common.sh"
machine=$1
sets=${2:-120}
out=build/demo
case $machine in arm64) emulator=qemu-aarch64 ;; armhf) emulator=qemu-arm ;; esac
emulated="$emulator -L build/sysroot-$machine build/$machine/bin/omma-fsw"
[ -d $out/frames ] || build/release/bin/omma simulate config/demo_scenario.toml --out $out/frames

fly() { # LOG FRAME_SETS PROGRAM...
  "${@:3}" config/demo.toml --frames $out/frames --no-dds --frame-sets "$2" --log "$1" >"$1.txt" 2>&1 ||
    { tail -5 "$1.txt" >&2; exit 1; }
}
say "The demo on this machine and on an emulated $machine: $sets frame sets"
fly $out/native.mcap "$sets" build/release/bin/omma-fsw
fly $out/$machine.mcap "$sets" $emulated
cmp $out/native.mcap $out/$machine.mcap ||
  { build/release/bin/omma compare $out/native.mcap $out/$machine.mcap; exit 1; }
echo "the recordings are the same bytes ($(stat -c%s $out/$machine.mcap))"

say "Instructions"
gcc -shared -fPIC -O2 -o build/$machine/instructions.so scripts/instructions.c
count() { # FRAME_SETS: a line a thread
  QEMU_PLUGIN=file=build/$machine/instructions.so fly $out/count.mcap "$1" $emulated
  grep '^instructions ' $out/count.mcap.txt
}
# Thread 0 steps the components in a replay; the others read the recorded images and write the log.
join -j 2 <(count 20 | sort -k2b,2) <(count 40 | sort -k2b,2) | awk '
  { each = ($5 - $3) / 20e6; if ($1 == 0) steps = each; else rest += each }
  END { printf "a frame set: %.1f million in the steps of the components, %.1f in reading PNG and writing the log\n", steps, rest }'
rm -f $out/count.mcap*
