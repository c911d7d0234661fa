# Damaged .hrad files in the hands of the tool: bits turned, cut, added to, of other versions, and with
# right checksums huge counts and streams that expand without end. Each is refused with exit code 4 and
# the section. With HRAD_LONG thousands of them, and none may take ten seconds of CPU or more memory than
# the format allows (tests/kills.sh).
import os
import random
import re
import resource
import subprocess
import sys
import tempfile
import unittest
import zlib

HRAD = os.environ["HRAD"]
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.environ["HRAD_SOURCE_DIR"], "tests", "solver"))
from write_hrad import Frame, Run, filled_up  # noqa: E402

LONG = bool(os.environ.get("HRAD_LONG"))
FLIPS, CUTS = (10000, 1000) if LONG else (60, 30)
BOMBS = [20, 24, 27, 30] if LONG else [22]  # bits of their lengths
COUNTS = [1 << 20, (1 << 31) - 1, 1 << 31, 1 << 32, 1 << 40, (1 << 63) - 1, (1 << 64) - 1]
MOST_SECONDS = 10
# A run is expanded as a whole, to at most 64 times what it takes in the file.
MOST_BYTES_OF_ONE, MOST_BYTES = 70, 64 << 20


def varint(number):
    parts = []
    while number > 127:
        parts.append(number % 128 + 128)
        number //= 128
    return bytes(parts + [number])


def varints(data):
    numbers, at = [], 0
    while at < len(data):
        end = at
        while data[end] > 127:
            end += 1
        numbers.append(sum((byte & 127) << (7 * k) for k, byte in enumerate(data[at:end + 1])))
        at = end + 1
    return numbers


