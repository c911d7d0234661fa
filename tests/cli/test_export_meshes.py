# The meshes that `hrad solve -o` writes, .ply and .glb: well formed by readers that know the formats
# alone, and holding what .csv, .vtu and `hrad query` say.
import csv
import json
import os
import re
import struct
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from gltf_rules import Broken, read_glb, split_chunks  # noqa: E402
from ply_reader import read_ply  # noqa: E402

HRAD = os.environ["HRAD"]
SCENE = ["cornell", "--accuracy", "0.2"]

# A two-sided sheet over a glowing floor; one band of the three is dark.
SHEETS = """mtllib sheets.mtl
v 0 0 0
v 1000 0 0
v 1000 1000 0
v 0 1000 0
v 0 0 500
v 1000 0 500
v 1000 1000 500
v 0 1000 500
usemtl lamp
f 1 2 3 4
usemtl sheet
f 5 6 7 8
"""
SHEETS_MTL = """newmtl lamp
Kd 0.5 0.5 0.5
Ke 10 5 0
newmtl sheet
Kd 0.5 0.25 0
"""


def hrad(*arguments, status=0):
    result = subprocess.run([HRAD, *arguments], capture_output=True, text=True, timeout=300)
    if result.returncode != status:
        sys.exit(f"hrad {' '.join(arguments)}: exit code {result.returncode}\n{result.stderr}")
    return result


def content_of(path):
    with open(path, "rb") as file:
        return file.read()


def single(value):
    """The nearest single-precision number."""
    return struct.unpack("<f", struct.pack("<f", value))[0]


def srgb_byte(linear):
    encoded = 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055
    return 255 * encoded


def corner_values(vtu, bands=3):
    """Per leaf the radiosity at its three corners, from the .vtu's array radiosity_linear."""
    mark = b'<AppendedData encoding="raw">\n_'
    start = vtu.index(mark) + len(mark)
    element = re.search(rb'<DataArray [^>]*Name="radiosity_linear"[^>]*offset="(\d+)"', vtu)
    at = start + int(element.group(1))
    (size,) = struct.unpack_from("<Q", vtu, at)
    values = struct.unpack_from(f"<{size // 8}d", vtu, at + 8)
    points = [values[i : i + bands] for i in range(0, len(values), bands)]
    return [points[i : i + 3] for i in range(0, len(points), 3)]


