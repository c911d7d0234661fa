# Files that `hrad solve -o` writes, read back by a second reader made of Python's standard library:
# .csv and .vtu hold the same leaves, and their sums are what the tool itself reports.
import csv
import json
import os
import re
import struct
import subprocess
import sys
import tempfile
import unittest

HRAD = os.environ["HRAD"]
VTK_TYPES = {"Float64": "d", "Int64": "q", "Int32": "i", "UInt8": "B"}


def hrad(*arguments, status=0):
    result = subprocess.run([HRAD, *arguments], capture_output=True, text=True, timeout=300)
    if result.returncode != status:
        sys.exit(f"hrad {' '.join(arguments)}: exit code {result.returncode}\n{result.stderr}")
    return result


def read_vtu(path):
    """The numbers of cells and points, and every array as {name: (components, values)}."""
    with open(path, "rb") as file:
        content = file.read()
    mark = b'<AppendedData encoding="raw">\n_'
    end = content.index(mark)
    start = end + len(mark)
    xml = content[:end].decode("ascii")
    assert 'byte_order="LittleEndian"' in xml and 'header_type="UInt64"' in xml
    arrays = {}
    for element in re.findall(r"<DataArray ([^>]*)/>", xml):
        attributes = dict(re.findall(r'(\w+)="([^"]*)"', element))
        code = VTK_TYPES[attributes["type"]]
        at = start + int(attributes["offset"])
        (size,) = struct.unpack_from("<Q", content, at)
        count = size // struct.calcsize("<" + code)
        values = struct.unpack_from(f"<{count}{code}", content, at + 8)
        arrays[attributes["Name"]] = (int(attributes["NumberOfComponents"]), values)
    cells = int(re.search(r'NumberOfCells="(\d+)"', xml).group(1))
    points = int(re.search(r'NumberOfPoints="(\d+)"', xml).group(1))
    return cells, points, arrays


def rows_of(array):
    components, values = array
    return [values[i : i + components] for i in range(0, len(values), components)]


class ExportedFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.csv_path = os.path.join(cls.folder.name, "cornell.csv")
        cls.vtu_path = os.path.join(cls.folder.name, "cornell.vtu")
        solved = hrad("solve", "cornell", "--accuracy", "0.2", "--json", "--quiet",
                      "-o", cls.csv_path, "-o", cls.vtu_path)
        cls.summary = json.loads(solved.stdout)
        with open(cls.csv_path, newline="") as file:
            cls.header, *cls.rows = csv.reader(file)
        cls.cells, cls.points, cls.arrays = read_vtu(cls.vtu_path)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_header(self):
        corners = [axis + corner for corner in "012" for axis in "xyz"]
        self.assertEqual(self.header,
                         ["patch", "face", "side", *corners, "area", "b0", "b1", "b2"])

    def test_counts(self):
        self.assertEqual(len(self.rows), self.summary["leaves"])
        self.assertEqual(self.cells, self.summary["leaves"])
        self.assertEqual(self.points, 3 * self.summary["leaves"])
        patches = {int(row[0]) for row in self.rows}
        self.assertEqual(patches, set(range(self.summary["patches"])))

    def test_both_files_hold_the_same_leaves(self):
        for name, column in (("patch", 0), ("face", 1), ("side", 2)):
            self.assertEqual([int(row[column]) for row in self.rows],
                             list(self.arrays[name][1]), name)
        self.assertEqual([tuple(map(float, row[13:16])) for row in self.rows],
                         rows_of(self.arrays["radiosity"]))
        points = rows_of(self.arrays["Points"])
        triangles = [sum((points[p] for p in cell), ()) for cell in
                     zip(*[iter(self.arrays["connectivity"][1])] * 3)]
        self.assertEqual([tuple(map(float, row[3:12])) for row in self.rows], triangles)
        self.assertEqual(set(self.arrays["types"][1]), {5})

    def test_areas_are_those_of_the_corners(self):
        for row in self.rows:
            a, b, c = (tuple(map(float, row[k : k + 3])) for k in (3, 6, 9))
            u, v = ([q - p for p, q in zip(a, other)] for other in (b, c))
            cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                     u[0] * v[1] - u[1] * v[0])
            area = 0.5 * sum(x * x for x in cross) ** 0.5
            self.assertAlmostEqual(float(row[12]) / area, 1, places=9)

    def test_emission_adds_up_to_the_power_emitted(self):
        power = [0.0, 0.0, 0.0]
        for row, emission in zip(self.rows, rows_of(self.arrays["emission"])):
            for band in range(3):
                power[band] += float(row[12]) * emission[band]
        for band in range(3):
            self.assertAlmostEqual(power[band] / self.summary["emitted"][band], 1, places=9)

    def test_leaf_means_add_up_to_the_patch_means_of_a_query(self):
        for quantity in ("radiosity", "irradiance", "emission"):
            queried = json.loads(hrad("query", "cornell", "--accuracy", "0.2", "--quiet",
                                      "--patches", "--quantity", quantity, "--json").stdout)
            powers, areas = {}, {}
            for row, values in zip(self.rows, rows_of(self.arrays[quantity])):
                key, area = (int(row[0]), int(row[2])), float(row[12])
                areas[key] = areas.get(key, 0) + area
                powers[key] = [power + area * value for power, value in
                               zip(powers.get(key, (0, 0, 0)), values)]
            self.assertEqual(len(queried["patches"]), len(areas))
            for patch in queried["patches"]:
                key = (patch["patch"], patch["side"])
                self.assertAlmostEqual(areas[key] / patch["area"], 1, places=9)
                # Shares of area that are exposed are kept in single precision.
                for power, mean in zip(powers[key], patch["values"]):
                    self.assertAlmostEqual(power / areas[key], mean, delta=1e-6 * (1 + mean))

    def test_radiosity_is_emission_and_more(self):
        for radiosity, emission in zip(rows_of(self.arrays["radiosity"]),
                                       rows_of(self.arrays["emission"])):
            for b, e in zip(radiosity, emission):
                self.assertGreaterEqual(b, e * (1 - 1e-9))

    def test_the_export_command_writes_the_same_bytes(self):
        path = os.path.join(self.folder.name, "again.csv")
        hrad("export", "cornell", "--accuracy", "0.2", "--quiet", "-o", path)
        with open(path, "rb") as again, open(self.csv_path, "rb") as first:
            self.assertEqual(again.read(), first.read())


if __name__ == "__main__":
    unittest.main()
