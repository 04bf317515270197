#!/bin/sh
# What fields cost a run: 5,000 steps of a bed as of paper 004 (35,000 grains of 5 to 65 um on a floor), with a field of
# 17.3 um voxels every 1,000 steps (the .vdb, the .vti, slices, lines, layers) and without, in turns.
#   field_share.sh INTERSTICE BED.dump [ROUNDS]     BED: a text dump with columns x y z and diameter or radius
set -eu
command=$(realpath "$1")
bed=$(realpath "$2")
rounds=${3:-3}
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
cd "$work"
case $bed in *.gz) zcat "$bed" ;; *) cat "$bed" ;; esac | awk '
  /^ITEM: ATOMS/ { for (i = 3; i <= NF; ++i) at[$i] = i - 2; rows = 1; print "x [m],y [m],z [m],diameter [m]"; next }
  /^ITEM/ { rows = 0 }
  rows { printf "%s,%s,%s,%s\n", $at["x"], $at["y"], $at["z"], "diameter" in at ? $at["diameter"] : 2 * $at["radius"] }' > grains.csv
cat > plain.toml <<'S'
[domain]
box = [["-0.1 mm", "3.1 mm"], ["-0.1 mm", "0.6 mm"], ["-0.1 mm", "2.2 mm"]]
boundary = ["open", "open", "open"]
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[materials.powder]
density = "8200 kg/m^3"
youngs_modulus = "1 GPa"
poisson_ratio = 0.3
[contact]
normal = "hertz"
damping = "tension"
tangential = "mindlin"
rolling = "cdt"
cohesion = "sjkr"
[[contact.pair]]
materials = ["powder", "powder"]
restitution = 0.35
friction = 0.3
rolling_friction = 0.005
cohesion_energy_density = "1 MJ/m^3"
[[particles]]
name = "bed"
material = "powder"
insert = { method = "list", file = "grains.csv" }
[[walls]]
name = "floor"
material = "powder"
shape = { plane = { point = ["0 m", "0 m", "0 m"], normal = [0, 0, 1] } }
[[phases]]
name = "rest"
duration = "40 us"
[time]
step = "8 ns"
seed = 1
[output]
series = "8 us"
S
cp plain.toml fields.toml
cat >> fields.toml <<'S'
[[fields]]
name = "bed"
voxel = "17.3 um"
box = [["0 mm", "3 mm"], ["0 mm", "0.5 mm"], ["0 mm", "1.7 mm"]]
every = "8 us"
slices = ["x=1.5 mm", "z=0.5 mm"]
lines = ["x@y=0.25 mm,z=0.5 mm"]
S
echo "| round | scene | wall s | steps s | M particle-steps/s | waited for fields % | fields beside % | files % |"
echo "|---|---|---|---|---|---|---|---|"
for round in $(seq "$rounds"); do
  for scene in plain fields; do
    "$command" run $scene.toml -o out-$scene --overwrite --quiet --no-figures > /dev/null
    awk -v round="$round" -v scene=$scene '
      { gsub(/[",:]/, " ") }
      $1 == "wall_s" { wall = $2 } $1 == "particle_steps_per_s" { rate = $2 } $1 == "share_stepping" { steps = $2 }
      $1 == "share_fields_waited" { waited = $2 } $1 == "share_fields_beside" { beside = $2 } $1 == "share_files" { files = $2 }
      END { printf "| %d | %s | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f |\n", round, scene, wall, wall * steps, rate / 1e6,
            100 * waited, 100 * beside, 100 * files }' out-$scene/run.json
  done
done
