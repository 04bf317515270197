#!/bin/sh
# Installs the build tree into a scratch prefix, builds the consumer against it, runs it.
# usage: check.sh BUILD_DIR SOURCE_DIR SCRATCH_DIR
set -e
build=$1 source=$2 scratch=$3
rm -rf "$scratch"
cmake --install "$build" --prefix "$scratch/prefix" >/dev/null
cmake -S "$source/tests/consumer" -B "$scratch/build" -G Ninja -DCMAKE_PREFIX_PATH="$scratch/prefix" -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build "$scratch/build" >/dev/null
"$scratch/build/consumer"
"$scratch/prefix/bin/interstice" --version
