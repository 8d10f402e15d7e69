#!/usr/bin/env bash
# What is checked, by process 1's own word: ready when it flies; kept alive by its strokes; ended and started anew
# when it falls silent, and what the silent run told survives; ended as it should on a stop.
failed=0
echo 1 >/mnt/code
check() {  # check WHAT EXPECTED FOUND
  if [ "$2" = "$3" ]; then echo "ok    $1: $3"; else echo "WRONG $1: expected $2, found $3"; failed=1; fi
}
property() { systemctl show omma-fsw --property="$1" --value; }

began=$(date +%s%N)
systemctl start omma-fsw
check "started" 0 $?
echo "      ready after $((($(date +%s%N) - began) / 1000000)) ms"
check "state" "active running" "$(property ActiveState) $(property SubState)"
first=$(property MainPID)
sleep 8
check "the same process after eight seconds, with a watchdog of three" "$first 0" "$(property MainPID) $(property NRestarts)"
echo "      says: $(property StatusText)"
check "runs as a user of its own, not as root" yes "$([ "$(stat -c %u "/proc/$first")" -ge 1000 ] && echo yes)"
echo "      threads, class and priority: $(ps -L -o comm=,cls=,rtprio= -p "$first" | tr -s ' ' | paste -sd, -)"

kill -STOP "$first"
for _ in $(seq 80); do
  sleep 0.25
  [ "$(property NRestarts)" = 1 ] && [ "$(property ActiveState)" = active ] && break
done
check "stopped from outside: ended and started anew" "1 active" "$(property NRestarts) $(property ActiveState)"
check "because of" watchdog "$(cat /run/omma-ended)"
sleep 1
told=$(omma events /var/lib/omma/events.ring)
check "runs that the event store tells" "1 2" "$(awk '/^run/ { print $2 }' <<<"$told" | sort -nu | xargs)"
check "the first run's last event is its fatal signal 6" yes \
  "$(awk '$1 == "run" && $2 == 1' <<<"$told" | tail -1 | grep -q 'event_25 (6)' && echo yes)"

systemctl stop omma-fsw
check "stopped as it should" "inactive success" "$(property ActiveState) $(property Result)"
echo $failed >/mnt/code
exit $failed
