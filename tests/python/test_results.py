"""Results in Python are those of the tool and of its files: patches, points, sensors, leaves, balance,
exports, checkpoints; ranges that are wrong are refused."""

import csv
import io
import os
import shutil
import tempfile
import unittest

import support

import numpy as np

import hrad

SCENE = ("cornell", "--accuracy", "0.2")


def table(text):
    return list(csv.DictReader(io.StringIO(text)))


def numbers(rows, names):
    return np.array([[float(row[name]) for name in names] for row in rows])


class Results(support.Case):
    @classmethod
    def setUpClass(cls):
        cls.solved = hrad.Solver()
        cls.solved.make_scene("cornell")
        cls.solved["accuracy"] = 0.2
        cls.solved.solve()

    @classmethod
    def tearDownClass(cls):
        cls.solved.destroy()

    def setUp(self):
        super().setUp()
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def test_patches(self):
        for quantity, name in ((hrad.RADIOSITY, "radiosity"), (hrad.IRRADIANCE, "irradiance"),
                               (hrad.EMISSION, "emission"), (hrad.NET_FLUX, "net_flux")):
            rows = table(support.hrad_tool("query", *SCENE, "--patches", "--csv", "--quantity", name))
            fronts = [row for row in rows if row["side"] == "0"]
            wanted = numbers(fronts, ("b0", "b1", "b2"))
            np.testing.assert_array_equal(self.solved.query_patches(quantity), wanted)
        part = self.solved.query_patches(hrad.NET_FLUX, hrad.FRONT, 3, 5)
        np.testing.assert_array_equal(part, wanted[3:8])
        np.testing.assert_array_equal(self.solved.query_patches(hrad.NET_FLUX, first=30), wanted[30:])
        self.assertFalse(self.solved.query_patches(hrad.RADIOSITY, hrad.BACK).any())
        self.assertEqual(self.solved.query_patches(hrad.RADIOSITY, first=36).shape, (0, 3))

    def test_ranges(self):
        query = self.solved.query_patches
        for arguments in ((0, 0, -1, 1), (0, 0, 0, 37), (0, 0, 36, 1), (0, 0, 37), (0, 0, 0, -1),
                          (0, 0, 1, 2**62), (0, 0, 2**63, 1)):
            self.assert_misfit("there are 36", query, *arguments)
        self.assert_misfit("quantity", query, 4)
        self.assert_misfit("quantity is 4294967296", query, 2**32)
        self.assert_misfit("side", query, 0, 2)
        self.assert_misfit("there are", self.solved.query_leaves, 0, 10**15)
        self.assert_misfit("no field 'colour'", self.solved.query_leaves, fields=("colour",))

    def test_results_are_written_to_the_arrays_given(self):
        room = np.full((40, 3), -1.0)
        out = room[2:38]
        self.assertIs(self.solved.query_patches(hrad.RADIOSITY, out=out), out)
        self.assertTrue((room[:2] == -1).all() and (room[38:] == -1).all())
        np.testing.assert_array_equal(out, self.solved.query_patches(hrad.RADIOSITY))
        values, errors = np.empty((1, 3)), np.empty((1, 3))
        found = self.solved.query_sensors([[0.2, 0.2, 0.2]], [[0, 0, 1]], values, errors)
        self.assertTrue(found[0] is values and found[1] is errors)
        # A call that fails leaves them alone.
        room[:] = -1
        self.assert_misfit("quantity", self.solved.query_patches, 9, out=out)
        self.assertTrue((room == -1).all())

    def test_points(self):
        patch, uv = [1, 7, 7], [[0.9, 0.05], [0, 0], [0.5, 0.5]]
        found = self.solved.query_points(hrad.IRRADIANCE, patch, uv)
        self.assertEqual(found.shape, (3, 3))
        self.assertTrue((found > 0).all())
        rho = self.solved.get_material(self.solved.get_patch(1).material).reflectance
        radiosity = self.solved.query_points(hrad.RADIOSITY, patch, uv)
        np.testing.assert_allclose(radiosity[0], rho * found[0], rtol=1e-9)
        self.assert_misfit(r"uv has the shape \(2,\)", self.solved.query_points, 0, [0], [0.2, 0.2])
        self.assert_misfit(r"\(3, 2\)", self.solved.query_points, 0, patch, uv[:2])
        self.assert_misfit("u = nan", self.solved.query_points, 0, [0], [[np.nan, 0]])
        self.assert_misfit("patch 36", self.solved.query_points, 0, [36], [[0, 0]])
        self.assert_misfit("float64", self.solved.query_points, 0, [0.0], [[0, 0]])

    def test_sensors(self):
        (told,) = support.hrad_json("query", *SCENE, "--at", "0.2,0.2,0.2:0,0,1")["sensors"]
        irradiance, error = self.solved.query_sensors([[0.2, 0.2, 0.2]], [[0, 0, 1]])
        self.assertEqual(irradiance.tolist(), [told["irradiance"]])
        self.assertEqual(error.tolist(), [told["standard_error"]])
        self.assert_misfit("normal", self.solved.query_sensors, [[0, 0, 0]], [[0, 0, 0]])
        self.assert_misfit("finite", self.solved.query_sensors, [[0, np.nan, 0]], [[0, 0, 1]])
        self.assert_misfit(r"\(2, 3\)", self.solved.query_sensors, np.zeros((2, 3)), [[0, 0, 1]])

    def test_leaves(self):
        self.solved.export(self.path("python.csv"))
        support.hrad_tool("solve", *SCENE, "-o", self.path("tool.csv"))
        with open(self.path("python.csv"), "rb") as ours, open(self.path("tool.csv"), "rb") as theirs:
            text = ours.read()
            self.assertEqual(text, theirs.read())
        rows = table(text.decode())
        leaves = self.solved.query_leaves()
        self.assertEqual(len(rows), self.solved.leaf_count())
        corners = [axis + corner for corner in "012" for axis in "xyz"]
        for name, columns in (("patch", ["patch"]), ("face", ["face"]), ("side", ["side"]),
                              ("corners_xyz", corners), ("area", ["area"]),
                              ("radiosity", ["b0", "b1", "b2"])):
            found = getattr(leaves, name)
            np.testing.assert_array_equal(found.reshape(len(rows), -1), numbers(rows, columns), name)
        self.assertEqual(leaves.corners_xyz.shape, (len(rows), 3, 3))
        some = self.solved.query_leaves(5, 7, ("area", "side"))
        self.assertIsNone(some.radiosity)
        np.testing.assert_array_equal(some.area, leaves.area[5:12])

    def test_balance(self):
        told = support.hrad_json("solve", *SCENE)
        balance = self.solved.power_balance()
        for name, values in balance._asdict().items():
            self.assertEqual(values.tolist(), told[name], name)

    def test_before_a_solve(self):
        self.solver.make_scene("cornell")
        for method, arguments in (("query_patches", (hrad.RADIOSITY,)), ("leaf_count", ()),
                                  ("query_leaves", ()), ("power_balance", ()),
                                  ("query_sensors", ([[0, 0, 0]], [[0, 0, 1]])),
                                  ("query_points", (hrad.RADIOSITY, [0], [[0, 0]])),
                                  ("export", (self.path("early.csv"),))):
            self.assert_fails(hrad.ERROR_STATE, "solve", getattr(self.solver, method), *arguments)
        self.assertTrue(self.solver.query_patches(hrad.EMISSION).any())

    def test_checkpoints(self):
        path = self.path("room.hrad")
        self.solver.make_scene("cornell")
        self.solver["accuracy"] = 0.2

        def keep(progress):
            if progress.stage != "sweep":
                return False
            self.solver.write_checkpoint(path)
            return True
        self.solver.set_progress(keep)
        self.assertEqual(self.solver.solve(), hrad.STOPPED)
        with hrad.Solver() as other:
            other.read_checkpoint(path)
            self.assertEqual(other["accuracy"], 0.2)
            self.assertEqual(other.solve(), hrad.OK)
            self.assertEqual(other.state_hash(), self.solved.state_hash())
            other.write_checkpoint(path)
            other.lock_checkpoint(path)
            self.assert_fails(hrad.ERROR_FILE, "lock", self.solver.lock_checkpoint, path)
        text = hrad.describe_checkpoint(path)
        self.assertIn("\nlinks: %d\n" % self.solved.get_stats().links, text)
        with open(path, "r+b") as file:
            file.seek(100)
            file.write(b"damage")
        self.assert_fails(hrad.ERROR_FORMAT, "", self.solver.read_checkpoint, path)
        self.assert_fails(hrad.ERROR_FORMAT, "", hrad.describe_checkpoint, path)
        self.assert_fails(hrad.ERROR_FILE, "nowhere", hrad.describe_checkpoint, self.path("nowhere"))

    def test_endings(self):
        self.assert_misfit("txt", self.solved.export, self.path("x.txt"))
        self.assert_fails(hrad.ERROR_FILE, "nowhere", self.solved.export, self.path("nowhere/x.csv"))
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    unittest.main()
