#!/usr/bin/env bash
# Measures what programs of users cost the compiler: user CPU seconds and peak memory of g++ -O2, the least of
# several runs. A revision to compare with compiles the same programs, each in turn with this tree.
# Usage: bench/compile.sh [--repeat 3] [--compare <git revision>]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

repeat=3
trees=(now)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch"/{now,before}
ln -s "$PWD" "$scratch/now/dalembert"
while (($# > 0)); do
  case $1=${2:-} in
    --repeat=[1-9]*) repeat=$2 ;;
    --compare=?*)
      git archive --prefix=dalembert/ "$2" | tar -x -C "$scratch/before"
      trees=(before now)
      ;;
    *) echo "usage: bench/compile.sh [--repeat 3] [--compare <git revision>]" >&2 && exit 2 ;;
  esac
  shift 2
done

cp bench/compile/*.cpp "$scratch"
# shellcheck disable=SC2016 # fences, no expressions
sed -n '/^```cpp$/,/^```$/{//!p;/^```$/q}' README.md >"$scratch/readme.cpp"

# Runs a command and prints its user seconds and its peak memory in MB, those of its children among them.
used='import os, sys
_, status, used = os.wait4(os.spawnvp(os.P_NOWAIT, sys.argv[1], sys.argv[1:]), 0)
print(f"{used.ru_utime:.3f} {used.ru_maxrss // 1024}")
sys.exit(os.waitstatus_to_exitcode(status))'
for ((i = 0; i < repeat; ++i)); do
  for program in eigen umbrella readme no_lambda ten_lambdas; do
    for tree in "${trees[@]}"; do
      cost=$(/usr/bin/python3 -c "$used" g++ -std=c++20 -O2 -I"$scratch/$tree" -isystem /usr/include/eigen3 \
        -c "$scratch/$program.cpp" -o "$scratch/$program.o")
      echo "$program $tree $cost" >>"$scratch/costs"
    done
  done
done

awk -v compared=$((${#trees[@]} - 1)) '
  { key = $1 " " $2 }
  !(key in s) || $3 < s[key] { s[key] = $3 }
  !(key in mb) || $4 < mb[key] { mb[key] = $4 }
  function row(what, memory, now, before) {
    line = sprintf("%-28s %8s %8.2f", what, memory, now)
    if (compared) line = line sprintf(" %8.2f %8.2f", before, now / before)
    print line
  }
  function whole(what, program) { row(what, mb[program " now"], s[program " now"], s[program " before"]) }
  function per_lambda(tree) { return (s["ten_lambdas " tree] - s["no_lambda " tree]) / 10 }
  END {
    print "user CPU of g++ -O2                MB        s" (compared ? "   before    ratio" : "")
    whole("#include <Eigen/Dense>", "eigen")
    whole("#include <dalembert.h>", "umbrella")
    whole("README, first program", "readme")
    whole("two particles", "no_lambda")
    whole("two particles, ten lambdas", "ten_lambdas")
    row("one further lambda", "", per_lambda("now"), per_lambda("before"))
  }' "$scratch/costs"
