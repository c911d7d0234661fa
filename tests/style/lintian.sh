#!/usr/bin/env bash
# Holds Debian packages to Debian's rules: no errors, and no warnings but two.
#   bash tests/style/lintian.sh PACKAGE.deb...
set -euo pipefail

# No bug report asks for the packages; cpack renews the loader's cache in scripts besides the trigger.
unasked=initial-upload-closes-no-bugs,maintscript-calls-ldconfig
as_root=()
if [[ $(id -u) == 0 ]]; then as_root=(--allow-root); fi
lintian "${as_root[@]}" --fail-on error,warning --suppress-tags "$unasked" "$@"
