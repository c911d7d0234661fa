"""Materials, patches and files from Python: arrays reach C where they lie, whatever doesn't fit is
refused with a reason and changes nothing, and nothing is cut to size without a word."""

import ctypes
import os
import shutil
import tempfile
import unittest

import support

import numpy as np

import hrad
from hrad import _calls

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
HALVES = np.array([[0, 1, 2], [0, 2, 3]], np.int64)
NAN = float("nan")


class Recorder:
    """Stands before the library and notes where pointers lead."""

    def __init__(self, library):
        self.wrapped = library
        self.addresses = []

    def __getattr__(self, name):
        function = getattr(self.wrapped, name)

        def call(*arguments):
            self.addresses += [ctypes.cast(a, ctypes.c_void_p).value for a in arguments
                               if isinstance(a, ctypes._Pointer)]
            return function(*arguments)
        return call


class Arrays(support.Case):
    def add_square(self, **named):
        self.solver.add_patches(SQUARE, HALVES, **named)

    def test_materials(self):
        solver = self.solver
        self.assertEqual(solver.add_material([0.1, 0.2, 0.3], [4, 5, 6], hrad.TWO_SIDED, "Öl"), 0)
        self.assertEqual(solver.add_material(), 1)
        found = solver.get_material(0)
        self.assertEqual((found.name, found.flags), ("Öl", hrad.TWO_SIDED))
        np.testing.assert_array_equal(found.reflectance, [0.1, 0.2, 0.3])
        np.testing.assert_array_equal(found.emission, [4, 5, 6])
        np.testing.assert_array_equal(solver.get_material(1).reflectance, [0.5] * 3)
        for words, arguments in (
                (r"reflectance has the shape \(2,\): it must be \(3,\)", dict(reflectance=[0.5, 0.5])),
                (r"emission has the shape \(\)", dict(emission=1.0)),
                ("reflectance", dict(reflectance=[NAN, 0, 0])),
                ("reflectance", dict(reflectance=[1, 0, 0])),
                ("emission has values of type complex128", dict(emission=[1j, 0, 0])),
                ("flags", dict(flags=64)), ("flags is 4294967296", dict(flags=2**32)),
                ("name holds the character NUL", dict(name="a\0b"))):
            self.assert_misfit(words, solver.add_material, **arguments)
        self.assertEqual(solver.scene_size(), (0, 2))
        self.assert_misfit("2 materials|there are 2", solver.get_material, 2)

    def test_long_names_come_whole(self):
        name = "wood" * 1000
        self.solver.add_material(name=name)
        self.assertEqual(self.solver.get_material(0).name, name)

    def test_patches(self):
        solver = self.solver
        number = solver.add_material(flags=hrad.TWO_SIDED)
        self.add_square()
        solver.add_patches(SQUARE.tolist(), HALVES[:, ::-1], [number, number])
        self.assertEqual(solver.scene_size(), (4, 1))
        patch = solver.get_patch(1)
        np.testing.assert_array_equal(patch.corners_xyz, SQUARE[HALVES[1]])
        self.assertEqual((patch.area, patch.face, patch.material), (0.5, 1, 0))
        self.assertEqual(patch.flags, hrad.PATCH_TWO_SIDED)
        np.testing.assert_array_equal(solver.get_patch(2).corners_xyz, SQUARE[HALVES[0, ::-1]])
        self.assert_misfit("there are 4", solver.get_patch, 4)
        self.assert_misfit("there are 4", solver.get_patch, -1)

    def test_other_types_and_orders_are_read_as_they_are_meant(self):
        for xyz in (SQUARE.astype(np.float32), np.asfortranarray(SQUARE), SQUARE.astype(">f8"),
                    np.repeat(SQUARE, 2, axis=0)[::2], SQUARE.astype(int),
                    np.frombuffer(b"-" + SQUARE.tobytes(), np.uint8)[1:].view(float).reshape(4, 3)):
            for vertex in (HALVES.astype(np.uint8), HALVES.astype(np.uint64), HALVES.tolist()):
                with hrad.Solver() as solver:
                    solver.add_patches(xyz, vertex)
                    np.testing.assert_array_equal(solver.get_patch(1).corners_xyz,
                                                  SQUARE[HALVES[1]])

    def test_faults_of_patches(self):
        solver, add = self.solver, self.solver.add_patches
        solver.add_material()
        wrong = SQUARE.copy()
        wrong[2, 1] = NAN
        for words, arguments in (
                (r"xyz has the shape \(12,\): it must be \(any, 3\)", (SQUARE.ravel(), HALVES)),
                (r"xyz has the shape \(3, 4\)", (SQUARE.T, HALVES)),
                (r"vertex has the shape \(2, 2\)", (SQUARE, HALVES[:, :2])),
                ("vertex has values of type float64", (SQUARE, HALVES + 0.5)),
                ("vertex has values of type float64", (SQUARE, HALVES.astype(float))),
                ("vertex has a number beyond int64",
                 (SQUARE, HALVES.astype(np.uint64) + np.uint64(2**63))),
                ("vertex has values of type <U1", (SQUARE, [["a", "b", "c"]])),
                ("rows differ in length", (SQUARE, [[0, 1, 2], [0, 1]])),
                (r"material has the shape \(3,\): it must be \(2,\)", (SQUARE, HALVES, [0, 0, 0])),
                ("material has a number beyond int32", (SQUARE, HALVES, [0, 2**32])),
                ("material", (SQUARE, HALVES, [0, 1])),
                ("4", (SQUARE, HALVES + 2)), ("-1", (SQUARE, HALVES - 1)),
                ("finite", (wrong, HALVES)), ("finite", (SQUARE + np.inf, HALVES))):
            self.assert_misfit(words, add, *arguments)
        self.assertEqual(solver.scene_size(), (0, 1))
        add(np.empty((0, 3)), np.empty((0, 3), int), [])
        self.assertEqual(solver.scene_size(), (0, 1))

    def test_arrays_reach_c_where_they_lie(self):
        recorder = Recorder(_calls.LIBRARY)
        _calls.LIBRARY = recorder
        self.addCleanup(setattr, _calls, "LIBRARY", recorder.wrapped)
        self.solver.add_material()
        xyz, vertex, material = SQUARE.copy(), HALVES.copy(), np.zeros(2, np.int32)
        emission = np.ones((2, 3))
        self.solver.add_patches(xyz, vertex, material)
        self.solver.set_emission(0, emission)
        out = np.empty((2, 3))
        self.assertIs(self.solver.query_patches(hrad.EMISSION, out=out), out)
        for array in (xyz, vertex, material, emission, out):
            self.assertIn(array.ctypes.data, recorder.addresses)
        np.testing.assert_array_equal(out, emission)
        # What is given is only read.
        vertex.flags.writeable = xyz.flags.writeable = False
        self.solver.add_patches(xyz, vertex)
        self.assertIn(xyz.ctypes.data, recorder.addresses[-8:])

    def test_emission_and_reflectance(self):
        solver = self.solver
        self.add_square()
        solver.set_emission(1, [[1, 2, 3]])
        np.testing.assert_array_equal(solver.query_patches(hrad.EMISSION), [[0, 0, 0], [1, 2, 3]])
        solver.set_reflectance(0, np.full((2, 3), 0.25))
        self.assert_misfit(r"\(any, 3\)", solver.set_emission, 0, [1, 2, 3])
        self.assert_misfit("has 2 patches", solver.set_emission, 1, np.ones((2, 3)))
        self.assert_misfit("emission", solver.set_emission, 0, [[NAN, 0, 0]])
        self.assert_misfit("reflectance", solver.set_reflectance, 0, [[1, 0, 0]])
        self.assertRaises(TypeError, solver.set_emission, 0.5, [[1, 2, 3]])

    def test_the_tool_tells_of_emission_that_is_no_materials(self):
        self.add_square()
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "square.hrad")
            for count in (0, 1):
                self.solver.set_emission(0, np.full((count, 3), 7.0))
                self.solver.write_checkpoint(path)
                self.assertEqual(support.hrad_json("info", path)["own_emission"], count)
                self.assertEqual("emission of their own" in support.hrad_tool("info", path), count > 0)

    def test_arrays_have_z_up(self):
        self.assertEqual(self.solver.get_stats().up_axis, 0)
        self.add_square()
        self.assertEqual(self.solver.get_stats().up_axis, 2)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "square.hrad")
            for axis, up in ((1, "y"), (2, "z")):
                self.solver["up"] = up
                self.assertEqual(self.solver.get_stats().up_axis, axis)
                self.solver.write_checkpoint(path)
                with hrad.Solver() as reader:
                    reader.read_checkpoint(path)
                    self.assertEqual(reader.get_stats().up_axis, axis - 1 if up == "y" else axis)

    def test_out_arrays_that_do_not_fit(self):
        self.add_square()
        fixed = np.zeros((2, 3))
        fixed.flags.writeable = False
        for words, out in ((r"out has the shape \(3, 2\): it must be \(2, 3\)", np.zeros((3, 2))),
                           ("type float32: it must have float64", np.zeros((2, 3), np.float32)),
                           ("C order", np.zeros((3, 2)).T), ("C order", np.zeros((2, 6))[:, ::2]),
                           ("writeable", fixed), ("must be a NumPy array", [[0] * 3] * 2),
                           ("values of type >f8", np.zeros((2, 3), ">f8"))):
            self.assert_misfit(words, self.solver.query_patches, hrad.EMISSION, out=out)


