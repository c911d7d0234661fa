#!/usr/bin/env bash
# Run as root in a bare Debian, with the packages of one build in the current folder: each is installed
# with what it depends on and nothing else, and does what it is for; in the end they are removed.
set -euo pipefail
export DEBIAN_FRONTEND=noninteractive OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
  OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_btl=vader,self OMPI_MCA_plm=isolated
here=$PWD

complain() {
  echo "$@" >&2
  exit 1
}
add() {  # PACKAGE or ./FILE...
  apt-get install -qq --yes --no-install-recommends "$@" >installed 2>&1 || { cat installed >&2 && exit 1; }
}
shared=()
if compgen -G './libhrad0*.deb' >/dev/null; then shared=(./libhrad0*.deb ./libhrad-mpi0*.deb); fi

# The tool alone.
add ./hrad_*.deb "${shared[@]}"
hrad solve cornell --accuracy 0.05 -o cornell.csv | tee said
grep -q '^status  *converged$' said
[[ $(wc -l <cornell.csv) -gt 30 ]]

# A program in C that pkg-config helps.
add ./libhrad-dev_*.deb ./hrad-doc_*.deb gcc libc6-dev make pkg-config
cp -r /usr/share/doc/hrad/examples .
make -C examples/makefile CFLAGS="-std=c99 -Wall -Wextra -Werror"
examples/makefile/work_plane | tee said
[[ -s said ]]
if ldd examples/makefile/work_plane | grep -E 'libmpi|not found'; then complain "the program in C needs these"; fi

# A program in Fortran; the compiler looks for modules where the package has them.
add ./libhrad-fortran-dev_*.deb
make -C examples/makefile heated_room
examples/makefile/heated_room | tee said
[[ $(wc -l <said) == 6 ]]

# A program over several processes: the one in the header.
if compgen -G './libhrad-mpi-dev_*.deb' >/dev/null; then
  add ./libhrad-mpi-dev_*.deb openmpi-bin
  sed -n 's/^ \*   //p' /usr/include/hrad/hrad_mpi.h >program.c
  read -r -a flags <<<"$(pkg-config --cflags --libs --static hrad-mpi)"
  mpicc -std=c99 -Wall -Wextra -Werror program.c -o program "${flags[@]}"
  mpirun -n 2 ./program
  make -C examples/makefile shared_plane dimmed_room
  mpirun -n 2 examples/makefile/shared_plane
  mpirun -n 2 examples/makefile/dimmed_room
  mpirun -n 2 hrad solve cornell --accuracy 0.05 --json >said
  grep -q '"ranks": *2' said
fi

# Python's module.
if compgen -G './python3-hrad_*.deb' >/dev/null; then
  add ./python3-hrad_*.deb
  (cd / && python3 -c '
import hrad
with hrad.Solver() as solver:
    solver.make_scene("cornell")
    solver["accuracy"] = 0.05
    solver.solve()
    power, front, back, escaped = solver.power_balance()
assert all(abs(front + back + escaped - power) < 0.01 * power.max())')
fi

# CMake finds what it needs.
add g++ cmake
for language in C CXX Fortran; do
  cmake -S examples/cmake -B "cmake-$language" -DLANGUAGE=$language >configured || { cat configured && exit 1; }
  cmake --build "cmake-$language" >built || { cat built && exit 1; }
done
for program in C/work_plane CXX/version Fortran/heated_room; do "cmake-$program" >/dev/null; done

# The manual pages, also under the names of functions.
add man-db
for page in 'hrad 1' 'hrad-solve 1' 'hrad-scene 5' 'hrad-params 7' 'libhrad 3' 'hrad_query_points 3'; do
  read -r name section <<<"$page"
  man "$section" "$name" >page
  grep -q "${name%%_*}" page || complain "the manual page $name($section) is another"
done

# Nothing of theirs is left.
packages=()
for archive in *.deb; do
  package=$(dpkg-deb -f "$archive" Package)
  packages+=("$package")
  for file in copyright changelog.gz changelog.Debian.gz; do
    [[ -s /usr/share/doc/$package/$file ]] || complain "$package has no $file"
  done
done
apt-get purge -qq --yes "${packages[@]}" >/dev/null
if find / -xdev -iname '*hrad*' -not -path "$here/*" -not -path '/var/cache/man/*' | grep .; then
  complain "these are left"
fi
