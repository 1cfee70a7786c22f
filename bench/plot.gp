# Error against run time of one model, from the table of `dalembert-bench work-precision`:
#   gnuplot -e "csv='work-precision.csv'; model='pendulum'; report='.'" plot.gp

steppers = system(sprintf("awk -F, '$1 == \"%s\" && !seen[$2]++ { print $2 }' '%s'", model, csv))
colours = "#0072B2 #D55E00 #009E73 #CC79A7 #E69F00 #56B4E9" # Okabe and Ito: told apart by colour-blind readers
colour(i) = word(colours, (i - 1) % words(colours) + 1)

# A refused run has no error and no point; the key counts them. gnuplot refuses to plot nothing, so that
# lines without any point (and a model without any) are left out.
count(stepper, condition) = int(system(sprintf("awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) c[$i] = i } NR > 1 && $1 == \"%s\" && $2 == \"%s\" && %s { ++n } END { print n + 0 }' '%s'", model, stepper, condition, csv)))
refused(stepper) = count(stepper, "$c[\"outcome\"] != \"ok\"")
with_refused(stepper) = refused(stepper) > 0 ? sprintf(", %d refused", refused(stepper)) : ""
lines = ""
do for [stepper in steppers] {
  do for [error in "position force"] {
    if (count(stepper, sprintf("$c[\"outcome\"] == \"ok\" && $c[\"error_%s\"] > 0", error)) > 0) { lines = lines . stepper . ":" . error . " " }
  }
}
stepper(i) = word(lines, i)[1:strstrt(word(lines, i), ":") - 1]
what(i) = word(lines, i)[strstrt(word(lines, i), ":") + 1:]
dash(i) = what(i) eq "position" ? 1 : 2
mark(i) = what(i) eq "position" ? 7 : 4
rank(stepper) = sum [i = 1:words(steppers)] (word(steppers, i) eq stepper ? i : 0)

# Points that are NaN are left out, and the line goes on to the next one.
set datafile separator comma missing NaN
of(stepper, value) = strcol("model") eq model && strcol("stepper") eq stepper && value > 0 ? value : NaN

set title model font ",20" noenhanced
set xlabel "run time / ms"
set ylabel "relative error (position / length, force / weight)"
set logscale xy
set xrange [*:*] noextend
set offsets graph 0.05, graph 0.05, 0, 0
set format y "10^{%T}"
set mytics 10
set xtics () # a model's run times span a decade or two: label 1, 2 and 5 of each
set for [e = -3:6] for [digit in "1 2 5"] xtics add (sprintf("%g", digit * 10.0**e) digit * 10.0**e)
set grid xtics ytics linetype 1 linewidth 0.7 linecolor rgb "#dddddd"
set border linecolor rgb "#444444"
set key outside right top Left reverse samplen 3 spacing 1.4 noenhanced

do for [terminal in "svg png"] {
  if (terminal eq "svg") {
    set terminal svg size 900,560 dynamic enhanced font "DejaVu Sans,15" background rgb "white"
  } else {
    set terminal pngcairo size 1350,840 enhanced font "DejaVu Sans,15" fontscale 1.3 linewidth 1.5 background rgb "white"
  }
  set output sprintf("%s/%s.%s", report, model, terminal)
  if (lines eq "") {
    set label 1 "refused at every tolerance" at graph 0.5, graph 0.5 center
    plot [1:10] [1:10] 0.1 notitle
  } else {
    plot for [i = 1:words(lines)] csv \
           using (column("run_time_s") * 1e3):(of(stepper(i), column("error_" . what(i)))) \
           with linespoints linewidth 2 dashtype dash(i) \
           pointtype mark(i) pointsize 1.1 linecolor rgb colour(rank(stepper(i))) \
           title stepper(i) . " " . what(i) . with_refused(stepper(i))
  }
  unset output
}
