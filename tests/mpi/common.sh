# shellcheck shell=bash
# What the tests of the tool under mpirun share: sourced, never run. Skips the test where there is no
# MPI.
if ! grep -q '^HRAD_MPI:BOOL=ON' "$HRAD_BINARY_DIR/CMakeCache.txt" || ! command -v mpirun >/dev/null; then
  echo "No MPI in this build."
  exit 77
fi
# shellcheck source=tests/cli/common.sh
. "$HRAD_SOURCE_DIR/tests/cli/common.sh"
export HRAD

# What leaks in modules that MPI has closed can not be told by name.
export ASAN_OPTIONS=detect_leaks=0

cat >process.sh <<'END'
echo $$ >"process.$OMPI_COMM_WORLD_RANK"
exec "$HRAD" "$@"
END

# launch RANKS ARGUMENTS...: begins, mpirun as process $launched, with the options of the array nodes, its
# ranks in the files process.K; what they print in out, what they say in err.
nodes=()
launch() {
  local ranks=$1
  shift
  ran="mpirun ${nodes[*]} -n $ranks hrad $*"
  rm -f process.[0-9]* launcher out err
  # shellcheck disable=SC2016
  timeout 500 bash -c 'echo $$ >launcher; exec "$@"' - mpirun "${nodes[@]}" -n "$ranks" bash process.sh "$@" \
    </dev/null >out 2>err &
  launched=$!
}

# signal_all NAME: to mpirun, which hands it on.
signal_all() { kill -s "$1" "$(cat launcher)"; }

# until_said TEXT: the ranks have said it, or are at their end.
until_said() {
  until grep -qs -- "$1" err || ! kill -0 "$launched" 2>/dev/null; do sleep 0.02; done
}

# is_at_work PROCESS: it is there, and no zombie that nobody has waited for.
is_at_work() {
  local state
  state=$(sed -n 's/^State:[[:space:]]*\(.\).*/\1/p' "/proc/$1/status" 2>/dev/null)
  [ -n "$state" ] && [ "$state" != Z ] && [ "$state" != X ]
}

# all_are_gone: no rank is left at work when mpirun has ended.
all_are_gone() {
  local file
  for file in process.[0-9]*; do
    for _ in $(seq 600); do
      is_at_work "$(cat "$file")" || break
      sleep 0.1
    done
    is_at_work "$(cat "$file")" && complain "$ran: rank ${file#*.} is left at work"
  done
}

# ends: waits for mpirun; its exit code in $code.
ends() {
  wait "$launched"
  code=$?
  all_are_gone
}

hash_of() { # OPTIONS...: what one process finds
  "$HRAD" solve "$@" --threads 1 --json 2>/dev/null </dev/null |
    python3 -c 'import json, sys; print(json.load(sys.stdin)["state_hash"])'
}
