# Shared by ./run and ./test: install what is missing, configure, build. Sourced, not run.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# The compiler cache serves every clone of the project on this machine alike.
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1

say() { printf '\033[1m==> %s\033[0m\n' "$*"; }

# missing_packages LIST...: names in those files that dpkg does not know as installed.
missing_packages() {
  local name
  grep -hvE '^\s*(#|$)' "$@" | while read -r name; do
    dpkg-query -W -f='${Status}' "$name" 2>/dev/null | grep -q 'ok installed' || echo "$name"
  done
}

# install_packages [LIST...]; packages.txt where none is named
install_packages() {
  local missing sudo=""
  missing=$(missing_packages "${@:-packages.txt}" | tr '\n' ' ')
  [ -z "${missing// /}" ] && return 0
  say "Installing from Debian: $missing"
  if [ "$(id -u)" -ne 0 ]; then sudo="sudo"; fi
  export DEBIAN_FRONTEND=noninteractive
  $sudo apt-get -qq update
  # shellcheck disable=SC2086
  $sudo apt-get -qq -o DPkg::Lock::Timeout=600 install -y --no-install-recommends $missing >/dev/null
}

# build_preset PRESET [TARGET...]
build_preset() {
  local preset=$1
  shift
  say "Building ($preset) in build/$preset"
  [ -f "build/$preset/build.ninja" ] || cmake --preset "$preset" >/dev/null
  cmake --build --preset "$preset" ${1:+--target "$@"}
}

# cross_build arm64|armhf all|flight [TARGET]: the sysroot where there is none, then the cross-build; `flight` without
# the ground tools
cross_build() {
  local machine=$1 ground=ON
  if [ "$2" = flight ]; then ground=OFF; fi
  install_packages packages.txt packages-cross.txt
  scripts/cross_sysroot.sh "$machine" "build/sysroot-$machine"
  cmake --preset "$machine" -DOMMA_GROUND=$ground >/dev/null
  build_preset "$machine" "${@:3}"
}
