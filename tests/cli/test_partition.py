# hrad partition: tables, JSON and the .vtu of owners agree, and mistakes are told.
import json
import os
import re
import struct
import subprocess
import tempfile
import unittest
from collections import Counter

HRAD = os.environ["HRAD"]
SCENE = "furnished-room"
RANKS = 5


def hrad(*arguments, code=0):
    run = subprocess.run([HRAD, *arguments], capture_output=True, text=True, timeout=120,
                         check=False)
    if run.returncode != code:
        raise AssertionError("exit code %d of %s: %s" % (run.returncode, arguments, run.stderr))
    return run


def cell_arrays(path):
    """The cell data of a .vtu with appended raw arrays, by name."""
    with open(path, "rb") as file:
        head, body = file.read().split(b'<AppendedData encoding="raw">\n_', 1)
    formats = {"Int32": "i", "Int64": "q", "Float64": "d"}
    arrays = {}
    cells = head[head.index(b"<CellData>"):head.index(b"</CellData>")].decode()
    for kind, name, offset in re.findall(r'type="(\w+)" Name="(\w+)".*?offset="(\d+)"', cells):
        (size,) = struct.unpack_from("<Q", body, int(offset))
        count = size // struct.calcsize("<" + formats[kind])
        arrays[name] = struct.unpack_from("<%d%s" % (count, formats[kind]), body, int(offset) + 8)
    return arrays


class Partition(unittest.TestCase):
    def test_json_and_file_agree(self):
        with tempfile.TemporaryDirectory() as folder:
            for method in "cost", "grid":
                path = os.path.join(folder, method + ".vtu")
                report = json.loads(hrad("partition", SCENE, "-n", str(RANKS), "--method", method,
                                         "-o", path, "--json").stdout)
                self.assertEqual(report["ranks"], RANKS)
                (plan,) = report["methods"]
                self.assertEqual(plan["method"], method)
                cells = cell_arrays(path)
                patches, work = Counter(cells["owner"]), Counter()
                for owner, of_patch in zip(cells["owner"], cells["work"]):
                    work[owner] += of_patch
                for rank, load in enumerate(plan["loads"]):
                    self.assertEqual(load["patches"], patches[rank])
                    self.assertAlmostEqual(load["work"], work[rank], delta=1e-6 * load["work"])
                    self.assertTrue(0 <= load["remote"] <= 1)
                mean = sum(work.values()) / RANKS
                self.assertAlmostEqual(plan["imbalance"], max(work.values()) / mean, places=9)

    def test_both_methods_stand_in_the_tables(self):
        text = hrad("partition", SCENE, "-n", str(RANKS)).stdout
        self.assertIn("cost: imbalance", text)
        self.assertIn("grid: imbalance", text)
        self.assertEqual(len(re.findall(r"^ +\d+ +\d+ ", text, re.MULTILINE)), 2 * RANKS)

    def test_mistakes(self):
        for arguments in (["partition", SCENE], ["partition", SCENE, "-n", "0"],
                          ["partition", SCENE, "-n", "2.5"], ["partition", SCENE, "-n", "1e9"],
                          ["partition", SCENE, "-n", "2", "--method", "metis"],
                          ["partition", SCENE, "-n", "2", "-o", "x.csv"]):
            self.assertRegex(hrad(*arguments, code=2).stderr, r"^hrad: .*(-n|method|x\.csv)")
        hrad("partition", "no-such-file.obj", "-n", "2", code=5)
        hrad("partition", SCENE, "-n", "2", "-o", "/nowhere/x.vtu", code=5)


if __name__ == "__main__":
    unittest.main()
