#!/usr/bin/env bash
# Fails where a shared library shows a class of solvers/private.  Usage: tests/symbols.sh libdalembert.so
set -euo pipefail
source=$(dirname "${BASH_SOURCE[0]}")/..
private=$(grep -hoP '^(class|struct) \K\w+' "$source"/solvers/private/*.h | sort -u | paste -sd '|')
if nm -DC --defined-only "$1" | grep -P "dalembert::($private)\b"; then
  echo "private names among the symbols of $1: does a header lack DALEMBERT_HIDDEN?" && exit 1
fi