class Meshes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        path = cls.path
        hrad("solve", *SCENE, "--quiet", *(word for ending in ("csv", "vtu", "ply", "glb")
                                           for word in ("-o", path("box." + ending))))
        with open(path("box.csv"), newline="") as file:
            cls.leaves = list(csv.DictReader(file))
        cls.corner_values = corner_values(content_of(path("box.vtu")))
        cls.ply, cls.comments = read_ply(content_of(path("box.ply")))
        cls.glb = content_of(path("box.glb"))
        cls.gltf, cls.accessors = read_glb(cls.glb)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def path(cls, name):
        return os.path.join(cls.folder.name, name)

    def positions_of(self, leaf):
        return [[float(leaf[axis + corner]) for axis in "xyz"] for corner in "012"]

    def exposure(self):
        (primitive_mesh,) = self.gltf["meshes"]
        return primitive_mesh["extras"]["exposure"]

    # ---- .ply

    def test_ply_has_the_leaves_of_the_table(self):
        self.assertEqual(len(self.ply["face"]), len(self.leaves))
        self.assertLess(len(self.ply["vertex"]), 2 * len(self.leaves))
        used = set()
        for face, leaf, values in zip(self.ply["face"], self.leaves, self.corner_values):
            for key in "patch", "face", "side":
                self.assertEqual(face[key], int(leaf[key]))
            self.assertEqual(len(set(face["vertex_indices"])), 3)
            used.update(face["vertex_indices"])
            for number, position, value in zip(face["vertex_indices"], self.positions_of(leaf),
                                               values):
                vertex = self.ply["vertex"][number]
                for axis, coordinate in zip("xyz", position):
                    self.assertAlmostEqual(vertex[axis], coordinate, delta=1e-15)
                for band in range(3):
                    self.assertEqual(vertex[f"radiosity_{band}"], single(value[band]))
        self.assertEqual(used, set(range(len(self.ply["vertex"]))))

    def test_ply_colours_are_exposed_srgb(self):
        (exposure,) = (float(line.split()[-1]) for line in self.comments if "sRGB" in line)
        self.assertEqual(exposure, self.exposure())
        seen = set()
        for vertex in self.ply["vertex"]:
            for band, color in enumerate(("red", "green", "blue")):
                linear = min(1, exposure * vertex[f"radiosity_{band}"])
                self.assertAlmostEqual(vertex[color], srgb_byte(linear), delta=0.5001)
                seen.add(vertex[color])
        self.assertTrue({0, 255} < seen and len(seen) > 100, seen)

    def test_names_its_version(self):
        version = hrad("--version").stdout.split()[1]
        self.assertIn("hrad " + version, self.comments)
        self.assertEqual(self.gltf["asset"], {"version": "2.0", "generator": "hrad " + version})

    # ---- .glb

    def attribute(self, name):
        ((primitive,),) = (mesh["primitives"] for mesh in self.gltf["meshes"])
        return self.accessors[primitive["attributes"][name]]

    def triangles(self):
        ((primitive,),) = (mesh["primitives"] for mesh in self.gltf["meshes"])
        indices = [index for (index,) in self.accessors[primitive["indices"]]]
        return list(zip(*[iter(indices)] * 3))

    def test_glb_has_the_leaves_of_the_table(self):
        positions, radiosity = self.attribute("POSITION"), self.attribute("_RADIOSITY")
        triangles = self.triangles()
        self.assertEqual(len(triangles), len(self.leaves))
        for triangle, leaf, values in zip(triangles, self.leaves, self.corner_values):
            for number, position, value in zip(triangle, self.positions_of(leaf), values):
                for found, coordinate in zip(positions[number], position):
                    self.assertAlmostEqual(found, coordinate, delta=1e-7)
                self.assertEqual(radiosity[number], tuple(map(single, value)))

    def test_glb_normals_face_the_side_of_the_leaf(self):
        normals = self.attribute("NORMAL")
        for triangle, leaf in zip(self.triangles(), self.leaves):
            a, b, c = self.positions_of(leaf)
            u, v = ([q - p for p, q in zip(a, other)] for other in (b, c))
            cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                     u[0] * v[1] - u[1] * v[0])
            length = sum(x * x for x in cross) ** 0.5
            for number in triangle:
                for found, x in zip(normals[number], cross):
                    self.assertAlmostEqual(found, x / length, delta=1e-6)

    def test_glb_colours_are_exposed_and_linear(self):
        exposure = self.exposure()
        for color, radiosity in zip(self.attribute("COLOR_0"), self.attribute("_RADIOSITY")):
            for c, b in zip(color, radiosity):
                self.assertAlmostEqual(c, min(1, exposure * b), delta=1e-6)

    def test_glb_is_shown_as_solved(self):
        self.assertEqual(self.gltf["extensionsUsed"], ["KHR_materials_unlit"])
        (material,) = self.gltf["materials"]
        self.assertIn("KHR_materials_unlit", material["extensions"])
        # Each side has triangles of its own; the back of a one-sided patch is not drawn.
        self.assertFalse(material["doubleSided"])

    def test_glb_stands_upright(self):
        (node,) = self.gltf["nodes"]
        x, y, z, w = node["rotation"]
        self.assertNotIn("scale", node)
        up = (2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y))  # z, turned
        for found, wanted in zip(up, (0, 1, 0)):
            self.assertAlmostEqual(found, wanted, places=12)

    def test_glb_of_a_written_scene_is_the_same(self):
        hrad("scene", SCENE[0], "-o", self.path("again.obj"))
        hrad("export", self.path("again.obj"), *SCENE[1:], "--quiet", "-o", self.path("again.glb"))
        self.assertEqual(content_of(self.path("again.glb")), self.glb)

    def test_patch_means_are_those_of_a_query(self):
        queried = json.loads(hrad("query", *SCENE, "--quiet", "--patches", "--json").stdout)
        means = {(p["patch"], p["side"]): p["values"] for p in queried["patches"]}
        powers = {}
        for triangle, leaf in zip(self.triangles(), self.leaves):
            key = int(leaf["patch"]), int(leaf["side"])
            power = powers.setdefault(key, [0.0, 0.0, 0.0, 0.0])
            area = float(leaf["area"])
            power[3] += area
            for number in triangle:
                for band, value in enumerate(self.attribute("_RADIOSITY")[number]):
                    power[band] += area * value / 3
        self.assertEqual(set(powers), set(means))
        # Linear reconstruction moves some light from leaf to leaf, and little from patch to patch.
        apart = scale = 0
        for key, (*power, area) in powers.items():
            for band in range(3):
                apart += area * (power[band] / area - means[key][band]) ** 2
                scale += area * means[key][band] ** 2
        self.assertLess(apart, 0.03**2 * scale)

    # ---- both

    def test_the_same_bytes_for_any_number_of_threads(self):
        for threads in "1", "3":
            outputs = [self.path(f"threads{threads}.{ending}") for ending in ("ply", "glb")]
            hrad("export", *SCENE, "--quiet", "--threads", threads, "-o", outputs[0],
                 "-o", outputs[1])
            for output in outputs:
                first = self.path("box" + os.path.splitext(output)[1])
                self.assertEqual(content_of(output), content_of(first), output)

    def test_own_files_keep_their_axes_and_state_their_unit(self):
        for name, text in (("sheets.obj", SHEETS), ("sheets.mtl", SHEETS_MTL)):
            with open(self.path(name), "w", encoding="ascii") as file:
                file.write(text)
        hrad("export", self.path("sheets.obj"), "--quiet", "--two-sided", "--set", "unit=mm",
             "--accuracy", "0.2", "-o", self.path("sheets.glb"), "-o", self.path("sheets.ply"))
        gltf, accessors = read_glb(content_of(self.path("sheets.glb")))
        (node,) = gltf["nodes"]
        self.assertEqual(node["scale"], [0.001] * 3)
        self.assertNotIn("rotation", node)
        self.assertNotIn("translation", node)
        self.assertEqual(accessors[0][0], (0, 0, 0))
        ply, _ = read_ply(content_of(self.path("sheets.ply")))
        sides = {(face["patch"], face["side"]) for face in ply["face"]}
        self.assertEqual(sides, {(patch, side) for patch in range(4) for side in range(2)})
        self.assertEqual({face["face"] for face in ply["face"]}, {0, 1})

    def test_one_band_is_grey(self):
        hrad("export", *SCENE, "--quiet", "--set", "bands=1", "-o", self.path("grey.ply"),
             "-o", self.path("grey.glb"))
        ply, _ = read_ply(content_of(self.path("grey.ply")))
        self.assertNotIn("radiosity_1", ply["vertex"][0])
        for vertex in ply["vertex"]:
            self.assertTrue(vertex["red"] == vertex["green"] == vertex["blue"])
        gltf, accessors = read_glb(content_of(self.path("grey.glb")))
        attributes = gltf["meshes"][0]["primitives"][0]["attributes"]
        self.assertEqual(gltf["accessors"][attributes["_RADIOSITY"]]["type"], "SCALAR")
        self.assertEqual([value for (value,) in accessors[attributes["_RADIOSITY"]]],
                         [vertex["radiosity_0"] for vertex in ply["vertex"]])


