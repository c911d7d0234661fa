"""Solvers of several processes from Python, with communicators of mpi4py: the bits of one process. Skipped
(77) where mpi4py or MPI is missing."""

import os
import shutil
import subprocess
import sys
import unittest

import support

support.need("mpi4py", "mpi4py")
if not support.built("hrad_mpi") or not shutil.which("mpirun"):
    support.skip("there is no MPI in this build")


class Ranks(unittest.TestCase):
    def test_bits_are_those_of_one_process(self):
        told = support.hrad_json("solve", "cornell", "--accuracy", "0.2")["state_hash"]
        program = os.path.join(support.SOURCE, "tests", "python", "ranks.py")
        for ranks in (1, 2):
            done = subprocess.run(["mpirun", "-n", str(ranks), sys.executable, program],
                                  env=dict(os.environ, PYTHONPATH=support.PACKAGES,
                                           PYTHONDONTWRITEBYTECODE="1"),
                                  stdout=subprocess.PIPE, universal_newlines=True, timeout=300)
            self.assertEqual(done.returncode, 0)
            self.assertEqual(done.stdout.splitlines(), ["hash " + told] * ranks)


if __name__ == "__main__":
    unittest.main()
