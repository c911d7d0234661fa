#!/usr/bin/env bash
# The bash completion names the same commands, options and parameters as the tool.
. "$(dirname "$0")/common.sh"
# shellcheck disable=SC2317
complete() { :; }  # a builtin of interactive shells; the lists and functions are wanted here
compopt() { :; }
# shellcheck source=cli/hrad.bash
. "$HRAD_SOURCE_DIR/cli/hrad.bash"
unset -f complete
PATH=$(dirname "$HRAD"):$PATH

sorted() { tr -s ' \n' '\n' | grep . | sort; }
same() {  # WHAT ONE OTHER
  [ "$2" = "$3" ] || complain "$1: completion and tool differ: $(diff <(echo "$2") <(echo "$3"))"
}

works --help
same commands "$(echo "$_hrad_commands" | sorted)" \
  "$(sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p' out | sort)"
for command in $_hrad_commands; do
  works "$command" --help
  same "$command" "$(_hrad_options "$command" | sorted)" \
    "$(sed -n '/^Options:/,/^$/s/^  \(-[a-z],\)\{0,1\}\(--[a-z-]*\).*/\2/p' out | sort)"
done
works params
same parameters "$(echo "$_hrad_params" | sorted)" "$(tail -n +2 out | cut -d' ' -f1 | sort)"

# What is offered at some places.
offers() {  # WANTED WORDS...: completing the last of the words
  local wanted=$1
  shift
  COMP_WORDS=("$@")
  COMP_CWORD=$(($# - 1))
  COMPREPLY=()
  _hrad
  [[ " ${COMPREPLY[*]} " == *" $wanted "* ]] || complain "'$*' offers '${COMPREPLY[*]}'"
}
touch room.obj room.csv
offers solve hrad so
offers --accuracy hrad solve --acc
offers accuracy= hrad solve cornell --set acc
offers cornell hrad query cor
offers furnace hrad scene furn
offers room.obj hrad info roo
offers room.csv hrad solve cornell -o roo
offers --checkpoint-keep hrad solve cornell --checkp
offers auto hrad solve cornell --restart a
offers net_flux hrad query cornell --quantity n
[[ " ${COMPREPLY[*]} " == *" radiosity "* ]] && complain "net_flux: others are offered too"
finish
