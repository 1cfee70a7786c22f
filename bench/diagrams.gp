# Three pictures from the tables of `dalembert-bench diagrams`:
#   gnuplot -e "report='.'" diagrams.gp
# report/hoop-branches: equilibria of the bead on a turning hoop (mex39); report/governor-branches: of the governor
# (mex23); report/kapitza-chart: where a pendulum stands upright on a shaken pivot.

file(name) = sprintf("%s/%s", report, name)
colours = "#0072B2 #D55E00" # Okabe and Ito: told apart by colour-blind readers
set datafile separator comma
set border linecolor rgb "#444444"
set grid linetype 1 linewidth 0.7 linecolor rgb "#dddddd"

holds(angle) = column("softest") > -1e-9 ? angle : NaN
yields(angle) = column("softest") < 1e-9 ? angle : NaN
branches(csv) = system(sprintf("awk -F, 'NR > 1 && !seen[$1]++ { print $1 }' '%s'", csv))
mine(b, angle) = strcol("branch") eq b ? angle : NaN

do for [terminal in "svg png"] {
  if (terminal eq "svg") {
    set terminal svg size 900,560 dynamic enhanced font "DejaVu Sans,15" background rgb "white"
  } else {
    set terminal pngcairo size 1350,840 enhanced font "DejaVu Sans,15" fontscale 1.3 linewidth 1.5 background rgb "white"
  }

  set ylabel "angle from the vertical / degrees"
  set key top left Left reverse samplen 3
  set yrange [-90:90]
  set ytics 30
  do for [name in "hoop governor"] {
    csv = file(name . ".csv")
    set output file(name . "-branches." . terminal)
    set title (name eq "hoop" ? "Bead on a hoop that turns about its vertical diameter (mex39)" : "Watt's governor (mex23)") font ",20"
    set xlabel "rate of turning / (rad/s)"
    plot for [b in branches(csv)] csv using "rate":(mine(b, holds(column("angle_deg")))) with lines linewidth 3 linecolor rgb word(colours, 1) notitle, \
         for [b in branches(csv)] csv using "rate":(mine(b, yields(column("angle_deg")))) with lines linewidth 3 dashtype 2 linecolor rgb word(colours, 2) notitle, \
         NaN with lines linewidth 3 linecolor rgb word(colours, 1) title "stiffness > 0", \
         NaN with lines linewidth 3 dashtype 2 linecolor rgb word(colours, 2) title "stiffness < 0"
    unset output
  }

  set output file("kapitza-chart." . terminal)
  set title "Pendulum upright on a shaken pivot" font ",20"
  set xlabel "amplitude A/l"
  set ylabel "gravity g/(l {/Symbol w}^2)"
  set xrange [0:0.6]
  set yrange [0:0.12]
  set ytics 0.02
  set key top left opaque
  set cblabel "log_{10} of growth in a period, by floquet"
  set palette defined (0 "#ffffff", 0.001 "#cfe3f1", 1 "#0072B2")
  set cbrange [0:1]
  plot file("kapitza.csv") using "amplitude":"gravity":(column("growth") > 1 + 1e-5 ? log10(column("growth")) : 0) with image notitle, \
       file("kapitza-boundary.csv") using "amplitude":(strcol("side") eq "lower" ? column("gravity") : NaN) with lines linewidth 2 linecolor rgb word(colours, 2) title "exact boundary: a_0, b_1 of Mathieu's equation", \
       file("kapitza-boundary.csv") using "amplitude":(strcol("side") eq "upper" ? column("gravity") : NaN) with lines linewidth 2 linecolor rgb word(colours, 2) notitle
  unset output
  set xrange [*:*]
  unset cblabel
}
