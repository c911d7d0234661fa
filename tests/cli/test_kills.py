# Solves killed at random moments by SIGKILL and gone on with on other numbers of processes and threads:
# whatever is in the file is whole, nothing piles up beside it, and the solution is that of a solve that
# was left alone. HRAD_KILLS kills, a few unless set, drawn from HRAD_SEED; with HRAD_LONG of larger scenes
# on up to four processes (tests/kills.sh).
import collections
import filecmp
import itertools
import json
import os
import random
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
from killed_solve import CHECKPOINT, HRAD, Solve, has_mpi  # noqa: E402

KILLS = int(os.environ.get("HRAD_KILLS", "8"))
SEED = int(os.environ.get("HRAD_SEED", "0")) or random.SystemRandom().randrange(1, 1 << 32)
LONG = bool(os.environ.get("HRAD_LONG"))
# A second or some on one core each: few are over before they are killed, and none takes for ever.
CASES = [["cornell", "--accuracy", "0.01"],
         ["cornell", "--accuracy", "0.05", "--set", "linking=pairs"],
         ["furnished-room", "--accuracy", "0.05", "--set", "linking=clusters"],
         ["building", "--accuracy", "0.05"]] if LONG else [
             ["cornell", "--accuracy", "0.02"],
             ["cornell", "--accuracy", "0.1", "--set", "linking=pairs"]]
MOST_RANKS = 4 if LONG else 2
MOST_THREADS = 4
MOST_KILLS_OF_A_SOLVE = 12 if LONG else 4
INTERVALS = ["0.00001", "0.0005", "0.005"]  # minutes
# Of the time that a solve takes alone; what it grows by brings every solve to its end.
FIRST_SHARE, MORE_EACH_TIME = 0.3, 0.15

counts = collections.Counter()
failures = []


def complain(what):
    failures.append(what)
    print("FAILED:", what, flush=True)


def is_whole(path):
    return subprocess.run([HRAD, "check", path], stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, check=False).returncode == 0


def left_alone(case, folder):
    """The file, the hash and the seconds of a solve that nobody disturbs."""
    start = time.monotonic()
    path = os.path.join(folder, "wanted.hrad")
    run = subprocess.run([HRAD, "solve", *case, "--threads", "1", "--json", "-o", path],
                         stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
    return path, json.loads(run.stdout)["state_hash"], time.monotonic() - start


def look_at(place, had_file, what):
    """What a killed solve has left in its folder. Whether there is a checkpoint."""
    there = set(os.listdir(place))
    files = {name for name in there if name.startswith(CHECKPOINT) and not name.endswith(".lock")}
    temporaries = {name for name in there if name.startswith(".hrad-")}
    for name in sorted(files):
        counts["files checked"] += 1
        if not is_whole(os.path.join(place, name)):
            complain(f"{name} is damaged after {what}")
    if had_file and CHECKPOINT not in files:
        complain(f"{CHECKPOINT} is gone after {what}")
    # One that was being written, and a second name of the old file: of the last writer alone.
    if len(temporaries) > 2:
        complain(f"{len(temporaries)} temporaries have piled up after {what}")
    if there - files - temporaries - {CHECKPOINT + ".lock"}:
        complain(f"unknown files after {what}: {sorted(there)}")
    counts[f"kills that left {len(files)} files"] += 1
    counts["kills that left temporaries"] += bool(temporaries)
    return CHECKPOINT in files


def conclude(solve, code, place, wanted, wanted_hash, what):
    """A solve has come to its end."""
    if code not in (0, 7):
        complain(f"exit code {code}: {what}: {solve.said()[-500:]}")
        return
    if json.loads(solve.printed())["state_hash"] != wanted_hash:
        complain(f"another solution: {what}")
    path = os.path.join(place, CHECKPOINT)
    info = subprocess.run([HRAD, "info", path, "--json"], stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, check=False)
    if json.loads(info.stdout)["solution"]["state_hash"] != wanted_hash:
        complain(f"another solution in the file: {what}")
    if not filecmp.cmp(path, wanted, shallow=False):
        counts["files that tell of other work"] += 1
    if set(os.listdir(place)) - {CHECKPOINT, CHECKPOINT + ".prev"}:
        complain(f"left behind: {sorted(os.listdir(place))}: {what}")


def solve_through_kills(case, choice, ranks_to_take, folder):
    """Begins anew after every kill, elsewhere, until the solve is done."""
    place, notes = os.path.join(folder, "place"), os.path.join(folder, "notes")
    os.mkdir(place)
    os.mkdir(notes)
    wanted, wanted_hash, seconds = left_alone(case, folder)
    ranks = threads = None
    had_file, kills, start = False, 0, time.monotonic()
    while True:
        ranks = choice.choice([r for r in ranks_to_take if r != ranks] or [1])
        threads = choice.choice([t for t in range(1, MOST_THREADS + 1) if t != threads])
        limit = choice.random() * seconds * (FIRST_SHARE + MORE_EACH_TIME * kills)
        what = f"{' '.join(case)} on {ranks} x {threads}, round {kills + 1}"
        solve = Solve([*case, "--checkpoint", CHECKPOINT, "--restart", "auto",
                       "--checkpoint-interval", choice.choice(INTERVALS)], ranks, threads, place, notes)
        killed = False
        if counts["kills sent"] < KILLS and kills < MOST_KILLS_OF_A_SOLVE:
            counts["kills sent"] += 1
            killed = solve.kill_after(limit, choice)
            counts["of them too late"] += not killed
        code, left = solve.end()
        if left:
            complain(f"{left} ranks were left at work: {what}")
        if not killed or code in (0, 7):
            break
        kills += 1
        counts["kills that met a solve"] += 1
        counts[f"kills of {solve.victim}"] += 1
        counts[f"kills in stage {solve.stage()}"] += 1
        had_file = look_at(place, had_file, f"{what}: {solve.victim} killed")
    conclude(solve, code, place, wanted, wanted_hash, what)
    counts["solves"] += 1
    print(f"{' '.join(case)}: {kills} kills, {time.monotonic() - start:.1f} s; "
          f"{seconds:.1f} s left alone", flush=True)


def main():
    choice = random.Random(SEED)
    ranks = list(range(1, MOST_RANKS + 1)) if has_mpi() else [1]
    print(f"HRAD_KILLS={KILLS} HRAD_SEED={SEED}, ranks {ranks}", flush=True)
    for case in itertools.cycle(CASES):
        with tempfile.TemporaryDirectory() as folder:
            solve_through_kills(case, choice, ranks, folder)
        if counts["kills sent"] >= KILLS:
            break
    for what in sorted(counts):
        print(f"{counts[what]:6d} {what}")
    print(f"{len(failures)} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
