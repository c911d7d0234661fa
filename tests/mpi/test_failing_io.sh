#!/usr/bin/env bash
# A call that writes a checkpoint fails on one of three processes: the file that was there is whole, or
# the new one is; nothing else is left; nobody waits; the exit code is 5 with what happened and why, told
# once.
# shellcheck source=tests/mpi/common.sh
. "$HRAD_SOURCE_DIR/tests/mpi/common.sh"

make_failing_io
cat >process.sh <<'END'
echo $$ >"process.$OMPI_COMM_WORLD_RANK"
if [ "$OMPI_COMM_WORLD_RANK" = "$failing" ]; then
  export HRAD_FAIL_FOLDER=$PWD/place HRAD_FAIL_REPORT=$PWD/calls LD_PRELOAD=$PWD/failing_io.so
fi
exec "$HRAD" "$@"
END

works solve cornell --accuracy 0.5 -o small.hrad
works solve furnace --accuracy 0.4 -o other.hrad
here=$work/place

# attempt RANK CALL EVER ERRNO: writes over a checkpoint with one call of the rank failing.
failed=0
reasons=([28]="No space left on device" [5]="Input/output error")
attempt() {
  rm -rf "$here"
  mkdir "$here"
  cp other.hrad "$here/c.hrad"
  failing=$1 HRAD_FAIL_CALL=$2 HRAD_FAIL_EVER=$3 HRAD_FAIL_ERRNO=$4 \
    launch 3 solve small.hrad --threads 1 --checkpoint "$here/c.hrad"
  ends
  ran="rank $1, call $2 failing with $4 (ever: $3)"
  case $code in
    0) cmp -s "$here/c.hrad" small.hrad || complain "$ran: exit code 0 and not the new file" ;;
    5)
      failed=$((failed + 1))
      [ "$(grep -c 'c.hrad: cannot ' err)" = 1 ] || complain "$ran: not said once: $(cat err)"
      # Why a file can't be opened is told in MPI's words, which has none for some reasons.
      grep -qF "${reasons[$4]:-nothing}" err || grep -q 'cannot open: MPI_ERR_' err ||
        complain "$ran: it is not said why: $(cat err)"
      cmp -s "$here/c.hrad" other.hrad || cmp -s "$here/c.hrad" small.hrad ||
        complain "$ran: the file is neither the old nor the new one"
      ;;
    *) complain "$ran: exit code $code: $(cat err)" ;;
  esac
  holds_checkpoints_alone "$here"
}

attempt 1 0 0 5
calls=$(head -1 calls)
[ "$failed" = 0 ] || complain "nothing was to fail: $(cat err)"
[ "$calls" -ge 6 ] || complain "only $calls calls were seen on rank 1"
cmp -s "$here/c.hrad.prev" other.hrad || complain "the old file was not kept"

# 0: a short write.
for call in $(seq "$calls"); do attempt 1 "$call" 0 28; done
for call in $(seq 1 3 "$calls"); do attempt 1 "$call" 1 5; done
for call in $(seq 2 3 "$calls"); do attempt 1 "$call" 0 0; done
for call in 1 4 7 10 13; do attempt 0 "$call" 0 28; done
[ $failed -gt "$calls" ] || complain "only $failed attempts failed"
finish
