#!/usr/bin/env bash
# scripts/hil/run.sh [short] [drivers|libcamera|lines|watchdog|lab|flight]...: `./test hil`. Makes the machine where there is none, then
# every part of the test in a machine of its own; short: fewer frames, for continuous integration. A part NAME is NAME.sh, which
# runs inside; NAME.before.sh, where there is one, makes what it needs, and NAME.after.sh judges on this side what it wrote
# into build/hil/NAME. Skipped with a sentence where it cannot be done.
set -uo pipefail
cd "$(dirname "$0")/../.."
skip() { echo "hil: $1; not tested"; exit 0; }
command -v qemu-system-x86_64 >/dev/null || skip "no qemu-system-x86_64 here"
[ "$(dpkg --print-architecture)" = amd64 ] || skip "the machine is made for amd64"
scripts/hil/kernel.sh > build/hil.kernel.log 2>&1 || skip "the kernel cannot be had ($(tail -1 build/hil.kernel.log))"
scripts/hil/root.sh || exit 1
failed=0
if [ "${1:-}" = short ]; then
  export HIL_SHORT=short
  shift
fi
[ $# -gt 0 ] || set -- drivers libcamera lines watchdog lab flight
for part; do
  OUTPUT=$PWD/build/hil/$part
  rm -rf "$OUTPUT"
  mkdir -p "$OUTPUT"
  [ ! -x "scripts/hil/$part.before.sh" ] || "scripts/hil/$part.before.sh" "$OUTPUT" || failed=1
  begin=$SECONDS
  frames=()
  case $part in watchdog | lab | flight) frames=(-i build/hil/frames) ;; esac
  scripts/hil/machine.sh -t "${HIL_SECONDS:-900}" -w "$OUTPUT" "${frames[@]}" -- \
    env HIL_SHORT="${HIL_SHORT:-}" "scripts/hil/$part.sh" "$OUTPUT"
  status=$?
  [ ! -x "scripts/hil/$part.after.sh" ] || "scripts/hil/$part.after.sh" "$OUTPUT" || status=1
  echo "hil: $part $([ $status = 0 ] && echo passed || echo FAILED) in $((SECONDS - begin)) s"
  [ $status = 0 ] || failed=1
done
exit $failed
