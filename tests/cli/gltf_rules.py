# A reader of binary glTF that takes nothing on trust: it checks the rules of the glTF 2.0
# specification (ISO/IEC 12113) for what a file holds, and returns its numbers. Python's standard
# library alone.
import json
import math
import re
import struct

COMPONENT_TYPES = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
TARGETS = {34962: "vertices", 34963: "indices"}
TOP_LEVEL = {"asset", "scene", "scenes", "nodes", "meshes", "materials", "accessors", "bufferViews",
             "buffers", "extensionsUsed", "extensionsRequired", "extras"}
KNOWN_EXTENSIONS = {"KHR_materials_unlit"}


class Broken(Exception):
    """The file breaks a rule."""


def rule(holds, text, *values):
    if not holds:
        raise Broken(text.format(*values))


def is_index(value, table):
    return isinstance(value, int) and not isinstance(value, bool) and 0 <= value < len(table)


def split_chunks(content):
    """The JSON object and the bytes of the binary chunk (empty when there is none)."""
    rule(len(content) >= 20, "the file is too short")
    magic, version, length = struct.unpack_from("<4sII", content)
    rule(magic == b"glTF" and version == 2, "the header is {} {}", magic, version)
    rule(length == len(content), "the header says {} bytes, there are {}", length, len(content))
    chunks, at = [], 12
    while at < length:
        rule(at + 8 <= length, "a chunk's head is cut off")
        size, kind = struct.unpack_from("<I4s", content, at)
        rule(size % 4 == 0, "a chunk of {} bytes is not aligned", size)
        rule(at + 8 + size <= length, "a chunk is cut off")
        chunks.append((kind, content[at + 8 : at + 8 + size]))
        at += 8 + size
    rule([kind for kind, _ in chunks] in ([b"JSON"], [b"JSON", b"BIN\0"]), "wrong chunks")
    text = chunks[0][1].decode("utf-8")
    rule(text.startswith("{"), "the JSON begins with {!r}", text[:1])

    def distinct(pairs):
        rule(len({key for key, _ in pairs}) == len(pairs), "a key is repeated")
        return dict(pairs)

    def no_number(word):
        raise Broken(word + " is no JSON")

    root = json.loads(text, object_pairs_hook=distinct, parse_constant=no_number)
    return root, chunks[1][1] if len(chunks) == 2 else b""


def check_root(root):
    rule(set(root) <= TOP_LEVEL, "unknown properties {}", set(root) - TOP_LEVEL)
    rule(re.fullmatch(r"2\.\d+", root["asset"]["version"]), "asset.version")
    for key, value in root.items():
        rule(value != [] and value != {}, "{} is empty", key)
    used, declared = set(), set(root.get("extensionsUsed", []))

    def walk(value):
        if isinstance(value, dict):
            used.update(value.get("extensions", {}))
            for inner in value.values():
                walk(inner)
        elif isinstance(value, list):
            for inner in value:
                walk(inner)

    walk(root)
    rule(used <= declared, "extensions {} are not declared", used - declared)
    rule(declared <= used, "extensions {} are declared and not used", declared - used)
    rule(set(root.get("extensionsRequired", [])) <= declared, "a required extension is not used")
    rule(declared <= KNOWN_EXTENSIONS, "unknown extensions {}", declared)


def check_buffers(root, binary):
    buffers = root.get("buffers", [])
    rule(len(buffers) == (1 if binary else 0), "{} buffers", len(buffers))
    for buffer in buffers:
        rule("uri" not in buffer, "the buffer of the binary chunk has a uri")
        rule(0 <= len(binary) - buffer["byteLength"] < 4, "the buffer and its chunk differ in length")
        rule(not any(binary[buffer["byteLength"] :]), "the padding is not 0")
    for view in root.get("bufferViews", []):
        rule(is_index(view["buffer"], buffers), "a view of no buffer")
        start, size = view.get("byteOffset", 0), view["byteLength"]
        rule(start >= 0 and size >= 1, "a view of {} bytes from {}", size, start)
        rule(start + size <= buffers[view["buffer"]]["byteLength"], "a view leaves its buffer")
        rule(view.get("target") in TARGETS, "a view without a target")
        if "byteStride" in view:
            rule(view["target"] == 34962, "a stride of indices")
            rule(4 <= view["byteStride"] <= 252 and view["byteStride"] % 4 == 0, "byteStride")


def check_accessor(root, accessor, binary):
    """The elements of the accessor as tuples."""
    rule(is_index(accessor["bufferView"], root["bufferViews"]), "an accessor of no view")
    view = root["bufferViews"][accessor["bufferView"]]
    rule(accessor["componentType"] in COMPONENT_TYPES, "componentType")
    rule(accessor["count"] >= 1, "an empty accessor")
    code = COMPONENT_TYPES[accessor["componentType"]]
    components = COMPONENTS[accessor["type"]]
    size = struct.calcsize(code)
    start = accessor.get("byteOffset", 0)
    stride = view.get("byteStride", size * components)
    rule(start % size == 0 and (start + view.get("byteOffset", 0)) % size == 0, "misaligned accessor")
    rule(stride % size == 0 and stride >= size * components, "a stride of {} is too small", stride)
    if view["target"] == 34962:
        rule(start % 4 == 0 and stride % 4 == 0, "vertices off the 4-byte grid")
    rule(start + stride * (accessor["count"] - 1) + size * components <= view["byteLength"],
         "an accessor leaves its view")
    rule(not accessor.get("normalized") or code in "bBhH", "normalized {}", code)
    base = view.get("byteOffset", 0) + start
    elements = [struct.unpack_from(f"<{components}{code}", binary, base + stride * i)
                for i in range(accessor["count"])]
    if code == "f":
        for element in elements:
            rule(all(map(math.isfinite, element)), "a number is not finite: {}", element)
    for name, function in (("min", min), ("max", max)):
        if name in accessor:
            found = [function(column) for column in zip(*elements)]
            rule(accessor[name] == found, "{} is {}, not {}", name, accessor[name], found)
    return elements


