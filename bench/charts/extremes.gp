# A chart per case, of its errors against their limits and of its steps, from the table of `dalembert-bench extremes`:
#   gnuplot -e "report='build/report'" bench/charts/extremes.gp

load "bench/charts/style.gp"
csv = file("extremes.csv")
cases = system(sprintf("awk -F, 'NR > 1 && !seen[$1]++ { print $1 }' '%s'", csv))
steppers = "ida erk"

# Zeros are drawn a decade below the smallest value of the case, and errors below round-off at it.
smallest(name) = 0.0 + (system(sprintf("awk -F, '$1 == \"%s\" && $2 > 0 && (!m || $2 < m) { m = $2 } END { printf(\"%%.20f\", m / 10) }' '%s'", name, csv)))
mine(stepper) = strcol("case") eq this && strcol("stepper") eq stepper
finite(text) = text ne "nan" && text ne "inf"
error(x) = finite(strcol("error")) ? column("error") : NaN
is_right(x) = error(0) <= column("limit")
abscissa(x) = strcol("case") ne this ? NaN : column("parameter") > 0 ? column("parameter") : least
ran(stepper) = mine(stepper) && is_right(0) && strcol("outcome") eq "ok" ? floor_of(error(0)) : NaN
refused(stepper) = mine(stepper) && is_right(0) && strcol("outcome") ne "ok" ? floor_of(error(0)) : NaN
wrong(stepper) = mine(stepper) && !is_right(0) ? floor_of(error(0) == error(0) ? error(0) : column("limit")) : NaN
limit(stepper) = mine(stepper) && column("limit") > 0 ? floor_of(column("limit")) : NaN
floor_of(e) = e > 1e-17 ? e : 1e-17
taken(stepper) = mine(stepper) && column("steps") > 0 ? column("steps") : NaN

stepped(name) = int(system(sprintf("awk -F, '$1 == \"%s\" && $6 > 0 { n++ } END { print n + 0 }' '%s'", name, csv)))
# The last column, in quotes if it has a comma.
varied(name) = system(sprintf("awk -F, '$1 == \"%s\"' '%s' | sed -n 1p | cut -d, -f9- | tr -d '\"'", name, csv))

set logscale xy
set offsets graph 0.08, graph 0.08, graph 0.08, graph 0.08
set format "10^{%T}"
set mxtics 1
set mytics 1
unset key

do for [this in cases] {
  least = smallest(this)
  set terminal svg size 560,270 dynamic enhanced font "sans-serif,12"
  set output file("extremes-" . this . ".svg")
  set multiplot layout 1,2 margins 0.1,0.98,0.24,0.9 spacing 0.1,0
  set label 1 varied(this) at screen 0.5, screen 0.05 center noenhanced
  set title "error" offset 0,-0.7
  plot for [k = 1:2] csv using (abscissa(0)):(limit(word(steppers, k))) with lines dashtype 2 linewidth 1.5 linecolor rgb word(colours, k), \
       for [k = 1:2] csv using (abscissa(0)):(ran(word(steppers, k))) with linespoints linewidth 1.5 pointtype 7 pointsize 0.7 linecolor rgb word(colours, k), \
       for [k = 1:2] csv using (abscissa(0)):(refused(word(steppers, k))) with points pointtype 6 pointsize 0.9 linewidth 2 linecolor rgb word(colours, k), \
       for [k = 1:2] csv using (abscissa(0)):(wrong(word(steppers, k))) with points pointtype 2 pointsize 1.2 linewidth 3 linecolor rgb red
  unset label 1
  set title "steps"
  if (stepped(this)) {
    plot for [k = 1:2] csv using (abscissa(0)):(taken(word(steppers, k))) with linespoints linewidth 1.5 pointtype 7 pointsize 0.7 linecolor rgb word(colours, k)
  } else { # gnuplot refuses to plot nothing
    set label 2 "none: all about the start" at graph 0.5, graph 0.5 center
    plot [1:10] [1:10] 0.1
    unset label 2
  }
  unset multiplot
  unset output
}
