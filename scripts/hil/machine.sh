#!/usr/bin/env bash
# scripts/hil/machine.sh [-t SECONDS] [-w FOLDER] [-i FOLDER] -- COMMAND...: boots the machine made by kernel.sh and root.sh,
# runs the command in it as root in this folder, prints what it says, and exits with its status. -i: this folder, too, lies
# in its memory; -w: what the command leaves in this folder is here afterwards.
#
# The processor is emulated, and its time is counted in its own instructions, one a nanosecond: a computer of one
# thousand million instructions a second, like the core of a small ARM board. How busy this machine is makes a run
# longer, but changes nothing in it: time flies while it has nothing to execute, so nothing in it may wait for this side.
set -uo pipefail
cd "$(dirname "$0")/../.."
FOLDER=$PWD/build/hil
SECONDS_MOST=600
OUTPUT=""
IMAGES=()
while [ $# -gt 0 ]; do
  case $1 in
    -t) SECONDS_MOST=$2; shift 2 ;;
    -w) OUTPUT=$(realpath "$2"); shift 2 ;;
    -i) IMAGES+=("$(realpath "$2")"); shift 2 ;;
    --) shift; break ;;
    *) break ;;
  esac
done
SHARE=$(mktemp -d)
trap 'rm -rf "$SHARE"' EXIT
printf '%q ' "$@" > "$SHARE/command"
cat > "$SHARE/guest.sh" <<X
for port in /dev/vport*p1; do exec </dev/null >\$port 2>&1; break; done
modprobe -q configfs; mount -t configfs none /sys/kernel/config 2>/dev/null
mount -t debugfs none /sys/kernel/debug 2>/dev/null
ip link set lo up
echo 4 4 1 7 > /proc/sys/kernel/printk
mkdir -p '$PWD/build' '${OUTPUT:-/tmp}'
cd '$PWD'
( eval "\$(cat /hil/command)" )
echo \$? > /hil/status.new
[ -z '$OUTPUT' ] || cp -r '$OUTPUT/.' /hil/output
mv /hil/status.new /hil/status; sync
echo o > /proc/sysrq-trigger; sleep 60
X
mkdir "$SHARE/output"
cp "$FOLDER/root.cpio" "$SHARE/initrd"
for image in "${IMAGES[@]}"; do
  # Another archive after the first; its folder is in it as well.
  mkdir -p "$SHARE/more${image%/*}" && cp -r "$image" "$SHARE/more${image%/*}"
  (cd "$SHARE/more" && find . | cpio -o -H newc --quiet) >> "$SHARE/initrd"
  rm -r "$SHARE/more"
done

timeout "$SECONDS_MOST" qemu-system-x86_64 -M q35 -accel tcg,thread=single -icount shift=0,sleep=off \
  -cpu max,-la57,-pcid,-smap,-smep -smp 1 -m 1536 -nodefaults -display none -no-reboot \
  -kernel "$FOLDER/vmlinuz" -initrd "$SHARE/initrd" \
  -append "console=ttyS0 quiet panic=-1 tsc=reliable mitigations=off nokaslr no_timer_check" \
  -serial "file:$SHARE/console" -device virtio-serial-pci -chardev file,id=out,path=/dev/stdout,append=on \
  -device virtserialport,chardev=out,name=out -device virtio-rng-pci \
  -virtfs "local,path=$SHARE,mount_tag=share,security_model=none,multidevs=remap" </dev/null | cat
EMULATOR=${PIPESTATUS[0]}
[ -z "$OUTPUT" ] || cp -r "$SHARE/output/." "$OUTPUT"
[ -s "$SHARE/status" ] && exit "$(cat "$SHARE/status")"
if [ "$EMULATOR" = 124 ]; then echo "machine: not ready after $SECONDS_MOST s" >&2; else
  echo "machine: ended without a status; its console:" >&2
  tail -20 "$SHARE/console" >&2
fi
exit 125
