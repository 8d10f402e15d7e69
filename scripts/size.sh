#!/usr/bin/env bash
# scripts/size.sh [BUILD]: how large the flight program is and why: code, constants and static data by room, from the
# linker's map, then the largest single items. Shared libraries (DDS, image formats, C++) are not in it. Ends with 1 when
# the rooms do not account for nine tenths of the program.
set -euo pipefail
build=${1:-$(dirname "$0")/../build/release}
program=$(size "$build/bin/omma-fsw" | awk 'NR == 2 { print $4 }')

awk -v program="$program" '
  /^Linker script and memory map/ { inside = 1 }
  !inside { next }
  # A long section name stands on a line of its own; address, size and file follow.
  NF == 1 && $1 ~ /^\.[a-zA-Z]/ { section = $1; next }
  $1 ~ /^\.[a-zA-Z]/ && $2 ~ /^0x/ && $3 ~ /^0x/ && NF >= 4 { section = $1; add($3, $4); next }
  $1 ~ /^0x/ && $2 ~ /^0x/ && NF >= 3 && section != "" { add($2, $3); next }
  function number(hex,   i, value) {
    for (i = 3; i <= length(hex); ++i) value = 16 * value + index("0123456789abcdef", substr(hex, i, 1)) - 1
    return value
  }
  function add(hex, file,   size, room, kind) {
    size = number(hex)
    if (size == 0) return
    if (section ~ /^\.(text|init|fini)/) kind = "code"
    else if (section ~ /^\.(rodata|eh_frame|gcc_except_table)/) kind = "constants"
    else if (section ~ /^\.(data|bss|tbss|tdata)/) kind = "data"
    else return
    room = file
    if (!sub(/^.*libomma_/, "", room) || !sub(/\.a\(.*$/, "", room)) room = file ~ /omma|fsw/ ? "omma-fsw itself" : "start-up"
    sum[room, kind] += size; rooms[room] += size; total[kind] += size
  }
  END {
    printf "%-28s %9s %9s %9s %9s\n", "bytes", "code", "constants", "data", "all"
    order = "sort -k1,1nr | cut -f2-"
    for (room in rooms)
      printf "%d\t%-28s %9d %9d %9d %9d\n", rooms[room], room, sum[room, "code"], sum[room, "constants"],
             sum[room, "data"], rooms[room] | order
    close(order)
    printf "%-28s %9d %9d %9d %9d\n", "all", total["code"], total["constants"], total["data"],
           total["code"] + total["constants"] + total["data"]
    exit total["code"] + total["constants"] + total["data"] < 0.9 * program
  }' "$build/omma-fsw.map"

echo
echo "The program as the system sees it, and its largest items (bytes):"
size "$build/bin/omma-fsw"
nm -S --size-sort -C -t d "$build/bin/omma-fsw" | tail -8 | awk '{ printf "%9d  ", $2; $1 = $2 = $3 = ""; print substr($0, 4, 100) }'
