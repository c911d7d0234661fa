"""A .hrad file taken apart into the plain bytes of its runs and put together again, with right lengths
and checksums, whatever is in it: for tests that damage what checksums would otherwise protect."""

import struct
import zlib

HEAD, ENTRY, END = 32, 40, b"hradend\n"
LEAST_SHARE = 64  # no run is stored in less than this part of its length


class Run:
    """Plain bytes; or what is stored and stated instead, where that is to be wrong."""

    def __init__(self, plain, stored=None, stated=None):
        self.plain = plain
        self.stored = packed(plain) if stored is None else stored
        self.stated = len(plain) if stated is None else stated


def filled_up(stream, length):
    return stream.ljust((length + LEAST_SHARE - 1) // LEAST_SHARE, b"\0")


def packed(plain):
    return filled_up(zlib.compress(plain), len(plain))


class Frame:
    """Version, and of each section its name and its runs."""

    def __init__(self, data):
        self.version, count = struct.unpack("<II", data[8:16])
        self.magic, self.sections, self.begins = data[:8], [], {}
        for k in range(count):
            entry = data[HEAD + k * ENTRY:HEAD + (k + 1) * ENTRY]
            name, at, size = struct.unpack("<8sQQ", entry[:24])
            name = name.rstrip(b"\0").decode()
            self.begins[name], end, runs = at, at + size, []
            while at < end:
                stored, = struct.unpack("<I", data[at:at + 4])
                runs.append(Run(zlib.decompressobj().decompress(data[at + 8:at + 8 + stored])))
                at += 8 + stored
            self.sections.append((name, runs))

    def bytes(self, changed=None, version=None):
        """The file, with other runs in the sections that `changed` names."""
        table, body = b"", b""
        first = HEAD + ENTRY * len(self.sections)
        for name, runs in self.sections:
            runs = (changed or {}).get(name, runs)
            stored = b"".join(struct.pack("<II", len(run.stored), run.stated) + run.stored
                              for run in runs)
            plain_sum = 0
            for run in runs:
                plain_sum = zlib.crc32(run.plain, plain_sum)
            table += struct.pack("<8sQQQII", name.encode(), first + len(body), len(stored),
                                 sum(run.stated for run in runs), zlib.crc32(stored), plain_sum)
            body += stored
        head = self.magic + struct.pack("<IIQI", self.version if version is None else version,
                                        len(self.sections), first + len(body) + len(END),
                                        zlib.crc32(table))
        return head + struct.pack("<I", zlib.crc32(head)) + table + body + END
