#!/usr/bin/env bash
# The library hrad_mpi in the hands of other projects: installed, moved, found by pkg-config and by
# CMake; its header in every language; and who uses hrad alone needs no MPI.
set -euo pipefail
if ! grep -q '^HRAD_MPI:BOOL=ON' "$HRAD_BINARY_DIR/CMakeCache.txt" || ! command -v mpicc >/dev/null; then
  echo "No MPI in this build."
  exit 77
fi
if grep -q '^CMAKE_C_FLAGS:.*-fsanitize' "$HRAD_BINARY_DIR/CMakeCache.txt"; then
  echo "mpicc does not link what sanitizers are in."
  exit 77
fi

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp -r "$HRAD_SOURCE_DIR/tests/consumers" "$folder/consumers"
cd "$folder"

cmake --install "$HRAD_BINARY_DIR" --prefix "$folder/before" >installed
mv before after
config=$(find after -name hrad-mpi.pc -printf '%h')
export PKG_CONFIG_PATH=$folder/$config
library_path=$(dirname "$(find "$folder/after" -name 'libhrad_mpi.[as]*' | head -n 1)")
export LD_LIBRARY_PATH=$library_path

# The program of the header, with every warning: it compiles as C and C++ and runs.
sed -n 's/^ \*   //p' "$HRAD_SOURCE_DIR/include/hrad/hrad_mpi.h" >program.c
grep -q MPI_Init_thread program.c
read -r -a flags <<<"$(pkg-config --cflags --libs --static hrad-mpi)"
for standard in c99 c11; do
  mpicc -std=$standard -Wall -Wextra -Werror -Wstrict-prototypes -Wundef program.c -o program "${flags[@]}"
done
mpirun -n 2 ./program
[[ $(wc -l <cornell.csv) -gt 30 ]]
cp program.c program.cpp
read -r -a flags <<<"$(pkg-config --cflags hrad-mpi)"
for standard in c++11 c++17; do
  mpicxx -std=$standard -Wall -Wextra -Werror -c program.cpp "${flags[@]}"
done

# Every function of the header is in the library, and nothing else. A shared one has several names.
sed -n 's/^HRAD_API.*[ *]\(hrad_[a-z_]*\)(.*/\1/p' "$HRAD_SOURCE_DIR/include/hrad/hrad_mpi.h" |
  sort >declared
[[ $(wc -l <declared) == 2 ]]
nm --defined-only "$HRAD_BINARY_DIR"/lib/libhrad_mpi.* 2>/dev/null |
  sed -n 's/^[0-9a-f]* T \(hrad_[a-z_]*\).*$/\1/p' | sort -u >defined
diff declared defined
nm --undefined-only "$HRAD_BINARY_DIR"/lib/libhrad.* 2>/dev/null | grep ' MPI_' && exit 1

# find_package: with the component, behind find_package(MPI), and without either.
mkdir cmake
cat >cmake/CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.18)
project(program LANGUAGES C)
if(HOW STREQUAL "behind")
  find_package(MPI REQUIRED COMPONENTS C)
  find_package(hrad REQUIRED)
elseif(HOW STREQUAL "component")
  find_package(hrad REQUIRED COMPONENTS mpi)
else()
  find_package(hrad REQUIRED)
  if(TARGET hrad::hrad_mpi OR TARGET MPI::MPI_C)
    message(FATAL_ERROR "MPI was looked for though nobody asked")
  endif()
  return()
endif()
add_executable(program ../program.c)
target_link_libraries(program PRIVATE hrad::hrad_mpi)
END
for how in component behind neither; do
  cmake -S cmake -B "cmake-$how" -DHOW=$how -DCMAKE_PREFIX_PATH="$folder/after" >configured ||
    { cat configured && exit 1; }
  cmake --build "cmake-$how" >built || { cat built && exit 1; }
  [[ $how == neither ]] || mpirun -n 1 "cmake-$how/program"
done

# The examples over several processes. One rank and two tell the same, whoever compiled them.
tells() {  # PROGRAM LINES: as many on 2 ranks
  mpirun -n 2 "$1" | tee said
  [[ $(wc -l <said) == "$2" ]] || { echo "$1 does not print $2 lines" >&2 && exit 1; }
  mpirun -n 1 "$1" | sed 's/by 1 ranks/by 2 ranks/' | diff - said || { echo "$1 on 1 rank (<) says otherwise" >&2 && exit 1; }
}
with_mpi=(C)
for compiler in gcc clang; do
  command -v $compiler >/dev/null || continue
  OMPI_CC=$compiler mpicc --version | grep -qi "${compiler/gcc/free software}" || continue
  echo "pkg-config, mpicc with $compiler"
  make -s -C consumers/makefile clean
  OMPI_CC=$compiler make -s -C consumers/makefile shared_plane CFLAGS="-std=c99 -Wall -Wextra -Werror"
  tells consumers/makefile/shared_plane 1
  cp said "plane-$compiler"
