#!/usr/bin/env bash
# Where the decimal separator is a comma, numbers have points all the same: whatever is read and
# printed, for the tool sets no locale; and files, tables and JSON even where something that is loaded
# with it has set one.
. "$(dirname "$0")/common.sh"

# Machines need not have a locale with a comma.
mkdir locales
localedef -i de_DE -f UTF-8 "$work/locales/de_DE.UTF-8" >localedef.out 2>&1
[ -e locales/de_DE.UTF-8/LC_NUMERIC ] || {
  echo "skipped: no localedef that makes de_DE.UTF-8: $(head -1 localedef.out)"
  exit 77
}
cat >set_locale.c <<'C'
#include <locale.h>
#include <stdlib.h>
__attribute__((constructor)) static void set_locale(void) {
  if (!setlocale(LC_ALL, "") || *localeconv()->decimal_point != ',') abort();
}
C
make_preload set_locale.c

# in_german LOCALE ARGUMENTS...: as run, with the locale asked for by the environment or, has_set, set.
in_german() {
  local preload=
  [ "$1" = asked ] || preload=$work/set_locale.so
  shift
  ran="hrad $* (in German${preload:+, set})"
  LOCPATH=$work/locales LC_ALL=de_DE.UTF-8 LD_PRELOAD=$preload "$HRAD" "$@" >out 2>err </dev/null
  code=$?
}

# A comma is no part of a number, and a point is.
for wrong in "--accuracy 0,3" "--set accuracy=0,3" "--set tolerance=0,1" "--accuracy 1.000"; do
  for locale in asked has_set; do
    # shellcheck disable=SC2086
    in_german $locale solve cornell $wrong
    [ "$code" = 2 ] || complain "$ran: exit code $code, not 2: $(cat err)"
    [ -s out ] && complain "$ran: output on stdout though it failed"
    grep -qE 'accuracy|tolerance' err || complain "$ran: it does not say what: $(cat err)"
  done
done

# same LOCALE [FILE] -- ARGUMENTS...: works, and prints and writes what it does without a locale.
same() {
  local locale=$1 files=(out) file
  shift
  [ "$1" = -- ] || { files+=("$1") && shift; }
  shift
  works "$@"
  for file in "${files[@]}"; do mv "$file" "plain.$file"; done
  in_german "$locale" "$@"
  [ "$code" = 0 ] || complain "$ran: exit code $code: $(cat err)"
  for file in "${files[@]}"; do
    cmp -s "$file" "plain.$file" || complain "$ran: $file is another: $(head -3 "$file")"
  done
}

works solve cornell --accuracy 0.5 --quiet -o plain.hrad
for locale in asked has_set; do
  in_german $locale solve cornell --accuracy 0.5 -o leaves.hrad -o solved.csv
  [ "$code" = 0 ] || complain "$ran: exit code $code: $(cat err)"
  cmp -s leaves.hrad plain.hrad || complain "$ran: leaves.hrad is another"
  for kind in csv vtu ply glb; do
    same $locale "leaves.$kind" -- export leaves.hrad -o "leaves.$kind"
  done
  cmp -s leaves.csv solved.csv || complain "$ran: solved.csv is not leaves.csv"
  grep -q '^0,0,0,0.0032,0,0,0.03775' leaves.csv || complain "$ran: no points: $(head -3 leaves.csv)"
  same $locale room.obj -- scene cornell -o room.obj
  same $locale room.mtl -- scene cornell -o room.obj
  same $locale -- info room.obj --json
  same $locale -- query leaves.hrad --at 0.2,0.2,0.2:0,0,1 --csv
  same $locale -- query leaves.hrad --json
done
# What is for people to read.
same asked -- info leaves.hrad
same asked -- check leaves.hrad
same asked -- params
finish
