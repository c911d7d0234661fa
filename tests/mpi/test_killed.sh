#!/usr/bin/env bash
# A process that is killed ends the job: mpirun fails, no other process is left, and the checkpoint is
# one that was whole before or a whole new one.
# shellcheck source=tests/mpi/common.sh
. "$HRAD_SOURCE_DIR/tests/mpi/common.sh"

scene=(cornell --accuracy 0.03 --set linking=pairs)
wanted=$(hash_of "${scene[@]}")

# Files under other names that a killed writer may leave behind.
only_whole_files() {
  local file
  for file in *.hrad *.hrad.prev*; do
    [ -e "$file" ] || continue
    "$HRAD" check "$file" >/dev/null 2>damage || complain "$ran: $file is damaged: $(cat damage)"
  done
}

# Each rank in turn, while links are refined and while checkpoints are written without a pause.
for victim in 0 1 2; do
  for interval in 10 0.00001; do
    rm -f a.hrad* .hrad-*
    "$HRAD" solve cornell --accuracy 0.3 --set linking=pairs --quiet -o a.hrad </dev/null >/dev/null
    cp a.hrad before.hrad
    launch 3 solve "${scene[@]}" --threads 1 --checkpoint a.hrad --checkpoint-interval $interval -v \
      -o result.csv
    if [ $interval = 10 ]; then until_said 'stage refine'; else until_said 'wrote'; fi
    kill -s KILL "$(cat process.$victim)" 2>/dev/null || complain "$ran: over before it was killed"
    ends
    [ "$code" != 0 ] || complain "$ran: exit code 0 though rank $victim was killed"
    [ "$code" != 124 ] || complain "$ran: hangs when rank $victim is killed"
    [ -e result.csv ] && complain "$ran: a result was written"
    [ -e a.hrad ] || complain "$ran: the checkpoint is gone"
    only_whole_files
    [ $interval != 10 ] || cmp -s a.hrad before.hrad || complain "$ran: the old checkpoint was changed"
  done
done

# What is left behind is no hindrance: the lock of a killed process is nobody's.
launch 2 solve "${scene[@]}" --threads 1 --checkpoint a.hrad --restart auto --json
ends
[ "$code" = 0 ] || complain "$ran: exit code $code: $(cat err)"
holds "j['state_hash'] == '$wanted'"
finish
