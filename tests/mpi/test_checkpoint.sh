#!/usr/bin/env bash
# Checkpoints of several processes: written on the way, at a signal to mpirun and at the time limit;
# other numbers of processes go on from them; the result is that of one process that was left alone.
# shellcheck source=tests/mpi/common.sh
. "$HRAD_SOURCE_DIR/tests/mpi/common.sh"

is_whole() {
  [ "$code" = 0 ] || complain "$ran: exit code $code: $(cat err)"
  holds "j['state_hash'] == '$wanted'"
}

# Written by all of them while the solve goes on: the longer, the busier this machine is, for several
# of them.
for accuracy in 0.05 0.03 0.02; do
  scene=(cornell --accuracy "$accuracy" --set linking=pairs)
  wanted=$(hash_of "${scene[@]}")
  [ ${#wanted} = 16 ] || complain "no hash: $wanted"
  launch 3 solve "${scene[@]}" --threads 1 --checkpoint a.hrad --checkpoint-interval 0.00001 \
    --checkpoint-keep 3 -v --json
  ends
  is_whole
  written=$(grep -c '^hrad: wrote a.hrad' err)
  [ "$written" -lt 5 ] || break
done
[ "$written" -ge 5 ] || complain "$ran: too few checkpoints: $(cat err)"
for file in a.hrad a.hrad.prev a.hrad.prev2 a.hrad.prev3; do works check $file; done
# Any of them is a beginning, for any number of processes.
mv a.hrad.prev3 early.hrad
for ranks in 1 4; do
  launch $ranks solve "${scene[@]}" --threads 1 --restart early.hrad --json
  ends
  is_whole
done
rm -f a.hrad*

# By rows.
by_rows=(cornell --accuracy 0.05 --set linking=rows)
rows_wanted=$(hash_of "${by_rows[@]}")
launch 2 solve "${by_rows[@]}" --threads 1 --checkpoint a.hrad --checkpoint-interval 0.00001 -v --json
ends
holds "j['state_hash'] == '$rows_wanted'"
grep -q '^hrad: wrote a.hrad' err || complain "$ran: no checkpoint: $(cat err)"
works check a.hrad.prev
rm -f a.hrad*

# Long enough to be stopped.
scene=(cornell --accuracy 0.03 --set linking=pairs)
wanted=$(hash_of "${scene[@]}")

# begin: two processes at work between two rounds, some of them done; no checkpoint is due.
begin() {
  launch 2 solve "${scene[@]}" --threads 1 --checkpoint a.hrad -v --json
  until_said 'stage refine after .* and 1[0-9] iterations'
}

# SIGUSR2: a checkpoint, and on they go.
begin
signal_all USR2
ends
is_whole
grep -q '^hrad: wrote a.hrad' err || complain "SIGUSR2: no checkpoint was written on the way: $(cat err)"
works check a.hrad.prev
rm -f a.hrad*

# A second signal to one of them ends all at once, and the checkpoint stays as it was. It sleeps while
# both are sent: with the first alone, all would write a checkpoint together and end with 75.
begin
signal_all USR2
until_said '^hrad: wrote a.hrad'
falls_asleep "$(cat process.1)"
cp a.hrad before
for signal in INT TERM CONT; do kill -s $signal "$(cat process.1)"; done
ends
[ "$code" = 130 ] || [ "$code" = 143 ] || complain "$ran: two signals: exit code $code: $(cat err)"
[ -s out ] && complain "$ran: two signals: output on stdout"
cmp -s a.hrad before || complain "$ran: two signals: the checkpoint was written anew"
rm -f a.hrad* before

# A signal to mpirun stops all with a checkpoint, and other numbers of processes go on.
for signal in USR1 TERM; do
  begin
  signal_all $signal
  ends
  grep -q 'a.hrad has the solve so far' err || complain "SIG$signal: nothing said: $(cat err)"
  [ -s out ] && complain "SIG$signal: output on stdout"
  [ $signal = TERM ] || [ "$code" = 75 ] || complain "SIG$signal: exit code $code"
  works check a.hrad
  says "state: "
  grep -q 'state: converged' out && complain "SIG$signal: the solve was over"
  ranks=1
  [ $signal = USR1 ] && ranks=3
  launch $ranks solve "${scene[@]}" --threads 1 \
    --checkpoint a.hrad --restart auto --json
  ends
  is_whole
  rm -f a.hrad*
done

# A job of many short runs on other numbers of processes each time. On a busy machine a second may be
# over before they have found each other.
runs=0
while :; do
  runs=$((runs + 1))
  launch $((runs % 4 + 1)) solve "${scene[@]}" --threads 1 --checkpoint job.hrad \
    --checkpoint-interval 0.005 --restart auto --time-limit 0:0:$(((runs + 1) / 2)) --json
  ends
  works_at=$code
  case $works_at in
    0) break ;;
    75) grep -q 'job.hrad has the solve so far' err || complain "$ran: nothing said: $(cat err)" ;;
    *) complain "$ran: exit code $works_at: $(cat err)" && break ;;
  esac
  [ $runs -lt 60 ] || { complain "the job doesn't come to its end" && break; }
done
code=$works_at
is_whole
[ $runs -gt 1 ] || complain "the job was over after one run"

# A disk that can't be written ends no solve, and is told once by all together.
mkdir locked
launch 2 solve "${scene[@]}" --threads 1 --checkpoint locked/a.hrad -v --json
until_said 'stage refine'
mkdir locked/a.hrad.prev && mkdir locked/a.hrad
signal_all USR2
ends
grep -q 'no checkpoint was written' err || complain "$ran: nothing said of the folder: $(cat err)"
[ "$code" = 5 ] || complain "$ran: exit code $code at the end: $(cat err)"
finish
