#!/usr/bin/env bash
# scripts/hil/machine.sh [-t SECONDS] [-w FOLDER]... -- COMMAND...: boots the machine made by kernel.sh, runs the
# command in it as root in this folder, prints what it says, and exits with its status. Files are this machine's,
# read-only; what is written stays in memory, but for the folders given with -w.
#
# The processor is emulated, and its time is counted in its own instructions, one a nanosecond: a computer of one
# thousand million instructions a second, like the core of a small ARM board. How busy this machine is makes a run
# longer, but changes nothing in it.
set -uo pipefail
cd "$(dirname "$0")/../.."
FOLDER=$PWD/build/hil
SECONDS_MOST=600
WRITABLE=()
while [ $# -gt 0 ]; do
  case $1 in
    -t) SECONDS_MOST=$2; shift 2 ;;
    -w) WRITABLE+=("$(realpath "$2")"); shift 2 ;;
    --) shift; break ;;
    *) break ;;
  esac
done
SHARE=$(mktemp -d)
trap 'rm -rf "$SHARE"' EXIT
printf '%q ' "$@" > "$SHARE/command"
P9=trans=virtio,version=9p2000.L,msize=262144
{
  cat <<X
export PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8
for port in /dev/vport*p1; do exec </dev/null >\$port 2>&1; break; done
mkdir -p /lib/modules
mount -t 9p -o ro,$P9,cache=loose modules /lib/modules
modprobe -q configfs; mount -t configfs none /sys/kernel/config 2>/dev/null
mount -t debugfs none /sys/kernel/debug 2>/dev/null
ip link set lo up
echo 4 4 1 7 > /proc/sys/kernel/printk
X
  for i in "${!WRITABLE[@]}"; do
    echo "mkdir -p '${WRITABLE[i]}'; mount -t 9p -o rw,$P9,cache=none writable$i '${WRITABLE[i]}'"
  done
  cat <<X
cd '$PWD'
( eval "\$(cat /hil/command)" )
echo \$? > /hil/status; sync
echo o > /proc/sysrq-trigger; sleep 60
X
} > "$SHARE/guest.sh"
DISKS=()
share() { DISKS+=(-virtfs "local,path=$1,mount_tag=$2,security_model=none,multidevs=remap${3:-}"); }
share / root ,readonly=on
share "$FOLDER/root/lib/modules" modules ,readonly=on
share "$SHARE" share
for i in "${!WRITABLE[@]}"; do share "${WRITABLE[i]}" "writable$i"; done

timeout "$SECONDS_MOST" qemu-system-x86_64 -M q35 -accel tcg,thread=single -icount shift=0,sleep=off \
  -cpu max,-la57,-pcid,-smap,-smep -smp 1 -m 1536 -nodefaults -display none -no-reboot \
  -kernel "$FOLDER/vmlinuz" -initrd "$FOLDER/initrd.gz" \
  -append "console=ttyS0 quiet panic=-1 tsc=reliable mitigations=off nokaslr no_timer_check" \
  -serial "file:$SHARE/console" -device virtio-serial-pci -chardev file,id=out,path=/dev/stdout,append=on \
  -device virtserialport,chardev=out,name=out -device virtio-rng-pci "${DISKS[@]}" </dev/null | cat
EMULATOR=${PIPESTATUS[0]}
[ -s "$SHARE/status" ] && exit "$(cat "$SHARE/status")"
if [ "$EMULATOR" = 124 ]; then echo "machine: not ready after $SECONDS_MOST s" >&2; else
  echo "machine: ended without a status; its console:" >&2
  tail -20 "$SHARE/console" >&2
fi
exit 125
