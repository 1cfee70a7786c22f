#!/usr/bin/env bash
# Installs what is missing and builds the pages and the reference into build/docs/.  Usage: docs/build.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

cmake/dependencies.sh doxygen python3
cmake --preset install
cmake --build --preset install --target docs
ln -sfn install/docs/html build/docs
tests/pages/links.py build/docs
echo "build/docs/index.html"
