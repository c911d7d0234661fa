#!/usr/bin/env bash
# The program of the README, compiled from its text by the README's command and run: it says how
# much power was emitted and leaves its table.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=link_program.sh
. "$HRAD_SOURCE_DIR/tests/consumers/link_program.sh"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# shellcheck disable=SC2016  # fences of Markdown
sed -n '/^```c$/,/^```$/p' "$HRAD_SOURCE_DIR/README.md" | sed '1d;$d' >program.c
link_program
./a.out | tee said
grep -Eq '^emitted [0-9.e+]+ W, absorbed [0-9.e+]+ W$' said
head -n 1 cornell.csv | grep -q '^patch,face,side,x0,.*,area,b0,b1,b2$'
[[ $(wc -l <cornell.csv) -gt 30 ]]
