#!/usr/bin/env bash
# Measures what an evaluation of equations costs as users' programs compile them, by g++ and clang at -O2 and
# -O3: nanoseconds of a constraint, the least of several rounds, in each of which all take turns.
# Usage: bench/kernels.sh [rounds, 5 if not given]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
rounds=${1:-5}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

cmake --preset release >/dev/null
cmake --build --preset release --target equations-by-compiler >&2
for ((i = 0; i < rounds; ++i)); do
  for program in build/release/bench/equations-*-O[23]; do
    "$program" --benchmark_min_time=0.05 --benchmark_format=csv 2>/dev/null |
      awk -F, -v by="${program##*/equations-}" '/^"/ { split($1, its, "/"); print its[1] "/" its[2], by, 1e9 / $7 }'
  done
done | tr -d '"' | awk '
  !($1 in known) { known[$1]; order[++n] = $1 }
  !($2 in by) { by[$2]; columns[++m] = $2 }
  !(($1, $2) in ns) || $3 < ns[$1, $2] { ns[$1, $2] = $3 }
  END {
    printf "%-34s", "ns of a constraint"
    for (k = 1; k <= m; ++k) printf " %12s", columns[k]
    print ""
    for (i = 1; i <= n; ++i) {
      printf "%-34s", order[i]
      for (k = 1; k <= m; ++k) printf " %12.1f", ns[order[i], columns[k]]
      print ""
    }
  }'
