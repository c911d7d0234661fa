# The pictures in the README are what the tool draws today, but for what other ray engines round.
import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
from png_reader import Png  # noqa: E402

HRAD, SOURCE = os.environ["HRAD"], os.environ["HRAD_SOURCE_DIR"]
# Of 255: of the mean value of a picture, and of all but one in a thousand.
MEAN, MOST = 0.3, 12


def differences(one, other):
    assert (one.width, one.height) == (other.width, other.height)
    return sorted(abs(a - b) for row, other_row in zip(one.rows, other.rows)
                  for a, b in zip(row, other_row))


def main():
    scene = os.path.join(SOURCE, "tests", "cli", "scenes", "CornellBox-Original.obj")
    pictures = {"classroom.png": ["solve", "classroom"],
                "cornell_box.png": ["render", scene, "--accuracy", "0.01", "--size", "480x480"]}
    with open(os.path.join(SOURCE, "README.md"), encoding="utf-8") as file:
        readme = file.read()
    for name, command in pictures.items():
        assert f"](cli/{name})" in readme, name
        with tempfile.TemporaryDirectory() as folder:
            drawn = os.path.join(folder, name)
            subprocess.run([HRAD, *command, "-o", drawn, "--quiet"], check=True,
                           stdout=subprocess.DEVNULL)
            found = differences(Png(drawn), Png(os.path.join(SOURCE, "cli", name)))
        mean, most = sum(found) / len(found), found[-len(found) // 1000]
        print(f"{name}: differences of {mean:.3f} in the mean, {most} at the most but for 1/1000")
        assert mean <= MEAN and most <= MOST, name


if __name__ == "__main__":
    sys.exit(main())
