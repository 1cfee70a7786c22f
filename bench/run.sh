#!/usr/bin/env bash
# Installs what is missing, builds, measures and writes build/report/index.html.  Usage: bench/run.sh [--quick]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case ${1:-} in
  '')
    work_precision=(--repeat 5) scaling=(--size 10,100,1000,10000) set_up=() ratios=() leave_out=() extremes=() audit=()
    sensitivity=() chart=() certificates=() requests=(--repeat 5) sweep=(--flips 1000 --kapitza 150)
    kernels=(--benchmark_min_time=0.2) products=20000
    ;;
  --quick)
    work_precision=(--repeat 1) scaling=(--size 10,100) set_up=(--size 1,10 --repeat 1)
    ratios=(--scene plane-pendulum,cone,double-pendulum --repeat 1) leave_out=(--size 10 --repeat 1)
    extremes=(--quick) audit=(--quick --repeat 1 --tolerance 1e-6)
    sensitivity=(--constant safety,share_of_a_step) chart=(--points 20)
    certificates=(--quick) requests=(--model plane-pendulum,cone,andrews --repeat 1) sweep=(--quick)
    kernels=(--benchmark_min_time=0.001) products=20
    ;;
  *) echo "usage: bench/run.sh [--quick]" >&2 && exit 2 ;;
esac

cmake/dependencies.sh gnuplot-nox libbenchmark-dev libmimalloc-dev python3-jinja2
cmake --preset release
cmake --build --preset release --target dalembert-bench

bench=build/release/bench/dalembert-bench
report=build/report
rm -rf $report # what an earlier run has left would look like results of this one
mkdir -p $report

# Runs one benchmark. One that fails, or finds a row that is wrong, fails the whole, but not before the report is
# there, which names it.
status=0
measure() {
  local failed=0
  "$@" || failed=$?
  ((failed == 0)) || { status=$failed && echo "${1##*/} ${2:-} ended with status $failed" >>$report/failures.txt; }
}
# Compiles a program just before it is measured: the first figures do not wait for it, and nothing is measured while
# something compiles.
compile() { measure cmake --build --preset release --target "$1"; }
# Whether CMake has found what a program needs.
has() { cmake --build --preset release --target help | grep "^$1: " >/dev/null; }
# Draws a chart, if its table is there: what is missing is named in the report.
draw() { # table, script, definitions
  [[ ! -e $report/$1 ]] || measure gnuplot -e "report='$report'; ${3:-}" "bench/charts/$2.gp"
}

measure $bench work-precision --stepper ida,erk,hand --csv $report/work-precision.csv "${work_precision[@]}"
measure $bench pages --directory $report
for model in $(tail -qn +2 $report/work-precision.csv $report/models.csv | cut -d, -f1 | sort -u); do
  draw work-precision.csv work-precision "model='$model'"
  draw "$model-motion.csv" motion "model='$model'"
done
measure $bench ratios --csv $report/ratios.csv "${ratios[@]}"
measure $bench scaling --stepper ida,erk,hand --tolerance 1e-5 --t-end 0.05 --csv $report/scaling.csv "${scaling[@]}"
draw scaling.csv scaling
measure $bench set-up --csv $report/set-up.csv "${set_up[@]}"
compile dalembert-checks
measure $bench extremes --csv $report/extremes.csv "${extremes[@]}"
draw extremes.csv extremes
measure $bench audit --csv $report/audit.csv "${audit[@]}"
measure $bench modes --csv $report/modes.csv
measure $bench events --csv $report/events.csv
measure $bench certificates --csv $report/certificates.csv "${certificates[@]}"
draw certificates.csv certificates
measure $bench requests --csv $report/requests.csv "${requests[@]}"
measure $bench diagrams --directory $report "${chart[@]}"
draw kapitza-boundary.csv diagrams
compile dalembert-sensitivity
measure $bench sensitivity --csv $report/sensitivity.csv "${sensitivity[@]}"
measure $bench own-constraint --csv $report/own-constraint.csv
measure $bench leave-out --stepper ida,erk --csv $report/leave-out.csv "${leave_out[@]}"

if has dalembert-sweeps; then
  compile dalembert-sweeps
  measure $bench sweep --csv $report/sweep.csv --directory $report "${sweep[@]}"
  side() { echo "sqrt($(stat -c %s "$report/$1") / 4)"; } # of a square of 4-byte numbers
  draw governors.csv sweeps "flips=$(side flips.bin); kapitza=$(side kapitza-runs.bin)"
fi

if has dalembert-kernels; then
  compile dalembert-kernels
  measure build/release/bench/dalembert-kernels --benchmark_out=$report/kernels.json --benchmark_out_format=json \
    "${kernels[@]}"
fi
compile dalembert-fuzz
measure build/release/tests/dalembert-fuzz --family products --scenes $products --pairs $report/pairs.csv

commit=$(git describe --always --dirty 2>/dev/null || echo unknown)
/usr/bin/python3 -B bench/page/report.py $report --commit "$commit" ${1:-}
exit $status
