#!/usr/bin/env bash
# The manual pages are right mdoc, also the one that is made, and the one of the .hrad format names the
# sections and the version that the library writes.
cd "${HRAD_SOURCE_DIR:?the path of the sources}" || exit 1
page=man/hrad-checkpoint.5
failed=0
while read -r name; do
  grep -q "^\.It $name (" $page || { echo "$page lacks section $name" >&2; failed=1; }
done < <(sed -n '/^constexpr Kind kinds/,/;$/p' lib/solver/checkpoint_format.cpp |
  grep -o '{"[a-z]*", [0-9]*}' | sed 's/{"\([a-z]*\)", \([0-9]*\)}/\1/')
version=$(sed -n 's/^constexpr uint32_t checkpoint_version = \([0-9]*\);/\1/p' lib/solver/checkpoint_format.h)
grep -q "the version of the format, $version\$" $page || { echo "$page: not version $version" >&2; failed=1; }
[ $failed = 0 ] || exit 1
command -v mandoc >/dev/null || { echo "skipped: no mandoc"; exit 77; }
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
sh man/params_page.sh "$HRAD" man/hrad-params.7.in "$made/hrad-params.7" || exit 1
mandoc -T lint -W warning man/*.[1-9] "$made/hrad-params.7"
