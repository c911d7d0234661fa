# Pictures: decoded by Python's standard library, they show what the solution and the camera say.
import csv
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True
from png_reader import Png  # noqa: E402

HRAD = os.environ["HRAD"]
BACKGROUND = (52, 56, 64)
PAPER, INK = (24, 24, 24), (225, 225, 225)  # of a legend


def hrad(*arguments, status=0, folder=None):
    result = subprocess.run([HRAD, *arguments], capture_output=True, text=True, timeout=300,
                            cwd=folder)
    if result.returncode != status:
        raise AssertionError(f"hrad {' '.join(arguments)}: exit code {result.returncode}, not "
                             f"{status}\n{result.stderr}")
    return result


def linear(code):
    s = code / 255
    return s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055) ** 2.4


# The inside of a cube, all of it equally bright: closed, lit by itself.
FURNACE = ("furnace", "--accuracy", "0.05", "--quiet")
CORNELL = ("cornell", "--accuracy", "0.2", "--quiet")
INTO_CORNELL = ("--eye", "0.278,-0.8,0.27", "--look", "0.278,0.28,0.27", "--up", "0,0,1",
                "--fov", "40")


class Pictures(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name
        self.path = os.path.join(self.folder, "picture.png")

    def render(self, *arguments):
        said = hrad("render", *arguments, "-o", self.path, "--json").stdout
        return Png(self.path), json.loads(said)

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="ascii") as file:
            file.write(text)
        return path

    def test_size(self):
        for width, height in ((96, 72), (61, 130), (1, 1)):
            picture, said = self.render(*FURNACE, "--size", f"{width}x{height}")
            self.assertEqual((picture.width, picture.height), (width, height))
            self.assertEqual((said["width"], said["height"]), (width, height))
        said = json.loads(hrad("render", *FURNACE, "-o", self.path, "--json").stdout)
        self.assertEqual((said["width"], said["height"]), (960, 720))

    def test_a_furnace_is_of_one_colour(self):
        picture, said = self.render(*FURNACE, "--size", "80x60")
        self.assertEqual(said["backs"], "black")
        pixels = picture.pixels()
        for band in range(3):
            values = [pixel[band] for pixel in pixels]
            self.assertGreater(min(values), 100)
            # Errors at points, above all in corners, are larger than the accuracy of means.
            self.assertLess(max(values) - min(values), 18)

    def test_a_pixel_is_the_radiosity_times_the_scale(self):
        # A lit floor far below a lamp, straight from above; in the middle of the picture its centre.
        self.write("m.mtl", "newmtl lamp\nKd 0 0 0\nKe 40 30 20\nnewmtl floor\nKd 0.8 0.5 0.2\n")
        scene = self.write("lamp.obj", "mtllib m.mtl\n"
                           "v -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\n"
                           "v -1 2 -1\nv 1 2 -1\nv 1 2 1\nv -1 2 1\n"
                           "usemtl floor\nf 1 2 3 4\nusemtl lamp\nf 5 6 7 8\n")
        picture, said = self.render(scene, "--accuracy", "0.05", "--quiet", "--size", "31x31",
                                    "--eye", "0,1.9,0", "--look", "0,0,0", "--up", "0,0,-1",
                                    "--fov", "20", "--exposure", "-1")
        sensor = json.loads(hrad("query", scene, "--accuracy", "0.05", "--quiet", "--json",
                                 "--at", "0,0.001,0:0,1,0").stdout)["sensors"][0]
        for band, reflectance in enumerate((0.8, 0.5, 0.2)):
            wanted = said["scale"] * reflectance * sensor["irradiance"][band]
            self.assertAlmostEqual(linear(picture.at(15, 15)[band]) / wanted, 1, delta=0.08)

    def test_background_and_black_backs(self):
        self.write("m.mtl", "newmtl lamp\nKd 0.5 0.5 0.5\nKe 1 1 1\n")
        scene = self.write("sheet.obj", "mtllib m.mtl\nusemtl lamp\n"
                           "v -1 0 0\nv 1 0 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n"
                           "v 0 0 4\nv 0.1 0 4\nv 0 0.1 4\nf 5 6 7\n")
        view = ("--look", "0,0.5,0", "--up", "0,1,0", "--fov", "60", "--size", "40x40",
                "--accuracy", "0.1", "--quiet")
        picture, said = self.render(scene, "--eye", "0,0.5,2", *view)
        self.assertGreater(min(picture.at(20, 20)), 150)
        self.assertEqual(picture.at(20, 1), BACKGROUND)
        # Inside the scene's box backs are black, outside they are left out.
        self.assertEqual(said["backs"], "black")
        picture, said = self.render(scene, "--eye", "0,0.5,-2", *view)
        self.assertEqual(said["backs"], "hidden")
        self.assertEqual(picture.at(20, 20), BACKGROUND)
        self.write("m.mtl", "newmtl lamp\nKd 0.5 0.5 0.5\nKe 1 1 1\n")
        with open(scene, encoding="ascii") as file:
            sheet = file.read()
        scene = self.write("sheets.obj", sheet +
                           "v 0 0 -4\nv 0 0.1 -4\nv 0.1 0 -4\nf 8 9 10\n")
        picture, said = self.render(scene, "--eye", "0,0.5,-2", *view)
        self.assertEqual(said["backs"], "black")
        self.assertEqual(picture.at(20, 20), (0, 0, 0))

    def test_what_is_behind_or_beside_the_eye_does_no_harm(self):
        # Walls of the furnace pass the eye on all sides: nothing but walls is seen.
        picture, _ = self.render(*FURNACE, "--size", "64x48", "--eye", "0.999,0.5,0.5",
                                 "--look", "0,0.501,0.5", "--fov", "150")
        self.assertNotIn(BACKGROUND, picture.pixels())
        self.assertNotIn((0, 0, 0), picture.pixels())

    def test_edges_are_smooth(self):
        # A lamp of one colour before nothing: what is neither is a pixel that the edge crosses.
        self.write("m.mtl", "newmtl lamp\nKd 0 0 0\nKe 1 1 1\n")
        scene = self.write("lamp.obj", "mtllib m.mtl\nusemtl lamp\n"
                           "v -1 -1 0\nv 1 -0.7 0\nv 0.2 1 0\nf 1 2 3\n")
        picture, _ = self.render(scene, "--quiet", "--size", "60x60", "--eye", "0,0,3", "--look",
                                 "0,0,0", "--up", "0,1,0", "--fov", "50")
        lamp, colours = picture.at(30, 30), set(picture.pixels())
        between = colours - {lamp, BACKGROUND}
        for colour in between:
            self.assertTrue(all(b <= c <= l for b, c, l in zip(BACKGROUND, colour, lamp)), colour)
        # Sixteen samples a pixel have fifteen steps between none and all.
        self.assertGreater(len(between), 9)

    def test_the_left_wall_of_cornell_is_red_the_right_one_green(self):
        picture, said = self.render(*CORNELL, "--size", "160x120")
        red, green = picture.at(34, 60), picture.at(126, 60)
        self.assertGreater(red[0], 2 * red[1])
        self.assertGreater(green[1], green[0])
        self.assertEqual(picture.at(1, 60), BACKGROUND)
        self.assertEqual(said["backs"], "hidden")

    def test_the_camera_that_is_told_makes_the_same_picture(self):
        for scene in (CORNELL, FURNACE):
            first, said = self.render(*scene, "--size", "64x48")
            camera = said["camera"]
            options = []
            for name in ("eye", "look", "up"):
                options += [f"--{name}", ",".join(map(repr, camera[name]))]
            again, said_again = self.render(*scene, "--size", "64x48", *options,
                                            "--fov", repr(camera["fov"]))
            self.assertEqual(said_again["camera"], camera)
            self.assertEqual(first.rows, again.rows)

    def test_inside_a_closed_room_the_camera_is_inside(self):
        for scene in ("furnished-room", "furnace-boxes"):
            info = json.loads(hrad("info", scene, "--json").stdout)
            picture, said = self.render(scene, "--accuracy", "0.5", "--quiet", "--size", "64x48")
            for x, low, high in zip(said["camera"]["eye"], info["lower"], info["upper"]):
                self.assertTrue(low < x < high)
            self.assertEqual(said["camera"]["up"], [0, 0, 1])
            self.assertNotIn(BACKGROUND, picture.pixels())

    def test_exposure(self):
        sums = []
        for stops in ("-2", "0", "2"):
            picture, said = self.render(*CORNELL, "--size", "64x48", "--exposure", stops)
            sums.append(sum(map(sum, picture.pixels())))
            self.assertEqual(said["exposure"], float(stops))
        self.assertLess(sums[0], sums[1])
        self.assertLess(sums[1], sums[2])

    def test_mesh(self):
        plain, _ = self.render(*CORNELL, *INTO_CORNELL, "--size", "240x180")
        mesh, said = self.render(*CORNELL, *INTO_CORNELL, "--size", "240x180", "--mesh")
        self.assertTrue(said["mesh"])
        differing = sum(a != b for a, b in zip(plain.pixels(), mesh.pixels()))
        self.assertGreater(differing, 1000)
        self.assertLess(differing, 240 * 180 * 2 // 3)
        self.assertEqual(mesh.at(2, 90), BACKGROUND)

    def test_false_colour_has_a_legend(self):
        picture, said = self.render(*CORNELL, *INTO_CORNELL, "--size", "320x240", "--false-colour",
                                    "--range", "0:4")
        self.assertEqual((picture.width, picture.height), (320, 240))
        self.assertEqual(said["range"], [0, 4])
        self.assertEqual(said["quantity"], "radiosity")
        left = 320 - 76
        legend = picture.pixels(range(left, 320))
        self.assertGreater(legend.count(PAPER), len(legend) // 2)
        # Above the bar its caption: the second line is the unit, in letters five pixels wide.
        unit = ["".join("#" if picture.at(left + 8 + column, 19 + row) == INK else "."
                        for column in range(23)) for row in range(7)]
        self.assertEqual(unit, ["#...#..............##..",
                                "#...#.....#.......#..#.",
                                "#...#....#..##.#....#..",
                                "#.#.#...#...#.#.#..#...",
                                "#.#.#..#....#.#.#.####.",
                                "#.#.#.#.....#...#......",
                                ".#.#........#...#......"])
        # The bar runs from the map's last colour above to its first below.
        bar = [picture.at(left + 12, row) for row in range(240)]
        bar = [colour for colour in bar if colour not in (PAPER, INK)]
        self.assertEqual((bar[0], bar[-1]), ((253, 231, 37), (68, 1, 84)))
        # The lamp is above the range.
        self.assertIn((253, 231, 37), picture.pixels(range(left)))
        self.assertNotIn(PAPER, picture.pixels(range(left)))

    def test_false_colour_is_the_value(self):
        means = json.loads(hrad("query", *FURNACE, "--json", "--quantity", "irradiance").stdout)
        middle = sum(means["patches"][0]["values"])
        picture, said = self.render(*FURNACE, "--size", "160x120", "--false-colour",
                                    "--quantity", "irradiance", "--range", f"0:{2 * middle!r}")
        self.assertEqual(said["quantity"], "irradiance")
        # Half way: between the fifth and the sixth of the ten colours of viridis.
        for value, low, high in zip(picture.at(40, 60), (31, 130, 137), (38, 158, 142)):
            self.assertTrue(low - 4 <= value <= high + 4, picture.at(40, 60))

    def test_one_band_is_grey(self):
        picture, _ = self.render(*CORNELL, "--set", "bands=1", *INTO_CORNELL, "--size", "64x48")
        for red, green, blue in (picture.at(column, 24) for column in range(12, 52)):
            self.assertTrue(red == green == blue)

    def test_solve_and_export_write_the_automatic_picture(self):
        paths = [os.path.join(self.folder, name) for name in ("render.png", "solve.png", "export.png")]
        hrad("render", *CORNELL, "-o", paths[0])
        solved = hrad("solve", *CORNELL, "-o", paths[1], "-o", os.path.join(self.folder, "c.csv"))
        self.assertIn("solve.png", solved.stdout)
        hrad("export", *CORNELL, "-o", paths[2])
        contents = []
        for path in paths:
            with open(path, "rb") as file:
                contents.append(file.read())
        self.assertEqual(contents[0], contents[1])
        self.assertEqual(contents[0], contents[2])

    def test_grid(self):
        grid = ("--grid", "0.1,0.1,0.3:0.5,0.3,0.3:8x4")
        result = hrad("query", *CORNELL, *grid, "-o", self.path)
        picture = Png(self.path)
        rows = list(csv.DictReader(result.stdout.splitlines()))
        self.assertEqual(len(rows), 32)
        self.assertGreater(picture.height, 390)
        # The brightest cell is nearest to the end of the map, where it lies in the plane.
        sums = [sum(float(row[f"irradiance{band}"]) for band in range(3)) for row in rows]
        width = picture.width - 76 * max(1, round(picture.height / 480))
        at = {}
        for cell, row in enumerate(rows):
            column = int((float(row["x"]) - 0.1) / 0.4 * width)
            line = int((0.3 - float(row["y"])) / 0.2 * picture.height)
            at[cell] = picture.at(column, line)
        greens = sorted(range(32), key=lambda cell: at[cell][1])
        self.assertEqual(at[greens[-1]], at[max(range(32), key=lambda cell: sums[cell])])
        self.assertEqual(at[greens[0]], at[min(range(32), key=lambda cell: sums[cell])])

    def test_no_half_file_when_it_ends_early(self):
        with open(self.path, "wb") as file:
            file.write(b"old")
        process = subprocess.Popen([HRAD, "render", "cornell", "--accuracy", "0.2", "-q", "--size",
                                    "8000x8000", "-o", self.path], stderr=subprocess.DEVNULL)
        time.sleep(2)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=60), 128 + signal.SIGTERM)
        self.assertEqual(os.listdir(self.folder), ["picture.png"])
        with open(self.path, "rb") as file:
            self.assertEqual(file.read(), b"old")

    def test_a_link_is_followed_and_the_mode_kept(self):
        target = os.path.join(self.folder, "target.png")
        with open(target, "wb"):
            pass
        os.chmod(target, 0o640)
        os.symlink("target.png", self.path)
        hrad("render", *FURNACE, "--size", "8x8", "-o", self.path)
        self.assertTrue(os.path.islink(self.path))
        self.assertEqual((Png(target).width, os.stat(target).st_mode & 0o777), (8, 0o640))

    def test_an_inside_out_room_is_warned_of(self):
        self.write("m.mtl", "newmtl lamp\nKd 0.5 0.5 0.5\nKe 1 1 1\n")
        corners = "".join(f"v {x} {y} {z}\n" for z in (0, 1) for y in (0, 1) for x in (0, 1))
        faces = "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n"
        lamp = ("mtllib m.mtl\nusemtl lamp\nv 0.4 0.9 0.4\nv 0.6 0.9 0.4\nv 0.6 0.9 0.6\n"
                "f 9 10 11\n")
        scene = self.write("out.obj", corners + faces + lamp)
        warned = hrad("render", scene, "--accuracy", "0.2", "--size", "32x24", "-o", self.path)
        self.assertIn("--flip", warned.stderr)

    def test_usage(self):
        for said, arguments in (
                ("-o FILE.png is missing", []),
                ("given more than once", ["-o", "a.png", "-o", "b.png"]),
                ("endings known here: .png", ["-o", "a.jpg"]),
                ("a result, not a picture", ["-o", "a.csv"]),
                ("--size takes", ["-o", "a.png", "--size", "0x10"]),
                ("--size takes", ["-o", "a.png", "--size", "10"]),
                ("--size takes", ["-o", "a.png", "--size", "20000x10"]),
                ("legend", ["-o", "a.png", "--size", "100x100", "--false-colour"]),
                ("--eye takes X,Y,Z", ["-o", "a.png", "--eye", "1,2"]),
                ("--look is for", ["-o", "a.png", "--look", "1,2,3"]),
                ("same point", ["-o", "a.png", "--eye", "1,2,3", "--look", "1,2,3"]),
                ("no length", ["-o", "a.png", "--up", "0,0,0"]),
                ("along its own --up", ["-o", "a.png", "--eye", "0,0,0", "--look", "0,0,1", "--up",
                                        "0,0,2"]),
                ("--fov takes", ["-o", "a.png", "--fov", "180"]),
                ("--exposure takes", ["-o", "a.png", "--exposure", "bright"]),
                ("are for --false-colour", ["-o", "a.png", "--quantity", "irradiance"]),
                ("--quantity takes", ["-o", "a.png", "--false-colour", "--quantity", "colour"]),
                ("--range takes", ["-o", "a.png", "--false-colour", "--range", "2:1"]),
                ("exclude each other", ["-o", "a.png", "--false-colour", "--range", "1:2",
                                        "--exposure", "1"])):
            result = hrad("render", "cornell", *arguments, status=2, folder=self.folder)
            self.assertIn(said, result.stderr)
            self.assertEqual(result.stdout, "")
        for arguments in (["--patches"], ["--at", "0,0,0:0,0,1"], []):
            result = hrad("query", "cornell", *arguments, "-o", "a.png", status=2,
                          folder=self.folder)
            self.assertIn("picture of one --grid", result.stderr)
        hrad("render", "cornell", "-o", "missing/a.png", status=5, folder=self.folder)
        self.assertEqual(os.listdir(self.folder), [])

    def test_not_converged_still_makes_the_picture(self):
        hrad("render", "cornell", "--accuracy", "0.1", "--set", "max_iterations=1", "--size", "16x12",
             "-o", self.path, status=7)
        self.assertEqual(Png(self.path).width, 16)


def writes_pictures():
    result = subprocess.run([HRAD, "render", "cornell", "-o", "missing/a.png"],
                            capture_output=True, text=True)
    return "writes no pictures" not in result.stderr


if __name__ == "__main__":
    if not writes_pictures():
        print("this build has no libpng: nothing to test")
        sys.exit(0)
    unittest.main()
