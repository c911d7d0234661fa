#!/usr/bin/env bash
# Debian packages of what is committed, with shared libraries and with archives: two clones in different
# folders, of different dates and permissions, give the same bytes, libraries, modules and tool as well;
# lintian finds nothing; in a bare Debian of this release each package does what it is for. A build with
# shared libraries also passes the tests of programs that use them. Four builds: some half an hour on two
# cores. The bare Debian needs root, debootstrap and the network, and is left out without.
#   bash tests/packages.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if ! command -v dpkg-shlibdeps >/dev/null; then
  echo "No dpkg-shlibdeps (package dpkg-dev): packages are left out." >&2
  exit 0
fi

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# shellcheck source=tests/mpi/environment.sh
source tests/mpi/environment.sh
export CCACHE_DISABLE=1  # what is compared must be made twice
unset SOURCE_DATE_EPOCH
one=$folder/one/libhrad
another=$folder/in-another-place/by-somebody-else/libhrad

# build CLONE KIND: libraries, tool and packages, in CLONE/build-KIND.
build() {
  local shared=OFF
  if [[ $2 == shared ]]; then shared=ON; fi
  cmake -S "$1" -B "$1/build-$2" -G Ninja -DHRAD_TESTS=OFF -DBUILD_SHARED_LIBS=$shared \
    -DCMAKE_INSTALL_PREFIX=/usr >/dev/null
  cmake --build "$1/build-$2" --parallel "$(nproc)" >/dev/null
  (cd "$1/build-$2" && cpack >cpack.log 2>&1) || { cat "$1/build-$2/cpack.log" && return 1; }
}

# sums BUILD: of all that a build makes for others.
sums() {
  (cd "$1" && find . -path ./_CPack_Packages -prune -o -type f \
    \( -name 'libhrad*.a' -o -name 'libhrad*.so*' -o -name '*.mod' -o -name '*.deb' -o -path ./hrad \) \
    -print0 | sort -z | xargs -0 sha256sum)
}

git clone --quiet . "$one"
(
  umask 077
  git clone --quiet . "$another"
  find "$another" -path '*/.git' -prune -o -type f -exec touch -d '2001-02-03 04:05' {} +
)
for kind in static shared; do
  echo "== packages, $kind" >&2
  build "$one" $kind
  (
    umask 077
    export TZ=Asia/Tokyo LC_ALL=C
    build "$another" $kind
  )
  sums "$one/build-$kind" >"$folder/sums"
  [[ $(grep -c '\.deb$' "$folder/sums") -ge 3 ]]
  sums "$another/build-$kind" | diff "$folder/sums" - || { echo "two builds differ" >&2 && exit 1; }
  echo "$(wc -l <"$folder/sums") files are the same bytes in both builds." >&2
  if command -v lintian >/dev/null; then
    bash tests/style/lintian.sh "$one/build-$kind"/*.deb
  else
    echo "No lintian: left out." >&2
  fi
done

# test_of SCRIPT: a test of the clone, on its build with shared libraries; 77: not for this machine.
test_of() {
  local status=0
  HRAD=$one/build-shared/hrad HRAD_SOURCE_DIR=$one HRAD_BINARY_DIR=$one/build-shared \
    bash "$one/tests/$1" || status=$?
  [[ $status == 0 || $status == 77 ]]
}
# In another prefix than /usr, where libraries find each other.
cmake -DCMAKE_INSTALL_PREFIX=/usr/local "$one/build-shared" >/dev/null
cmake --build "$one/build-shared" >/dev/null
for test in consumers/test_{symbols,components,installed}.sh mpi/test_installed.sh; do
  echo "== shared libraries, $test" >&2
  test_of "$test"
done

if [[ $(id -u) != 0 ]] || ! command -v debootstrap >/dev/null; then
  echo "No root, or no debootstrap: the packages are not tried in a bare Debian." >&2
  exit 0
fi
bare=$folder/bare
release=$(. /etc/os-release && echo "$VERSION_CODENAME")
debootstrap --variant=minbase "$release" "$bare" >"$folder/debootstrap.log" ||
  { tail -n 20 "$folder/debootstrap.log" && exit 1; }
for kind in static shared; do
  echo "== bare Debian, $kind" >&2
  mkdir "$bare/packages"
  cp "$one/build-$kind"/*.deb tests/consumers/bare_debian.sh "$bare/packages"
  env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin chroot "$bare" \
    bash -c 'cd /packages && apt-get update -qq && bash bare_debian.sh'
  rm -r "$bare/packages"
done
