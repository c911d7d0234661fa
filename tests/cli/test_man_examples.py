#!/usr/bin/env python3
"""The examples of the manual pages of the tool, run as they stand, in a folder that has a scene
room.obj and its solution room.hrad; and the scene of hrad-scene(5), solved."""
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

HRAD = os.environ["HRAD"]
MAN = pathlib.Path(os.environ["HRAD_SOURCE_DIR"]) / "man"
LINE = re.compile(r"\.Dl (.*)")
BLOCK = re.compile(r"\.Bd -literal[^\n]*\n(.*?)\n\.Ed", re.DOTALL)


def examples_of(page):
    """The section EXAMPLES of a page."""
    text = page.read_text()
    if ".Sh EXAMPLES\n" not in text:
        return ""
    return text.split(".Sh EXAMPLES\n", 1)[1].split("\n.Sh ", 1)[0]


def blocks_of(text):
    return [block.replace("\\e", "\\") for block in BLOCK.findall(text)]


def commands_of(text):
    """Every command, lines that go on joined. Those of mpirun without it: this is one machine."""
    lines = [line.replace("\\e", "\\") for line in LINE.findall(text)]
    for block in blocks_of(text):
        lines += block.replace("\\\n", " ").splitlines()
    return [re.sub(r"^mpirun .*? (?=hrad )", "", line) for line in lines
            if re.match(r"(mpirun .*? )?hrad ", line)]


def run(command, folder):
    """The command by a shell that finds the tool as a user would."""
    path = f"{folder}/bin:{os.environ['PATH']}"
    done = subprocess.run(["bash", "-c", command], cwd=folder, env=dict(os.environ, PATH=path),
                          stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


def outputs_of(command):
    """The files that the command says it writes."""
    words = shlex.split(command)
    return [words[at + 1] for at, word in enumerate(words[:-1])
            if word in ("-o", ">", "--checkpoint")]


def main():
    failures = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "bin").mkdir()
        (folder / "bin" / "hrad").symlink_to(HRAD)
        for command in ("hrad scene furnished-room -o room.obj",
                        "hrad solve room.obj --accuracy 0.05 -o room.hrad"):
            code, _, said = run(command, folder)
            assert code == 0, said
        count = 0
        for page in sorted(MAN.glob("hrad*.1")):
            commands = commands_of(examples_of(page))
            if not commands:
                failures.append(f"{page.name} has no example")
            for command in commands:
                count += 1
                for file in outputs_of(command):
                    if file != "room.hrad":
                        (folder / file).unlink(missing_ok=True)
                code, out, said = run(command, folder)
                if code != 0:
                    failures.append(f"{page.name}: {command}: exit code {code}: {said}")
                for file in outputs_of(command):
                    path = folder / file
                    if not path.is_file() or path.stat().st_size == 0:
                        failures.append(f"{page.name}: {command}: it left no {file}")
                if not out and not outputs_of(command):
                    failures.append(f"{page.name}: {command}: it says nothing")
        if count < 15:
            failures.append(f"only {count} examples were found")
        scene, materials = blocks_of(examples_of(MAN / "hrad-scene.5"))
        (folder / "small.obj").write_text(scene + "\n")
        (folder / "small.mtl").write_text(materials + "\n")
        code, out, said = run("hrad solve small.obj --accuracy 0.05 --json", folder)
        if code != 0 or '"emitted"' not in out:
            failures.append(f"hrad-scene.5: the scene: exit code {code}: {said}{out[:300]}")
        _, out, said = run("hrad info small.obj", folder)
        if said:
            failures.append(f"hrad-scene.5: the scene is doubtful: {said}")
    print("\n".join(failures) or "ok")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
