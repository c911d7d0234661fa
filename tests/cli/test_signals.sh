#!/usr/bin/env bash
# SIGINT, SIGTERM and SIGUSR1 stop a solve: exit code 128 + signal, nothing on stdout, no file.
. "$(dirname "$0")/common.sh"

# Far longer than any test may take when nothing stops it.
start() {
  rm -f out err  # of the round before
  "$HRAD" solve classroom --accuracy 0.0005 -v -o result.csv >out 2>err &
  process=$!
  until grep -q '^hrad: stage' err || ! kill -0 $process; do sleep 0.1; done
}

for signal in INT TERM USR1; do
  start
  kill -s $signal $process
  wait $process
  code=$?
  [ $code = $((128 + $(kill -l $signal))) ] || complain "SIG$signal: exit code $code: $(cat err)"
  [ -s out ] && complain "SIG$signal: output on stdout"
  grep -q '^hrad: stopped' err || complain "SIG$signal: nothing said: $(cat err)"
  [ "$(ls | grep -c result)" = 0 ] || complain "SIG$signal: files are left: $(ls)"
done

# SIGUSR2 asks for a checkpoint: it must not end a solve. The second SIGTERM ends it at once.
start
kill -s USR2 $process
sleep 0.2
kill -0 $process 2>/dev/null || complain "SIGUSR2 ended the solve: $(cat err)"
kill -s TERM $process
kill -s TERM $process 2>/dev/null
wait $process
code=$?
[ $code = 143 ] || complain "two SIGTERM: exit code $code"
[ "$(ls | grep -c result)" = 0 ] || complain "two SIGTERM: files are left: $(ls)"
finish
