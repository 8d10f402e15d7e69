#!/usr/bin/env bash
# The demo's first frames, rendered once.
cd "$(dirname "$0")/../.."
[ -f build/hil/frames/truth.jsonl ] || build/release/bin/omma simulate config/demo_scenario.toml --frames 64 --out build/hil/frames
