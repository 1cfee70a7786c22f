#!/usr/bin/env bash
# Fails where a shared library shows a class of the solvers' own.  Usage: tests/symbols.sh libdalembert.so
set -euo pipefail
source=$(dirname "${BASH_SOURCE[0]}")/..
own=$(find "$source"/solvers/*/ -name '*.h' -not -name options.h -exec grep -hoP '^(class|struct) \K\w+' {} + |
  sort -u | paste -sd '|')
if nm -DC --defined-only "$1" | grep -P "dalembert::($own)\b"; then
  echo "private names among the symbols of $1: does a header lack DALEMBERT_HIDDEN?" && exit 1
fi
