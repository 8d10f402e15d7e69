# sync_line LABEL: a GPIO chip of the kernel's simulator with one named line, frame_sync; SYNC_VALUE is the file that tells it.
# Sourced, not run.
sync_line() {
  local chip=/sys/kernel/config/gpio-sim/$1
  modprobe gpio-sim || exit 1
  mkdir -p "$chip/bank0/line3"
  echo 8 > "$chip/bank0/num_lines"
  echo "$1" > "$chip/bank0/label"
  echo frame_sync > "$chip/bank0/line3/name"
  echo 1 > "$chip/live"
  SYNC_VALUE=/sys/devices/platform/$(cat "$chip/dev_name")/$(cat "$chip/bank0/chip_name")/sim_gpio3/value
}
