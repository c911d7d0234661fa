#!/usr/bin/env bash
# Nothing for shellcheck to find in any script; what it is not asked is in .shellcheckrc.
set -euo pipefail
cd "${HRAD_SOURCE_DIR:?the path of the sources}"
command -v shellcheck >/dev/null || { echo "skipped: no shellcheck"; exit 77; }
mapfile -t scripts < <(find cli man tests bindings -name '*.sh')
[[ ${#scripts[@]} -gt 20 ]]
shellcheck "${scripts[@]}" cli/hrad.bash .ci/run pkgconfig/debian/python/{postinst,prerm}
