# Error against run time of one model, from the table of `dalembert-bench work-precision`:
#   gnuplot -e "report='build/report'; model='cone'" bench/charts/work-precision.gp

load "bench/charts/style.gp"
csv = file("work-precision.csv")
steppers = system(sprintf("awk -F, '$1 == \"%s\" && !seen[$2]++ { print $2 }' '%s'", model, csv))

# A refused run has no error and no point; the key counts them. gnuplot refuses to plot nothing, so that
# lines without any point (and a model without any) are left out.
count(stepper, condition) = int(system(sprintf("awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) c[$i] = i } NR > 1 && $1 == \"%s\" && $2 == \"%s\" && %s { ++n } END { print n + 0 }' '%s'", model, stepper, condition, csv)))
refused(stepper) = count(stepper, "$c[\"outcome\"] != \"ok\"")
with_refused(stepper) = refused(stepper) > 0 ? sprintf(", %d refused", refused(stepper)) : ""
lines = ""
do for [error in "position force"] {
  do for [stepper in steppers] {
    if (count(stepper, sprintf("$c[\"outcome\"] == \"ok\" && $c[\"error_%s\"] > 0", error)) > 0) { lines = lines . stepper . ":" . error . " " }
  }
}
stepper(i) = word(lines, i)[1:strstrt(word(lines, i), ":") - 1]
what(i) = word(lines, i)[strstrt(word(lines, i), ":") + 1:]
dash(i) = what(i) eq "position" ? 1 : 2
mark(i) = what(i) eq "position" ? 7 : 4
rank(stepper) = sum [i = 1:words(steppers)] (word(steppers, i) eq stepper ? i : 0)

# Points that are NaN are left out, and the line goes on to the next one.
set datafile missing NaN
of(stepper, value) = strcol("model") eq model && strcol("stepper") eq stepper && value > 0 ? value : NaN

set xlabel "run time / ms"
set ylabel "relative error (position / length, force / weight)"
set logscale xy
set xrange [*:*] noextend
set offsets graph 0.05, graph 0.05, 0, 0
set xtics () # a model's run times span a decade or two: label 1, 2 and 5 of each
if (lines ne "") {
  stats csv using (strcol("model") eq model && strcol("outcome") eq "ok" ? column("run_time_s") * 1e3 : NaN) nooutput
  do for [e = -3:6] {
    do for [digit in "1 2 5"] {
      x = digit * 10.0**e # for labels beyond the range gnuplot would make room all the same
      if (x > STATS_min / 1.1 && x < 1.1 * STATS_max) { set xtics add (sprintf("%g", x) x) }
    }
  }
}
set rmargin 3
set key maxcols 3

set terminal svg size 560,500 dynamic enhanced font "sans-serif,13"
set output file(model . ".svg")
if (lines eq "") {
  set label 1 "refused at every tolerance" at graph 0.5, graph 0.5 center
  plot [1:10] [1:10] 0.1 notitle
} else {
  plot for [i = 1:words(lines)] csv \
         using (column("run_time_s") * 1e3):(of(stepper(i), column("error_" . what(i)))) \
         with linespoints linewidth 2 dashtype dash(i) \
         pointtype mark(i) pointsize 0.8 linecolor rgb colour(rank(stepper(i))) \
         title stepper(i) . " " . what(i) . with_refused(stepper(i))
}
