#!/bin/sh
# Runs the verification programs and makes docs/VERIFICATION.md of what they report, with its figure; with LONG=1
# runs those of the label long instead (an hour or so) and makes docs/VERIFICATION_LONG.md.
# Usage: tests/verification/make_page.sh BUILD_DIR
set -eu
build=$(cd "${1:?usage: make_page.sh BUILD_DIR}" && pwd)
root=$(cd "$(dirname "$0")/../.." && pwd)
report=$(mktemp -d)
trap 'rm -rf "$report"' EXIT
export INTERSTICE_REPORT="$report"

# The tests that CMake knows there are: a program that was not built fails.
page=VERIFICATION labels='-L verification -LE long'
[ "${LONG:-0}" = 1 ] && page=VERIFICATION_LONG labels='-L verification -L long'
status=0
ctest --test-dir "$build" $labels --output-on-failure >"$report/log" 2>&1 || status=$?
tail -n 25 "$report/log"
"$build/tests/report/report_page" check "$root/docs/$page.md" "$report"/*.tsv
printf '\nComputed at commit %s.\n' "$(git -C "$root" rev-parse --short HEAD)" >>"$root/docs/$page.md"
[ $page = VERIFICATION ] && "$root/tests/verification/figures.sh" "$report" "$root/docs/images/oblique_impacts.png"
[ "$status" = 0 ] || echo "make_page.sh: checks failed; their rows say NO" >&2
exit "$status"
