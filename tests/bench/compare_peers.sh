#!/bin/sh
# This engine and other codes on the same beds, in turns: Hertz and Mindlin's springs with history, gravity, the same positions at the start
# and the same time step. Prints the tables of docs/PERFORMANCE.md: medians (lowest-highest) of all blocks, and ratios of medians.
#   compare_peers.sh INTERSTICE [ROUNDS [PART...]]
#   PART: bed-35k, bed-materials (of two, mixed), bed-200k, bed-1m (LIGGGHTS on settled beds), lammps, yade (on 35,000 equal grains), spreading (LIGGGHTS, whole runs);
#   all of them unless some are named. Codes that are missing are installed (Debian's packages, as root or with sudo); one that cannot be
#   costs its part only.
#   Environment: STEPS in a block of 35,000 grains (40; half as many of the larger beds; of ours six times as
#   many, which take about as long as LIGGGHTS'), SHARE: 20 for a 20th of the spreading run.
set -eu
command=$(realpath "$1")
here=$(realpath "$(dirname "$0")")/peers
rounds=${2:-5}
[ $# -lt 2 ] && shift 1 || shift 2
parts=${*:-bed-35k bed-materials bed-200k bed-1m lammps yade spreading}
block=${STEPS:-40}
share=${SHARE:-20}
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
cd "$work"
cp "$here"/* .
. ./numbers.sh
. ./install.sh
. ./beds.sh
. ./spreading.sh

install_peers $parts
grep -m1 'model name' /proc/cpuinfo | sed 's/.*: //'
"$command" --version | head -1
dpkg-query -W -f '${Package} ${Version}\n' liggghts lammps yade 2> /dev/null || true
for part in $parts; do
  echo
  case $part in
    bed-35k) needs liggghts && beside_liggghts 35000 "$block" "equal powder wide" "sjkr none" "1 2" ;;
    bed-materials) needs liggghts && beside_liggghts 35000 "$block" "equal powder" sjkr "1 2" 2 ;;
    bed-200k) needs liggghts && beside_liggghts 200000 $((block / 2)) "equal powder" "sjkr none" "1 2" ;;
    bed-1m) needs liggghts && beside_liggghts 1000000 $((block / 2)) "equal powder" "sjkr none" "1 2" ;;
    lammps) needs lmp && beside_lammps "$block" ;;
    yade) needs yade && beside_yade $((block / 2 + 1)) ;;
    spreading) needs liggghts && spreading "$share" ;;
    *) echo "compare_peers.sh: no part $part; see the head of the script" >&2; exit 2 ;;
  esac || echo "$part: left out"
done
