# What all charts share. The report colours them by its style sheet, which knows the colours named here: Okabe and
# Ito's, told apart by colour-blind readers.
blue = "#0072B2"
orange = "#D55E00"
green = "#009E73"
pink = "#CC79A7"
yellow = "#E69F00"
sky = "#56B4E9"
colours = blue . " " . orange . " " . green . " " . pink . " " . yellow . " " . sky
red = "#CC0000" # what is wrong
colour(i) = word(colours, (i - 1) % words(colours) + 1)

set datafile separator comma
set border linecolor rgb "#444444"
set grid xtics ytics linetype 1 linewidth 0.7 linecolor rgb "#DDDDDD"
set key outside above left Left reverse horizontal samplen 2 noenhanced
set format y "10^{%T}"
file(name) = sprintf("%s/%s", report, name)
