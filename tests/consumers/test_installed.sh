#!/usr/bin/env bash
# The library in the hands of other projects: installed, moved, found by pkg-config and by CMake, and
# linked by every compiler that is here. No program of one process needs an MPI library.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp -r "$HRAD_SOURCE_DIR/tests/consumers" "$folder/consumers"
cd "$folder"

cmake --install "$HRAD_BINARY_DIR" --prefix "$folder/before" >installed
mv before after

# Staged by DESTDIR, for who makes packages: the same files below the build's own prefix, none beside it.
prefix=$(sed -n 's/^CMAKE_INSTALL_PREFIX:PATH=//p' "$HRAD_BINARY_DIR/CMakeCache.txt")
DESTDIR=$folder/stage cmake --install "$HRAD_BINARY_DIR" >installed
diff -r "stage$prefix" after || { echo "DESTDIR gives other files (<) than --prefix (>)" >&2 && exit 1; }
[[ $(find stage ! -type d | wc -l) == $(find after ! -type d | wc -l) ]] || {
  echo "DESTDIR leaves files outside the prefix" >&2 && exit 1
}

config=$(find after -name hrad.pc -printf '%h')
export PKG_CONFIG_PATH=$folder/$config
case $(pkg-config --libs --cflags --static hrad) in
  *"$folder/before"*) echo "hrad.pc names the prefix that is gone" >&2 && exit 1 ;;
esac

# The tool runs from the moved prefix, also when the library is shared; in /usr the loader looks by itself.
grep -q '^CMAKE_INSTALL_PREFIX:PATH=/usr$' "$HRAD_BINARY_DIR/CMakeCache.txt" || after/bin/hrad --version

# The flags of this build, so that a library built with a sanitizer links as well.
flags=$(sed -n 's/^CMAKE_C_FLAGS:STRING=//p' "$HRAD_BINARY_DIR/CMakeCache.txt")
library_path=$(dirname "$(find "$folder/after" -name 'libhrad.[as]*' | head -n 1)")
export LD_LIBRARY_PATH=$library_path

# Every function has a manual page under its own name; links lead to pages that are there.
manual=$(dirname "$(find after -name man3)")
while read -r name; do
  [[ -s $manual/man3/$name.3 ]] || { echo "no man page $name(3)" >&2 && exit 1; }
