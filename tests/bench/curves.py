#!/usr/bin/env python3
"""Curves of error against time: pairs, clusters, rows, and path tracing, on three scenes.

    curves.py BENCH_PAPER REFERENCES   solves, writes curves.csv and curves.svg beside this script
    curves.py                          draws curves.svg from curves.csv

REFERENCES is the folder given to bench_paper --reference-dir; it must hold good references of the
three scenes. Times are user CPU of one thread in calibration loops (calibration.h). Path tracing is
the reference's own estimator with another seed: its error is its noise, which falls with the root
of the time.
"""
import csv
import math
import os
import re
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
SCENES = ["furnished-room", "building", "classroom"]
METHODS = {
    "rows": [0.1, 0.05, 0.02, 0.01, 0.006],
    "clusters": [0.2, 0.1, 0.05],
    "pairs": [0.2, 0.1, 0.05, 0.02],
}
COLORS = {"rows": "#c0392b", "clusters": "#2471a3", "pairs": "#1e8449", "path tracing": "#7f8c8d"}
FIELDS = ["scene", "method", "accuracy", "loops", "means", "points"]


def solve(bench, references, scene, method, accuracy):
    """One row of FIELDS from the table row that bench_paper prints."""
    print(f"{scene}, {method}, accuracy {accuracy}", file=sys.stderr)
    out = subprocess.run(
        [bench, "--reference-dir", references, "--set", f"linking={method}",
         "--case", f"accuracy={accuracy}", scene],
        check=True, capture_output=True, text=True).stdout
    cells = [c.strip() for c in re.search(r"^\|(.*)\|$", out, re.M).group(1).split("|")]
    loops, means, points = cells[3], cells[10], cells[12]
    if not means:
        sys.exit(f"curves.py: no reference of {scene} in {references}")
    return [scene, method, accuracy, loops, means.split()[0], points.split()[0]]


def path_tracing(bench, scene, seconds):
    """Time and noise of means and of points, each from the time that it took itself."""
    with tempfile.TemporaryDirectory() as folder:
        out = subprocess.run(
            [bench, "--reference-dir", folder, "--reference-seconds", str(seconds),
             "--reference-only", "--seed", "977", scene],
            check=True, capture_output=True, text=True).stdout
    times = [float(t) for t in re.findall(r"passes, ([0-9.]+) s", out)]
    noise = [float(n) for n in re.findall(r"noise ([0-9.]+) %", out)]
    loop = float(re.search(r"calibration loop ([0-9.]+)", out).group(1))
    rows = []
    for share in (64, 16, 4, 1):
        # The two were sampled one after the other: both are scaled to one time.
        spent = seconds / share
        rows.append([scene, "path tracing", "", f"{spent / loop:.2f}",
                     *(f"{n * math.sqrt(t / spent):.3f}" for n, t in zip(noise, times))])
    return rows


