#!/bin/sh
# The table of docs/calibrate.md, "From a checkerboard": rms of lenses calibrated on real sets of board views, beside
# OpenCV's. Usage: scripts/lens_calibration.sh BOARDS [OPENCV]
#   BOARDS  folder with camodocal/*.png and babelcalib_ov_plane/{train,test}/*.orpc, ov_plane.dsc
#   OPENCV  folder with left*.jpg, of Debian's opencv-doc (default: where the package puts it)
set -eu
here=$(dirname "$0")/..
omma=${OMMA:-$here/build/release/bin/omma}
boards=${1:?usage: $0 BOARDS [OPENCV]}
opencv=${2:-/usr/share/doc/opencv-doc/examples/data}
[ -d "$boards" ] || { echo "$0: $boards: no such folder" >&2; exit 2; }
[ -x "$omma" ] || { echo "$0: $omma: not built" >&2; exit 2; }

# rms MODEL ARGUMENTS...: "0.233 px", with the test views' rms behind it where there are some, or why there is none.
rms() {
  model=$1
  shift
  if out=$("$omma" calibrate lens "$@" --model "$model"); then
    echo "$out" | awk '/^rms/ {all = $2 " px"} /^test rms/ {all = all " (test " $3 " px)"} END {print all}'
  else
    echo refused
  fi
}

# row NAME OPENCV_FIGURE ARGUMENTS...
row() {
  name=$1
  figure=$2
  shift 2
  printf '%-34s %-28s %-28s %-12s %s\n' "$name" "$(rms kb4 "$@")" "$(rms ocam "$@")" "$(rms caltech "$@")" "$figure"
}

printf '%-34s %-28s %-28s %-12s %s\n' set kb4 ocam caltech "OpenCV 4.6"
if [ -d "$opencv" ]; then
  row "OpenCV's left*.jpg" "0.245 px" "$opencv"/left[0-9]*.jpg --board 9x6
else
  echo "OpenCV's left*.jpg: no $opencv (package opencv-doc)"
fi
row "camodocal" "1.01 px (9 views)" "$boards"/camodocal/*.png --board 9x6
plane=$boards/babelcalib_ov_plane
row "ov_plane, and views kept apart" "0.500 px" "$plane"/train/*.orpc --board-file "$plane"/ov_plane.dsc --test "$plane"/test/*.orpc
