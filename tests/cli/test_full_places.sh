#!/usr/bin/env bash
# File systems that are full or read-only. The exit code is 5 with what happened, the old file is whole,
# and nothing is left behind. With mounts of its own, which are gone with it; skipped where none are
# permitted.
if [ "${HRAD_OWN_MOUNTS-}" = '' ]; then
  for own in -m -rm; do
    if unshare $own true 2>/dev/null; then HRAD_OWN_MOUNTS=yes exec unshare $own bash "$0"; fi
  done
fi
. "$(dirname "$0")/places.sh"

{ [ "${HRAD_OWN_MOUNTS-}" = yes ] && mount -t tmpfs -o size=64k none place 2>/dev/null; } || {
  echo "skipped: no mounts are permitted here"
  exit 77
}
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
finish
