# A second reader, in another language, decodes what the tool writes and agrees with its other
# outputs: leaves, radiosity, counts. And the golden files, which every version must read for ever.
import csv
import hashlib
import json
import os
import subprocess
import sys
import tempfile
import unittest

SOURCE = os.environ["HRAD_SOURCE_DIR"]
sys.path.insert(0, os.path.join(SOURCE, "tests", "solver"))
import read_hrad  # noqa: E402


def hrad(*arguments):
    return subprocess.run([os.environ["HRAD"], *arguments], check=True, stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL).stdout


class SecondReader(unittest.TestCase):
    def compare(self, path, folder, report=None):
        """The reader's view of a file with the .csv that the tool makes of it."""
        table = os.path.join(folder, "leaves.csv")
        hrad("export", path, "-o", table)
        checkpoint = read_hrad.Checkpoint(path)
        with open(table, newline="") as file:
            rows = list(csv.DictReader(file))
        leaves = list(checkpoint.leaves())
        self.assertEqual(len(rows), len(leaves))
        self.assertGreater(len(rows), 10)
        for row, k in zip(rows, leaves):
            patch, side = checkpoint.surfaces[checkpoint.nodes[k].surface]
            self.assertEqual((int(row["patch"]), int(row["side"])), (patch, side))
            self.assertEqual(int(row["face"]), checkpoint.patches[patch][1])
            self.assertEqual([float(row[f"b{b}"]) for b in range(checkpoint.bands)],
                             checkpoint.mean_radiosity(k))
            corner = checkpoint.vertices[checkpoint.patches[patch][0][0]]
            if checkpoint.nodes[k].level == 0:
                self.assertEqual([float(row[name]) for name in ("x0", "y0", "z0")], list(corner))
        info = json.loads(hrad("info", path, "--json"))
        self.assertEqual(info["solution"]["links"], checkpoint.link_count())
        self.assertEqual(info["solution"]["emitted"], checkpoint.progress["emitted"])
        self.assertEqual(info["solution"]["iterations"], checkpoint.progress["iterations"])
        for parameter in info["parameters"]:
            if parameter["name"] in checkpoint.params:
                self.assertEqual(parameter["value"], checkpoint.params[parameter["name"]])
        for name in "linking", "seed", "accuracy":
            self.assertIn(name, checkpoint.params)

    def test_agrees_with_the_tool(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.hrad")
            for case in (["cornell", "--accuracy", "0.3"],
                         ["furnished-room", "--accuracy", "0.4", "--set", "bands=1"],
                         ["cornell", "--accuracy", "0.4", "--set", "linking=pairs"],
                         ["cornell", "--accuracy", "0.5", "--set", "linking=clusters"],
                         ["furnace", "--accuracy", "0.2", "--set", "detail=means"]):
                with self.subTest(case):
                    hrad("solve", *case, "-o", path)
                    self.compare(path, folder)

    def test_reads_the_golden_files(self):
        golden = os.path.join(SOURCE, "tests", "golden")
        with open(os.path.join(golden, "leaves.sha256")) as file:
            wanted = {name: value for value, name in map(str.split, file)}
        names = sorted(name for name in os.listdir(golden) if name.endswith(".hrad"))
        self.assertGreaterEqual(len(names), 6)
        for name in names:
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                path = os.path.join(golden, name)
                checkpoint = read_hrad.Checkpoint(path)
                self.assertEqual(name.startswith(f"v{checkpoint.version}-"), True)
                if name in wanted:
                    self.compare(path, folder)
                    table = os.path.join(folder, "leaves.csv")
                    hrad("export", path, "-o", table)
                    with open(table, "rb") as now:
                        self.assertEqual(hashlib.sha256(now.read()).hexdigest(), wanted[name])
                else:
                    self.assertGreater(checkpoint.sizes["steps"], 0)
                # It can still be solved on.
                hrad("check", path)
                hrad("solve", path)

    def test_refuses_what_the_tool_refuses(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.hrad")
            hrad("solve", "furnace", "--accuracy", "0.4", "-o", path)
            with open(path, "rb") as file:
                good = file.read()
            for at in list(range(0, 700, 7)) + list(range(700, len(good), 997)):
                with open(path, "wb") as file:
                    file.write(good[:at] + bytes([good[at] ^ 4]) + good[at + 1:])
                with self.assertRaises(Exception):
                    read_hrad.Checkpoint(path)
                code = subprocess.run([os.environ["HRAD"], "check", path],
                                      stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                self.assertEqual(code.returncode, 4)


if __name__ == "__main__":
    unittest.main()
