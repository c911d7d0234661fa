"""How bright is it over the desks of a classroom? Solves the built-in scene, measures the irradiance on
a plane 0.8 m above the floor, and draws it with the desks in the file given: work_plane.py FILE.png.
Takes Matplotlib (python3-matplotlib in Debian)."""

import sys

import hrad
import matplotlib
import numpy as np

matplotlib.use("Agg")  # into a file, without a window
from matplotlib import pyplot  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402

HEIGHT = 0.8  # of the plane above the floor, in m
STEP = 0.2  # between its points
MARGIN = 0.6  # around the desks


def desk_tops(solver):
    """The triangles of the tops of desks, (count, 3, 3)."""
    patches = [solver.get_patch(number) for number in range(solver.scene_size()[0])]
    corners = np.array([patch.corners_xyz for patch in patches
                        if solver.get_material(patch.material).name == "desk"])
    heights = corners[:, :, 2]
    return corners[(heights > heights.max() - 0.001).all(axis=1)]


def centres(low, high):
    """The middles of the steps between two places."""
    count = int((high - low) / STEP)
    return low + (np.arange(count) + 0.5) * (high - low) / count


def progress(now):
    print(f"\r{now.stage:8} {now.fraction:4.0%}", end="", file=sys.stderr)


with hrad.Solver() as solver:
    solver.make_scene("classroom")
    solver["accuracy"] = 0.05
    solver.set_progress(progress)
    if solver.solve() == hrad.NOT_CONVERGED:
        print("\nthe stated accuracy is not assured", file=sys.stderr)
    print(file=sys.stderr)

    tops = desk_tops(solver)[:, :, :2]
    (west, south), (east, north) = tops.min(axis=(0, 1)) - MARGIN, tops.max(axis=(0, 1)) + MARGIN
    x, y = centres(west, east), centres(south, north)
    points = np.array([(column, row, HEIGHT) for row in y for column in x])
    up = np.broadcast_to((0.0, 0.0, 1.0), points.shape)
    irradiance, standard_error = solver.query_sensors(points, up)

plane = irradiance.sum(axis=1).reshape(len(y), len(x))  # all bands together
print(f"{plane.size} points: mean {plane.mean():.2f}, least {plane.min():.2f}, most "
      f"{plane.max():.2f} W/m2")

figure, axes = pyplot.subplots(figsize=(8, 5.5), constrained_layout=True)
image = axes.imshow(plane, origin="lower", extent=(west, east, south, north), cmap="inferno")
axes.add_collection(PolyCollection(tops, facecolors="none", edgecolors="deepskyblue", linewidths=0.6))
axes.set(title=f"Irradiance {HEIGHT} m above the floor", xlabel="x in m", ylabel="y in m")
figure.colorbar(image, label="W/m², all bands")
figure.savefig(sys.argv[1], dpi=100)
