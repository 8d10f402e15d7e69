#!/usr/bin/env bash
# scripts/hil/lines.sh: inside the machine, the lines that go out to the lab: the trigger on a simulated GPIO line, its
# pulses dated by the kernel's own trace, and servos over USB, with chips and cables that go and come.
set -uo pipefail
[ -d /sys/kernel/tracing/events ] || mount -t tracefs none /sys/kernel/tracing
modprobe gpio-sim || exit 1
OMMA_HIL=1 build/release/tests/kernel_devices_test
