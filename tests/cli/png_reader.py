"""Pictures, read by Python's standard library alone."""
import struct
import zlib


class Png:
    """An 8-bit RGB picture, all its checksums verified."""

    def __init__(self, path):
        with open(path, "rb") as file:
            content = file.read()
        assert content[:8] == b"\x89PNG\r\n\x1a\n"
        data, at, kinds = b"", 8, []
        while at < len(content):
            size, kind = struct.unpack_from(">I4s", content, at)
            body = content[at + 8 : at + 8 + size]
            (checksum,) = struct.unpack_from(">I", content, at + 8 + size)
            assert zlib.crc32(kind + body) == checksum
            kinds.append(kind)
            if kind == b"IHDR":
                self.width, self.height, depth, colour = struct.unpack(">IIBB", body[:10])
                assert (depth, colour, body[12]) == (8, 2, 0)
            elif kind == b"IDAT":
                data += body
            at += size + 12
        assert kinds[0] == b"IHDR" and kinds[-1] == b"IEND"
        self.rows = []
        raw, stride = zlib.decompress(data), 3 * self.width
        assert len(raw) == self.height * (stride + 1)
        above = bytearray(stride)
        for row in range(self.height):
            start = row * (stride + 1)
            above = self.unfiltered(raw[start], bytearray(raw[start + 1 : start + 1 + stride]), above)
            self.rows.append(above)

    @staticmethod
    def unfiltered(kind, line, above):
        for i in range(len(line)):
            left = line[i - 3] if i >= 3 else 0
            up, corner = above[i], above[i - 3] if i >= 3 else 0
            if kind == 1:
                guess = left
            elif kind == 2:
                guess = up
            elif kind == 3:
                guess = (left + up) // 2
            elif kind == 4:
                p = left + up - corner
                guess = min((abs(p - left), 0, left), (abs(p - up), 1, up),
                            (abs(p - corner), 2, corner))[2]
            else:
                guess = 0
            line[i] = (line[i] + guess) & 255
        return line

    def at(self, column, row):
        return tuple(self.rows[row][3 * column : 3 * column + 3])

    def pixels(self, columns=None):
        return [self.at(column, row) for row in range(self.height)
                for column in columns or range(self.width)]
