#!/usr/bin/env bash
# Calls that fail where others have failed already, or that seldom do: hard links that a file system has
# not, and a rename besides; modes that can't be set; reading; locks that are always interrupted. The
# old content has a name, nothing else is left, and the exit code says what happened and why.
. "$(dirname "$0")/common.sh"

make_failing_io
works solve cornell --accuracy 0.5 -o small.hrad
works solve furnace --accuracy 0.4 -o other.hrad
here=$work/place

# failing NAME ERRNO: from here on that call fails always.
failing() { export HRAD_FAIL_ALWAYS=$1 HRAD_FAIL_ALWAYS_ERRNO=$2; }

# in_front COMMAND...: with the calls that fail.
in_front() {
  HRAD_FAIL_FOLDER=$here HRAD_FAIL_REPORT=$work/calls LD_PRELOAD=$work/failing_io.so "$@" >out 2>err </dev/null
  code=$?
}

# over_another MODE: writes over a checkpoint that has this mode.
over_another() {
  rm -rf "$here"
  mkdir "$here"
  cp other.hrad "$here/c.hrad"
  chmod "$1" "$here/c.hrad"
  in_front "$HRAD" solve small.hrad --checkpoint "$here/c.hrad"
}

# ends_with CODE REASON: says the file and why, and leaves nothing behind but the old content.
ends_with() {
  [ "$code" = "$1" ] || complain "$ran: exit code $code: $(cat err)"
  grep -qF "$2" err || complain "$ran: it is not said why: $(cat err)"
  cmp -s "$here/c.hrad" other.hrad || cmp -s "$here/c.hrad.prev" other.hrad ||
    complain "$ran: the old content is gone"
  holds_checkpoints_alone "$here"
}

failing link 1
ran="no links"
over_another 644
[ "$code" = 0 ] || complain "$ran: exit code $code: $(cat err)"
cmp -s "$here/c.hrad" small.hrad || complain "$ran: not the new file"
cmp -s "$here/c.hrad.prev" other.hrad || complain "$ran: the old file was not kept"
calls=$(head -1 calls)
put_back=0 moved=0
for ever in 0 1; do
  for call in $(seq "$calls"); do
    export HRAD_FAIL_CALL=$call HRAD_FAIL_EVER=$ever HRAD_FAIL_ERRNO=5
    over_another 644
    [ "$(tail -1 calls)" = "rename a file" ] || continue
    ran="no links, rename $call failing (ever: $ever)"
    ends_with 5 "c.hrad: cannot "
    grep -qF "Input/output error" err || complain "$ran: it is not said why: $(cat err)"
    # Where the file could not come back under its name, it goes on from the one before.
    if [ -e "$here/c.hrad" ]; then
      put_back=$((put_back + 1))
    else
      moved=$((moved + 1))
      works solve furnace --accuracy 0.4 --checkpoint "$here/c.hrad" --restart auto
    fi
  done
done
[ $put_back -ge 2 ] || complain "no file came back under its name"
[ $moved -ge 1 ] || complain "every file came back under its name"
unset HRAD_FAIL_CALL HRAD_FAIL_EVER HRAD_FAIL_ERRNO

failing fchmod 1
for mode in 640 400; do
  ran="a file of mode $mode, which can't be kept"
  over_another $mode
  ends_with 5 "cannot keep the mode: Operation not permitted"
done

failing flock 4
ran="a lock that is always interrupted"
over_another 644
ends_with 5 "cannot lock $here/c.hrad.lock: Interrupted system call"

failing read 5
cp "$HRAD_SOURCE_DIR/tests/cli/scenes/"CornellBox-Original.* "$here"
ran="a scene that can't be read"
in_front "$HRAD" info "$here/CornellBox-Original.obj"
[ "$code" = 5 ] || complain "$ran: exit code $code: $(cat err)"
grep -qF "cannot read: Input/output error" err || complain "$ran: it is not said why: $(cat err)"
finish
