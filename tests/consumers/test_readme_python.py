"""The Python program of the README, run as the README says, in this build."""

import os
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.environ["HRAD_SOURCE_DIR"], "tests", "python"))
import support  # noqa: E402


class Readme(unittest.TestCase):
    def test_program(self):
        with open(os.path.join(support.SOURCE, "README.md"), encoding="utf-8") as file:
            (program,) = re.findall(r"^```python\n(.*?)^```", file.read(), re.M | re.S)
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "room.py"), "w", encoding="utf-8") as file:
                file.write(program)
            done = subprocess.run([sys.executable, "room.py"], cwd=folder, timeout=300,
                                  env=dict(os.environ, PYTHONPATH=support.PACKAGES,
                                           PYTHONDONTWRITEBYTECODE="1"),
                                  stdout=subprocess.PIPE, universal_newlines=True)
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stdout, r"^emitted [0-9.]+ W, absorbed [0-9.]+ W\n$")


if __name__ == "__main__":
    unittest.main()
