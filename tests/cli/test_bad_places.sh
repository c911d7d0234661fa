#!/usr/bin/env bash
# Places where nothing can be written: somebody else's, removed in the midst of a solve, or under a
# limit on the size of files. The exit code is 5 with what happened, the old file is whole, and nothing
# is left behind.
. "$(dirname "$0")/places.sh"

# meanwhile COMMAND...: while the solve sleeps between two writes, with no temporary in the place.
meanwhile() {
  falls_asleep "$process"
  while compgen -G 'place/.hrad-*.tmp' >/dev/null; do
    kill -s CONT "$process"
    sleep 0.02
    falls_asleep "$process"
  done
  "$@"
  kill -s CONT "$process"
}
make_read_only() {
  chmod 555 place
  kept=$(cksum <place/c.hrad)
}
make_anew() {
  rm -rf place
  mkdir place
}

# A folder that belongs to somebody else: for root, one that is not root's.
as_other=
if [ "$(id -u)" = 0 ]; then as_other='setpriv --reuid 65534 --regid 65534 --clear-groups'; fi
chmod 755 "$work" place
if $as_other test -x "$HRAD" 2>/dev/null && $as_other test -r old.hrad; then
  cp old.hrad place/c.hrad
  chmod 555 place
  for option in --checkpoint -o; do
    printf 'exec %s "%s" "$@"\n' "$as_other" "$HRAD" >as_other.sh
    HRAD=bash refuses 5 "Permission denied" as_other.sh "${large[@]}" $option place/c.hrad
  done
  old_is_whole
  only c.hrad
  # It becomes so while the solve is under way: the lock, too, has to stay.
  chmod 777 place
  rm place/c.hrad
  $as_other cp old.hrad place/c.hrad
  begin "$as_other" place/c.hrad
  meanwhile make_read_only
  until_said 'no checkpoint was written: .*Permission denied'
  end_with 5 'Permission denied'
  [ "$(cksum <place/c.hrad)" = "$kept" ] || complain "$ran: the old file was changed"
  works check place/c.hrad
  chmod 755 place
  rm -f place/c.hrad.prev
  only c.hrad c.hrad.lock
else
  echo "left out: no other user can run the tool here"
fi
rm -rf place

# The folder is removed while the solve is under way.
mkdir place
begin '' place/c.hrad
meanwhile rm -rf place
end_with 5 'place/c.hrad: .*No such file or directory'
[ -e place ] && complain "$ran: the folder was made again"
# And with it the one that the solve runs in.
mkdir place
begin "env -C place" c.hrad
meanwhile rm -rf place
end_with 5 'c.hrad: .*No such file or directory'
[ -e place ] && complain "$ran: the folder was made again"
# Another one takes its place: it is as good.
mkdir place
begin '' place/c.hrad
meanwhile make_anew
end_with 75 'c.hrad has the solve so far'
works check place/c.hrad
rm -f place/c.hrad.prev
only c.hrad
rm -rf place

# A limit on the size of files.
mkdir place
cp old.hrad place/c.hrad
for option in --checkpoint -o; do
  (
    ulimit -f 30
    exec "$HRAD" "${large[@]}" $option place/c.hrad >out 2>err
  )
  code=$?
  ran="ulimit -f, $option"
  [ $code = 5 ] || complain "$ran: exit code $code, not 5: $(cat err)"
  grep -q 'cannot write: File too large' err || complain "$ran: not told why: $(cat err)"
  old_is_whole
  only c.hrad
done
finish
