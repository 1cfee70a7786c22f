#!/usr/bin/env bash
# Installs what is missing and builds the pages and the reference into build/docs/, with the moving pages of the models'
# runs. These need the library compiled: --quick leaves them out.  Usage: docs/build.sh [--quick]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
[[ ${1:---quick} == --quick ]] || { echo "usage: docs/build.sh [--quick]" >&2 && exit 2; }

cmake/dependencies.sh doxygen python3
cmake --preset install
cmake --build --preset install --target docs
ln -sfn install/docs/html build/docs
if [[ $# == 0 ]]; then
  cmake --preset release
  cmake --build --preset release --target dalembert-bench
  mkdir build/docs/runs
  build/release/bench/dalembert-bench pages --directory build/docs/runs
  rm build/docs/runs/*.csv
  docs/moving.py build/docs
fi
tests/pages/links.py build/docs
echo "build/docs/index.html"
