#!/usr/bin/env bash
# package_depends.sh PACKAGE.deb PROGRAM: does the package depend on every library the program is linked with, and on
# nothing else? The packages of the libraries are those of this machine: names are the same on every architecture.
set -euo pipefail
declared=$(dpkg-deb -f "$1" Depends | tr -d ' ' | tr ',' '\n' | sed 's/(.*//' | sort)
needed=$(readelf -d "$2" | sed -n 's/.*NEEDED.*\[\(.*\)\]/\1/p' | grep -v '^ld-linux' | while read -r library; do
  # A library's package by the file the linker would find here.
  file=$(ldconfig -p | awk -v name="$library" '$1 == name { print $NF; exit }')
  [ -n "$file" ] || { echo "$library: expected to be installed on this machine as well, found nothing" >&2; exit 1; }
  { dpkg-query -S "$(realpath "$file")" || dpkg-query -S "$file"; } 2>/dev/null | sed 's/:.*//' | head -1
done | sort -u)
diff <(echo "$declared") <(echo "$needed") || { echo "$1: depends on other packages (<) than its program needs (>)" >&2; exit 1; }
echo "depends on exactly the $(wc -l <<<"$needed") packages its program is linked with"
