#!/usr/bin/env bash
# Installs what is missing, builds, measures and plots into build/report/.  Usage: bench/run.sh [--quick]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case ${1:-} in
  '') work_precision=(--repeat 5) scaling=(--size 10,100,1000,10000) ratios=() ;;
  --quick)
    work_precision=(--repeat 1 --tolerance 1e-4,1e-6,1e-8) scaling=(--size 10,100)
    ratios=(--scene plane-pendulum,cone,double-pendulum --repeat 1)
    ;;
  *) echo "usage: bench/run.sh [--quick]" >&2 && exit 2 ;;
esac

cmake/dependencies.sh gnuplot-nox
cmake --preset release
cmake --build --preset release --target dalembert-bench

bench=build/release/bench/dalembert-bench
report=build/report
mkdir -p $report

# One paragraph per question: run the benchmark, then plot its table.
$bench work-precision --stepper ida,erk,hand --csv $report/work-precision.csv "${work_precision[@]}"
for model in $(tail -n +2 $report/work-precision.csv | cut -d, -f1 | sort -u); do
  gnuplot -e "csv='$report/work-precision.csv'; model='$model'; report='$report'" bench/plot.gp
done

$bench ratios --csv $report/ratios.csv "${ratios[@]}"

$bench scaling --stepper ida,erk,hand --tolerance 1e-5 --t-end 0.05 --csv $report/scaling.csv "${scaling[@]}"

$bench own-constraint --csv $report/own-constraint.csv

echo "Report in $report/:" $report/*
