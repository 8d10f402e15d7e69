#!/usr/bin/env bash
# The flight program under the systemd of this machine, started as process 1 of namespaces of its own over a copy of
# the root that is thrown away: config/omma-fsw.service as it is installed, but for a recording instead of cameras.
# scripts/systemd/inside.sh says what is checked. Needs root and build/release; ends with 77 where it cannot be done.
set -euo pipefail
cd "$(dirname "$0")/../.."

if [ "${1:-}" != inside ]; then
  [ "$(id -u)" -eq 0 ] && [ -x /lib/systemd/systemd ] && unshare --mount --pid --fork --uts --ipc true 2>/dev/null || {
    echo "systemd: no root, no systemd, or no namespaces here; not checked"
    exit 77
  }
  OMMA_SHARED=$(mktemp -d)
  export OMMA_SHARED
  trap 'rm -rf "$OMMA_SHARED"' EXIT
  build/release/bin/omma simulate config/demo_scenario.toml --frames 20 --out "$OMMA_SHARED/frames" >/dev/null
  chmod -R a+rX "$OMMA_SHARED" # the program runs as a user of its own
  code=0
  timeout 120 unshare --mount --pid --fork --uts --ipc --propagation private "$0" inside || code=$?
  cat "$OMMA_SHARED/told" 2>/dev/null || echo "systemd: did not come up (exit code $code)"
  exit "$code"
fi

scratch=$OMMA_SHARED/scratch
root=$scratch/root
mkdir "$scratch"
mount -t tmpfs tmpfs "$scratch"
mkdir "$scratch/changed" "$scratch/work" "$root"
mount -t overlay -o "lowerdir=/,upperdir=$scratch/changed,workdir=$scratch/work" overlay "$root" || exit 77
mount -t proc proc "$root/proc"
mount --rbind /sys "$root/sys"
mount --rbind /dev "$root/dev"
mount -t tmpfs tmpfs "$root/run"
mount --bind "$OMMA_SHARED" "$root/mnt"

install -D build/release/bin/omma-fsw "$root/usr/bin/omma-fsw"
install -D build/release/bin/omma "$root/usr/bin/omma"
mkdir -p "$root/etc/omma" "$root/run/systemd/system/omma-fsw.service.d"
cp -r config/. "$root/etc/omma"
cp config/demo.toml "$root/etc/omma/mission.toml"
install -m 644 config/omma-fsw.service "$root/run/systemd/system/omma-fsw.service"
cat >"$root/run/systemd/system/omma-fsw.service.d/recording.conf" <<'UNIT'
[Unit]
DefaultDependencies=no
After=
[Service]
WatchdogSec=3
ExecStart=
ExecStart=/usr/bin/omma-fsw /etc/omma/mission.toml --parameters parameters --events events.ring --frames /mnt/frames --real-time --rounds 100000 --no-dds
# Written as it ends: asked for afterwards, the reason is gone as soon as the next run is up.
ExecStopPost=+/bin/sh -c 'echo "$$SERVICE_RESULT" >>/run/omma-ended'
UNIT
cat >"$root/run/systemd/system/check.service" <<UNIT
[Unit]
DefaultDependencies=no
[Service]
Type=oneshot
ExecStart=/bin/bash $PWD/scripts/systemd/inside.sh
ExecStopPost=/bin/sh -c 'systemctl --no-block exit \$\$(cat /mnt/code)'
StandardOutput=file:/mnt/told
StandardError=inherit
UNIT
export container=omma
exec chroot "$root" /lib/systemd/systemd --unit=check.service --log-target=null --show-status=0