done
if compgen -G 'plane-*' >/dev/null; then sort -u plane-* | wc -l | grep -qx 1; fi
grep -Eq '^plane: mean [1-9][0-9.]* W/m2, measured by 2 ranks$' said
if [[ -n $(find after -name hrad-fortran-mpi.pc) ]]; then
  echo "pkg-config, mpifort"
  with_mpi+=('C;Fortran')
  make -s -C consumers/makefile dimmed_room FFLAGS="-std=f2008 -O2 -Wall -Wextra -Werror"
  tells consumers/makefile/dimmed_room 4
  # Half the lamp, half the light.
  awk 'NR <= 3 { light[NR] = $2 } END {
    exit !(light[1] > 1 && light[2] > 0.4999 * light[1] && light[2] < 0.5001 * light[1] &&
           light[3] > 0.4999 * light[2] && light[3] < 0.5001 * light[2]) }' said
  after/bin/hrad check dimmed_room.hrad | grep '^patches: 14$' >/dev/null
fi
for languages in "${with_mpi[@]}"; do
  echo "CMake, $languages with MPI"
  build=cmake-${languages//;/-}
  cmake -S consumers/cmake -B "$build" -DLANGUAGE="$languages" -DMPI=ON \
    -DCMAKE_PREFIX_PATH="$folder/after" >configured || { cat configured && exit 1; }
  cmake --build "$build" >built || { cat built && exit 1; }
  tells "$build/shared_plane" 1
done
[[ $languages == C ]] || tells "$build/dimmed_room" 4

# The README's program in Fortran, over several processes by what it says of them: found by pkg-config
# and by CMake's component.
if [[ -n $(find after -name hrad-fortran-mpi.pc) ]]; then
  # shellcheck disable=SC2016  # fences of Markdown
  sed -n '/^```fortran$/,/^```$/p' "$HRAD_SOURCE_DIR/README.md" | sed '1d;$d' |
    sed -e 's/^  use hrad$/  use mpi\n  use hrad\n  use hrad_mpi/' \
      -e 's/^  integer :: status$/  integer :: status, level, error/' \
      -e 's/call hrad_create(solver)/call mpi_init_thread(MPI_THREAD_FUNNELED, level, error)\n  call hrad_create_mpi(MPI_COMM_WORLD, solver)/' \
      -e 's/call hrad_destroy(solver)/&\n  call mpi_finalize(error)/' >heat.f90
  [[ $(grep -c mpi heat.f90) == 5 ]]
  read -r -a flags <<<"$(pkg-config --cflags --libs --static hrad-fortran-mpi)"
  mpifort -Wall -Wextra -Werror heat.f90 -o heat "${flags[@]}"
  mpirun -n 2 ./heat >said
  [[ $(grep -c '^emitted ' said) == 2 && $(sort -u said | wc -l) == 1 ]]
  mkdir fortran
  cat >fortran/CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.18)
project(heat LANGUAGES C Fortran)
find_package(hrad REQUIRED COMPONENTS ${WANTED})
find_package(MPI REQUIRED COMPONENTS Fortran)
add_executable(heat ../heat.f90)
target_link_libraries(heat PRIVATE hrad::fortran_mpi MPI::MPI_Fortran)
END
  cmake -S fortran -B fortran-found -DWANTED=fortran_mpi -DCMAKE_PREFIX_PATH="$folder/after" >configured ||
    { cat configured && exit 1; }
  cmake --build fortran-found >built || { cat built && exit 1; }
  mpirun -n 2 fortran-found/heat | diff - said
  if cmake -S fortran -B fortran-refused -DWANTED=fortan -DCMAKE_PREFIX_PATH="$folder/after" >configured 2>&1; then
    echo "a component that there is not was found" >&2
    exit 1
  fi
  tr -s ' \n' ' ' <configured | grep 'no component fortan: there are mpi, fortran and fortran_mpi' >/dev/null
fi

# A build without MPI has none of it, and says so to who asks.
cmake -S "$HRAD_SOURCE_DIR" -B without -DHRAD_TESTS=OFF -DHRAD_EMBREE=OFF -DHRAD_MPI=OFF \
  -DCMAKE_INSTALL_PREFIX="$folder/prefix" >configured || { cat configured && exit 1; }
if find without -name 'hrad-mpi.pc' | grep .; then exit 1; fi
rm -r "$(find after -name hradMpiTargets.cmake -printf '%h')"/hradMpiTargets*.cmake
if cmake -S cmake -B refused -DHOW=component -DCMAKE_PREFIX_PATH="$folder/after" >configured 2>&1; then
  echo "a component that is not there was found" >&2
  exit 1
fi
tr -s ' \n' ' ' <configured | grep 'built without MPI' >/dev/null
