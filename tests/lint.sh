#!/usr/bin/env bash
# Every linter, each over what it knows; what it is not asked stands with the reason in its own file:
#   man         mandoc over the manual pages, also the one that is made
#   shell       shellcheck over the scripts                              .shellcheckrc
#   cppcheck    lib and cli                                              tests/style/cppcheck.txt
#   tidy        clang-tidy over lib, cli and their headers, half an hour on one core    .clang-tidy
#   packages    lintian over the .deb files that cpack left in build folders, or else over such as are
#               made for it, some five minutes on one core
#   bash tests/lint.sh [--strict] [LINTER...]   these, or all; those that are not installed are left
#                                               out, or with --strict fail
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

linters=(man shell cppcheck tidy packages)
strict=false
if [[ ${1:-} == --strict ]]; then
  strict=true
  shift
fi
for linter in "$@"; do
  [[ " ${linters[*]} " == *" $linter "* ]] || {
    echo "usage: bash tests/lint.sh [--strict] [${linters[*]}]" >&2
    exit 2
  }
done
if [[ $# != 0 ]]; then linters=("$@"); fi

is_here() {
  command -v "$1" >/dev/null && return
  echo "No $1: left out." >&2
  return 1
}

# What a linter that is not here comes to.
is_left_out() { ! $strict; }

# test_of NAME: a test of the tree that is a linter.
test_of() {
  local status=0
  HRAD=$PWD/build-tests/hrad HRAD_SOURCE_DIR=$PWD HRAD_BINARY_DIR=$PWD/build-tests \
    bash "tests/style/test_$1.sh" || status=$?
  if [[ $status == 77 ]]; then is_left_out; else return $status; fi
}

configure() {
  bash tests/configure.sh release build-tests -DHRAD_TESTS=ON -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null
}

lint_man() {
  configure && cmake --build build-tests --parallel "$(nproc)" --target hrad_cli >/dev/null || return
  test_of man
}

lint_shell() { test_of shellcheck; }

lint_cppcheck() {
  is_here cppcheck || { is_left_out; return; }
  cppcheck --quiet --error-exitcode=1 --std=c++17 --language=c++ -I lib -I include -I cli \
    -DHRAD_X86_KERNELS -DHRAD_PNG -DHRAD_CLI_MPI --enable=warning,performance,portability \
    --suppressions-list=tests/style/cppcheck.txt lib cli
}

# Beside other work: one file at a time, and behind whatever else wants the processor.
lint_tidy() {
  is_here clang-tidy || { is_left_out; return; }
  configure || return
  local sources source status=0
  mapfile -t sources < <(python3 -c '
import json
for unit in json.load(open("build-tests/compile_commands.json")):
    print(unit["file"])' | grep -E "^$PWD/(lib|cli)/" | sort -u)
  [[ ${#sources[@]} != 0 ]] || return
  for source in "${sources[@]}"; do
    # What it says of how much it has left out goes to stderr.
    nice -n 10 clang-tidy -p build-tests --quiet --warnings-as-errors='*' "$source" 2>/dev/null ||
      status=1
  done
  return $status
}

lint_packages() {
  is_here lintian || { is_left_out; return; }
  local packages folder
  mapfile -t packages < <(find . -maxdepth 2 -path './build*.deb')
  if [[ ${#packages[@]} != 0 ]]; then
    bash tests/style/lintian.sh "${packages[@]}"
    return
  fi
  is_here dpkg-shlibdeps || { is_left_out; return; }
  folder=$(mktemp -d)
  # In a shell of its own, which takes the folder away with it.
  (
    trap 'rm -rf "$folder"' EXIT
    { cmake -S . -B "$folder" -G Ninja -DHRAD_TESTS=OFF -DCMAKE_INSTALL_PREFIX=/usr &&
      cmake --build "$folder" --parallel "$(nproc)" && cd "$folder" && cpack; } >"$folder/said" 2>&1 ||
      { cat "$folder/said" && exit 1; }
    cd "$OLDPWD" && bash tests/style/lintian.sh "$folder"/*.deb
  )
}

failed=()
for linter in "${linters[@]}"; do
  echo "== $linter" >&2
  "lint_$linter" || failed+=("$linter")
done
[[ ${#failed[@]} == 0 ]] || { echo "Found something: ${failed[*]}" >&2 && exit 1; }
