#!/usr/bin/env bash
# cross_sysroot.sh ARCHITECTURE FOLDER: libraries and headers of a Debian of that architecture (arm64, armhf),
# downloaded and unpacked. Nothing foreign is installed here and apt of this machine keeps its architectures: lists,
# state and cache are a folder of their own.
source "$(dirname "$0")/common.sh"
architecture=$1
sysroot=$(realpath -m "$2")
work=$sysroot.apt
packages="libc6-dev libstdc++-12-dev linux-libc-dev libeigen3-dev cyclonedds-dev libtomlplusplus-dev libspng-dev
  libjpeg62-turbo-dev libcfitsio-dev libyaml-cpp-dev libzstd-dev liberfa-dev libgpiod-dev libcli11-dev nlohmann-json3-dev libncurses-dev
  libcairo2-dev libmicrohttpd-dev librsvg2-dev libopencv-calib3d-dev libgtest-dev libgmock-dev libbenchmark-dev"
[ -e "$sysroot/.complete" ] && [ "$(cat "$sysroot/.complete")" = "$packages" ] && exit 0

say "Sysroot: $architecture packages into $sysroot"
mkdir -p "$work"/{lists/partial,archives/partial} "$sysroot"/usr/{bin,sbin,lib}
: >"$work/status"  # nothing is installed there: the whole closure comes, libc included
options=(-qq -y -o Debug::NoLocking=1 -o APT::Architecture="$architecture" -o APT::Architectures::="$architecture"
  -o APT::Sandbox::User=root -o Dir::State::status="$work/status" -o Dir::State::lists="$work/lists"
  -o Dir::Cache::archives="$work/archives" -o Dir::Cache::pkgcache="" -o Dir::Cache::srcpkgcache="")
# shellcheck disable=SC2086
# An index that cannot be had (a mirror in mid-update) matters only where a package is missing for it.
{ apt-get "${options[@]}" update || true; apt-get "${options[@]}" -o APT::Get::Download-Only=true \
  --no-install-recommends install $(printf "%s:$architecture " $packages); } >"$work/log" 2>&1 ||
  { tail -20 "$work/log" >&2; exit 1; }
for folder in bin sbin lib; do [ -e "$sysroot/$folder" ] || ln -s usr/$folder "$sysroot/$folder"; done
for package in "$work"/archives/*.deb; do
  dpkg-deb --fsys-tarfile "$package" | tar -x -C "$sysroot" --keep-directory-symlink \
    --exclude=./usr/share/doc --exclude=./usr/share/man --exclude=./usr/share/locale
done
# What Debian's alternatives would have linked (OpenCV's core needs them).
library=$(echo "$sysroot"/usr/lib/*-linux-gnu*)
ln -sf lapack/liblapack.so.3 blas/libblas.so.3 "$library"
# Absolute links would lead out of the sysroot.
find "$sysroot" -type l -lname '/*' | while read -r link; do
  ln -sfn "$(realpath -m --relative-to="$(dirname "$link")" "$sysroot$(readlink "$link")")" "$link"
done
rm -rf "$work/archives"
echo "$packages" >"$sysroot/.complete"
