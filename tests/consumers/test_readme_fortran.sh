#!/usr/bin/env bash
# The Fortran program of the README, compiled from its text by the README's command and run.
set -euo pipefail
# shellcheck source=tests/consumers/fortran.sh
source "$HRAD_SOURCE_DIR/tests/consumers/fortran.sh"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# shellcheck disable=SC2016  # fences of Markdown
sed -n '/^```fortran$/,/^```$/p' "$HRAD_SOURCE_DIR/README.md" | sed '1d;$d' >heat.f90
link_fortran heat heat.f90
./heat | tee said
grep -Eq '^emitted +[0-9.]+ W, absorbed +[0-9.]+ W$' said
