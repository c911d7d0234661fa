"""A reader of .hrad files that shares nothing with the library: written from hrad-checkpoint(5), with
Python's standard library alone, and independent of the byte order of the machine.

    python3 read_hrad.py FILE.hrad      prints what is in it
"""

import struct
import sys
import zlib

from packed_bytes import Bytes, as_double, as_float, float_bits, from_zigzag, need

MAGIC = b"\x89HRD\r\n\x1a\n"
END = b"hradend\n"
SECTIONS = [("origin", 1), ("params", 1), ("sizes", 1), ("material", 1), ("vertices", 4096),
            ("patches", 4096), ("progress", 1), ("tree", 4096), ("nodes", 4096), ("clusters", 1),
            ("links", 1024), ("cells", 16384), ("mean", 4096), ("points", 4096), ("ptlinks", 4096),
            ("own", 16384), ("light", 4096), ("steps", 1)]
SIZES = ["bands", "vertices", "materials", "patches", "surfaces", "clusters", "families", "links",
         "cells", "receivers_of_means", "mean_links", "leaves_of_points", "points", "point_links",
         "own_points", "steps"]
DROPPED, TWO_SIDED, BLOCKER = 1, 2, 4
AT_CORNERS, HALF_WAY, OWN = 0, 1, 2
FINEST = 15


class Node:
    def __init__(self, parent, surface, level=0, i=0, j=0, inverted=False):
        self.parent, self.surface, self.level = parent, surface, level
        self.i, self.j, self.inverted = i, j, inverted
        self.first_child = None
        self.light_points, self.exposed = 0, 1.0
        self.is_cluster = False


def child_of(parent, number, k):
    node = Node(number, parent.surface, parent.level + 1)
    flip = parent.inverted
    node.i = 2 * parent.i + ((k != 1) if flip else (k == 1))
    node.j = 2 * parent.j + ((k != 2) if flip else (k == 2))
    node.inverted = (k != 3) if flip else (k == 3)
    return node


def corners_of(node):
    """Lattice points of its corners."""
    step = 1 << (FINEST - node.level)
    i, j = node.i * step, node.j * step
    if node.inverted:
        return [(i + step, j + step), (i, j + step), (i + step, j)]
    return [(i, j), (i + step, j), (i, j + step)]