def check_primitive(root, primitive, elements):
    accessors = root["accessors"]
    attributes = primitive["attributes"]
    rule("POSITION" in attributes, "no POSITION")
    for name, number in attributes.items():
        rule(is_index(number, accessors), "{} is no accessor", name)
        accessor = accessors[number]
        kind, component = accessor["type"], accessor["componentType"]
        target = root["bufferViews"][accessor["bufferView"]]["target"]
        rule(TARGETS[target] == "vertices", "{} lies in the view of indices", name)
        rule(accessor["count"] == accessors[attributes["POSITION"]]["count"], "{}: count", name)
        if name == "POSITION":
            rule((kind, component) == ("VEC3", 5126), "POSITION is {} {}", kind, component)
            rule("min" in accessor and "max" in accessor, "POSITION without min and max")
        elif name == "NORMAL":
            rule((kind, component) == ("VEC3", 5126), "NORMAL is {} {}", kind, component)
            for normal in elements[number]:
                rule(abs(math.hypot(*normal) - 1) < 1e-6, "a normal is {}", normal)
        elif name == "COLOR_0":
            rule(kind in ("VEC3", "VEC4"), "COLOR_0 is {}", kind)
            rule(component == 5126 or component in (5121, 5123) and accessor.get("normalized"),
                 "COLOR_0 of type {}", component)
            if component == 5126:
                for color in elements[number]:
                    rule(all(0 <= c <= 1 for c in color), "a colour is {}", color)
        else:
            rule(re.fullmatch(r"_[A-Z0-9_]+", name), "attribute {}", name)
            rule(component != 5125, "{} of 32-bit integers", name)
    rule(primitive.get("mode", 4) == 4, "the mode is {}", primitive.get("mode"))
    rule(is_index(primitive["indices"], accessors), "no indices")
    accessor = accessors[primitive["indices"]]
    rule(accessor["type"] == "SCALAR" and accessor["componentType"] in (5121, 5123, 5125),
         "indices are {} {}", accessor["type"], accessor["componentType"])
    view = root["bufferViews"][accessor["bufferView"]]
    rule(TARGETS[view["target"]] == "indices" and "byteStride" not in view, "the view of indices")
    rule(accessor["count"] % 3 == 0, "{} indices are no triangles", accessor["count"])
    vertices = accessors[attributes["POSITION"]]["count"]
    highest = max(index for (index,) in elements[primitive["indices"]])
    rule(highest < vertices, "index {} of {} vertices", highest, vertices)
    rule(highest < 2 ** (8 * struct.calcsize(COMPONENT_TYPES[accessor["componentType"]])) - 1,
         "an index restarts the primitive")
    rule(is_index(primitive["material"], root["materials"]), "no material")


def check_nodes(root):
    nodes, scenes = root.get("nodes", []), root.get("scenes", [])
    rule("scene" not in root or is_index(root["scene"], scenes), "no scene")
    for scene in scenes:
        rule(all(is_index(node, nodes) for node in scene["nodes"]), "a scene of no node")
        rule(len(set(scene["nodes"])) == len(scene["nodes"]), "a node stands twice in a scene")
    for node in nodes:
        rule("mesh" not in node or is_index(node["mesh"], root.get("meshes", [])), "no mesh")
        for name, length in (("translation", 3), ("rotation", 4), ("scale", 3)):
            rule(len(node.get(name, [0] * length)) == length, name)
        if "rotation" in node:
            rule(abs(math.hypot(*node["rotation"]) - 1) < 1e-6, "rotation {}", node["rotation"])


def check_materials(root):
    for material in root.get("materials", []):
        rule(isinstance(material.get("doubleSided", False), bool), "doubleSided")
        surface = material.get("pbrMetallicRoughness", {})
        for value in [*surface.get("baseColorFactor", []), surface.get("metallicFactor", 1),
                      surface.get("roughnessFactor", 1)]:
            rule(0 <= value <= 1, "a factor of {}", value)


def read_glb(content):
    """Checks the file; returns its JSON and, per accessor, its elements as tuples."""
    root, binary = split_chunks(content)
    check_root(root)
    check_buffers(root, binary)
    check_nodes(root)
    check_materials(root)
    elements = [check_accessor(root, accessor, binary) for accessor in root.get("accessors", [])]
    for mesh in root.get("meshes", []):
        rule(mesh["primitives"], "a mesh without primitives")
        for primitive in mesh["primitives"]:
            check_primitive(root, primitive, elements)
    return root, elements
