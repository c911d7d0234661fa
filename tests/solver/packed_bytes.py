"""Numbers in the bytes of a .hrad file: the parts that the reader is made of."""

import struct


class Damaged(Exception):
    pass


def need(condition, what):
    if not condition:
        raise Damaged(what)


def as_float(bits):
    return struct.unpack("<f", struct.pack("<I", bits & 0xFFFFFFFF))[0]


def float_bits(value):
    return struct.unpack("<I", struct.pack("<f", value))[0]


def as_double(bits):
    return struct.unpack("<d", struct.pack("<Q", bits))[0]


def double_bits(value):
    return struct.unpack("<Q", struct.pack("<d", value))[0]


def from_zigzag(code):
    return code >> 1 if code % 2 == 0 else -(code >> 1) - 1


class Bytes:
    """The bytes of one run, read from the front."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, size):
        need(self.at + size <= len(self.data), "a run ends early")
        self.at += size
        return self.data[self.at - size:self.at]

    def rest(self):
        return self.take(len(self.data) - self.at)

    def byte(self):
        return self.take(1)[0]

    def varint(self):
        value = shift = 0
        while True:
            byte = self.byte()
            value |= (byte & 127) << shift
            if byte < 128:
                return value
            shift += 7

    def signed(self):
        return from_zigzag(self.varint())

    def double(self):
        return struct.unpack("<d", self.take(8))[0]

    def text(self):
        return self.take(self.varint()).decode()

    def planes(self, count, width):
        planes = [self.take(count) for _ in range(width)]
        return [int.from_bytes(bytes(column), "big") for column in zip(*planes)]

    def finish(self):
        need(self.at == len(self.data), "bytes are left over in a run")
