#!/bin/sh
# Runs the verification programs (with LONG=1 those of the label long too) and makes docs/VERIFICATION.md of what
# they report. Usage: tests/verification/make_page.sh BUILD_DIR
set -eu
build=$(cd "${1:?usage: make_page.sh BUILD_DIR}" && pwd)
root=$(cd "$(dirname "$0")/../.." && pwd)
report=$(mktemp -d)
trap 'rm -rf "$report"' EXIT
export INTERSTICE_REPORT="$report"

# The tests that CMake knows there are: a program that was not built fails. Those labelled long stand apart.
apart=long
[ "${LONG:-0}" = 1 ] && apart='^$'
status=0
ctest --test-dir "$build" -L verification -LE "$apart" --output-on-failure >"$report/log" 2>&1 || status=$?
tail -n 25 "$report/log"
"$build/tests/report/report_page" check "$root/docs/VERIFICATION.md" "$report"/*.tsv
"$root/tests/verification/figures.sh" "$report" "$root/docs/images/oblique_impacts.png"
[ "$status" = 0 ] || echo "make_page.sh: checks failed; their rows say NO" >&2
exit "$status"
