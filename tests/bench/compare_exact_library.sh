#!/bin/sh
# Void-fraction fields beside the published exact library (Strobl, Formella and Poeschel, J. Comput. Phys. 311, 158, 2016): 35,000 spheres
# of 5 to 65 um on voxels of 17.3 um, one thread, in turns. Prints times, their ratio, and how far the solid fractions differ.
#   compare_exact_library.sh [FOLDER]        FOLDER holds the library's overlap.hpp; without it, it is cloned from
#                                            github.com/severinstrobl/overlap. Needs Eigen 3. The library is GPL and no part of this project.
# BUILD, SPHERES and ROUNDS in the environment: build/release, 35000, 5.
set -eu
source=$(realpath "$(dirname "$0")/../..")
build=${BUILD:-$source/build/release}
version=0e7b8ff1f0c66e7eb3c32d8649fc9a557b2f7072  # the single header overlap.hpp
if [ $# -gt 0 ]; then
  header=$(realpath "$1")
  [ -f "$header/overlap.hpp" ] || { echo "$header holds no overlap.hpp; name the folder that does" >&2; exit 2; }
else
  header=$(mktemp -d)
  trap 'rm -rf "$header"' EXIT
  git clone -q https://github.com/severinstrobl/overlap "$header" ||
    { echo "the library cannot be cloned; name a folder that holds its overlap.hpp" >&2; exit 2; }
  git -C "$header" checkout -q $version
fi
cmake -S "$source" -B "$build" -DINTERSTICE_EXACT_LIBRARY="$header" > /dev/null
cmake --build "$build" --target bench_exact_library > /dev/null
"$build/tests/bench/bench_exact_library" "${SPHERES:-35000}" "${ROUNDS:-5}"
cmake -S "$source" -B "$build" -UINTERSTICE_EXACT_LIBRARY > /dev/null
