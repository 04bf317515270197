#!/bin/sh
# This engine and LIGGGHTS on the same settled bed, in turns: Hertz-Mindlin with history, CDT, with and without SJKR, gravity, a floor,
# periodic sides, the same time step (0.2 of the Rayleigh time at 1 GPa). Prints a table of particle-steps/s (median, lowest and highest
# of all blocks) and the ratios of the medians.
#   compare_peers.sh INTERSTICE [ROUNDS]     installs Debian's liggghts where it is missing and this may be done
set -eu
command=$(realpath "$1")
rounds=${2:-5}
command -v liggghts > /dev/null || apt-get install -y liggghts > /dev/null
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
cd "$work"

cat > bed.in <<'S'
atom_style granular
atom_modify map array
boundary p p f
newton off
communicate single vel yes
units si
hard_particles yes
processors ${px} 1 1
read_data bed.data
neighbor ${skin} bin
neigh_modify delay 0 every 1 check yes
fix m1 all property/global youngsModulus peratomtype 1.0e9 1.0e9
fix m2 all property/global poissonsRatio peratomtype 0.3 0.3
fix m3 all property/global coefficientRestitution peratomtypepair 2 0.35 0.35 0.35 0.35
fix m4 all property/global coefficientFriction peratomtypepair 2 0.3 0.9 0.9 0.9
fix m5 all property/global coefficientRollingFriction peratomtypepair 2 0.005 0.005 0.005 0.005
fix m6 all property/global cohesionEnergyDensity peratomtypepair 2 1.0e6 1.0e6 1.0e6 1.0e6
pair_style gran model hertz tangential history ${laws} rolling_friction cdt
pair_coeff * *
fix wz all wall/gran model hertz tangential history ${laws} rolling_friction cdt primitive type 2 zplane 0.0
timestep ${dt}
fix gr all gravity 9.81 vector 0 0 -1
fix integ all nve/sphere
thermo 1000
thermo_modify lost error norm no
run 20
run ${steps}
run ${steps}
run ${steps}
S

# name, options of bench
make_bed() {
  "$command" bench $2 --blocks 1 --steps 1 --write-bed "$1.dump" > "$1.json"
  dt=$(sed -n 's/.*"time_step_s": \([^,]*\),*/\1/p' "$1.json")
  awk '/NUMBER OF ATOMS/ { getline n; next } /BOX BOUNDS/ { for (i = 0; i < 3; ++i) { getline; hi[i] = $2 } next }
       /ITEM: ATOMS/ { rows = 1
         printf "bed\n\n%d atoms\n2 atom types\n0 %s xlo xhi\n0 %s ylo yhi\n-5e-06 %s zlo zhi\n\nAtoms\n\n", n, hi[0], hi[1], hi[2] + 2e-3
         next }
       rows { printf "%d 1 %.12g 8200 %s %s %s\n", $1, 2 * $5, $2, $3, $4 }' "$1.dump" > bed.data
  grains=$(awk '/ atoms/ { print $1 }' bed.data)
}

theirs() {  # threads, laws; appends rates to the file `theirs`
  run=liggghts
  [ "$1" = 1 ] || run="mpirun --allow-run-as-root --bind-to none -np $1 liggghts"
  $run -in bed.in -log none -var px "$1" -var skin 2e-6 -var dt "$dt" -var steps 40 -var laws "$2" 2> /dev/null |
    awk -v n="$grains" '/Loop time/ && $9 == 40 { print n * 40 / $4 / 1e6 }' >> theirs
}

ours() {  # threads, precision, options; appends rates to the file of the precision
  "$command" bench --bed "$name.dump" --periodic --threads "$1" --precision "$2" --blocks 3 --steps 40 $3 |
    awk '/"rates"/ { rates = 1; next } rates && /]/ { exit } rates { sub(",", ""); print $1 / 1e6 }' >> "$2"
}

spread() { sort -g "$1" | awk '{ v[NR] = $1 } END { printf "%.2f (%.2f-%.2f)", v[int((NR + 1) / 2)], v[1], v[NR] }'; }
median() { sort -g "$1" | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }
ratio() { awk -v a="$(median "$1")" -v b="$(median theirs)" 'BEGIN { printf "%.1f", a / b }'; }

grep -m1 'model name' /proc/cpuinfo | sed 's/.*: //'
"$command" --version | head -1
dpkg-query -W -f '${Package} ${Version}\n' liggghts
echo "| bed | laws | threads | LIGGGHTS | double | ratio | mixed | ratio |"
echo "|---|---|---|---|---|---|---|---|"
for bed in "equal:--equal-sizes" "sizes:"; do
  name=${bed%%:*}
  make_bed "$name" "${bed#*:}"
  for cohesion in "cohesion sjkr:" ":--no-cohesion"; do
    for threads in 1 2; do
      : > theirs; : > double; : > mixed
      for round in $(seq "$rounds"); do
        theirs "$threads" "${cohesion%%:*}"
        ours "$threads" double "${cohesion#*:}"
        ours "$threads" mixed "${cohesion#*:}"
      done
      echo "| $grains, $name | ${cohesion%%:*} | $threads | $(spread theirs) | $(spread double) | $(ratio double) | $(spread mixed) | $(ratio mixed) |"
    done
  done
done
