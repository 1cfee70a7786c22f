#!/usr/bin/env bash
# Installs what is missing, builds and tests.  Usage: tests/run.sh [release|debug|threads]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${1:-release}

compiler=()
[[ $preset == release ]] || compiler=(clang libclang-rt-dev)
browser=() # for the pages of runs
[[ $preset == threads ]] || browser=(chromium nodejs)
cmake/dependencies.sh "${compiler[@]}" "${browser[@]}"
cmake --preset "$preset"
cmake --build --preset "$preset"
ctest --preset "$preset" --parallel "$(nproc)"