def places_of(node):
    corners = corners_of(node)
    if node.light_points == AT_CORNERS:
        return corners
    i, j = (sum(c[axis] for c in corners) for axis in (0, 1))
    return [((3 * c[0] + i) // 6, (3 * c[1] + j) // 6) for c in corners]


def runs_of_links(run, receivers):
    counts = [run.varint() for _ in range(receivers)]
    codes = iter([run.varint() for _ in range(sum(counts))])
    first_before, by_weight, links = 0, [], []
    for count in counts:
        made = []
        rays = run.varint() if count else 0
        source = first_before
        for k in range(count):
            code = next(codes)
            source += 1 + code if rays and k else from_zigzag(code)
            if rays:
                made.append([source, as_float(float_bits((1 + run.varint()) / rays))])
            else:
                made.append([source, None])
                by_weight.append(made[-1])
        if made:
            first_before = made[0][0]
        links.append(made)
    last = {}
    for link, code in zip(by_weight, run.planes(len(by_weight), 4)):
        bits = (last.get(link[0], 0) + from_zigzag(code)) & 0xFFFFFFFF
        last[link[0]] = bits
        link[1] = as_float(bits)
    return links


class Checkpoint:
    def __init__(self, path):
        with open(path, "rb") as file:
            self.data = file.read()
        self.read_frame()
        self.read_small()
        self.read_scene()
        self.read_progress()
        self.read_tree()
        self.read_links()
        self.read_light()
        self.read_steps()

    def read_frame(self):
        data = self.data
        need(data[:8] == MAGIC and data[-8:] == END, "the first or the last bytes")
        self.version, count, size, table_sum, head_sum = struct.unpack("<IIQII", data[8:32])
        need(self.version in (1, 2) and count == len(SECTIONS) and size == len(data), "the head")
        need(zlib.crc32(data[:28]) == head_sum, "the checksum of the head")
        table = data[32:32 + 40 * count]
        need(zlib.crc32(table) == table_sum, "the checksum of the table")
        self.table, end = {}, 32 + 40 * count
        for k, (name, _) in enumerate(SECTIONS):
            entry = struct.unpack("<8sQQQII", table[40 * k:40 * k + 40])
            need(entry[0].rstrip(b"\0").decode() == name and entry[1] == end, "the table")
            need(zlib.crc32(data[end:end + entry[2]]) == entry[4], "the checksum of " + name)
            end += entry[2]
            self.table[name] = entry[1:]
        need(end == len(data) - 8, "the end")

    def runs(self, name, items):
        """(first item, end, bytes) of every run."""
        offset, stored, raw, _, raw_sum = self.table[name]
        of_run, end, total, crc = dict(SECTIONS)[name], offset + stored, 0, 0
        for first in range(0, items, of_run):
            size, expanded = struct.unpack("<II", self.data[offset:offset + 8])
            stream = zlib.decompressobj()
            plain = stream.decompress(self.data[offset + 8:offset + 8 + size])
            need(stream.eof and len(plain) == expanded, "a run of " + name)
            need(not stream.unused_data.strip(b"\0"), "what fills a run of " + name)
            need(expanded <= 64 * size, "the length of a run of " + name)
            crc, total, offset = zlib.crc32(plain, crc), total + expanded, offset + 8 + size
            run = Bytes(plain)
            yield first, min(items, first + of_run), run
            run.finish()
        need((offset, total, crc) == (end, raw, raw_sum), "the runs of " + name)

    def one(self, name):
        for _, _, run in self.runs(name, 1):
            yield run

    def read_small(self):
        for run in self.one("origin"):
            self.origin = run.text()
        self.params = {}
        for run in self.one("params"):
            for _ in range(run.varint()):
                name = run.text()
                self.params[name] = run.text()
        for run in self.one("sizes"):
            self.sizes = {name: run.varint() for name in SIZES}
        self.bands = self.sizes["bands"]
        self.nodes_count = (self.sizes["surfaces"] + self.sizes["clusters"] +
                            4 * self.sizes["families"])

    def values(self, run):
        return [run.double() for _ in range(self.bands)]

    def read_scene(self):
        self.materials, self.vertices, self.patches = [], [], []
        for run in self.one("material"):
            self.z_up = run.byte() == 1
            for _ in range(self.sizes["materials"]):
                name, flags = run.text(), run.byte()
                self.materials.append((name, flags, self.values(run), self.values(run)))
            self.diagnostics = [run.text() for _ in range(run.varint())]
        for first, end, run in self.runs("vertices", self.sizes["vertices"]):
            axes = []
            for _ in range(3):
                bits, axis = 0, []
                for change in run.planes(end - first, 8):
                    bits ^= change
                    axis.append(as_double(bits))
                axes.append(axis)
            self.vertices.extend(zip(*axes))
        for first, end, run in self.runs("patches", self.sizes["patches"]):
            corner, material, face = 0, 0, first - 1
            for _ in range(first, end):
                corners = []
                for _ in range(3):
                    corner += run.signed()
                    corners.append(corner)
                material += run.signed()
                face += 1 + run.signed()
                flags, own = run.byte(), run.byte()
                _, _, reflectance, emission = self.materials[material]
                if own & 1:
                    emission = self.values(run)
                if own & 2:
                    reflectance = self.values(run)
                self.patches.append((corners, face, flags, emission, reflectance))

    def read_progress(self):
        for run in self.one("progress"):
            names = ("begun linked sweeping from_emission converged finished measuring_due "
                     "last_converged").split()
            self.progress = {name: run.byte() == 1 for name in names}
            for name in ("rounds_done tightened sweeping_round earlier_sweeps rounds iterations "
                         "rays pairs unresolved first_unresolved").split():
                self.progress[name] = run.varint()
            self.progress["light_hash"], self.progress["mesh_hash"] = struct.unpack(
                "<QQ", run.take(16))
            self.progress["key_of_steps"] = struct.unpack("<Q", run.take(8))[0]
            for name in ("scale accuracy_reached tolerance error_estimate error_standard_error "
                         "balance_back_share back_share mean_distance smallest").split():
                self.progress[name] = run.double()
            for name in "last change emitted absorbed absorbed_back escaped".split():
                self.progress[name] = [run.double() for _ in range(run.varint())]

    def read_tree(self):
        self.surfaces, self.nodes = [], []
        if self.sizes["surfaces"] == 0:
            return
        for patch, (_, _, flags, _, _) in enumerate(self.patches):
            if not flags & (DROPPED | BLOCKER):
                self.surfaces.extend((patch, side) for side in range(2 if flags & TWO_SIDED else 1))
        need(len(self.surfaces) == self.sizes["surfaces"], "the number of surfaces")
        self.nodes = [Node(None, surface) for surface in range(len(self.surfaces))]
        for _ in range(self.sizes["clusters"]):
            node = Node(None, None)
            node.is_cluster = True
            self.nodes.append(node)
        for first, end, run in self.runs("tree", self.sizes["families"]):
            parent = 0
            for _ in range(first, end):
                parent += run.signed()
                above = self.nodes[parent]
                need(above.first_child is None and not above.is_cluster, "a parent")
                above.first_child = len(self.nodes)
                self.nodes.extend(child_of(above, parent, k) for k in range(4))
        for first, end, run in self.runs("nodes", len(self.nodes)):
            for node in self.nodes[first:end]:
                node.light_points = run.byte()
            for node, code in zip(self.nodes[first:end], run.planes(end - first, 4)):
                expected = self.nodes[node.parent].exposed if node.level else 1.0
                node.exposed = as_float(float_bits(expected) + from_zigzag(code))
        self.order, self.lefts = [], []
        clusters = self.sizes["clusters"]
        for _, _, run in self.runs("clusters", 1 if clusters else 0):
            surface = 0
            for _ in range(clusters + 1):
                surface += run.signed()
                self.order.append(surface)
            self.lefts = [run.varint() for _ in range(clusters)]
            run.planes(clusters + 2, 8)

    def link_runs(self, name, receivers):
        result = []
        for first, end, run in self.runs(name, receivers):
            result.extend(runs_of_links(run, end - first))
        return result

    def read_steps(self):
        self.steps = []
        for _, _, run in self.runs("steps", self.sizes["steps"]):
            if self.version == 1:
                run.rest()
                continue
            number, count = run.varint(), run.varint()
            names, name = [], 0
            for _ in range(count):
                name = (name + run.signed()) % 2**64
                names.append(name)
            lengths = [run.varint() for _ in range(count)]
            self.steps.append((number, list(zip(names, map(run.take, lengths)))))

    def read_links(self):
        sizes = self.sizes
        self.links = self.link_runs("links", self.nodes_count)
        self.cells = []
        for first, end, run in self.runs("cells", sizes["cells"]):
            cell = -1
            for _ in range(first, end):
                cell += 1 + run.signed()
                self.cells.append(cell)
        self.mean = self.link_runs("mean", sizes["receivers_of_means"])
        self.points = []
        for first, end, run in self.runs("points", sizes["leaves_of_points"]):
            known, following = {}, 0
            for node in self.nodes[first:end]:
                numbers = None
                if not node.is_cluster and node.first_child is None and run.byte():
                    numbers = []
                    for c in range(3):
                        key = None if node.light_points == OWN else (node.surface,
                                                                     places_of(node)[c])
                        code = run.varint()
                        if key in known and code == 0:
                            number = known[key]
                        else:
                            number = following + from_zigzag(code - (key in known))
                            following = number + 1
                        if key is not None:
                            known[key] = number
                        numbers.append(number)
                self.points.append(numbers)
        self.point_links = self.link_runs("ptlinks", sizes["points"])
        self.own = []
        for first, end, run in self.runs("own", sizes["own_points"]):
            number, numbers = -1, []
            for _ in range(first, end):
                number += 1 + run.signed()
                numbers.append(number)
            places = [as_float(bits) for bits in run.planes(2 * len(numbers), 4)]
            self.own.extend(zip(numbers, places[0::2], places[1::2]))

    def read_light(self):
        bands, irradiance, changes = self.bands, [], []
        for first, end, run in self.runs("light", self.nodes_count):
            codes = iter(run.planes((end - first) * bands, 4))
            last = [0] * bands
            for node in self.nodes[first:end]:
                row = [from_zigzag(next(codes)) for _ in range(bands)]
                if node.first_child is None and not node.is_cluster:
                    last = row = [(a + b) & 0xFFFFFFFF for a, b in zip(last, row)]
                irradiance.append(row)
            codes = iter(run.planes((end - first) * bands, 4))
            changes.extend([from_zigzag(next(codes)) for _ in range(bands)]
                           for _ in range(first, end))
        self.irradiance, self.radiosity = [None] * len(irradiance), [None] * len(irradiance)
        for k in reversed(range(len(irradiance))):
            node = self.nodes[k]
            expected = [0] * bands
            if node.first_child is not None:
                children = range(node.first_child, node.first_child + 4)
                exposed = sum(self.nodes[c].exposed for c in children)
                for b in range(bands):
                    light = 0.0
                    for c in children:
                        light += self.nodes[c].exposed * self.irradiance[c][b]
                    expected[b] = float_bits(light / exposed) if exposed > 0 else 0
            self.irradiance[k] = [as_float(a + b) for a, b in zip(irradiance[k], expected)]
            if node.is_cluster:
                self.radiosity[k] = [as_float(change) for change in changes[k]]
                continue
            _, _, _, emission, reflectance = self.patches[self.surfaces[node.surface][0]]
            self.radiosity[k] = [
                as_float(float_bits(emission[b] + reflectance[b] * self.irradiance[k][b]) +
                         changes[k][b]) for b in range(bands)]

    def leaves(self):
        """Node numbers in key order: by surface, then by path."""
        for root in range(len(self.surfaces)):
            stack = [root]
            while stack:
                k = stack.pop()
                child = self.nodes[k].first_child
                if child is None:
                    yield k
                else:
                    stack.extend(range(child + 3, child - 1, -1))

    def mean_radiosity(self, k):
        """Over the whole area of a leaf, sealed parts included."""
        node = self.nodes[k]
        _, _, _, emission, reflectance = self.patches[self.surfaces[node.surface][0]]
        arriving = [as_float(float_bits(node.exposed * value)) for value in self.irradiance[k]]
        return [emission[b] + reflectance[b] * arriving[b] for b in range(self.bands)]

    def link_count(self):
        return sum(len(run) for runs in (self.links, self.mean, self.point_links) for run in runs)


def main(path):
    checkpoint = Checkpoint(path)
    print("written by", checkpoint.origin)
    for name, size in checkpoint.sizes.items():
        print(name, size)
    for name, value in checkpoint.params.items():
        print(name, "=", value)


if __name__ == "__main__":
    main(sys.argv[1])