class Damage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = os.path.join(cls.folder.name, "a.hrad")
        cls.files, cls.random = [], random.Random(1)
        for case in (["cornell", "--accuracy", "0.5"],
                     ["furnace", "--accuracy", "0.4", "--set", "linking=clusters"]):
            subprocess.run([HRAD, "solve", *case, "-o", cls.path], check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            with open(cls.path, "rb") as file:
                cls.files.append(file.read())
        cls.slowest, cls.largest = 0, 0

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()
        if LONG:
            print(f"slowest {cls.slowest:.2f} s of CPU, most memory {cls.largest >> 20} MiB", flush=True)

    def run_tool(self, data, arguments):
        """Exit code and what was said."""
        with open(self.path, "wb") as file:
            file.write(data)
        said = os.path.join(self.folder.name, "err")
        with open(said, "wb") as err:
            process = subprocess.Popen([HRAD, *arguments], stdout=subprocess.DEVNULL, stderr=err)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if LONG:
            # What this process takes counts as that of the tool until it has begun.
            before = 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
            seconds, memory = usage.ru_utime + usage.ru_stime, 1024 * usage.ru_maxrss
            Damage.slowest, Damage.largest = max(self.slowest, seconds), max(self.largest, memory)
            self.assertLess(seconds, MOST_SECONDS)
            self.assertLessEqual(memory, max(before, MOST_BYTES + MOST_BYTES_OF_ONE * len(data)))
        with open(said, encoding="utf-8", errors="replace") as file:
            return process.returncode, file.read()

    def refuses(self, data, sections=(), text="", arguments=None):
        code, said = self.run_tool(data, arguments or ["check", self.path])
        self.assertEqual(code, 4, said)
        named = re.findall(r"section '(\w+)'", said)
        self.assertTrue(named, said)
        if sections:
            self.assertTrue(set(named) & set(sections), f"{sections} wanted: {said}")
        self.assertIn(text, said)

    def test_sound_files_are_made_again_the_same(self):
        for data in self.files:
            frame = Frame(data)
            code, said = self.run_tool(frame.bytes(), ["check", self.path])
            self.assertEqual(code, 0, said)

    def section_at(self, data, at):
        inside = [name for name, begin in Frame(data).begins.items() if begin <= at]
        return inside[-1] if inside and at < len(data) - 8 else None

    def test_turned_bits(self):
        for k in range(FLIPS):
            data = self.files[k % len(self.files)]
            at = self.random.randrange(len(data))
            turned = bytearray(data)
            turned[at] ^= 1 << self.random.randrange(8)
            section = self.section_at(data, at)
            with self.subTest(at=at):
                self.refuses(bytes(turned), [section] if section else ["head", "table", "end"])

    def test_cuts(self):
        for data in self.files:
            borders = list(Frame(data).begins.values()) + [8, 32, len(data) - 8]
            places = {at + k for at in borders for k in (-1, 0, 1)} | {0, 1, len(data) - 1}
            places |= {self.random.randrange(len(data)) for _ in range(CUTS // len(self.files))}
            for at in sorted(places):
                with self.subTest(at=at):
                    self.refuses(data[:at], ["head"], "cut short" if at >= 8 else "")

    def test_additions(self):
        for data in self.files:
            for more in (b"\0", b"\n", b"hradend\n", data, bytes(1 << 20)):
                self.refuses(data + more, ["head"], "added to")

    def test_other_versions(self):
        frame = Frame(self.files[0])
        for version in (0, frame.version + 1, 255, 1 << 31, (1 << 32) - 1):
            self.refuses(frame.bytes(version=version), ["head"], f"version {version}")

    def test_huge_counts(self):
        for frame in map(Frame, self.files):
            sizes = varints(dict(frame.sections)["sizes"][0].plain)
            for k in range(len(sizes)):
                for count in COUNTS if LONG else COUNTS[2::4]:
                    changed = sizes[:k] + [count] + sizes[k + 1:]
                    with self.subTest(number=k, count=count):
                        self.refuses(frame.bytes({"sizes": [Run(b"".join(map(varint, changed)))]}),
                                     ["sizes"])
            for name, runs in frame.sections:
                for count in COUNTS if LONG else COUNTS[-1:]:
                    if not runs or name in ("sizes", "vertices", "light", "nodes"):
                        continue  # without counts
                    with self.subTest(section=name, count=count):
                        plain = varint(count) + runs[0].plain[1:]
                        self.refuses(frame.bytes({name: [Run(plain)] + runs[1:]}))

    def test_streams_that_expand_without_end(self):
        for bits in BOMBS:
            length = 1 << bits
            compressor = zlib.compressobj(9)
            bomb = b"".join(compressor.compress(bytes(1 << 20)) for _ in range(length >> 20))
            bomb += compressor.flush()
            whole, nested = filled_up(bomb, length), zlib.compress(bomb, 9)
            for frame in map(Frame, self.files if LONG and bits <= 24 else self.files[:1]):
                there = [(name, runs) for name, runs in frame.sections if runs]
                # A gigabyte takes some seconds each time.
                for name, runs in there[::4] if bits > 27 else there:
                    plain = runs[0].plain
                    for what, run in {
                            "as small as can be": Run(plain, bomb, length),
                            "as long as it must be": Run(plain, whole, length),
                            "states less": Run(plain, bomb),
                            "states more": Run(plain, filled_up(zlib.compress(plain), length), length),
                            "one in the other": Run(plain, nested, len(bomb)),
                            "one in the other, filled up":
                                Run(plain, filled_up(nested, len(bomb)), len(bomb)),
                            "one in the other, as if it were one":
                                Run(plain, filled_up(nested, length), length)}.items():
                        with self.subTest(section=name, what=what, bits=bits):
                            self.refuses(frame.bytes({name: [run] + runs[1:]}), [name])

    def test_every_command_refuses_them(self):
        data = self.files[0]
        frame = Frame(data)
        bomb = Run(b"", filled_up(zlib.compress(bytes(1 << 24)), 1 << 24), 1 << 24)
        out = os.path.join(self.folder.name, "out.csv")
        turned = data[:5000] + bytes([data[5000] ^ 4]) + data[5001:]
        for damaged in (data[:-1], turned, frame.bytes(version=9),
                        frame.bytes({"links": [bomb]})):
            for arguments in (["solve", "cornell", "--restart", self.path], ["solve", self.path],
                              ["query", self.path], ["info", self.path],
                              ["export", self.path, "-o", out]):
                with self.subTest(arguments):
                    self.refuses(damaged, arguments=arguments)
        self.assertFalse(os.path.exists(out))


if __name__ == "__main__":
    unittest.main()
