#!/usr/bin/env bash
# Fails where a shared library shows a class of the solvers' own.  Usage: tests/symbols.sh libdalembert.so
set -euo pipefail
source=$(dirname "${BASH_SOURCE[0]}")/..
# The headers that users include are those CMakeLists.txt names.
own=$(cd "$source"
  find solvers/*/ view sweep -name '*.h' | grep -vxFf <(grep -oh '\(solvers\|view\|sweep\)/[a-z_/]*\.h' CMakeLists.txt sweep/CMakeLists.txt) |
    xargs grep -hoP '^(class|struct) \K\w+' | sort -u | paste -sd '|')
if nm -DC --defined-only "$1" | grep -P "dalembert::($own)\b"; then
  echo "private names among the symbols of $1: does a header lack DALEMBERT_HIDDEN?" && exit 1
fi
