#!/usr/bin/env bash
# scripts/hil/root.sh [FOLDER]: everything that runs in the machine of `./test hil`, as one archive that lies in its memory
# from the start (FOLDER/root.cpio, build/hil unless given): the programs of build/release and the few of this system that
# the parts use, with their libraries, and the drivers.
#
# In memory, because the machine's time is counted in instructions and flies while it has none to execute: a
# file read from this side while this side is busy took minutes of the machine's time, and programs in it ran out of theirs.
set -euo pipefail
cd "$(dirname "$0")/../.."
FOLDER=$(realpath -m "${1:-build/hil}")
RELEASE=$(cat "$FOLDER/release")
PROJECT=$PWD
TOOLS="bash env cat dmesg chmod chrt cp cut date grep head ip kmod ln ls mkdir modprobe mount mv awk cmp ps readlink rm rmmod sed seq sh sleep sort sync tail
  timeout touch tr umount v4l2-ctl wc"
DRIVERS="virtio_pci virtio_console 9pnet_virtio 9p virtio_rng vivid v4l2loopback vimc gpio-sim dummy_hcd cdc_acm g_serial usb_f_acm veth softdog dma_heaps"

I=$(mktemp -d)
trap 'rm -rf "$I"' EXIT
mkdir -p "$I"/usr/{bin,sbin,lib,lib64} "$I"/{proc,sys,dev,tmp,run,hil,root,etc,var} "$I$PROJECT/build/release/tests"
for folder in bin sbin lib lib64; do ln -s "usr/$folder" "$I/$folder"; done
ln -s /run "$I/var/run"
install -m 755 scripts/hil/init "$I/init"
cp /etc/ld.so.cache /etc/passwd /etc/group /etc/nsswitch.conf "$I/etc"

programs=()
for tool in $TOOLS; do programs+=("$(command -v "$tool")"); done
programs+=("$PROJECT"/build/release/bin/omma*)
for test in kernel_devices_test linux_watchdog_test; do programs+=("$PROJECT/build/release/tests/$test"); done
shopt -s nullglob
libcamera=(/usr/lib/*/libcamera/*.so /usr/lib/*/libcamera/*_proxy)
copied() { for file; do [ ! -e "$file" ] || cp -L --parents "$file" "$I"; done; }
copied "${programs[@]}" "${libcamera[@]}" /lib64/ld-linux-x86-64.so.2
cp "$FOLDER/root/bin/udevadm" "$I/usr/bin"
ln -s udevadm "$I/usr/bin/systemd-udevd"
programs+=("$FOLDER/root/bin/udevadm")
{ ldd "${programs[@]}" "${libcamera[@]}" 2>/dev/null || true; } | awk '/=> \// { print $3 }' | sort -u | while read -r library; do copied "$library"; done
[ ! -d /usr/share/libcamera ] || cp -r --parents /usr/share/libcamera "$I"
cp -r --parents scripts config "$I$PROJECT"

for driver in $DRIVERS; do
  { modprobe -d "$FOLDER/root" -S "$RELEASE" --show-depends "$driver" 2>/dev/null || true; } | awk '$1 == "insmod" { print $2 }'
done | sort -u | while read -r file; do
  mkdir -p "$(dirname "$I/usr/${file#"$FOLDER/root/"}")"
  cp "$file" "$I/usr/${file#"$FOLDER/root/"}"
done
cp "$FOLDER/root/lib/modules/$RELEASE"/modules.{builtin,builtin.modinfo,order} "$I/usr/lib/modules/$RELEASE"
find "$I/usr/lib/modules" -name '*.ko' -exec strip --strip-debug {} +
depmod -b "$I" "$RELEASE"
(cd "$I" && find . | cpio -o -H newc --quiet) > "$FOLDER/root.cpio.new"
mv "$FOLDER/root.cpio.new" "$FOLDER/root.cpio"