class Files(support.Case):
    def setUp(self):
        super().setUp()
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def test_scenes_by_name_and_from_files(self):
        names = hrad.scene_names()
        self.assertEqual(names, support.hrad_tool("scene", "--list").split())
        self.assertEqual(hrad.scene_name(0), names[0])
        self.assertIsNone(hrad.scene_name(len(names)))
        self.solver.make_scene("cornell")
        self.assert_fails(hrad.ERROR_STATE, "", self.solver.make_scene, "cornell")
        path = os.path.join(self.folder, "Zimmer ö.obj")
        self.solver.export(path)
        with hrad.Solver() as other:
            self.assert_misfit("cornell", other.make_scene, "nowhere")
            other.load_scene(path)
            self.assertEqual(other.scene_size()[0], self.solver.scene_size()[0])

    def test_faults_of_files(self):
        load = self.solver.load_scene
        self.assert_fails(hrad.ERROR_FILE, "no.obj", load, os.path.join(self.folder, "no.obj"))
        path = self.write("bad.obj", "v 0 0 0\nf 1 2 3\n")
        self.assert_fails(hrad.ERROR_SCENE, "bad.obj:2", load, path)
        self.assert_misfit("NUL", load, "a\0.obj")
        self.assertRaises(TypeError, load, 5)

    def test_messages_and_what_their_function_raises(self):
        self.write("room.mtl", "newmtl a\nmap_Kd wood.png\n")
        path = self.write("room.obj", "mtllib room.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        heard = []
        self.solver.set_log(lambda level, message: heard.append((level, message)))
        self.solver.load_scene(path)
        self.assertTrue(any(level == hrad.LOG_WARNING and "texture" in message
                            for level, message in heard), heard)
        self.assertTrue(any("texture" in line for line in self.solver.diagnostics()))
        self.assertEqual(self.solver.get_diagnostic(0), self.solver.diagnostics()[0])

        def complain(level, message):
            raise KeyError(level)
        self.solver.set_log(complain, hrad.LOG_WARNING)
        self.assertRaises(KeyError, self.solver.load_scene, path)
        self.assert_misfit("level", self.solver.set_log, complain, 4)
        self.solver.set_log(None)
        heard.clear()
        self.solver.load_scene(path)
        self.assertEqual(heard, [])


if __name__ == "__main__":
    unittest.main()
