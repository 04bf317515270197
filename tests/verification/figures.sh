#!/bin/sh
# Draws what a curve says better than a table, from the rows of the verification and extremes programs.
#   tests/verification/figures.sh FOLDER_WITH_TSV OUT.png        oblique impacts (Chung & Ooi tests 4, 5, 6)
#   tests/verification/figures.sh --map STABILITY_MAP.tsv OUT.png  restitution against the time step
set -eu
data=$(mktemp -d)
trap 'rm -rf "$data"' EXIT

# rows CASE QUANTITY FROM: "x reference got" of the double back end, x being the number after FROM
rows() {
  grep -h "$1" "$source"/verify_chung_ooi.tsv | grep '(double)' | grep -F "$2" |
    awk -F'\t' -v from="$3" '{ s = $3; sub(".*" from, "", s); print s + 0, $4, $5 }'
}

style='set terminal pngcairo size 1500,520 font "DejaVu Sans,12"; set output output
set grid lc rgb "#dddddd"; set tics out nomirror; set border 3'

if [ "$1" = --map ]; then
  awk -F'\t' '$1 == "double" && $4 == 1 && $5 == 1 { print $2, $3, $6, $7, $8 }' "$2" >"$data/map"
  sort -un -k1,1 "$data/map" | cut -d' ' -f1 >"$data/set"
  cat >"$data/plot" <<PLOT
output = '$3'; data = '$data/map'
$(echo "$style" | sed 's/1500,520/900,560/')
PLOT
  cat >>"$data/plot" <<'PLOT'
    set logscale x; set xrange [0.008:0.7]; set yrange [0:2]; set key top left
    set xlabel "time step / collision time"; set ylabel "restitution"
    set arrow from 0.05, 0 to 0.05, 2 nohead dt 2 lc rgb "#888888"; set label "warned of" at 0.051, 0.08
    set arrow from 0.2, 0 to 0.2, 2 nohead dt 2 lc rgb "#888888"; set label "refused" at 0.205, 0.08
    plot data using 2:($1 == 1 ? $4 : NaN):5 with filledcurves fc rgb "#a6cee3" title "e = 1: least to most over 40 phases", \
         data using 2:($1 == 1 ? $3 : NaN) with linespoints lc rgb "#1f78b4" pt 7 title "mean", \
         data using 2:($1 < 1 ? $4 : NaN):5 with filledcurves fc rgb "#b2df8a" title "e = 0.5", \
         data using 2:($1 < 1 ? $3 : NaN) with linespoints lc rgb "#33a02c" pt 7 title "mean"
PLOT
  gnuplot "$data/plot"
  exit 0
fi

source=$1
rows "Test 4" "rebound angle" "at " >"$data/angle"
rows "Test 5.*steel" "R w'" "= " >"$data/five"
rows "Test 6.*nylon" "beta at" "v_st = " >"$data/six"
cat >"$data/plot" <<PLOT
output = '$2'; d = '$data'
$style
PLOT
cat >>"$data/plot" <<'PLOT'
  set multiplot layout 1,3 margins 0.06,0.98,0.13,0.9 spacing 0.07,0.1
  set title "Test 4: aluminium oxide on a plane"; set key top left
  set xlabel "angle of incidence [deg]"; set ylabel "rebound angle [deg]"
  plot d."/angle" using 1:3 with lines lw 2 lc rgb "#1f78b4" title "Interstice", \
       d."/angle" using 1:2 with points pt 6 lc rgb "#e31a1c" title "published (Kratos)"
  set title "Test 5: steel"; set key top right
  set xlabel "v_t / ({/Symbol m} v_n)"; set ylabel "R {/Symbol w}\047 / ({/Symbol m} v_n)"
  plot d."/five" using 1:3 with lines lw 2 lc rgb "#1f78b4" title "Interstice", \
       d."/five" using 1:2 with points pt 6 lc rgb "#e31a1c" title "finite elements"
  set title "Test 6: nylon"; set key bottom right
  set xlabel "3.5 {/Symbol m} (1 + e) v_n / v_{st}"; set ylabel "{/Symbol b}"
  plot d."/six" using 1:3 with lines lw 2 lc rgb "#1f78b4" title "Interstice", \
       d."/six" using 1:2 with points pt 6 lc rgb "#e31a1c" title "published"
  unset multiplot
PLOT
gnuplot "$data/plot"
