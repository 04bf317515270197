#!/bin/sh
# Runs the ordinary extremes and makes docs/EXTREMES.md of what they report, with its figure; with LONG=1 runs the
# long ones instead (ten minutes or so) and makes docs/EXTREMES_LONG.md.
# Usage: tests/extremes/make_page.sh BUILD_DIR
set -eu
build=$(cd "${1:?usage: make_page.sh BUILD_DIR}" && pwd)
root=$(cd "$(dirname "$0")/../.." && pwd)
report=$(mktemp -d)
trap 'rm -rf "$report"' EXIT
export INTERSTICE_REPORT="$report"

page=EXTREMES labels='-L extremes -LE long'
[ "${LONG:-0}" = 1 ] && page=EXTREMES_LONG labels='-L extremes -L long'
status=0
ctest --test-dir "$build" $labels --output-on-failure >"$report/log" 2>&1 || status=$?
tail -n 25 "$report/log"
"$build/tests/report/report_page" extreme "$root/docs/$page.md" "$report"/extreme_*.tsv
printf '\nComputed at commit %s.\n' "$(git -C "$root" rev-parse --short HEAD)" >>"$root/docs/$page.md"
[ $page = EXTREMES ] && "$root/tests/verification/figures.sh" --map "$report/stability_map.tsv" \
  "$root/docs/images/stability_map.png"
[ "$status" = 0 ] || echo "make_page.sh: some are not as they must be; their rows say NO" >&2
exit "$status"
