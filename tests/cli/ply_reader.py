# A reader of binary little-endian PLY files, from their own header. Python's standard library alone.
import struct

TYPES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I",
         "float": "f", "double": "d"}


def read_header(content):
    """The elements as [(name, count, [(property, type, type of the list's length or None)])],
    the comments, and where the numbers begin."""
    end = content.index(b"end_header\n") + len(b"end_header\n")
    lines = content[:end].decode("ascii").splitlines()
    assert lines[:2] == ["ply", "format binary_little_endian 1.0"], lines[:2]
    elements, comments = [], []
    for line in lines[2:-1]:
        word, *rest = line.split()
        if word == "comment":
            comments.append(line[len("comment ") :])
        elif word == "element":
            elements.append((rest[0], int(rest[1]), []))
        else:
            assert word == "property", line
            listed = TYPES[rest[1]] if rest[0] == "list" else None
            elements[-1][2].append((rest[-1], TYPES[rest[-2]], listed))
    return elements, comments, end


def read_ply(content):
    """Per element a list of {property: value}, and the comments."""
    elements, comments, at = read_header(content)
    tables = {}
    for name, count, properties in elements:
        rows = tables[name] = []
        for _ in range(count):
            row = {}
            for key, code, length_code in properties:
                length = 1
                if length_code:
                    (length,) = struct.unpack_from("<" + length_code, content, at)
                    at += struct.calcsize(length_code)
                values = struct.unpack_from(f"<{length}{code}", content, at)
                at += struct.calcsize(f"<{length}{code}")
                row[key] = values if length_code else values[0]
            rows.append(row)
    assert at == len(content), f"{len(content) - at} bytes are left over"
    return tables, comments
