#!/bin/sh
# The price of each contact feature, as a table in Markdown: time per particle-step and bytes per particle from
# build/release, instructions per contact from callgrind (valgrind knows no AVX-512: a second build without it,
# in build/count). The last rows show what a scene pays for laws that it does not name: instructions per contact
# with jkr, dmt and van_der_waals deleted from the list of kernels, which must not differ by one.
#   tests/bench/feature_cost.sh [STEPS counted, default 3]
set -eu
cd "$(dirname "$0")/../.."
steps=${1:-3}
command -v valgrind >/dev/null || { echo "error: valgrind is missing; install it: apt-get install valgrind" >&2; exit 1; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

build() { # folder, source folder
  cmake -S "$2" -B "$1" -G Ninja -DCMAKE_BUILD_TYPE=Release -DINTERSTICE_ARCH=x86-64-v3 >"$scratch/log" 2>&1 &&
    cmake --build "$1" --target bench_features >>"$scratch/log" 2>&1 || { tail -n 20 "$scratch/log" >&2; exit 1; }
}

instructions() { # program, combination -> instructions in the pair kernels, contacts, listed pairs
  numbers=$(valgrind --tool=callgrind --callgrind-out-file=/dev/null '--toggle-collect=*pairs_entry*' \
    "$1" count "$scratch/bed" "$2" "$steps" 2>"$scratch/callgrind")
  collected=$(sed -n 's/.*Collected : \([0-9]*\).*/\1/p' "$scratch/callgrind")
  # The three steps of preparation are counted by callgrind too.
  echo "$collected $numbers" | awk -v s="$steps" '{ printf "%.1f %.2f\n", $1 / ($2 * (s + 3) / s), $3 / $2 }'
}

cmake --build build/release --target bench_features >"$scratch/log" 2>&1 || { tail "$scratch/log" >&2; exit 1; }
build/release/tests/bench/bench_features make "$scratch/bed"
build/release/tests/bench/bench_features table "$scratch/bed" >"$scratch/table"
build build/count .
echo "| laws | ns per particle-step (low–high) | bytes per particle | instructions per contact | listed pairs per contact |"
echo "|---|---|---|---|---|"
for name in $(build/count/tests/bench/bench_features names); do
  set -- $(instructions build/count/tests/bench/bench_features "$name")
  awk -F'\t' -v n="$name" -v i="$1" -v l="$2" \
    '$1 == n { printf "| %s | %s (%s–%s) | %s | %s | %s |\n", $1, $2, $3, $4, $5, i, l }' "$scratch/table"
done

# The same without the policies that these scenes do not name.
mkdir "$scratch/source"
git ls-files -z | xargs -0 cp --parents -t "$scratch/source"
sed -i '/jkr},\|dmt},\|van_der_waals},/{/sjkr/!d}' "$scratch/source/dem/kernels/listed_laws.h"
build "$scratch/build" "$scratch/source"
echo
echo "| laws | instructions per contact | with jkr, dmt and van der Waals deleted from the list |"
echo "|---|---|---|"
for name in hertz hertz+mindlin+cdt hertz+mindlin+cdt+sjkr; do
  echo "| $name | $(instructions build/count/tests/bench/bench_features $name | cut -d' ' -f1)" \
    "| $(instructions "$scratch/build/tests/bench/bench_features" $name | cut -d' ' -f1) |"
done
