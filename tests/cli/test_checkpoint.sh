#!/usr/bin/env bash
# Solves that are stopped and go on: by the time limit in a queue's loop, by signals, from damaged
# files; what is refused; .hrad files as input and output of every command.
. "$(dirname "$0")/common.sh"

hash_of() {  # FILE or SCENE, OPTIONS...
  "$HRAD" solve "$@" --json 2>/dev/null </dev/null |
    python3 -c 'import json, sys; print(json.load(sys.stdin)["state_hash"])'
}
only() {  # FILES: nothing else is in the folder
  local there
  there=$(ls -A | grep -v -e '^out$' -e '^err$' -e '^ran' | tr '\n' ' ')
  [ "$there" = "$* " ] || complain "in the folder are: $there"
}

# A job of many short runs, as a queue starts them: each stopped by one of the means in turn. By pairs
# a round is begun anew, so that the limit must outgrow the longest one, however slow the machine.
job='solve cornell --accuracy 0.03 --set linking=pairs --threads 1'
wanted=$(hash_of cornell --accuracy 0.03 --set linking=pairs)
[ ${#wanted} = 16 ] || complain "no hash: $wanted"
runs=0
while :; do
  runs=$((runs + 1))
  # shellcheck disable=SC2086
  "$HRAD" $job --checkpoint job.hrad --checkpoint-interval 0.002 --checkpoint-keep 2 --restart auto \
    --time-limit 0:0:$((runs / 2 + 3)) --json >out 2>err </dev/null &
  process=$!
  ran="run $runs"
  case $((runs % 4)) in
    1) sleep 0.6 && kill -s USR1 $process ;;
    2) sleep 0.6 && kill -s TERM $process ;;
    3) sleep 0.6 && kill -s KILL $process ;;
  esac 2>/dev/null
  wait $process
  code=$?
  [ -e job.hrad ] && { "$HRAD" check job.hrad >/dev/null || complain "run $runs left a damaged file"; }
  case $code in
    0 | 7) break ;;
    75) [ -s out ] && complain "run $runs: output on stdout though it was stopped"
      grep -q 'job.hrad' err || complain "run $runs doesn't name the checkpoint: $(cat err)" ;;
    137) ;;
    *) complain "run $runs: exit code $code: $(cat err)" && break ;;
  esac
  [ $runs -lt 100 ] || { complain "the job doesn't come to its end"; break; }
done
[ $runs -gt 2 ] || complain "the job was over after $runs runs"
holds "j['state_hash'] == '$wanted'"
only job.hrad job.hrad.prev job.hrad.prev2

# Once more: nothing is left to do, and the file stays as it is.
cp -p job.hrad before
run solve cornell --checkpoint job.hrad --restart auto --json
holds "j['state_hash'] == '$wanted'"
cmp -s job.hrad before || complain "a finished checkpoint was written anew"
rm -f before job.*

# SIGUSR2 writes and goes on.
"$HRAD" solve cornell --accuracy 0.01 --set linking=pairs --checkpoint a.hrad >out 2>err &
process=$!
sleep 0.7
kill -s USR2 $process 2>/dev/null
for _ in $(seq 300); do
  if [ -e a.hrad ] || ! kill -0 $process 2>/dev/null; then break; fi
  sleep 0.1
done
kill -0 $process 2>/dev/null || complain "SIGUSR2 ended the solve: $(cat err)"
works check a.hrad
# While it is at work, a second writer is refused.
refuses 5 "another process" solve cornell --checkpoint a.hrad
# A second signal ends it at once. It sleeps while both are sent, lest it be over with the first alone,
# which writes a checkpoint and is code 75.
falls_asleep $process
cp a.hrad before
kill -s INT $process
kill -s TERM $process
kill -s CONT $process
wait $process
code=$?
[ $code = 130 ] || [ $code = 143 ] || complain "SIGINT and SIGTERM: exit code $code: $(cat err)"
cmp -s a.hrad before || complain "SIGINT and SIGTERM: the checkpoint was written anew"
only a.hrad a.hrad.lock before
rm -f a.hrad* before

# Files as input and output.
works solve cornell --accuracy 0.3 -o c.hrad -o direct.csv --json
wanted=$(python3 -c 'import json; print(json.load(open("out"))["state_hash"])')
works export c.hrad -o again.csv
cmp -s direct.csv again.csv || complain "a .hrad file exports another solution"
works query c.hrad --json
holds "j['state_hash'] == '$wanted' and len(j['patches']) == 36"
works query c.hrad --at 0.2,0.2,0.2:0,0,1 --csv
works info c.hrad --json
holds "j['solution']['state_hash'] == '$wanted' and 'libhrad' in j['solution']['written_by']"
works check c.hrad
says "written by: libhrad"
says "state: converged"
works solve c.hrad -o d.hrad --json
holds "j['state_hash'] == '$wanted'"
cmp -s c.hrad d.hrad || complain "a solution read and written is another file"
works solve c.hrad --accuracy 0.2 --json
holds "j['state_hash'] != '$wanted' and j['converged']"
refuses 2 "'seed' is 1" solve c.hrad --set seed=2
refuses 2 "accuracy = 0.3" query c.hrad --accuracy 0.2
works solve c.hrad --accuracy 0.3 --set threads=2
if "$HRAD" render --help | grep mesh >/dev/null && works render c.hrad -o c.png --size 40x30; then :; fi
only again.csv c.hrad c.png d.hrad direct.csv

