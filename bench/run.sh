#!/usr/bin/env bash
# Installs what is missing, builds, measures and plots into build/report/.  Usage: bench/run.sh [--quick]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case ${1:-} in
  '')
    work_precision=(--repeat 5) scaling=(--size 10,100,1000,10000) ratios=() leave_out=() extremes=() audit=()
    sensitivity=() chart=() certificates=() requests=(--repeat 5) sweep=(--flips 1000 --kapitza 150)
    kernels=(--benchmark_min_time=0.2) products=20000
    ;;
  --quick)
    work_precision=(--repeat 1) scaling=(--size 10,100)
    ratios=(--scene plane-pendulum,cone,double-pendulum --repeat 1) leave_out=(--size 10 --repeat 1)
    extremes=(--quick) audit=(--quick --repeat 1 --tolerance 1e-6)
    sensitivity=(--constant safety,share_of_a_step) chart=(--points 20)
    certificates=(--quick) requests=(--model plane-pendulum,cone,andrews --repeat 1) sweep=(--quick)
    kernels=(--benchmark_min_time=0.001) products=20
    ;;
  *) echo "usage: bench/run.sh [--quick]" >&2 && exit 2 ;;
esac

cmake/dependencies.sh gnuplot-nox libbenchmark-dev
cmake --preset release
cmake --build --preset release --target dalembert-benchmarks

bench=build/release/bench/dalembert-bench
report=build/report
mkdir -p $report

# One paragraph per question: run the benchmark, then plot its table. What a stepper refuses is a row of the
# table. A row that is wrong fails the report, but not before all of it is there.
status=0
$bench work-precision --stepper ida,erk,hand --csv $report/work-precision.csv "${work_precision[@]}"
for model in $(tail -n +2 $report/work-precision.csv | cut -d, -f1 | sort -u); do
  gnuplot -e "csv='$report/work-precision.csv'; model='$model'; report='$report'" bench/plot.gp
done

$bench ratios --csv $report/ratios.csv "${ratios[@]}"

$bench scaling --stepper ida,erk,hand --tolerance 1e-5 --t-end 0.05 --csv $report/scaling.csv "${scaling[@]}"

$bench extremes --csv $report/extremes.csv "${extremes[@]}" || status=$?
gnuplot -e "csv='$report/extremes.csv'; report='$report'" bench/extremes.gp

$bench audit --csv $report/audit.csv "${audit[@]}" || status=$?
$bench modes --csv $report/modes.csv || status=$?
$bench events --csv $report/events.csv || status=$?
$bench certificates --csv $report/certificates.csv "${certificates[@]}" || status=$?
$bench requests --csv $report/requests.csv "${requests[@]}" || status=$?
$bench diagrams --directory $report "${chart[@]}"
gnuplot -e "report='$report'" bench/diagrams.gp

$bench sensitivity --csv $report/sensitivity.csv "${sensitivity[@]}"

$bench own-constraint --csv $report/own-constraint.csv

$bench leave-out --stepper ida,erk --csv $report/leave-out.csv "${leave_out[@]}" || status=$?

sweeps_bench=build/release/bench/dalembert-sweeps # not built where HDF5 is not found
if [[ -x $sweeps_bench ]]; then
  $bench sweep --csv $report/sweep.csv --directory $report "${sweep[@]}" || status=$?
  side() { echo "sqrt($(stat -c %s "$1") / 4)"; } # of a square of 4-byte numbers
  gnuplot -e "report='$report'; flips=$(side $report/flips.bin); kapitza=$(side $report/kapitza-runs.bin)" bench/sweeps.gp
fi

kernels_bench=build/release/bench/dalembert-kernels # not built where Google Benchmark is not found
[[ ! -x $kernels_bench ]] ||
  $kernels_bench --benchmark_out=$report/kernels.json --benchmark_out_format=json "${kernels[@]}"

cmake --build --preset release --target dalembert-fuzz
build/release/tests/dalembert-fuzz --family products --scenes $products --pairs $report/pairs.csv || status=$?

echo "Report in $report/:" $report/*
exit $status
