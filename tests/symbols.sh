#!/usr/bin/env bash
# Fails where a shared library shows a class of the solvers' own.  Usage: tests/symbols.sh libdalembert.so
set -euo pipefail
source=$(dirname "${BASH_SOURCE[0]}")/..
# The headers that users include are those CMakeLists.txt names; a class that one of them declares is known to them.
own=$(cd "$source"
  public=$(grep -oh '\(solvers\|view\|sweep\)/[a-z_/]*\.h' CMakeLists.txt sweep/CMakeLists.txt)
  known=$(xargs grep -hoP '^(class|struct) \K\w+(?=;)' <<<"$public")
  find solvers/*/ view sweep -name '*.h' | grep -vxF "$public" |
    xargs grep -hoP '^(class|struct) \K\w+' | grep -vxF "$known" | sort -u | paste -sd '|')
if nm -DC --defined-only "$1" | grep -P "dalembert::($own)\b"; then
  echo "private names among the symbols of $1: does a header lack DALEMBERT_HIDDEN?" && exit 1
fi
