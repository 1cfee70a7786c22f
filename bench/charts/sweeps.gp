# Three pictures from the tables of `dalembert-bench sweep`:
#   gnuplot -e "report='build/report'; flips=1000; kapitza=150" bench/charts/sweeps.gp
# report/sweep-flips: first flip of a double pendulum over its start angles; report/sweep-kapitza: when a pendulum upright
# on a shaken pivot leaves, and where Floquet multipliers are stable; report/sweep-governors: bearing force of governors made
# within tolerances. flips and kapitza are points along either axis.

flips = int(flips + 0.5)
kapitza = int(kapitza + 0.5)
load "bench/charts/style.gp"
set format y "%g"
stats file("governors-quantile.csv") using "force" every ::0 nooutput
q = STATS_min
stats file("governors-quantile.csv") using "lower" nooutput
q_lower = STATS_min
stats file("governors-quantile.csv") using "upper" nooutput
q_upper = STATS_min
stats file("governors.csv") using "force" nooutput
bins = 60
width = STATS_max / bins
count = STATS_records

set terminal svg size 560,460 dynamic enhanced font "sans-serif,13"

# Row by row angle1, along each row angle2.
set output file("sweep-flips.svg")
set xlabel "angle of the lower rod / π"
set ylabel "angle of the upper rod / π"
set cblabel "time / (l/g)^{1/2}; blank: none until 50"
set size ratio -1
set xrange [-1:1]
set yrange [-1:1]
set xtics 0.5
set ytics 0.5
set logscale cb
set cbrange [0.7:50]
set palette defined (0 "#440154", 1 "#3b528b", 2 "#21918c", 3 "#5ec962", 4 "#fde725") # viridis
step = 2.0 / flips
plot file("flips.bin") binary array=(flips,flips) format="%float32" \
       origin=(-1 + step / 2, -1 + step / 2) dx=step dy=step using ($1 < 1e9 ? $1 : NaN) with image notitle
unset output
unset logscale cb
set size noratio

# Row by row amplitude, along each row gravity: transposed.
set output file("sweep-kapitza.svg")
set xlabel "amplitude A/l"
set ylabel "gravity g/(l ω^2)"
set cblabel "periods until 100 times as far off; blank: never in 100"
set xrange [0:0.6]
set yrange [0:0.12]
set xtics 0.1
set ytics 0.02
set logscale cb
set cbrange [2:100]
dx = 0.6 / kapitza
dy = 0.12 / kapitza
plot file("kapitza-runs.bin") binary array=(kapitza,kapitza) scan=yx format="%float32" \
       origin=(dx / 2, dy / 2) dx=dx dy=dy using ($1 < 1e9 ? $1 : NaN) with image notitle, \
     file("kapitza-floquet.csv") using "amplitude":"lower" with lines linewidth 3 linecolor rgb word(colours, 2) title "boundary by Floquet multipliers", \
     file("kapitza-floquet.csv") using "amplitude":(column("upper") < 0.12 ? column("upper") : NaN) with lines linewidth 3 linecolor rgb word(colours, 2) notitle
unset output
unset logscale cb

set output file("sweep-governors.svg")
set xlabel "largest horizontal force on the axis / N"
set ylabel "share of governors per N"
set xrange [0:*]
set yrange [0:*]
set xtics auto
set ytics auto
set style fill solid 0.6 noborder
set arrow 1 from q, graph 0 to q, graph 0.6 nohead linewidth 3 linecolor rgb word(colours, 2)
set object 1 rectangle from q_lower, graph 0 to q_upper, graph 0.6 fillcolor rgb word(colours, 2) fillstyle solid 0.25 noborder
plot file("governors.csv") using ((floor(column("force") / width) + 0.5) * width):(1.0 / count / width) smooth frequency \
       with boxes linecolor rgb word(colours, 1) title sprintf("%d governors", count), \
     NaN with lines linewidth 3 linecolor rgb word(colours, 2) title sprintf("99 %% quantile: %.4f N (95 %%: %.4f to %.4f)", q, q_lower, q_upper)
unset output