done < <(sed -n 's/^HRAD_API.*[ *]\(hrad_[a-z_]*\)(.*/\1/p' "$HRAD_SOURCE_DIR"/include/hrad/*.h)
while read -r link; do
  [[ -s $manual/$link ]] || { echo "a link of man leads to $link, which is not there" >&2 && exit 1; }
done < <(sed -n 's/^\.so //p' "$manual"/man3/*)
[[ -s $manual/man7/hrad-params.7 ]] || { echo "no man page hrad-params(7)" >&2 && exit 1; }

runs() {  # PROGRAM
  "$1" || { echo "$1 ends with $?" >&2 && exit 1; }
  if ldd "$1" | grep -i 'libmpi'; then
    echo "$1 needs an MPI library" >&2
    exit 1
  fi
}

compilers=(cc)
[[ -n $flags ]] || for other in gcc clang; do
  if command -v $other >/dev/null; then compilers+=("$other"); fi
done
for compiler in "${compilers[@]}"; do
  echo "pkg-config, $compiler"
  make -s -C consumers/makefile clean
  make -s -C consumers/makefile CC="$compiler" CFLAGS="-std=c99 -Wall -Wextra -Werror $flags"
  runs consumers/makefile/work_plane
done

projects=(C/work_plane CXX/version)
# Sanitizers of a build by clang are nothing that gfortran could link.
if [[ -z $flags ]] && pkg-config --exists hrad-fortran; then
  projects+=(Fortran/heated_room 'C;Fortran/work_plane' 'C;Fortran/heated_room')
  echo "pkg-config, gfortran"
  make -s -C consumers/makefile heated_room
  runs consumers/makefile/heated_room
fi

# The languages of a project, and a program in it.
for project in "${projects[@]}"; do
  languages=${project%/*}
  project=cmake-${project//;/-}
  echo "CMake, $project"
  cmake -S consumers/cmake -B "${project%/*}" -DLANGUAGE="$languages" \
    -DCMAKE_PREFIX_PATH="$folder/after" "-DCMAKE_${languages%;*}_FLAGS=$flags" >configured ||
    { cat configured && exit 1; }
  cmake --build "${project%/*}" >built || { cat built && exit 1; }
  runs "$project"
done

# Where libraries have folders of their own, and where theirs lies outside the prefix.
configure_only() {  # OPTION...
  cmake -S "$HRAD_SOURCE_DIR" -B configured-only -DHRAD_TESTS=OFF -DHRAD_MPI=OFF -DHRAD_FORTRAN=OFF \
    -DCMAKE_INSTALL_PREFIX="$folder/prefix" "$@" >configured || { cat configured && exit 1; }
}
for libdir in lib/some-machine-gnu "$folder/elsewhere/lib"; do
  configure_only -DHRAD_EMBREE=OFF -DCMAKE_INSTALL_LIBDIR="$libdir"
  case $libdir in
    /*) wanted=$libdir ;;
    *) wanted=$folder/prefix/$libdir ;;
  esac
  mkdir -p "$wanted/pkgconfig"
  cp configured-only/pkgconfig/hrad.pc "$wanted/pkgconfig"
  said=$(PKG_CONFIG_PATH=$wanted/pkgconfig pkg-config --variable=libdir hrad)
  [[ $(realpath -m "$said") == "$wanted" ]] || {
    echo "with the libdir $libdir hrad.pc says $said" >&2 && exit 1
  }
  said=$(PKG_CONFIG_PATH=$wanted/pkgconfig pkg-config --variable=includedir hrad)
  [[ $(realpath -m "$said") == "$folder/prefix/include" ]] || {
    echo "with the libdir $libdir hrad.pc looks for headers in $said" >&2 && exit 1
  }
  rm -r configured-only
done

# C and C++ by clang, through CMake.
if [[ -z $flags ]] && command -v clang >/dev/null && command -v clang++ >/dev/null; then
  echo "CMake, clang"
  CC=clang CXX=clang++ cmake -S consumers/cmake -B cmake-clang -DLANGUAGE='C;CXX' \
    -DCMAKE_PREFIX_PATH="$folder/after" >configured || { cat configured && exit 1; }
  grep -q '^-- The CXX compiler identification is Clang' configured
  cmake --build cmake-clang >built || { cat built && exit 1; }
  runs cmake-clang/work_plane
  runs cmake-clang/version
fi

# Headers in a folder of their own, in the prefix and outside: pkg-config and CMake both know it. The
# library is the one that was built.
kept() { sed -n "s/^$1:[A-Z]*=/-D$1=/p" "$HRAD_BINARY_DIR/CMakeCache.txt"; }
for includedir in include/of-hrad "$folder/elsewhere/include"; do
  configure_only "$(kept BUILD_SHARED_LIBS)" "$(kept HRAD_EMBREE)" "$(kept CMAKE_CXX_COMPILER)" \
    -DHRAD_PYTHON=OFF -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_INSTALL_INCLUDEDIR="$includedir"
  mkdir -p configured-only/lib
  cp -P "$HRAD_BINARY_DIR"/lib/libhrad.* configured-only/lib
  for component in library development; do
    cmake --install configured-only --component $component >installed
  done
  echo "headers in $includedir"
  make -s -C consumers/makefile clean
  PKG_CONFIG_PATH=$folder/prefix/lib/pkgconfig make -s -C consumers/makefile CFLAGS="$flags" work_plane
  cmake -S consumers/cmake -B cmake-headers -DCMAKE_PREFIX_PATH="$folder/prefix" \
    "-DCMAKE_C_FLAGS=$flags" >configured || { cat configured && exit 1; }
  cmake --build cmake-headers >built || { cat built && exit 1; }
  rm -r configured-only cmake-headers prefix
done
