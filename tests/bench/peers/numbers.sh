# Files of one number a line, and what is printed of them. Sourced by compare_peers.sh.
spread() { sort -g "$1" | awk '{ v[NR] = $1 } END { if (NR) printf "%.3g (%.3g-%.3g)", v[int((NR + 1) / 2)], v[1], v[NR]; else printf "failed" }'; }
median() { sort -g "$1" | awk '{ v[NR] = $1 } END { print NR ? v[int((NR + 1) / 2)] : 0 }'; }
ratio() { awk -v a="$(median "$1")" -v b="$(median "$2")" 'BEGIN { if (a > 0 && b > 0) printf "%.2f", a / b; else printf "-" }'; }

# processes, command: with as many processes of MPI
parallel() {
  processes=$1
  shift
  if [ "$processes" = 1 ]; then "$@"; else mpirun --allow-run-as-root --bind-to none -np "$processes" "$@"; fi
}

# sjkr or none: the laws as LIGGGHTS names them
model() { case $1 in sjkr) echo "hertz tangential history cohesion sjkr rolling_friction cdt" ;; *) echo "hertz tangential history rolling_friction cdt" ;; esac; }
