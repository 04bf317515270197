#!/bin/sh
# The page maker on two small tables. Usage: test_report_page.sh REPORT_PAGE
set -eu
maker=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "test_report_page: $1" >&2; exit 1; }
line() { grep -Fxq "$1" "$2" || fail "no line '$1' in $2"; }

printf 'check\tcase B\tlength [m]\t1\t1.01\t±1 %%\tyes\tbook one\n' >b.tsv
printf 'check\tcase A\tforce | load\t2\t3\t±0.1\tNO\tbook two\n' >a.tsv
printf 'check\tcase B\ttime [s]\t5\t6\ta curve\tshown\tbook three\n' >>a.tsv
printf 'extreme\tno step\tdt = 0\trefused\tyes\n' >>a.tsv

"$maker" check one.md b.tsv a.tsv
line '2 cases; 1 checks passed, 1 did not, 1 numbers are shown.' one.md
line '| length [m] | 1 | 1.01 | ±1 % | yes |' one.md
line '| force \| load | 2 | 3 | ±0.1 | NO |' one.md
line 'Reference: book three.' one.md
[ "$(grep -c '^## ' one.md)" = 2 ] || fail 'rows of one case are not gathered under one heading'
[ "$(grep '^## ' one.md | head -n 1)" = '## case A' ] || fail 'sections do not follow the names of the files'
"$maker" check two.md a.tsv b.tsv
cmp -s one.md two.md || fail 'the page depends on the order in which files are named'

"$maker" extreme three.md a.tsv
line '| dt = 0 | refused | yes |' three.md
line '1 cases; 1 checks passed, 0 did not.' three.md

for back_end in double reference mixed; do
  printf 'check\tcase\tload (%s)\t1\t1.5\t±1\tyes\tbook\n' $back_end
done >d.tsv
printf 'check\tcase\tload (mixed)\t1\t1.6\t±1\tyes\tbook\n' >>d.tsv
"$maker" check five.md d.tsv
line '| load (double, reference, mixed) | 1 | 1.5 | ±1 | yes |' five.md
line '| load (mixed) | 1 | 1.6 | ±1 | yes |' five.md
line '1 cases; 4 checks passed, 0 did not.' five.md

printf 'check\tcase\tshort\n' >c.tsv
if "$maker" check four.md c.tsv 2>errors; then fail 'a row with too few columns was taken'; fi
grep -q 'c.tsv, line 1' errors || fail 'the error does not say where the row is'
if "$maker" verdict four.md a.tsv 2>errors; then fail 'an unknown kind was taken'; fi
if "$maker" check four.md missing.tsv 2>errors; then fail 'a missing file was taken'; fi
