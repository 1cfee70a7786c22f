# Three pictures from the tables of `dalembert-bench diagrams`:
#   gnuplot -e "report='build/report'" bench/charts/diagrams.gp
# report/hoop-branches: equilibria of the bead on a turning hoop (mex39); report/governor-branches: of the governor
# (mex23); report/kapitza-chart: where a pendulum stands upright on a shaken pivot.

load "bench/charts/style.gp"

holds(angle) = column("softest") > -1e-9 ? angle : NaN
yields(angle) = column("softest") < 1e-9 ? angle : NaN
branches(csv) = system(sprintf("awk -F, 'NR > 1 && !seen[$1]++ { print $1 }' '%s'", csv))
mine(b, angle) = strcol("branch") eq b ? angle : NaN

set terminal svg size 560,400 dynamic enhanced font "sans-serif,13"

set ylabel "angle from the vertical / degrees"
set format y "%g"
set yrange [-90:90]
set ytics 30
do for [name in "hoop governor"] {
  csv = file(name . ".csv")
  set output file(name . "-branches.svg")
  set xlabel "rate of turning / (rad/s)"
  plot for [b in branches(csv)] csv using "rate":(mine(b, holds(column("angle_deg")))) with lines linewidth 3 linecolor rgb word(colours, 1) notitle, \
       for [b in branches(csv)] csv using "rate":(mine(b, yields(column("angle_deg")))) with lines linewidth 3 dashtype 2 linecolor rgb word(colours, 2) notitle, \
       NaN with lines linewidth 3 linecolor rgb word(colours, 1) title "stiffness > 0", \
       NaN with lines linewidth 3 dashtype 2 linecolor rgb word(colours, 2) title "stiffness < 0"
  unset output
}

set output file("kapitza-chart.svg")
set xlabel "amplitude A/l"
set ylabel "gravity g/(l ω^2)"
set xrange [0:0.6]
set yrange [0:0.12]
set ytics 0.02
set cblabel "log_{10} of growth in a period, by floquet"
set palette defined (0 "#ffffff", 0.001 "#cfe3f1", 1 "#0072B2")
set cbrange [0:1]
plot file("kapitza.csv") using "amplitude":"gravity":(column("growth") > 1 + 1e-5 ? log10(column("growth")) : 0) with image notitle, \
     file("kapitza-boundary.csv") using "amplitude":(strcol("side") eq "lower" ? column("gravity") : NaN) with lines linewidth 2 linecolor rgb word(colours, 2) title "exact boundary: a_0, b_1 of Mathieu's equation", \
     file("kapitza-boundary.csv") using "amplitude":(strcol("side") eq "upper" ? column("gravity") : NaN) with lines linewidth 2 linecolor rgb word(colours, 2) notitle
unset output
