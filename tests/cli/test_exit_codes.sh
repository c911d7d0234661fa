#!/usr/bin/env bash
# What ends with which code when the command line itself is right: scene 3, input and output 5, memory 6,
# not converged 7 with its results, MPI 8.
. "$(dirname "$0")/common.sh"

# Scenes.
refuses 3 "neither a file nor a built-in scene" solve no_such_scene
refuses 3 "cornell" info no_such_scene
refuses 3 "furnace" scene no_such_scene -o x.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 x\nf 1 2 3\n' >broken.obj
refuses 3 "broken.obj:3" solve broken.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n' >broken.obj
refuses 3 "broken.obj:4" info broken.obj
printf '# nothing\n' >empty.obj
refuses 3 "" solve empty.obj

# Input and output.
refuses 5 "no_such_file.obj" solve no_such_file.obj
refuses 5 "no_such_folder/file" solve no_such_folder/file
mkdir folder.obj
refuses 5 "folder.obj" info folder.obj
refuses 5 "no_such_file.txt" query cornell --sensors no_such_file.txt
refuses 5 "can't read" query cornell --sensors .
printf '# x y z nx ny nz\n1 1 1 0 0 1\n1 1 1 0 0\n' >sensors.txt
refuses 5 "sensors.txt:3" query cornell --sensors sensors.txt
printf '1 1 1 0 0 one\n' >sensors.txt
refuses 5 "sensors.txt:1" query cornell --sensors sensors.txt
printf '1,,1 1 0 0 1\n' >sensors.txt
refuses 5 "sensors.txt:1" query cornell --sensors sensors.txt
printf '1 1 1 0 0 1,\n' >sensors.txt
refuses 5 "sensors.txt:1" query cornell --sensors sensors.txt
printf '\n1 1 1 0 0 0\n' >sensors.txt
refuses 5 "sensors.txt:2" query cornell --sensors sensors.txt

# Memory: the limit is named, and nothing is written.
refuses 6 "max_memory is 20000000 bytes" solve classroom --set max_memory=20000000 -o room.csv
[ -e room.csv ] && complain "$ran: room.csv was written"

# Not converged: the results are written.
run solve cornell --accuracy 0.1 --set max_iterations=1 -o part.csv --json
[ "$code" = 7 ] || complain "$ran: exit code $code, not 7: $(cat err)"
grep -q "not converged" err || complain "$ran: nothing said: $(cat err)"
[ -s part.csv ] || complain "$ran: part.csv was not written"
holds 'j["converged"] is False and j["status"] == "HRAD_NOT_CONVERGED"'

# One of many processes that don't find each other must not do the work of all, and what takes one
# process is the first one's work. (What an MPI that begins and ends leaves is its own affair.)
ASAN_OPTIONS=detect_leaks=0 OMPI_COMM_WORLD_SIZE=2 refuses 8 "one of 2 processes" solve cornell --accuracy 0.1
if ! grep -q '^HRAD_MPI:BOOL=ON' "$HRAD_BINARY_DIR/CMakeCache.txt"; then
  refuses 8 "no MPI" solve cornell --mpi on
  refuses 8 "no MPI" info cornell --mpi on
  PMI_SIZE=3 refuses 8 "one of 3 processes" solve cornell
  SLURM_STEP_NUM_TASKS=4 refuses 8 "one of 4 processes" solve cornell
  PMIX_RANK=0 refuses 8 "one of several processes" solve cornell
fi
for rank in OMPI_COMM_WORLD_RANK PMI_RANK SLURM_PROCID; do
  count=OMPI_COMM_WORLD_SIZE
  [ $rank = PMI_RANK ] && count=PMI_SIZE
  [ $rank = SLURM_PROCID ] && count=SLURM_STEP_NUM_TASKS
  for command in 'info cornell' 'scene --list' 'machine'; do
    export $count=2 $rank=0
    # shellcheck disable=SC2086
    works $command
    [ -s out ] || complain "$ran: the first process prints nothing"
    export $rank=1
    # shellcheck disable=SC2086
    works $command
    if [ -s out ] || [ -s err ]; then complain "$ran: the second process prints $(cat out err)"; fi
    unset $count $rank
  done
done
OMPI_COMM_WORLD_SIZE=2 OMPI_COMM_WORLD_RANK=1 works info cornell --mpi off
[ -s out ] || complain "$ran: a process by itself prints nothing"
OMPI_COMM_WORLD_SIZE=1 works info cornell

# What is said on stdout must arrive there.
if [ -c /dev/full ]; then
  "$HRAD" params >/dev/full 2>err
  [ $? = 5 ] || complain "a full stdout is not 5: $(cat err)"
fi
"$HRAD" --help >&- 2>err
[ $? = 5 ] || complain "a closed stdout is not 5: $(cat err)"
"$HRAD" info cornell -o x >&- 2>err
[ $? = 2 ] || complain "a usage error with a closed stdout is not 2: $(cat err)"
"$HRAD" params 2>err | :
code=${PIPESTATUS[0]}
[ "$code" = 5 ] || [ "$code" = 0 ] || complain "a closed pipe is $code: $(cat err)"
finish
