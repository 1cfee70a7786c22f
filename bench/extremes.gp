# Sheets of small plots, one per case, from the table of `dalembert-bench extremes`:
#   gnuplot -e "csv='extremes.csv'; report='.'" extremes.gp
# report/extremes-error-N: errors against their limits; report/extremes-steps-N: steps.

cases = system(sprintf("awk -F, 'NR > 1 && !seen[$1]++ { print $1 }' '%s'", csv))
steppers = "ida erk"
colours = "#0072B2 #D55E00" # Okabe and Ito: told apart by colour-blind readers
across = 4
down = 5
per_sheet = across * down
sheets = (words(cases) + per_sheet - 1) / per_sheet

# Zeros are drawn a decade below the smallest value of the case, and errors below round-off at it.
smallest(name) = 0.0 + (system(sprintf("awk -F, '$1 == \"%s\" && $2 > 0 && (!m || $2 < m) { m = $2 } END { printf(\"%%.20f\", m / 10) }' '%s'", name, csv)))
set datafile separator comma
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

set logscale xy
set offsets graph 0.08, graph 0.08, graph 0.08, graph 0.08
set format "10^{%T}"
set grid xtics ytics linetype 1 linewidth 0.7 linecolor rgb "#dddddd"
set border linecolor rgb "#444444"
set terminal pngcairo size 2400,2600 enhanced font "DejaVu Sans,15" background rgb "white"
unset key

do for [sheet = 1:sheets] {
  do for [kind in "error steps"] {
    set output sprintf("%s/extremes-%s-%d.png", report, kind, sheet)
    what = kind eq "error" \
           ? "Error: dots ida (blue), erk (orange); dashed their limits; hollow: refused as is due; red cross: neither" \
           : "Steps: ida (blue), erk (orange)"
    set multiplot layout down, across title what font ",22"
    do for [i = (sheet - 1) * per_sheet + 1 : (sheet * per_sheet < words(cases) ? sheet * per_sheet : words(cases))] {
      this = word(cases, i)
      least = smallest(this)
      set title this noenhanced font ",17"
      if (kind eq "error") {
        plot for [k = 1:2] csv using (abscissa(0)):(limit(word(steppers, k))) with lines dashtype 2 linewidth 1.5 linecolor rgb word(colours, k), \
             for [k = 1:2] csv using (abscissa(0)):(ran(word(steppers, k))) with linespoints linewidth 1.5 pointtype 7 pointsize 1.3 linecolor rgb word(colours, k), \
             for [k = 1:2] csv using (abscissa(0)):(refused(word(steppers, k))) with points pointtype 6 pointsize 1.8 linewidth 2 linecolor rgb word(colours, k), \
             for [k = 1:2] csv using (abscissa(0)):(wrong(word(steppers, k))) with points pointtype 2 pointsize 2.2 linewidth 3 linecolor rgb "#cc0000"
      } else {
        if (stepped(this)) {
          plot for [k = 1:2] csv using (abscissa(0)):(taken(word(steppers, k))) with linespoints linewidth 1.5 pointtype 7 pointsize 1.3 linecolor rgb word(colours, k)
        } else { # gnuplot refuses to plot nothing
          set label 1 "no steps: all about the start" at graph 0.5, graph 0.5 center
          plot [1:10] [1:10] 0.1
          unset label 1
        }
      }
    }
    unset multiplot
    unset output
  }
}
