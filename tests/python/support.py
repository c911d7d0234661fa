"""What the Python tests share, imported first: the interpreter that has NumPy, the module of this
source tree and the shared library of this build; the test is skipped (77) where one is missing."""

import json
import os
import subprocess
import sys
import unittest

SOURCE = os.environ["HRAD_SOURCE_DIR"]
BINARY = os.environ["HRAD_BINARY_DIR"]
HRAD = os.environ["HRAD"]


def skip(reason):
    print("skipped: " + reason)
    sys.exit(77)


def need(module, package):
    """Debian's modules belong to Debian's interpreter, which need not be the first in PATH."""
    try:
        __import__(module)
    except ImportError:
        debian_python = "/usr/bin/python3"
        if os.path.exists(debian_python) and not os.path.samefile(debian_python, sys.executable):
            os.execv(debian_python, [debian_python, *sys.argv])
        skip("%s is not installed" % package)


def built(name):
    """A shared library, of the whole build or made for these tests; "" where sanitizers are in."""
    for folder in ("lib", "tests/python"):
        path = os.path.join(BINARY, folder, "lib%s.so" % name)
        if os.path.exists(path) and not sanitized():
            return path
    return ""


def sanitized():
    with open(os.path.join(BINARY, "CMakeCache.txt"), encoding="utf-8") as file:
        return any(line.startswith("CMAKE_CXX_FLAGS:") and "-fsanitize" in line for line in file)


def hrad_tool(*arguments):
    """What the tool prints."""
    return subprocess.run([HRAD, *arguments], check=True, stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, timeout=300).stdout.decode()


def hrad_json(*arguments):
    return json.loads(hrad_tool(*arguments, "--json"))


need("numpy", "NumPy")
LIBRARY = built("hrad")
if not LIBRARY:
    skip("there is no shared library in this build, or only one that Python can't load")
os.environ["HRAD_LIBRARY"] = LIBRARY
PACKAGES = os.path.join(SOURCE, "bindings", "python")
sys.dont_write_bytecode = True
sys.path.insert(0, PACKAGES)

import hrad  # noqa: E402


class Case(unittest.TestCase):
    def setUp(self):
        self.solver = hrad.Solver()
        self.addCleanup(self.solver.destroy)

    def assert_fails(self, status, words, function, *arguments, **named):
        with self.assertRaisesRegex(hrad.Error, words) as caught:
            function(*arguments, **named)
        self.assertEqual(caught.exception.status, status)
        return caught.exception

    def assert_misfit(self, words, function, *arguments, **named):
        error = self.assert_fails(hrad.ERROR_ARGUMENT, words, function, *arguments, **named)
        self.assertIsInstance(error, hrad.ArgumentError)
        self.assertIsInstance(error, ValueError)
