# shellcheck shell=bash
# What the tests of the command-line tool share: sourced, never run. HRAD is the tool.
set -u
: "${HRAD:?the path of the tool}" "${HRAD_SOURCE_DIR:?the path of the sources}"
work=$(mktemp -d)
trap 'chmod -R u+w "$work"; rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

complain() {
  echo "FAILED: $*" >&2
  failures=$((failures + 1))
}

# run ARGUMENTS...: the tool; its exit code in $code, what it said in the files out and err.
run() {
  ran="hrad $*"
  "$HRAD" "$@" >out 2>err </dev/null
  code=$?
}

# make_preload SOURCE.c: a library of that name here, SOURCE.so, to be loaded before others; skips the
# test where it can't be.
make_preload() {
  cc -shared -fPIC -O1 -o "$(basename "$1" .c).so" "$1" -ldl 2>cc.err || {
    echo "skipped: no C compiler that makes shared libraries: $(head -1 cc.err)"
    exit 77
  }
  # Sanitizers want to be loaded first.
  if nm "$HRAD" 2>/dev/null | grep -e __asan_init -e __tsan_init >/dev/null; then
    echo "skipped: the tool is built with a sanitizer"
    exit 77
  fi
}
make_failing_io() { make_preload "$HRAD_SOURCE_DIR/tests/cli/failing_io.c"; }

# holds_checkpoints_alone FOLDER: c.hrad and c.hrad.prev at the most; nothing is left behind.
holds_checkpoints_alone() {
  local left
  for left in "$1"/.[!.]* "$1"/*; do
    case $left in
      "$1/c.hrad" | "$1/c.hrad.prev" | "$1/.[!.]*") ;;
      *) complain "$ran: left behind: $left" ;;
    esac
  done
}

# refuses CODE TEXT ARGUMENTS...: ends with the code, says the text on stderr and nothing on stdout.
refuses() {
  local wanted=$1 text=$2
  shift 2
  run "$@"
  [ "$code" = "$wanted" ] || complain "$ran: exit code $code, not $wanted: $(cat err)"
  [ -s out ] && complain "$ran: output on stdout though it failed"
  grep -qF -- "$text" err || complain "$ran: stderr lacks '$text': $(cat err)"
  grep -qv '^hrad: ' err && complain "$ran: a line on stderr without 'hrad: ': $(cat err)"
}

# works ARGUMENTS...: ends with 0.
works() {
  run "$@"
  [ "$code" = 0 ] || complain "$ran: exit code $code: $(cat err)"
}

# says TEXT: the last output has it.
says() {
  grep -qF -- "$1" out || complain "$ran: stdout lacks '$1': $(head -c 2000 out)"
}

# holds EXPRESSION: a Python expression over the last output as JSON, named j, is true.
holds() {
  local why
  why=$(python3 - "$1" 2>&1 <<'PYTHON'
import json, sys
def refuse(name):
    raise ValueError(name + " in JSON")
try:
    with open("out", encoding="utf-8") as file:
        j = json.load(file, parse_constant=refuse)
    sys.exit(0 if eval(sys.argv[1]) else 1)
except Exception as error:
    sys.exit(repr(error))
PYTHON
  ) || complain "$ran: not so: $1 $why"
}

# falls_asleep PROCESS: it is sent SIGSTOP, and none of its threads runs any more.
falls_asleep() {
  kill -s STOP "$1"
  for _ in $(seq 600); do
    [ -e "/proc/$1" ] || break
    cat "/proc/$1"/task/*/status 2>/dev/null | grep '^State:' | grep -qv 'T (stopped)' || return 0
    sleep 0.02
  done
  complain "$ran: SIGSTOP doesn't stop it"
}

finish() {
  [ "$failures" = 0 ] || { echo "$failures failed" >&2; exit 1; }
}
