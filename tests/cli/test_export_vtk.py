# Exported files in a foreign program: VTK reads .vtu, .ply and .glb with its own readers and finds
# the values of `hrad solve -o FILE.csv` and `hrad query`. Skipped (code 77) where its Python modules,
# Debian's python3-vtk9, are not installed.
import csv
import json
import os
import subprocess
import sys
import tempfile
import unittest

try:
    from vtkmodules.vtkIOGeometry import vtkGLTFReader
    from vtkmodules.vtkIOPLY import vtkPLYReader
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError:
    # Debian's modules belong to Debian's interpreter, which need not be the first in PATH.
    debian_python = "/usr/bin/python3"
    if os.path.exists(debian_python) and not os.path.samefile(debian_python, sys.executable):
        os.execv(debian_python, [debian_python, *sys.argv])
    print("skipped: VTK's Python modules are not installed")
    sys.exit(77)

HRAD = os.environ["HRAD"]
SCENE = ["cornell", "--accuracy", "0.2", "--quiet"]


def hrad(*arguments):
    return subprocess.run([HRAD, *arguments], capture_output=True, text=True, timeout=300,
                          check=True).stdout


def tuples(array):
    return [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]


def read(reader, path):
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


class Vtk(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        paths = [cls.path(ending) for ending in ("csv", "vtu", "ply", "glb")]
        hrad("solve", *SCENE, *(word for path in paths for word in ("-o", path)))
        with open(paths[0], newline="") as file:
            cls.rows = list(csv.DictReader(file))
        cls.grid = read(vtkXMLUnstructuredGridReader(), paths[1])

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def path(cls, ending):
        return os.path.join(cls.folder.name, "box." + ending)

    def check_corners(self, mesh, delta):
        """Cell k of the mesh is row k of the table."""
        self.assertEqual(mesh.GetNumberOfCells(), len(self.rows))
        for k, row in enumerate(self.rows):
            cell = mesh.GetCell(k)
            for corner in range(3):
                point = mesh.GetPoint(cell.GetPointId(corner))
                for axis, x in zip("xyz", point):
                    self.assertAlmostEqual(x, float(row[axis + str(corner)]), delta=delta)

    def test_vtu_cells(self):
        self.check_corners(self.grid, 0)
        self.assertEqual(self.grid.GetCell(0).GetClassName(), "vtkTriangle")
        data = self.grid.GetCellData()
        self.assertEqual(tuples(data.GetArray("radiosity")),
                         [tuple(float(row[b]) for b in ("b0", "b1", "b2")) for row in self.rows])
        for name in "patch", "face", "side":
            self.assertEqual(tuples(data.GetArray(name)), [(int(row[name]),) for row in self.rows])

    def test_vtu_means_are_those_of_queries(self):
        sides = list(zip(tuples(self.grid.GetCellData().GetArray("patch")),
                         tuples(self.grid.GetCellData().GetArray("side"))))
        for quantity in ("radiosity", "irradiance", "emission"):
            answer = json.loads(hrad("query", *SCENE, "--patches", "--quantity", quantity, "--json"))
            powers, areas = {}, {}
            for ((patch,), (side,)), row, values in zip(
                    sides, self.rows, tuples(self.grid.GetCellData().GetArray(quantity))):
                key, area = (patch, side), float(row["area"])
                areas[key] = areas.get(key, 0) + area
                powers[key] = [p + area * v for p, v in zip(powers.get(key, (0, 0, 0)), values)]
            self.assertEqual(len(answer["patches"]), len(areas))
            for patch in answer["patches"]:
                key = patch["patch"], patch["side"]
                for power, mean in zip(powers[key], patch["values"]):
                    self.assertAlmostEqual(power / areas[key], mean, delta=1e-6 * (1 + mean))

    def test_vtu_points(self):
        linear = self.grid.GetPointData().GetArray("radiosity_linear")
        self.assertEqual(linear.GetNumberOfTuples(), 3 * len(self.rows))
        self.assertEqual(linear.GetNumberOfComponents(), 3)
        self.assertGreater(max(map(max, tuples(linear))), 0)

    def test_ply(self):
        mesh = read(vtkPLYReader(), self.path("ply"))
        self.check_corners(mesh, 1e-7)  # the reader takes them down to single precision
        colors = tuples(mesh.GetPointData().GetArray("RGB"))
        self.assertEqual(len(colors), mesh.GetNumberOfPoints())
        self.assertEqual(max(map(max, colors)), 255)

    def test_glb(self):
        mesh = read(vtkGLTFReader(), self.path("glb"))
        while mesh.IsA("vtkMultiBlockDataSet"):
            self.assertEqual(mesh.GetNumberOfBlocks(), 1)
            mesh = mesh.GetBlock(0)
        self.assertEqual(mesh.GetNumberOfCells(), len(self.rows))
        linear = tuples(self.grid.GetPointData().GetArray("radiosity_linear"))
        data = mesh.GetPointData()
        radiosity = tuples(data.GetArray("_RADIOSITY"))
        for k, row in enumerate(self.rows):
            cell = mesh.GetCell(k)
            for corner in range(3):
                number = cell.GetPointId(corner)
                # Its node turns the scene, whose z is up, to glTF's y up.
                x, y, z = (float(row[axis + str(corner)]) for axis in "xyz")
                for found, wanted in zip(mesh.GetPoint(number), (x, z, -y)):
                    self.assertAlmostEqual(found, wanted, delta=1e-6)
                for found, wanted in zip(radiosity[number], linear[3 * k + corner]):
                    self.assertAlmostEqual(found, wanted, delta=1e-6 * (1 + wanted))


if __name__ == "__main__":
    unittest.main()
