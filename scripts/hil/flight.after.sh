#!/usr/bin/env bash
# The flight against the simulator's truth, from its own recording and from what the ground heard over DDS.
cd "$(dirname "$0")/../.."
for recording in flown heard; do
  echo "$recording.mcap:"
  build/release/bin/omma-hil-judge "$1/$recording.mcap" build/hil/frames "$1/fed.csv" config/hil.toml || exit 1
done
