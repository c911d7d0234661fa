#!/usr/bin/env bash
# The program of libhrad(3), compiled from the page's text and run: it says what the floor takes in,
# three times as much in the third step as in the first.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=link_program.sh
. "$HRAD_SOURCE_DIR/tests/consumers/link_program.sh"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

sed -n '/^\.Bd -literal$/,/^\.Ed$/p' "$HRAD_SOURCE_DIR/man/libhrad.3" | sed '1d;$d;s/\\e/\\/g' >program.c
link_program
./a.out | tee said
[[ $(grep -Ec '^step [123]: the floor takes in [0-9]+\.[0-9] W/m2$' said) -eq 3 ]]
awk '{ flux[NR] = $(NF - 1) } END { exit !(flux[1] > 10 && flux[3] > 2.99 * flux[1] && flux[3] < 3.01 * flux[1]) }' said
