#!/usr/bin/env bash
# scripts/hil/run.sh [drivers|libcamera|lines|lab|flight]...: `./test hil`. Makes the machine where there is none, then every part of the
# test in a machine of its own. A part NAME is NAME.sh, which runs inside, and NAME.after.sh where there is one, which
# judges on this side what it wrote into build/hil/NAME. Skipped with a sentence where it cannot be done.
set -uo pipefail
cd "$(dirname "$0")/../.."
skip() { echo "hil: $1; not tested"; exit 0; }
command -v qemu-system-x86_64 >/dev/null || skip "no qemu-system-x86_64 here"
[ "$(dpkg --print-architecture)" = amd64 ] || skip "the machine is made for amd64"
scripts/hil/kernel.sh > build/hil.kernel.log 2>&1 || skip "the kernel cannot be had ($(tail -1 build/hil.kernel.log))"
failed=0
[ $# -gt 0 ] || set -- drivers libcamera lines lab flight
for part; do
  OUTPUT=$PWD/build/hil/$part
  rm -rf "$OUTPUT"
  mkdir -p "$OUTPUT"
  [ ! -x "scripts/hil/$part.before.sh" ] || "scripts/hil/$part.before.sh" "$OUTPUT" || failed=1
  begin=$SECONDS
  scripts/hil/machine.sh -t "${HIL_SECONDS:-900}" -w "$OUTPUT" -- "scripts/hil/$part.sh" "$OUTPUT"
  status=$?
  [ ! -x "scripts/hil/$part.after.sh" ] || "scripts/hil/$part.after.sh" "$OUTPUT" || status=1
  echo "hil: $part $([ $status = 0 ] && echo passed || echo FAILED) in $((SECONDS - begin)) s"
  [ $status = 0 ] || failed=1
done
exit $failed
