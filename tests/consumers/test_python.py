"""The example in tests/consumers/python: it says what is on the plane over the desks, and draws it.
Skipped (77) where Matplotlib, Debian's python3-matplotlib, is not installed."""

import os
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.environ["HRAD_SOURCE_DIR"], "tests", "python"))
import support  # noqa: E402

support.need("matplotlib", "Matplotlib")
from matplotlib import image  # noqa: E402
import numpy as np  # noqa: E402


class WorkPlane(unittest.TestCase):
    def test_example(self):
        program = os.path.join(support.SOURCE, "tests", "consumers", "python", "work_plane.py")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "plane.png")
            done = subprocess.run([sys.executable, program, path], timeout=500,
                                  env=dict(os.environ, PYTHONPATH=support.PACKAGES,
                                           PYTHONDONTWRITEBYTECODE="1"),
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                  universal_newlines=True)
            self.assertEqual(done.returncode, 0, done.stderr[-1000:])
            picture = image.imread(path)
        mean, least, most = map(float, re.fullmatch(
            r"1504 points: mean ([0-9.]+), least ([0-9.]+), most ([0-9.]+) W/m2\n",
            done.stdout).groups())
        # In the middle it is brightest, and inside the name plates on the teacher's desk dark.
        self.assertEqual(least, 0)
        self.assertLess(abs(mean - 9.26), 0.2)
        self.assertLess(abs(most - 11.3), 0.5)
        self.assertEqual(picture.shape[:2], (550, 800))
        self.assertGreater(len(np.unique(picture.reshape(-1, picture.shape[2]), axis=0)), 200)
        self.assertIn("measure  100%", done.stderr)


if __name__ == "__main__":
    unittest.main()
