# Motion and forces of one model against its hand derivation, from the table of `dalembert-bench pages`:
#   gnuplot -e "report='build/report'; model='cone'" bench/charts/motion.gp
# Lines are the run and its estimated errors, circles the hand derivation and the true errors. Of many points the last is shown, of many forces the first three; errors are the largest of all.

load "bench/charts/style.gp"
csv = file(model . "-motion.csv")
columns = system(sprintf("head -1 '%s' | tr ',' '\\n' | grep -v -e reference -e error -e estimated", csv))
number(prefix) = int(system(sprintf("echo '%s' | tr ' ' '\\n' | sed -n 's/^%s\\([0-9]*\\).*/\\1/p' | sort -n | tail -1", columns, prefix)) + 0)
points = number("position")
forces = number("force")
point = sprintf("position%d.", points)
axes = system(sprintf("echo '%s' | tr ' ' '\\n' | sed -n 's/^position%d\\.//p'", columns, points))
samples = int(system(sprintf("tail -n +2 '%s' | wc -l", csv)))
step = samples > 40 ? samples / 40 : 1 # between marks

of_many(what, shown, count) = count > shown ? sprintf("%s (of %d)", what, count) : what
set terminal svg size 560,500 dynamic enhanced font "sans-serif,13"
set output file(model . "-motion.svg")
set multiplot layout 3,1 margins 0.14,0.98,0.085,0.95 spacing 0,0.065
set key at graph 0, graph 1.2 left top maxrows 1 samplen 1.5
unset xlabel
set format x ""
set format y "%g"
set xrange [*:*] noextend
set offsets 0, 0, graph 0.05, graph 0.05
set ylabel points > 1 ? sprintf("point %d of %d", points, points) : "position" offset 1
plot for [i = 1:words(axes)] csv using "t":(column(point . word(axes, i))) with lines linewidth 2 linecolor rgb colour(i) title word(axes, i), \
     for [i = 1:words(axes)] csv every step using "t":(column(point . word(axes, i) . ".reference")) with points pointtype 6 pointsize 0.6 linecolor rgb colour(i) notitle

shown = forces < 3 ? forces : 3
set ylabel "force of constraint" offset 1
force(i) = sprintf("force%d", i)
if (shown == 0) {
  set label 1 "none compared" at graph 0.5, graph 0.5 center
  plot csv using "t":(0) with lines linecolor rgb "#DDDDDD" notitle
  unset label 1
} else {
  plot for [i = 1:shown] csv using "t":(column(force(i))) with lines linewidth 2 linecolor rgb colour(i) \
         title i == 1 ? "force 1" : i == shown ? of_many(sprintf("%d", i), shown, forces) : sprintf("%d", i), \
       for [i = 1:shown] csv every step using "t":(column(force(i) . ".reference")) with points pointtype 6 pointsize 0.6 linecolor rgb colour(i) notitle
}

set xlabel "time"
set format x "%g"
set format y "10^{%T}"
set logscale y
set ytics 1e-18, 1e3
set mytics 1
set ylabel "relative error" offset 1
above_0(e) = e > 1e-18 && e < 1e9 ? e : NaN
plot for [i = 1:(forces > 0 ? 2 : 1)] csv using "t":(above_0(column("estimated_" . word("position force", i)))) with lines linewidth 1.5 linecolor rgb colour(i) title word("position force", i), \
     for [i = 1:(forces > 0 ? 2 : 1)] csv every step using "t":(above_0(column("error_" . word("position force", i)))) with points pointtype 6 pointsize 0.6 linecolor rgb colour(i) notitle
unset multiplot
