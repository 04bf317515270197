#!/bin/sh
# Runs the ordinary extremes (and, with LONG=1, the long ones) and makes docs/EXTREMES.md of what they report.
# Usage: tests/extremes/make_page.sh BUILD_DIR
set -eu
build=$(cd "${1:?usage: make_page.sh BUILD_DIR}" && pwd)
root=$(cd "$(dirname "$0")/../.." && pwd)
report=$(mktemp -d)
trap 'rm -rf "$report"' EXIT
export INTERSTICE_REPORT="$report"

failed=""
for program in "$build"/tests/extremes/extreme_*; do
  [ -x "$program" ] && [ -f "$program" ] || continue
  name=$(basename "$program")
  if [ "$name" = extreme_long ] && [ "${LONG:-0}" != 1 ]; then continue; fi
  "$program" >"$report/$name.log" 2>&1 || { failed="$failed $name"; tail -n 40 "$report/$name.log" >&2; }
  # Known faults are tests that are disabled; the page shows them too.
  "$program" --gtest_also_run_disabled_tests --gtest_filter='*DISABLED_*' >>"$report/$name.log" 2>&1 || true
done
"$build/tests/report/report_page" extreme "$root/docs/EXTREMES.md" "$report"/extreme_*.tsv
if [ -f "$report/stability_map.tsv" ]; then
  cp "$report/stability_map.tsv" "$build/tests/extremes/"
  "$root/tests/verification/figures.sh" --map "$report/stability_map.tsv" "$root/docs/images/stability_map.png"
fi
if [ -n "$failed" ]; then
  echo "failed:$failed (their rows say NO)" >&2
  exit 1
fi
