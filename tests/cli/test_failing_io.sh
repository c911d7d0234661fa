#!/usr/bin/env bash
# Every call that writes a checkpoint made to fail in turn, once and from then on: the file that was
# there is whole, or the new one is; nothing else is left; the exit code is 5 with what happened and why.
. "$(dirname "$0")/common.sh"

make_failing_io
works solve cornell --accuracy 0.5 -o small.hrad
works solve furnace --accuracy 0.4 -o other.hrad
works solve small.hrad -o wanted.csv
here=$work/place
mkdir "$here"

# attempt CALL EVER ERRNO: writes over a checkpoint with one call failing.
attempt() {
  rm -rf "$here"
  mkdir "$here"
  cp other.hrad "$here/c.hrad"
  rm -f leaves.csv
  HRAD_FAIL_FOLDER=$here HRAD_FAIL_CALL=$1 HRAD_FAIL_EVER=$2 HRAD_FAIL_ERRNO=$3 \
    HRAD_FAIL_REPORT=$work/calls LD_PRELOAD=$work/failing_io.so \
    "$HRAD" solve small.hrad --checkpoint "$here/c.hrad" -o leaves.csv >out 2>err </dev/null
  code=$?
  ran="call $1 failing with $3 (ever: $2)"
}

attempt 0 0 5
calls=$(head -1 calls)
[ "$code" = 0 ] || complain "nothing failed and the exit code is $code: $(cat err)"
[ "$calls" -ge 12 ] || complain "only $calls calls were seen"
cmp -s "$here/c.hrad" small.hrad || complain "without failures the file is another"
cmp -s "$here/c.hrad.prev" other.hrad || complain "the old file was not kept"

# 0: a short write.
reasons=([28]="No space left on device" [5]="Input/output error" [122]="Disk quota exceeded"
  [4]="Interrupted system call" [30]="Read-only file system")
failed=0 without_results=0 seen=()
for error in 28 5 122 4 30 0; do
  for ever in 0 1; do
    [ "$error" = 4 ] && [ "$ever" = 1 ] && continue # tried again for ever, as it should be
    for call in $(seq "$calls"); do
      attempt "$call" $ever $error
      what=$(tail -1 calls)
      seen[error]+="$what, "
      # The new file is whole by then.
      [[ $what != *" the folder" ]] || [ "$code" = 0 ] ||
        complain "$ran: $what: exit code $code: $(cat err)"
      case $code in
        0)
          cmp -s "$here/c.hrad" small.hrad || complain "$ran: exit code 0 and not the new file"
          ;;
        5)
          failed=$((failed + 1))
          # Only the lock comes before the solve.
          if [ ! -e leaves.csv ]; then
            without_results=$((without_results + 1))
            grep -q "lock" err || complain "$ran: the results were not written: $(cat err)"
          else
            cmp -s leaves.csv wanted.csv || complain "$ran: other results were written"
          fi
          grep -q "c.hrad" err || complain "$ran: the file is not named: $(cat err)"
          grep -qF "${reasons[$error]:-nothing}" err ||
            complain "$ran: $what: it is not said why: $(cat err)"
          cmp -s "$here/c.hrad" other.hrad || cmp -s "$here/c.hrad" small.hrad ||
            complain "$ran: the file is neither the old nor the new one"
          ;;
        *) complain "$ran: exit code $code: $(cat err)" ;;
      esac
      holds_checkpoints_alone "$here"
    done
  done
done
for error in 28 5 122 4 30; do
  for what in open fsync; do
    [[ ${seen[error]} == *"$what the folder"* ]] || complain "$what the folder never failed with $error"
  done
done
[ $failed -gt "$calls" ] || complain "only $failed attempts failed"
[ $without_results -lt $failed ] || complain "no results beside a checkpoint that failed"
finish
