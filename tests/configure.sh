#!/usr/bin/env bash
# Configures a build folder by a preset, with Ninja when it is new; a configured one keeps its generator.
#   bash tests/configure.sh PRESET FOLDER [OPTION...]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=$1 folder=$2
shift 2
generator=(-G Ninja)
if [[ -f $folder/CMakeCache.txt ]]; then generator=(); fi
cmake --preset "$preset" -B "$folder" "${generator[@]}" "$@"
