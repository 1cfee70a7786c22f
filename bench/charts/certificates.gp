# Estimated against true errors, from the table of `dalembert-bench certificates`:
#   gnuplot -e "report='build/report'" bench/charts/certificates.gp

load "bench/charts/style.gp"
csv = file("certificates.csv")
kinds = "position force event"
kind(quantity) = quantity eq "position" || quantity eq "force" ? quantity : "event"
of(k) = kind(strcol("quantity")) eq k && column("true_error") > 0 && column("estimated_error") < 1e99 && column("estimated_error") > column("round_off") ? column("estimated_error") : NaN
set logscale xy
set format "10^{%T}"
set xlabel "true error"
set ylabel "estimated error"
set terminal svg size 560,440 dynamic enhanced font "sans-serif,13"
set output file("certificates.svg")
plot for [i = 1:3] csv using "true_error":(of(word(kinds, i))) with points pointtype 6 pointsize 0.6 linecolor rgb colour(i) title word("position force events", i), \
     x with lines linewidth 1.5 linecolor rgb "#444444" title "equal"
