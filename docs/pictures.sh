#!/usr/bin/env bash
# Makes docs/pictures/runs: a picture of each model's run. To be run, and its result committed, after a change of what
# pages look like. Needs chromium, node and imagemagick.  Usage: docs/pictures.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

cmake --preset release
cmake --build --preset release --target dalembert-bench
runs=$(mktemp -d)
trap 'rm -rf "$runs"' EXIT
build/release/bench/dalembert-bench pages --directory "$runs"
node docs/pictures.mjs "$(command -v chromium)" "$runs" docs/pictures/runs
mogrify -colors 64 -define png:compression-level=9 -define png:exclude-chunks=date,time docs/pictures/runs/*.png
