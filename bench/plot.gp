# Error against run time of one model, from the table of `dalembert-bench work-precision`:
#   gnuplot -e "csv='work-precision.csv'; model='pendulum'; report='.'" plot.gp

steppers = system(sprintf("awk -F, '$1 == \"%s\" && !seen[$2]++ { print $2 }' '%s'", model, csv))
colours = "#0072B2 #D55E00 #009E73 #CC79A7 #E69F00 #56B4E9" # Okabe and Ito: told apart by colour-blind readers
colour(i) = word(colours, (i - 1) % words(colours) + 1)

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
  plot for [i = 1:words(steppers)] csv \
         using (column("run_time_s") * 1e3):(of(word(steppers, i), column("error_position"))) \
         with linespoints linewidth 2 dashtype 1 pointtype 7 pointsize 1.1 linecolor rgb colour(i) \
         title word(steppers, i) . " position", \
       for [i = 1:words(steppers)] csv \
         using (column("run_time_s") * 1e3):(of(word(steppers, i), column("error_force"))) \
         with linespoints linewidth 2 dashtype 2 pointtype 4 pointsize 1.1 linecolor rgb colour(i) \
         title word(steppers, i) . " force"
  unset output
}
