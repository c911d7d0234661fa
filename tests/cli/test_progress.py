# The progress line: only on a terminal, never backwards, gone at the end, silent with --quiet.
import os
import pty
import re
import select
import subprocess
import sys

HRAD = os.environ["HRAD"]
SOLVE = [HRAD, "solve", "cornell", "--accuracy", "0.05"]


try:
    for end in pty.openpty():
        os.close(end)
except OSError as error:
    print(f"skipped: no terminal can be made here ({error})")
    sys.exit(0)


def on_terminal(arguments):
    """Runs with stderr on a terminal; returns exit code, stdout, and what the terminal received."""
    ours, theirs = pty.openpty()
    process = subprocess.Popen(
        arguments, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=theirs)
    os.close(theirs)
    received = {process.stdout.fileno(): b"", ours: b""}
    waiting = set(received)
    while waiting:
        for file in select.select(list(waiting), [], [])[0]:
            try:
                data = os.read(file, 65536)
            except OSError:  # a terminal whose other side is closed
                data = b""
            if not data:
                waiting.discard(file)
            received[file] += data
    os.close(ours)
    return process.wait(), received[process.stdout.fileno()].decode(), received[ours].decode()


def screen_after(text):
    """What is left of the last line once all was written."""
    line = []
    for part in re.split("(\r\n|\n|\r)", text):
        if part in ("\n", "\r\n"):
            line = []
        elif part != "\r":
            line[: len(part)] = part
    return "".join(line).strip()


def main():
    code, out, terminal = on_terminal(SOLVE)
    assert code == 0, terminal
    percents = [int(p) for p in re.findall(r"(\d+) %", terminal)]
    assert percents, "no progress on a terminal: " + repr(terminal)
    assert percents == sorted(percents), percents
    assert 0 <= percents[0] and percents[-1] <= 100, percents
    assert screen_after(terminal) == "", repr(terminal)
    assert "\r" not in out and "%\r" not in out, repr(out)

    code, out, terminal = on_terminal(SOLVE + ["--quiet", "--json"])
    assert code == 0 and terminal == "", repr(terminal)
    assert out.startswith("{"), out

    result = subprocess.run(SOLVE, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    assert result.returncode == 0
    assert "\r" not in result.stderr and " %" not in result.stderr, repr(result.stderr)

    result = subprocess.run(SOLVE + ["-v"], capture_output=True, text=True,
                            stdin=subprocess.DEVNULL)
    assert result.returncode == 0
    assert "hrad: loaded cornell: 36 patches\n" in result.stderr, result.stderr
    assert "hrad: stage linking after " in result.stderr, result.stderr


if __name__ == "__main__":
    sys.exit(main())