class Rules(unittest.TestCase):
    """The checks of gltf_rules.py see what is wrong."""

    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "box.glb")
            hrad("export", "furnace", "--accuracy", "0.3", "--quiet", "-o", path)
            cls.root, cls.binary = split_chunks(content_of(path))

    @staticmethod
    def packed(root, binary):
        text = json.dumps(root).encode("ascii")
        text += b" " * (-len(text) % 4)
        return (struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(binary), len(text),
                            0x4E4F534A) + text + struct.pack("<I4s", len(binary), b"BIN\0") + binary)

    def refused(self, text, change, binary=None):
        root = json.loads(json.dumps(self.root))
        change(root)
        with self.assertRaisesRegex(Broken, text):
            read_glb(self.packed(root, self.binary if binary is None else binary))

    def test_what_is_whole_passes(self):
        read_glb(self.packed(self.root, self.binary))

    def test_what_is_broken_does_not(self):
        def set_at(*path, value):
            def change(root):
                for key in path[:-1]:
                    root = root[key]
                root[path[-1]] = value
            return change

        count = self.root["accessors"][0]["count"]
        self.refused("extensions", set_at("extensionsUsed", value=["KHR_other"]))
        self.refused("unknown properties", set_at("surprise", value=1))
        self.refused("asset.version", set_at("asset", "version", value="1.0"))
        self.refused("min is", set_at("accessors", 0, "min", 0, value=-1e9))
        self.refused("leaves its view", set_at("accessors", 0, "count", value=count + 1))
        self.refused("count", set_at("accessors", 1, "count", value=count - 1))
        self.refused("stride", set_at("bufferViews", 0, "byteStride", value=8))
        self.refused("byteStride", set_at("bufferViews", 0, "byteStride", value=50))
        self.refused("leaves its buffer", set_at("bufferViews", 1, "byteLength", value=1 << 30))
        self.refused("differ in length", set_at("buffers", 0, "byteLength", value=4))
        self.refused("NORMAL is", set_at("accessors", 1, "type", value="VEC2"))
        self.refused("a normal is", set_at("accessors", 1, "byteOffset", value=0))
        self.refused("misaligned", set_at("accessors", 0, "byteOffset", value=2))
        self.refused("no mesh", set_at("nodes", 0, "mesh", value=1))
        self.refused("rotation", set_at("nodes", 0, "rotation", value=[0, 0, 0, 2]))
        self.refused("no triangles", set_at("accessors", 4, "count", value=4))
        attributes = ("meshes", 0, "primitives", 0, "attributes")
        self.refused("attribute HEAT", set_at(*attributes, "HEAT", value=3))
        self.refused("no accessor", set_at(*attributes, "_HEAT", value=99))
        far = self.binary[:-4] + struct.pack("<I", count)
        self.refused("index", lambda root: None, far)
        with self.assertRaisesRegex(Broken, "the header says"):
            read_glb(self.packed(self.root, self.binary)[:-4])


if __name__ == "__main__":
    unittest.main()
