#!/usr/bin/env bash
# scripts/hil/kernel.sh [FOLDER]: the kernel of the machine for `./test hil`, in build/hil unless another folder is
# given. Debian's kernel package unpacked, not installed; the drivers that Debian does not ship built beside it
# (modules.sh); a small initramfs whose root is this machine's own, read-only. Leaves what is there already.
set -euo pipefail
cd "$(dirname "$0")/../.."
FOLDER=$(realpath -m "${1:-build/hil}")
HERE=$PWD/scripts/hil
[ -f "$FOLDER/initrd.gz" ] && exit 0

PACKAGE=$(apt-cache depends linux-image-amd64 | sed -n 's/^ *Depends: \(linux-image-6[^ :]*\).*/\1/p' | head -1)
[ -n "$PACKAGE" ] || { echo "no linux-image-amd64 among this machine's packages" >&2; exit 1; }
RELEASE=${PACKAGE#linux-image-}
mkdir -p "$FOLDER/downloads" "$FOLDER/root"
echo "$RELEASE" > "$FOLDER/release"

cd "$FOLDER/downloads"
for name in "$PACKAGE" "linux-headers-$RELEASE" "linux-headers-${RELEASE%-amd64}-common" linux-source-6.1 v4l2loopback-dkms; do
  compgen -G "${name}_*.deb" >/dev/null || apt-get -qq download "$name"
done
dpkg-deb --fsys-tarfile "$PACKAGE"_*.deb | tar -x -C "$FOLDER/root" ./boot ./lib/modules
cp "$FOLDER/root/boot/vmlinuz-$RELEASE" "$FOLDER/vmlinuz"
"$HERE/modules.sh" "$FOLDER" "$RELEASE"

# The initramfs: busybox, and what it takes to mount the root.
I=$(mktemp -d)
trap 'rm -rf "$I"' EXIT
mkdir -p "$I"/{bin,modules,proc,sys,dev,lower,upper,newroot}
install -m 755 /bin/busybox "$I/bin/busybox"
install -m 755 "$HERE/init" "$I/init"
for module in virtio_pci virtio_console 9pnet_virtio 9p overlay virtio_rng; do
  modprobe -d "$FOLDER/root" -S "$RELEASE" --show-depends $module 2>/dev/null | awk '$1 == "insmod" { print $2 }'
done | awk '!seen[$0]++' | while read -r file; do
  cp "$file" "$I/modules/"
  basename "$file" >> "$I/modules/order"
done
strip --strip-debug "$I"/modules/*.ko
(cd "$I" && find . | cpio -o -H newc --quiet | gzip -1) > "$FOLDER/initrd.gz.new"
mv "$FOLDER/initrd.gz.new" "$FOLDER/initrd.gz"
