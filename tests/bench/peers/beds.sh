# Settled beds with periodic sides, timed in blocks. Sourced by compare_peers.sh; rates are in million particle-steps/s.

# sizes, grains, options of bench, types of grains: makes bed.dump and bed.data; sets grains and dt
make_bed() {
  "$command" bench --sizes "$1" --grains "$2" $3 --warm-up 200 --blocks 1 --steps 1 --write-bed bed.dump > bed.json
  dt=$(sed -n 's/.*"time_step_s": \([^,]*\),*/\1/p' bed.json)
  coordination=$(sed -n '/"before"/,/}/s/.*"coordination": \([0-9.]*\).*/\1/p' bed.json | cut -c1-4)
  awk -v types="${4:-1}" '/NUMBER OF ATOMS/ { getline n; next } /BOX BOUNDS/ { for (i = 0; i < 3; ++i) { getline; hi[i] = $2 } next }
       /ITEM: ATOMS/ { rows = 1
         printf "bed\n\n%d atoms\n2 atom types\n0 %s xlo xhi\n0 %s ylo yhi\n-5e-06 %s zlo zhi\n\nAtoms\n\n", n, hi[0], hi[1], hi[2] + 2e-3
         next }
       rows { printf "%d %d %.12g 8200 %s %s %s\n", $1, types - $1 % types, 2 * $5, $2, $3, $4 }' bed.dump > bed.data
  grains=$(awk '/ atoms/ { print $1; exit }' bed.data)
}

# file of rates, steps in a block: from "Loop time of SECONDS" of blocks of that many steps
rates_from_loops() { awk -v n="$grains" -v s="$2" '/Loop time of/ && ($9 == s || NF == 4) { print n * s / $4 / 1e6 }' >> "$1"; }

# file of rates, steps, processes, skin [m], sjkr or none
liggghts_bed() {
  parallel "$3" liggghts -in bed.liggghts -log none -var px "$3" -var skin "$4" -var dt "$dt" -var steps "$2" -var model "$(model "$5")" \
    -var E 1e9 -var k 1e6 2> /dev/null | rates_from_loops "$1" "$2"
}

# file of rates, steps of theirs in a block, threads, precision, options: in blocks that last about as long as theirs
ours() {
  "$command" bench --bed bed.dump --periodic --threads "$3" --precision "$4" --warm-up 20 --blocks 3 --steps $((6 * $2)) $5 |
    awk '/"rates"/ { rates = 1; next } rates && /]/ { exit } rates { sub(",", ""); print $1 / 1e6 }' >> "$1"
}

# steps, processes, sjkr or none: the skin that LIGGGHTS is fastest with
best_skin() {
  for skin in 1e-6 2e-6 4e-6; do
    : > tried
    liggghts_bed tried "$1" "$2" $skin "$3"
    echo "$(median tried) $skin"
  done | sort -g | tail -1 | cut -d' ' -f2
}

# grains, steps in a block, sizes, cohesions, threads, types of grains
beside_liggghts() {
  wanted=$1
  types=${6:-1}
  echo "| bed | coordination | cohesion | threads | LIGGGHTS' best skin, um | LIGGGHTS | double | ratio | mixed | ratio |"
  echo "|---|---|---|---|---|---|---|---|---|---|"
  for sizes in $3; do
    for cohesion in $4; do
      case $cohesion in sjkr) option= ;; *) option=--no-cohesion ;; esac
      make_bed "$sizes" "$wanted" "$option" "$types"
      [ "$types" = 1 ] || option="$option --two-materials"
      for threads in $5; do
        skin=$(best_skin "$2" "$threads" "$cohesion")
        : > theirs; : > double; : > mixed
        for round in $(seq "$rounds"); do
          liggghts_bed theirs "$2" "$threads" "$skin" "$cohesion"
          ours double "$2" "$threads" double "$option"
          ours mixed "$2" "$threads" mixed "$option"
        done
        um=$(awk -v s="$skin" 'BEGIN { print s * 1e6 }')
        echo "| $grains, $sizes | $coordination | $cohesion | $threads | $um | $(spread theirs) | $(spread double) | $(ratio double theirs) | $(spread mixed) | $(ratio mixed theirs) |"
      done
    done
  done
}

# steps in a block
beside_lammps() {
  echo "LAMMPS has no CDT and no SJKR: the first pair of ours is without both, the second with CDT."
  echo
  echo "| LAMMPS style | threads | LAMMPS | double | ratio | mixed | ratio | double, CDT | ratio | mixed, CDT | ratio |"
  echo "|---|---|---|---|---|---|---|---|---|---|---|"
  make_bed equal 35000 --no-cohesion
  for style in 1 2; do
    for threads in 1 2; do
      : > theirs; : > double; : > mixed; : > double_cdt; : > mixed_cdt
      for round in $(seq "$rounds"); do
        parallel "$threads" lmp -in bed.lammps -log none -var px "$threads" -var skin 2e-6 -var dt "$dt" -var steps "$1" -var style $style \
          2> /dev/null | rates_from_loops theirs "$1"
        for precision in double mixed; do
          ours $precision "$1" "$threads" $precision "--no-cohesion --no-rolling"
          ours ${precision}_cdt "$1" "$threads" $precision --no-cohesion
        done
      done
      case $style in 1) name=gran/hertz/history ;; *) name=granular ;; esac
      row="| $name | $threads | $(spread theirs) |"
      for file in double mixed double_cdt mixed_cdt; do row="$row $(spread $file) | $(ratio $file theirs) |"; done
      echo "$row"
    done
  done
}

# steps in a block
beside_yade() {
  echo "YADE runs without rolling friction and cohesion; so does this engine here."
  echo
  echo "| threads | YADE | double | ratio | mixed | ratio |"
  echo "|---|---|---|---|---|---|"
  make_bed equal 35000 --no-cohesion
  for threads in 1 2; do
    : > theirs; : > double; : > mixed
    for round in $(seq "$rounds"); do
      BED=bed.dump DT=$dt STEPS=$1 yade -j"$threads" -n -x bed.yade.py 2> /dev/null | rates_from_loops theirs "$1"
      for precision in double mixed; do ours $precision "$1" "$threads" $precision "--no-cohesion --no-rolling"; done
    done
    echo "| $threads | $(spread theirs) | $(spread double) | $(ratio double theirs) | $(spread mixed) | $(ratio mixed theirs) |"
  done
}
