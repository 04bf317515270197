# A blade spreads a heap of 3,000 grains: whole runs with all that goes with them, timed by the clock on the wall. Sourced by compare_peers.sh.

# seconds COMMAND...: appends how long it took to a file
seconds() {
  file=$1
  shift
  start=$(date +%s.%N)
  "$@" > run.log 2>&1 || { grep -i error run.log | head -3 >&2; return 1; }
  date +%s.%N | awk -v s="$start" '{ print $1 - s }' >> "$file"
}

# The places of spread_MS.csv for LIGGGHTS.
spread_data() {
  awk -F, -v rows="$(grep -c '^[0-9-]' "$1")" '
    BEGIN { printf "heap\n\n%d atoms\n2 atom types\n-0.0001 0.0043 xlo xhi\n0 0.0005 ylo yhi\n-0.0003 0.0014 zlo zhi\n\nAtoms\n\n", rows }
    /^[0-9-]/ { printf "%d 1 %se-6 8200 %se-6 %se-6 %se-6\n", ++n, $4, $1, $2, $3 }' "$1" > spread.data
}

# share of the run: 20 for a 20th of it
spreading() {
  steps=$((655557 / $1))
  echo "Spreading, $steps steps of 90 ns of 655,557, seconds of the clock on the wall:"
  echo
  echo "| from | threads | LIGGGHTS | double | ratio | mixed | ratio |"
  echo "|---|---|---|---|---|---|---|"
  for start in "1 4.9995e-5" "30 1.49998e-3"; do
    ms=${start% *} gone=${start#* }
    cp "spread_$ms.csv" spread.csv
    spread_data spread.csv
    lo=$(awk -v g="$gone" 'BEGIN { printf "%.6f mm", (g - 30e-6) * 1e3 }')
    hi=$(awk -v g="$gone" 'BEGIN { printf "%.6f mm", (g - 1e-6) * 1e3 }')
    duration=$(awk -v s="$steps" 'BEGIN { printf "%.5f ms", s * 90e-6 }')
    for threads in 1 2; do
      : > theirs; : > double; : > mixed
      for round in $(seq "$rounds"); do
        seconds theirs parallel "$threads" liggghts -in spread.liggghts -log none -var px "$threads" -var steps "$steps" -var blade "$gone" \
          -var dt 9e-8 -var E 1e8 -var k 2.154e5 -var model "$(model sjkr)" || true
        for precision in double mixed; do
          seconds $precision "$command" run spread.toml -o out --overwrite --no-figures --quiet --threads "$threads" --precision $precision \
            --set phases.spread.duration="$duration" --set walls.blade.shape.box.lo.0="$lo" --set walls.blade.shape.box.hi.0="$hi" || true
        done
      done
      echo "| $ms ms | $threads | $(spread theirs) | $(spread double) | $(ratio theirs double) | $(spread mixed) | $(ratio theirs mixed) |"
    done
  done
}
