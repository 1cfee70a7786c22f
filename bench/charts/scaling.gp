# Run time and memory against size, from the table of `dalembert-bench scaling`:
#   gnuplot -e "report='build/report'" bench/charts/scaling.gp

load "bench/charts/style.gp"
csv = file("scaling.csv")
steppers = system(sprintf("awk -F, 'NR > 1 && !seen[$2]++ { print $2 }' '%s'", csv))
of(stepper) = strcol("stepper") eq stepper && strcol("outcome") eq "ok" ? column("run_time_s") : NaN
set datafile missing NaN
set logscale xy
set format "10^{%T}"
set xlabel "beads of the chain"
set ylabel "run time / s"
set terminal svg size 560,380 dynamic enhanced font "sans-serif,13"
set output file("scaling.svg")
plot for [i = 1:words(steppers)] csv using "size":(of(word(steppers, i))) with linespoints linewidth 2 pointtype 7 pointsize 0.8 linecolor rgb colour(i) title word(steppers, i)
