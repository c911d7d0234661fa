"""A solve that keeps a checkpoint, on one process or several of them, to be killed."""
import os
import random
import re
import signal
import subprocess
import time

HRAD = os.environ["HRAD"]
CHECKPOINT = "a.hrad"
# What is started by mpirun tells its number, so that it can be killed.
RANK = 'echo $$ >"$1/rank.$OMPI_COMM_WORLD_RANK" && shift && exec "$@"'

BEFORE = "none yet"


def has_mpi():
    with open(os.path.join(os.environ["HRAD_BINARY_DIR"], "CMakeCache.txt"), encoding="utf-8") as file:
        built = "\nHRAD_MPI:BOOL=ON" in file.read()
    try:
        return built and subprocess.run(["mpirun", "--version"], stdout=subprocess.DEVNULL,
                                        check=False).returncode == 0
    except OSError:
        return False


def is_at_work(process):
    """It is there, and no zombie that nobody has waited for."""
    try:
        with open(f"/proc/{process}/stat", encoding="utf-8", errors="replace") as file:
            return file.read().rpartition(")")[2].split()[0] not in "ZX"
    except OSError:
        return False


def kill(process):
    try:
        os.kill(process, signal.SIGKILL)
    except ProcessLookupError:
        pass


class Solve:
    """Under way in the folder `place`; `notes` is one for what it says and who it is."""

    def __init__(self, arguments, ranks, threads, place, notes):
        self.ranks, self.notes, self.victim = ranks, notes, None
        for name in os.listdir(notes):
            if name.startswith("rank."):
                os.unlink(os.path.join(notes, name))
        command = [HRAD, "solve", *arguments, "--threads", str(threads), "--json", "-v"]
        environment = dict(os.environ)
        if ranks > 1:
            command = ["mpirun", "-n", str(ranks), "bash", "-c", RANK, "-", notes, *command]
            # Killed launchers leave what they share in memory and elsewhere behind: here it is gone
            # with the test. Leaks of modules that MPI has closed can't be told by name.
            environment.update(TMPDIR=notes, OMPI_MCA_btl_vader_backing_directory=notes,
                               ASAN_OPTIONS="detect_leaks=0")
        with open(os.path.join(notes, "out"), "wb") as out, \
                open(os.path.join(notes, "err"), "wb") as err:
            self.process = subprocess.Popen(command, cwd=place, env=environment, stdout=out,
                                            stderr=err, stdin=subprocess.DEVNULL)

    def processes(self):
        """Of the ranks that have begun, when there are several."""
        numbers = []
        for rank in range(self.ranks):
            try:
                with open(os.path.join(self.notes, f"rank.{rank}"), encoding="utf-8") as file:
                    numbers.append(int(file.read()))
            except (OSError, ValueError):
                pass
        return numbers

    def is_over(self):
        return self.process.poll() is not None

    def kill_after(self, seconds, choice: random.Random):
        """False: it was over before. Most times only what follows the start of MPI and reading
        counts."""
        in_a_stage = choice.random() < 0.75
        while not self.is_over() and (len(self.processes()) < self.ranks > 1 or
                                      (in_a_stage and self.stage() == BEFORE)):
            time.sleep(0.01)
        try:
            self.process.wait(seconds)
            return False
        except subprocess.TimeoutExpired:
            pass
        self.victim = "the process" if self.ranks == 1 else \
            choice.choice(["one rank", "all ranks", "mpirun"])
        processes = self.processes()
        if self.victim == "one rank":
            kill(choice.choice(processes))
        elif self.victim == "all ranks":
            for process in processes:
                kill(process)
        else:
            self.process.kill()
        return True

    def end(self):
        """Waits for all of it; the exit code, and how many ranks went on for a minute without their
        launcher (these are ended)."""
        code = self.process.wait()
        end = time.monotonic() + 60
        while any(map(is_at_work, self.processes())) and time.monotonic() < end:
            time.sleep(0.01)
        left = [process for process in self.processes() if is_at_work(process)]
        for process in left:
            kill(process)
        return code, len(left)

    def said(self):
        with open(os.path.join(self.notes, "err"), encoding="utf-8", errors="replace") as file:
            return file.read()

    def printed(self):
        with open(os.path.join(self.notes, "out"), encoding="utf-8") as file:
            return file.read()

    def stage(self):
        """The last one that it has spoken of."""
        return ([BEFORE] + re.findall(r"^hrad: stage (\S+)", self.said(), re.M))[-1]
