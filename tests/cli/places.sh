# shellcheck shell=bash
# What the tests of places where nothing can be written share: sourced, never run.
# shellcheck source=tests/cli/common.sh
. "$HRAD_SOURCE_DIR/tests/cli/common.sh"

works solve furnace --accuracy 0.4 -o old.hrad
# shellcheck disable=SC2034  # for those that source this
large=(solve cornell --accuracy 0.5)  # some 110 kB
mkdir place

# only FILES: nothing else is in the place.
only() {
  [ "$(ls -A place | tr '\n' ' ')" = "$* " ] || complain "$ran: in the place are: $(ls -A place)"
}
old_is_whole() { cmp -s old.hrad place/c.hrad || complain "$ran: the old file was changed"; }

# A solve that ends by a signal alone, as process $process. Writes without a pause.
begin() { # COMMAND, CHECKPOINT
  ran="$1 solve classroom --checkpoint $2"
  rm -f out err  # of the round before
  # shellcheck disable=SC2086
  $1 "$HRAD" solve classroom --accuracy 0.0005 -v --checkpoint "$2" --checkpoint-interval 0.00001 \
    >out 2>err </dev/null &
  process=$!
  until_said '^hrad: stage'
}
until_said() {
  until grep -qs -e "$1" err || ! kill -0 "$process" 2>/dev/null; do sleep 0.02; done
}
end_with() { # CODE TEXT
  kill -s USR1 "$process" 2>/dev/null || complain "$ran: it ended by itself: $(tail -n 3 err)"
  wait "$process"
  code=$?
  [ $code = "$1" ] || complain "$ran: exit code $code, not $1: $(tail -n 3 err)"
  tail -n 2 err | grep -q -e "$2" || complain "$ran: nothing said of '$2': $(tail -n 3 err)"
}