def measure(bench, references):
    rows = []
    for scene in SCENES:
        for method, accuracies in METHODS.items():
            for accuracy in accuracies:
                rows.append(solve(bench, references, scene, method, accuracy))
        rows.extend(path_tracing(bench, scene, 40))
    with open(os.path.join(HERE, "curves.csv"), "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(FIELDS)
        writer.writerows(rows)


class Panel:
    """One pair of logarithmic axes."""

    def __init__(self, left, top, width, height, x, y):
        self.box = (left, top, width, height)
        self.x, self.y = x, y  # decades from and to

    def at(self, time, error):
        left, top, width, height = self.box
        u = (math.log10(time) - self.x[0]) / (self.x[1] - self.x[0])
        v = (math.log10(error) - self.y[0]) / (self.y[1] - self.y[0])
        return left + u * width, top + (1 - v) * height

    def axes(self, title, below, beside):
        left, top, width, height = self.box
        yield (f'<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="none" '
               f'stroke="#444"/>')
        yield f'<text x="{left + width / 2}" y="{top - 8}" class="title">{title}</text>'
        for axis, (low, high) in (("x", self.x), ("y", self.y)):
            for decade in range(math.floor(low), math.ceil(high) + 1):
                for digit in (1, 2, 5):
                    value = digit * 10.0 ** decade
                    if not low - 1e-9 <= math.log10(value) <= high + 1e-9:
                        continue
                    if axis == "x":
                        px = self.at(value, 10 ** self.y[0])[0]
                        yield (f'<path d="M{px:.1f} {top}v{height}" class="grid"/>'
                               f'<text x="{px:.1f}" y="{top + height + 14}" '
                               f'class="tick">{value:g}</text>')
                    else:
                        py = self.at(10 ** self.x[0], value)[1]
                        yield (f'<path d="M{left} {py:.1f}h{width}" class="grid"/>'
                               f'<text x="{left - 4}" y="{py + 4:.1f}" '
                               f'class="tick" text-anchor="end">{value:g}</text>')
        if below:
            yield (f'<text x="{left + width / 2}" y="{top + height + 30}" class="label">'
                   'calibration loops</text>')
        if beside:
            yield (f'<text transform="translate({left - 38} {top + height / 2}) rotate(-90)" '
                   f'class="label">{beside}</text>')

    def curve(self, method, points):
        color = COLORS[method]
        places = [self.at(*p) for p in sorted(points)]
        # Stroke by stroke: some programs close a path that goes on.
        path = "".join(f"M{x:.1f} {y:.1f}L{u:.1f} {v:.1f}"
                       for (x, y), (u, v) in zip(places, places[1:]))
        dash = ' stroke-dasharray="5 4"' if method == "path tracing" else ""
        yield f'<path d="{path}" fill="none" stroke="{color}" stroke-width="2"{dash}/>'
        if not dash:
            for x, y in places:
                yield f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.2" fill="{color}"/>'


def draw():
    with open(os.path.join(HERE, "curves.csv"), newline="") as file:
        rows = list(csv.DictReader(file))
    width, height, gap = 270, 220, 62
    total = (70 + 3 * width + 2 * gap + 20, 70 + 2 * height + 44 + 50)
    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {total[0]} {total[1]}" '
           f'width="{total[0]}" height="{total[1]}" font-family="sans-serif" font-size="12">',
           "<style>.grid{stroke:#ddd;stroke-width:.7}.title{font-weight:bold}"
           ".title,.label{text-anchor:middle}.tick{font-size:10px;fill:#444}</style>",
           f'<rect width="{total[0]}" height="{total[1]}" fill="white"/>']
    for line, quantity in enumerate(("means", "points")):
        values = [float(r[quantity]) for r in rows if float(r[quantity]) > 0]
        y = (math.floor(5 * math.log10(min(values))) / 5, math.ceil(5 * math.log10(max(values))) / 5)
        for column, scene in enumerate(SCENES):
            here = [r for r in rows if r["scene"] == scene]
            times = [float(r["loops"]) for r in here]
            x = (math.log10(min(times)) - 0.1, math.log10(max(times)) + 0.1)
            panel = Panel(70 + column * (width + gap), 40 + line * (height + 60), width, height, x, y)
            svg += panel.axes(scene if line == 0 else "", line == 1,
                              f"error of {'patch means' if line == 0 else 'points'}, %"
                              if column == 0 else "")
            for method in COLORS:
                points = [(float(r["loops"]), float(r[quantity])) for r in here
                          if r["method"] == method and float(r[quantity]) > 0]
                svg += panel.curve(method, points)
    for k, (method, color) in enumerate(COLORS.items()):
        x = 70 + k * 150
        svg.append(f'<path d="M{x} {total[1] - 14}h28" stroke="{color}" stroke-width="3"/>'
                   f'<text x="{x + 34}" y="{total[1] - 10}">{method}</text>')
    svg.append("</svg>")
    with open(os.path.join(HERE, "curves.svg"), "w", encoding="utf-8") as file:
        file.write("\n".join(svg) + "\n")


if __name__ == "__main__":
    if len(sys.argv) == 3:
        measure(sys.argv[1], sys.argv[2])
    elif len(sys.argv) != 1:
        sys.exit(__doc__)
    draw()
