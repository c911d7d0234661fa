#!/usr/bin/env bash
# The tool under mpirun: every process ends with the same exit code, the first one alone prints and
# writes files of the tool's own, and what it reads the others have too. Each process has a folder of
# its own, as on nodes that share none.
if ! grep -q '^HRAD_MPI:BOOL=ON' "$HRAD_BINARY_DIR/CMakeCache.txt" || ! command -v mpirun >/dev/null; then
  echo "No MPI in this build."
  exit 77
fi
# shellcheck source=tests/cli/common.sh
. "$HRAD_SOURCE_DIR/tests/cli/common.sh"

# What leaks in modules that MPI has closed can not be told by name.
export ASAN_OPTIONS=detect_leaks=0

ranks=3
cat >process.sh <<'END'
cd "folder.$OMPI_COMM_WORLD_RANK" || exit 1
"$HRAD" "$@" >out 2>err &
echo $! >process
wait $!
echo $? >code
END

# launch ARGUMENTS...: on all ranks; their exit codes in $codes, what rank k said in folder.k.
launch() {
  ran="mpirun -n $ranks hrad $*"
  for ((k = 0; k < ranks; ++k)); do
    mkdir -p folder.$k
    rm -f folder.$k/{out,err,code,process}
  done
  timeout 300 mpirun -n $ranks bash "$work/process.sh" "$@" </dev/null >said 2>&1 ||
    complain "$ran: mpirun ends with $?: $(cat said)"
  codes=$(cat folder.*/code | tr '\n' ' ')
}

all_end_with() {
  [ "$codes" = "$(for ((k = 0; k < ranks; ++k)); do printf '%s ' "$1"; done)" ] ||
    complain "$ran: exit codes $codes, not $1: $(cat folder.*/err said)"
}

the_others_are_silent() {
  for ((k = 1; k < ranks; ++k)); do
    [ -s folder.$k/out ] && complain "$ran: rank $k prints $(head -c 200 folder.$k/out)"
    [ -s folder.$k/err ] && complain "$ran: rank $k says $(cat folder.$k/err)"
  done
}

# all_refuse CODE TEXT ARGUMENTS...
all_refuse() {
  local wanted=$1 text=$2
  shift 2
  launch "$@"
  all_end_with "$wanted"
  the_others_are_silent
  grep -qF -- "$text" folder.0/err || complain "$ran: stderr lacks '$text': $(cat folder.0/err)"
  [ -s folder.0/out ] && complain "$ran: output on stdout though it failed"
}

only_the_first_has() {
  [ -s "folder.0/$1" ] || complain "$ran: $1 was not written"
  for ((k = 1; k < ranks; ++k)); do
    [ -e "folder.$k/$1" ] && complain "$ran: rank $k wrote $1"
  done
}

# What one process does as well is the first one's work.
for command in params 'scene --list' 'machine --threads 1' 'info cornell' '--version' 'solve --help'; do
  # shellcheck disable=SC2086
  launch $command
  all_end_with 0
  the_others_are_silent
  # shellcheck disable=SC2086
  "$HRAD" $command | cmp -s - folder.0/out || complain "$ran: another output than that of one process"
done
launch scene furnace -o furnace.obj
all_end_with 0
only_the_first_has furnace.obj

# Where they work by themselves each of them speaks.
launch solve furnace --accuracy 0.1 --threads 1 --mpi off --json
all_end_with 0
for ((k = 0; k < ranks; ++k)); do
  grep -q '"ranks": 1' folder.$k/out || complain "$ran: rank $k did not solve by itself"
done

all_refuse 2 "--mpi takes on, off or auto" solve cornell --mpi maybe
all_refuse 2 "'--no-such-option'" solve cornell --no-such-option
all_refuse 2 "no_such_parameter" solve cornell --set no_such_parameter=1
all_refuse 3 "neither a file nor a built-in scene" solve nothing
all_refuse 5 "no_such_folder" solve cornell -o no_such_folder/cornell.csv
all_refuse 5 "no_such_sensors" query cornell --sensors no_such_sensors
for ((k = 0; k < ranks; ++k)); do echo "no solution" >folder.$k/damaged.hrad; done
all_refuse 4 "damaged.hrad" solve furnace --restart damaged.hrad
mkdir -p folder.0/taken.png
all_refuse 5 "taken.png" render furnace --accuracy 0.1 --threads 1 --size 8x8 -o taken.png
rmdir folder.0/taken.png

# Together.
quick=(--accuracy 0.1 --threads 1)
launch solve furnace "${quick[@]}" --json
all_end_with 0
the_others_are_silent
cp folder.0/out out
holds 'j["converged"] is True'
launch solve cornell "${quick[@]}" --set max_iterations=1 --json
all_end_with 7
the_others_are_silent
launch render furnace "${quick[@]}" --size 16x12 -o furnace.png
all_end_with 0
the_others_are_silent
only_the_first_has furnace.png
printf '0.5 0.5 0.5 0 0 1\n0.2 0.5 0.5 1 0 0\n' >folder.0/sensors.txt
launch query furnace "${quick[@]}" --sensors sensors.txt
all_end_with 0
the_others_are_silent
[ "$(wc -l <folder.0/out)" = 3 ] || complain "$ran: $(cat folder.0/out)"
cp folder.0/out together.csv
run query furnace "${quick[@]}" --sensors folder.0/sensors.txt
cmp -s out together.csv || complain "$ran: another answer than that of one process"

# A signal to one of them ends all.
rm -f folder.0/err
launch solve cornell --accuracy 0.01 --threads 1 -v -o stopped.csv &
launched=$!
until grep -qs '^hrad: loaded' folder.0/err || ! kill -0 $launched 2>/dev/null; do sleep 0.1; done
kill -s USR1 "$(cat folder.1/process)"
wait $launched
codes=$(cat folder.*/code | tr '\n' ' ')
ran="a signal to one of $ranks"
all_end_with $((128 + $(kill -l USR1)))
[ -e folder.0/stopped.csv ] && complain "$ran: stopped.csv was written"

# A launcher whose processes don't find each other: nobody does the work of all.
OMPI_COMM_WORLD_SIZE=2 OMPI_COMM_WORLD_RANK=0 refuses 8 "one of 2 processes" solve furnace
OMPI_COMM_WORLD_SIZE=2 OMPI_COMM_WORLD_RANK=0 works solve furnace "${quick[@]}" --mpi off
# In a job of Slurm but beside srun there is no launcher.
SLURM_PROCID=0 SLURM_NTASKS=8 works solve furnace "${quick[@]}"
works solve furnace "${quick[@]}" --mpi on

finish
