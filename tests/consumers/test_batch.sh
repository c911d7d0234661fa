#!/usr/bin/env bash
# The batch job comes to its end in as many turns as it takes: by itself, and in a queue that stands in
# for SLURM; with the solution of a solve that was left alone. A failure is no turn.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
job=${HRAD_JOB:-$HRAD_SOURCE_DIR/tests/consumers/batch/job.sh}
scene=(cornell --accuracy 0.01 --threads 1)

fail() {
  echo "$*" >&2
  exit 1
}
hash_in() { python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["state_hash"])' "$1"; }
turns() { cat turns 2>/dev/null || echo 0; }

"$HRAD" solve "${scene[@]}" --json >wanted 2>/dev/null

# The tool, whose first turn is stopped by the signal that SLURM sends, and whose other ones have a second
# more each time, so that they come to an end on any machine.
cat >tool <<'END'
#!/usr/bin/env bash
turn=$(($(cat turns 2>/dev/null || echo 0) + 1))
echo $turn >turns
arguments=()
for argument in "$@"; do arguments+=("${argument/#LIMIT/0:0:$turn}"); done
if [ $turn = 1 ]; then
  "$TOOL" "${arguments[@]/0:0:1/1:00:00}" -v 2>said &
  until grep -qs 'stage' said || ! kill -0 $! 2>/dev/null; do sleep 0.02; done
  kill -s USR1 $!
  wait $!
else
  exec "$TOOL" "${arguments[@]}" 2>said
fi
END
mkdir slurm
cat >slurm/srun <<'END'
#!/usr/bin/env bash
exec "$@"
END
cat >slurm/scontrol <<'END'
#!/usr/bin/env bash
echo "$*" >>queue
END
chmod +x tool slurm/*
export TOOL=$HRAD HRAD=$PWD/tool HRAD_TIME=LIMIT
unset SLURM_JOB_ID

bash "$job" "${scene[0]}" a.hrad "${scene[@]:1}" --json >out || fail "ends with $?: $(cat said)"
[[ $(hash_in out) == "$(hash_in wanted)" ]] || fail "another solution"
[[ $(turns) -gt 1 ]] || fail "there was one turn: $(cat said)"

# In a queue: one turn each time.
rm -f turns a.hrad*
jobs=0
while :; do
  rm -f queue
  jobs=$((jobs + 1))
  SLURM_JOB_ID=7 PATH=$PWD/slurm:$PATH bash "$job" "${scene[0]}" a.hrad "${scene[@]:1}" --json >out ||
    fail "job $jobs ends with $?: $(cat said)"
  [[ $(turns) == "$jobs" ]] || fail "job $jobs made $(turns) turns"
  [[ -e queue ]] || break
  [[ $(cat queue) == 'requeue 7' ]] || fail "job $jobs says scontrol $(cat queue)"
  [[ ! -s out ]] || fail "job $jobs has printed a result and was queued again"
done
[[ $(hash_in out) == "$(hash_in wanted)" ]] || fail "another solution"
[[ $jobs -gt 1 ]] || fail "there was one job: $(cat said)"

# What fails is not queued again.
echo 1 >turns
code=0
SLURM_JOB_ID=7 PATH=$PWD/slurm:$PATH bash "$job" none.obj b.hrad >out || code=$?
[[ $code == 5 && ! -e queue && $(turns) == 2 ]] || fail "a missing scene: exit code $code: $(cat said)"