# What does not fit.
cp c.hrad e.hrad
ln -s e.hrad link.hrad
ln e.hrad hard.hrad
for same in e.hrad ./e.hrad link.hrad hard.hrad; do
  refuses 2 "write over the input" solve e.hrad -o $same
  refuses 2 "write over the input" solve e.hrad --checkpoint $same
  refuses 2 "write over the checkpoint" solve cornell --checkpoint e.hrad -o $same
  refuses 2 "write over the file to go on from" solve cornell --restart e.hrad -o $same
done
cmp -s c.hrad e.hrad || complain "the input was changed"
refuses 4 "another scene: the file has 36 patches and the scene 12" solve furnace --restart c.hrad
works scene cornell -o cornell.obj
sed -i 's/^Ke 17 /Ke 18 /' cornell.mtl
refuses 4 "the emission of patch" solve cornell.obj --restart c.hrad
refuses 2 "accuracy" solve cornell --restart c.hrad --accuracy 0.4
refuses 2 "refine=1" solve cornell --set refine=0
refuses 2 "give it once" solve cornell --checkpoint k.hrad --checkpoint-keep 2 --set checkpoint_keep=3
refuses 2 "--restart is for a scene" solve c.hrad --restart d.hrad
refuses 5 "none.hrad" solve none.hrad
refuses 5 "none.hrad" check none.hrad
refuses 5 "none.hrad" solve cornell --restart none.hrad
refuses 5 "no_such_folder" solve cornell --checkpoint no_such_folder/c.hrad
mkdir folder.hrad
refuses 5 "directory" solve cornell --checkpoint folder.hrad
refuses 5 "folder.hrad" check folder.hrad
refuses 4 "another kind of file" check cornell.obj
refuses 4 "another kind of file" solve cornell --restart cornell.obj
: >nothing.hrad
refuses 4 "section 'head'" check nothing.hrad

# --restart auto: fresh, from the file, from the older one, and refused when both are damaged.
works solve cornell --accuracy 0.3 --checkpoint r.hrad --restart auto --json
holds "j['state_hash'] == '$wanted'"
cp r.hrad r.hrad.prev
head -c 9000 c.hrad >r.hrad
works solve cornell --checkpoint r.hrad --restart auto --json
holds "j['state_hash'] == '$wanted'"
grep -q 'going on from the older' err || complain "nothing said of the older file: $(cat err)"
works check r.hrad
works check r.hrad.prev
head -c 9000 c.hrad >r.hrad
works solve cornell -q --checkpoint r.hrad --restart auto
[ -s err ] && complain "$ran: it is not quiet: $(cat err)"
for number in 3 4 5; do
  works solve cornell --accuracy 0.$number --checkpoint kept.hrad --set checkpoint_keep=2
done
works check kept.hrad.prev2
rm kept.hrad*
rm r.hrad
works solve cornell --checkpoint r.hrad --restart auto --json
grep -q 'r.hrad is missing' err || complain "nothing said of the missing file: $(cat err)"
head -c 9000 c.hrad >r.hrad
head -c 99 c.hrad >r.hrad.prev
refuses 4 "r.hrad.prev is damaged" solve cornell --checkpoint r.hrad --restart auto
rm r.hrad.prev
refuses 4 "r.hrad.prev is missing" solve cornell --checkpoint r.hrad --restart auto
cp c.hrad r.hrad
# What decides the result is that of the file.
while read -r option told; do
  refuses 2 "$told" solve cornell --checkpoint r.hrad --restart auto "$option"
done <<'END'
--set=seed=2 r.hrad: parameter 'seed' is 1 since the solve began and can't become 2
--set=linking=pairs r.hrad: parameter 'linking' is auto since the solve began and can't become pairs
--accuracy=0.4 r.hrad: parameter 'accuracy' is 0.3 since the solve began and can't become 0.4
END
cmp -s c.hrad r.hrad || complain "a refused file was changed"
refuses 4 "another scene" solve furnace --checkpoint r.hrad --restart auto
cmp -s c.hrad r.hrad || complain "a refused file was changed"

# A solve that was stopped before there was anything: a file without a solution.
"$HRAD" solve classroom --accuracy 0.0005 --checkpoint early.hrad -v >out 2>err &
process=$!
until grep -q '^hrad: stage' err || ! kill -0 $process; do sleep 0.1; done
kill -s INT $process
wait $process
code=$?
[ $code = 75 ] || complain "SIGINT with --checkpoint: exit code $code: $(cat err)"
works check early.hrad
says "state: nothing is linked yet"
refuses 4 "holds no solution yet" query early.hrad
works info early.hrad
finish
