#!/usr/bin/env bash
# scripts/hil/kernel.sh [FOLDER]: the kernel of the machine for `./test hil`, in build/hil unless another folder is
# given. Debian's kernel and udev packages unpacked, not installed; the drivers that Debian does not ship built beside it
# (modules.sh). Leaves what is there already; what runs on it is root.sh's.
set -euo pipefail
cd "$(dirname "$0")/../.."
FOLDER=$(realpath -m "${1:-build/hil}")
HERE=$PWD/scripts/hil
# Anew where the drivers are others.
[ "$FOLDER/made" -nt "$HERE/modules.sh" ] && exit 0

PACKAGE=$(apt-cache depends linux-image-amd64 | sed -n 's/^ *Depends: \(linux-image-6[^ :]*\).*/\1/p' | head -1)
[ -n "$PACKAGE" ] || { echo "no linux-image-amd64 among this machine's packages" >&2; exit 1; }
RELEASE=${PACKAGE#linux-image-}
mkdir -p "$FOLDER/downloads" "$FOLDER/root"
echo "$RELEASE" > "$FOLDER/release"

cd "$FOLDER/downloads"
for name in "$PACKAGE" "linux-headers-$RELEASE" "linux-headers-${RELEASE%-amd64}-common" linux-source-6.1 v4l2loopback-dkms udev; do
  compgen -G "${name}_*.deb" >/dev/null || apt-get -qq download "$name"
done
dpkg-deb --fsys-tarfile "$PACKAGE"_*.deb | tar -x -C "$FOLDER/root" ./boot ./lib/modules
dpkg-deb --fsys-tarfile udev_*.deb | tar -x -C "$FOLDER/root" ./bin/udevadm
cp "$FOLDER/root/boot/vmlinuz-$RELEASE" "$FOLDER/vmlinuz"
"$HERE/modules.sh" "$FOLDER" "$RELEASE"

touch "$FOLDER/made"
