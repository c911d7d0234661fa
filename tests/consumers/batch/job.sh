#!/bin/bash
# A solve as a batch job that takes as many turns as it needs: each stops before its time is over, with a
# checkpoint, and queues the job again until the solve is done. For SLURM
#
#     sbatch job.sh SCENE FILE.hrad [OPTION OF hrad solve]...
#
# and without it the same by itself, as a loop of turns. HRAD names the tool, HRAD_TIME how long a turn may
# take until it stops.
#SBATCH --job-name=hrad
#SBATCH --nodes=2
#SBATCH --ntasks-per-node=1
#SBATCH --exclusive
#SBATCH --time=2:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
# To the processes, three minutes before the end, for turns whose own limit is too long.
#SBATCH --signal=USR1@180
set -u
scene=$1 checkpoint=$2
shift 2

launch=()
if [ -n "${SLURM_JOB_ID-}" ]; then launch=(srun); fi

while :; do
  # Ten minutes of the two hours are for the start and for what is written at the end.
  "${launch[@]}" "${HRAD:-hrad}" solve "$scene" --checkpoint "$checkpoint" --restart auto \
    --time-limit "${HRAD_TIME:-1:50:00}" "$@"
  code=$?
  # 75 says that another turn goes on. All else is an end: done, or what would only happen again.
  if [ $code != 75 ]; then exit $code; fi
  if [ -n "${SLURM_JOB_ID-}" ]; then exec scontrol requeue "$SLURM_JOB_ID"; fi
done
