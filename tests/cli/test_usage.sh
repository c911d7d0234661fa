#!/usr/bin/env bash
# Usage: --help and --version succeed on stdout; every wrong use ends with 2, one sentence and
# nothing on stdout.
. "$(dirname "$0")/common.sh"

commands='solve export render query info check scene machine params'

works --version
[ "$(cat out)" = "hrad $(sed -n 's/.*HRAD_VERSION_MAJOR //p' "$HRAD_SOURCE_DIR/include/hrad/hrad.h")\
.$(sed -n 's/.*HRAD_VERSION_MINOR //p' "$HRAD_SOURCE_DIR/include/hrad/hrad.h")\
.$(sed -n 's/.*HRAD_VERSION_PATCH //p' "$HRAD_SOURCE_DIR/include/hrad/hrad.h")" ] ||
  complain "--version disagrees with hrad.h: $(cat out)"
works --help
for command in $commands; do says "  $command "; done
for command in $commands; do
  for option in --help -h; do
    works "$command" "$option"
    says "Usage: hrad $command"
    [ -s err ] && complain "$ran: output on stderr"
  done
done

refuses 2 "a command is missing"
refuses 2 "unknown command 'slove'" slove cornell
refuses 2 "commands: solve, export" slove
refuses 2 "unknown option '--bogus'" --bogus
for command in solve export render query info partition; do
  refuses 2 "try 'hrad $command --help'" "$command" --bogus
  refuses 2 "hrad $command --help" "$command" -o x.csv
done
refuses 2 "unexpected argument 'furnace'" solve cornell furnace
refuses 2 "unexpected argument '--bogus'" solve cornell --bogus
refuses 2 "--accuracy needs a value" solve cornell --accuracy
refuses 2 "--accuracy is given more than once" solve cornell --accuracy 0.1 --accuracy 0.2
refuses 2 "--two-sided" solve cornell --two-sided --flip
refuses 2 "--quiet" solve cornell -q -v
refuses 2 "NAME=VALUE" solve cornell --set accuracy
refuses 2 "NAME=VALUE" solve cornell --set =1
refuses 2 "'accuracy' is given twice" solve cornell --accuracy 0.1 --set accuracy=0.1
refuses 2 "no_such_parameter" solve cornell --set no_such_parameter=1
refuses 2 "--mpi takes on, off or auto" solve cornell --mpi yes
refuses 2 "unexpected argument '--checkpoint'" query cornell --checkpoint c.hrad
refuses 2 "ends with .hrad" solve cornell --checkpoint c.csv
refuses 2 "needs --checkpoint" solve cornell --restart auto
refuses 2 "needs --checkpoint" solve cornell --time-limit 1:00:00
refuses 2 "needs --checkpoint" solve cornell --checkpoint-keep 2
refuses 2 "--restart takes" solve cornell --restart ''
refuses 2 "--restart needs a value" solve cornell --restart
refuses 2 "--checkpoint is given more than once" solve cornell --checkpoint a.hrad --checkpoint a.hrad
refuses 2 "FILE.hrad" check
refuses 2 "unexpected argument" check a.hrad b.hrad
refuses 2 "-o FILE is missing" export cornell
refuses 2 "NAME or --list is missing" scene
refuses 2 "-o FILE.obj is missing" scene cornell
refuses 2 "neither a name nor -o" scene --list cornell
refuses 2 "unexpected argument" params cornell
refuses 2 "--json" query cornell --json --csv

# Numbers are read strictly.
for number in 10abc nan inf 1e999 1,5 0x1p-3 '' ' 0.1' '0.1 ' 0 -0.1 0.6 1e-999; do
  refuses 2 accuracy solve cornell --accuracy "$number"
done
for minutes in 0 -1 nan inf 1e999 10abc 1,5 ''; do
  refuses 2 "--checkpoint-interval takes" solve cornell --checkpoint c.hrad --checkpoint-interval "$minutes"
done
for files in -1 1.5 two 1e999 99999; do
  refuses 2 "--checkpoint-keep takes" solve cornell --checkpoint c.hrad --checkpoint-keep "$files"
done
for limit in 0 0:0:0 1:0 10 1:60:0 1:0:60 -1:0:0 1:0:0:0 1:0:x '' 1,5:0:0; do
  refuses 2 "--time-limit takes" solve cornell --checkpoint c.hrad --time-limit "$limit"
done
for number in 1.5 -1 two 99999999999999999999 1e3; do
  refuses 2 threads solve cornell --threads "$number"
done
for at in 1,2,3 1,2,3:0,0 1,2,x:0,0,1 1,2,nan:0,0,1 1,2,1e999:0,0,1 '1, 2,3:0,0,1' 1,2,3:0,0,1:; do
  refuses 2 "--at takes" query cornell --at "$at"
done
refuses 2 "no length" query cornell --at 1,2,3:0,0,0
for grid in 0,0,0:1,1,0 0,0,0:1,1,0:3 0,0,0:1,1,0:3x 0,0,0:1,1,0:2.5x2; do
  refuses 2 "--grid takes" query cornell --grid "$grid"
done
for grid in 0,0,0:1,1,1:2x2 0,0,0:0,0,0:2x2 0,0,0:1,0,0:2x2; do
  refuses 2 "exactly one coordinate" query cornell --grid "$grid"
done
for cells in 0x2 2x-1 100000x100000; do
  refuses 2 "cells" query cornell --grid "0,0,0:1,1,0:$cells"
done
refuses 2 "--quantity takes" query cornell --quantity colour
refuses 2 "irradiance alone" query cornell --quantity radiosity --at 0,0,0:0,0,1
refuses 2 "two tables" query cornell --patches --at 0,0,0:0,0,1
finish
