# Places where nothing can be written: full, read-only, somebody else's, removed in the midst of a
# solve, or under a limit on the size of files. The exit code is 5 with what happened, the old file is
# whole, and nothing is left behind.
# With mounts of its own, which are gone with it, where that is permitted.
if [ "${HRAD_OWN_MOUNTS-}" = '' ]; then
  for own in -m -rm; do
    if unshare $own true 2>/dev/null; then HRAD_OWN_MOUNTS=yes exec unshare $own bash "$0"; fi
  done
  HRAD_OWN_MOUNTS=no
fi
. "$(dirname "$0")/common.sh"

works solve furnace --accuracy 0.4 -o old.hrad
large=(solve cornell --accuracy 0.5)  # some 110 kB
mkdir place

# only FILES: nothing else is in the place.
only() {
  [ "$(ls -A place | tr '\n' ' ')" = "$* " ] || complain "$ran: in the place are: $(ls -A place)"
}
old_is_whole() { cmp -s old.hrad place/c.hrad || complain "$ran: the old file was changed"; }

# A solve that ends by a signal alone, as process $process. Writes without a pause.
begin() { # COMMAND, CHECKPOINT
  ran="$1 solve classroom --checkpoint $2"
  rm -f out err  # of the round before
  # shellcheck disable=SC2086
  $1 "$HRAD" solve classroom --accuracy 0.0005 -v --checkpoint "$2" --checkpoint-interval 0.00001 \
    >out 2>err </dev/null &
  process=$!
  until_said '^hrad: stage'
}
until_said() {
  until grep -qs -e "$1" err || ! kill -0 $process 2>/dev/null; do sleep 0.02; done
}
end_with() { # CODE TEXT
  kill -s USR1 $process 2>/dev/null || complain "$ran: it ended by itself: $(tail -n 3 err)"
  wait $process
  code=$?
  [ $code = "$1" ] || complain "$ran: exit code $code, not $1: $(tail -n 3 err)"
  tail -n 2 err | grep -q -e "$2" || complain "$ran: nothing said of '$2': $(tail -n 3 err)"
}

if [ "$HRAD_OWN_MOUNTS" = yes ] && mount -t tmpfs -o size=64k none place 2>/dev/null; then
  # The new file has no room beside the old one.
  cp old.hrad place/c.hrad
  for option in --checkpoint -o; do
    refuses 5 "place/c.hrad: cannot write: No space left" "${large[@]}" $option place/c.hrad
    old_is_whole
    only c.hrad
  done
  for file in leaves.csv leaves.vtu leaves.ply leaves.glb; do
    refuses 5 "No space left" "${large[@]}" -o place/$file
    only c.hrad
  done
  if "$HRAD" solve furnace --accuracy 0.5 -o picture.png >out 2>err; then
    head -c 60000 /dev/zero >place/filler 2>dev
    refuses 5 "No space left" solve furnace --accuracy 0.5 -o place/picture.png
    rm place/filler
  fi
  umount place

  # No room at all for a while ends no solve.
  mount -t tmpfs -o size=32m none place
  cp old.hrad place/c.hrad
  cat /dev/zero >place/filler 2>dev
  begin '' place/c.hrad
  until_said 'no checkpoint was written: .*No space left'
  kill -0 $process 2>/dev/null || complain "$ran: a full disk ended the solve: $(tail -n 3 err)"
  old_is_whole
  rm place/filler
  end_with 75 'c.hrad has the solve so far'
  works check place/c.hrad
  works check place/c.hrad.prev
  only c.hrad c.hrad.prev
  umount place

  # Read-only, as a whole.
  cp old.hrad place/c.hrad
  mount --bind place place && mount -o remount,bind,ro place
  for option in --checkpoint -o; do
    refuses 5 "Read-only file system" "${large[@]}" $option place/c.hrad
  done
  refuses 5 "Read-only file system" "${large[@]}" -o place/leaves.csv
  works check place/c.hrad
  works solve place/c.hrad --json
  old_is_whole
  only c.hrad
  umount place
else
  echo "left out: no mounts are permitted here"
fi

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
  chmod 555 place
  kept=$(cksum <place/c.hrad)
  until_said 'no checkpoint was written: .*Permission denied'
  end_with 5 'Permission denied'
  [ "$(cksum <place/c.hrad)" = "$kept" ] || complain "$ran: the old file was changed"
  works check place/c.hrad
  only c.hrad c.hrad.lock
  chmod 755 place
else
  echo "left out: no other user can run the tool here"
fi
rm -rf place

# The folder is removed while the solve is under way.
mkdir place
begin '' place/c.hrad
rm -rf place
end_with 5 'place/c.hrad: .*No such file or directory'
[ -e place ] && complain "$ran: the folder was made again"
# And with it the one that the solve runs in.
mkdir place
begin "env -C place" c.hrad
rm -rf place
end_with 5 'c.hrad: .*No such file or directory'
[ -e place ] && complain "$ran: the folder was made again"
# Another one takes its place: it is as good.
mkdir place
begin '' place/c.hrad
rm -rf place
mkdir place
end_with 75 'c.hrad has the solve so far'
works check place/c.hrad
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
