#!/usr/bin/env bash
# Every test of a fresh clone: installs what is missing (Debian, as root or with sudo), builds with
# warnings as errors, runs the tests.
#   bash tests/run.sh          every test, some minutes on two cores; with clang and its libFuzzer
#                              also every fuzz target for half a minute
#   bash tests/run.sh --full   all of what that takes samples of; before it the same tests under the
#                              address, undefined behaviour and thread sanitizers, a build without
#                              options, every example from an installed prefix (tests/consumers.sh),
#                              Debian packages (tests/packages.sh), the linters (tests/lint.sh), and
#                              all benchmarks; two minutes of fuzzing each
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

full=false
case "${1:-}" in
  '') ;;
  --full) full=true ;;
  *)
    echo "usage: bash tests/run.sh [--full]" >&2
    exit 2
    ;;
esac

# build PRESET FOLDER: configures and builds the library, the tool, the tests and the benchmarks.
build() {
  bash tests/configure.sh "$1" "$2" -DHRAD_TESTS=ON -DHRAD_WERROR=ON
  cmake --build "$2" --parallel "$(nproc)"
}

# run_tests FOLDER SECONDS: a test that takes longer than that has lost its way.
run_tests() {
  ctest --test-dir "$1" --output-on-failure --no-tests=error -j2 --timeout "$2"
}

# The library and the tool without all that is optional, and tests of each kind that tell.
test_without_options() {
  bash tests/configure.sh release build-plain -DHRAD_TESTS=ON -DHRAD_WERROR=ON -DHRAD_MPI=OFF \
    -DHRAD_FORTRAN=OFF -DHRAD_EMBREE=OFF -DCMAKE_DISABLE_FIND_PACKAGE_PNG=ON
  cmake --build build-plain --parallel "$(nproc)" --target hrad_cli hrad_man hrad_shared \
    test_api_solve test_api_checkpoint test_physics_furnaces test_solver_ranks_few
  ctest --test-dir build-plain --output-on-failure --no-tests=error -j2 --timeout 600 -R \
    '^(api_solve|api_checkpoint|physics_furnaces|solver_ranks_few|cli_usage|cli_query|cli_json|consumers_.*|style_style)$'
}

# fuzz_one TARGET SECONDS: from the corpus in the tree; what it finds beside it stays in build-fuzz.
fuzz_one() {
  set -euo pipefail
  local target=$1 dictionary=()
  mkdir -p "build-fuzz/corpus/$target"
  # Words of the formats; the C interface is called by numbers.
  case $target in
    fuzz_obj | fuzz_mtl) dictionary=(-dict=tests/fuzz/obj.dict) ;;
    fuzz_hrad) dictionary=(-dict=tests/fuzz/hrad.dict) ;;
  esac
  build-fuzz/tests/"$target" -max_total_time="$2" -timeout=60 -rss_limit_mb=3000 \
    "${dictionary[@]}" -artifact_prefix="build-fuzz/$target-" -print_final_stats=1 \
    "build-fuzz/corpus/$target" "tests/fuzz/corpus/${target#fuzz_}" || {
    echo "$target has found something." >&2
    return 1
  }
}
export -f fuzz_one

# fuzz SECONDS: every fuzz target for so long, as many at a time as there are cores. Nothing without
# clang and libFuzzer.
fuzz() {
  if ! echo 'extern "C" int LLVMFuzzerTestOneInput(const char*, long) { return 0; }' |
    clang++ -x c++ -fsanitize=fuzzer - -o /dev/null 2>/dev/null; then
    echo "No clang with libFuzzer: the fuzz targets are left out, their corpus was replayed." >&2
    return
  fi
  local targets
  targets=$(cd tests/fuzz && printf '%s\n' fuzz_*.cpp | sed 's/\.cpp$//')
  bash tests/configure.sh fuzz build-fuzz -DHRAD_TESTS=ON
  # shellcheck disable=SC2086
  cmake --build build-fuzz --parallel "$(nproc)" --target $targets
  echo "$targets" | xargs -P "$(nproc)" -I TARGET bash -c 'fuzz_one TARGET '"$1"
}

# Samples that a run which is waited for takes are all of it then.
if $full; then
  export HRAD_TEST_THOROUGH=1
fi

bash tests/setup.sh "$($full && echo full || echo tests)"

if $full; then
  for sanitizer in asan tsan; do
    build "$sanitizer" "build-$sanitizer"
    run_tests "build-$sanitizer" 3600
  done
  test_without_options
  bash tests/consumers.sh
  bash tests/packages.sh
  bash tests/lint.sh
fi

build release build-tests
if $full; then
  # What they print is explained in tests/bench/README.md.
  build-tests/tests/bench_visibility classroom building boxes soup
  mkdir -p out/references
  build-tests/tests/bench_paper --reference-dir out/references --reference-seconds 130 \
    --case accuracy=0.05 --case accuracy=0.02 building classroom
fi
run_tests build-tests 600
fuzz "$($full && echo 120 || echo 30)"
