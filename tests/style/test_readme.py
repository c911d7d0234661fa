# The README keeps its word: its program is the one in hrad.h, what it names exists, and all files
# that state the version state the same one.
import os
import re
import unittest

ROOT = os.environ["HRAD_SOURCE_DIR"]


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def version_of_header():
    header = read("include/hrad/hrad.h")
    return ".".join(re.search(rf"#define HRAD_VERSION_{part} (\d+)", header).group(1)
                    for part in ("MAJOR", "MINOR", "PATCH"))


class Readme(unittest.TestCase):
    def test_program_is_the_one_in_the_header(self):
        (shown,) = re.findall(r"^```c\n(.*?)^```", read("README.md"), re.M | re.S)
        comment = read("include/hrad/hrad.h").split("*/")[0]
        lines = [line[5:] for line in comment.splitlines() if line.startswith(" *   ")]
        first, last = lines.index("#include <hrad/hrad.h>"), lines.index("}")
        self.assertEqual(shown.splitlines(), lines[first : last + 1])

    def test_fortran_program_is_the_one_in_the_module(self):
        (shown,) = re.findall(r"^```fortran\n(.*?)^```", read("README.md"), re.M | re.S)
        head = read("bindings/fortran/hrad.f90").split("\nmodule hrad\n")[0]
        lines = [line[4:] for line in head.splitlines() if line.startswith("!   ")]
        self.assertEqual(shown.splitlines(), lines)

    def test_python_program_is_the_one_in_the_module(self):
        (shown,) = re.findall(r"^```python\n(.*?)^```", read("README.md"), re.M | re.S)
        head = read("bindings/python/hrad/__init__.py").split('"""')[1]
        (program,) = re.findall(r"A whole program:\n\n(.*?)\n\n(?=\w)", head, re.S)
        self.assertEqual(shown.splitlines(), [line[4:] for line in program.splitlines()])

    def test_paths_exist(self):
        text = read("README.md")
        paths = re.findall(r"`((?:lib|cli|tests|include|bindings|man|pkgconfig)/[\w./]*)`", text)
        paths += re.findall(r"\]\(((?!http|#)[^)]+)\)", text)
        paths += re.findall(r"^bash (\S+)", text, re.M)
        self.assertGreater(len(paths), 10)
        for path in paths:
            self.assertTrue(os.path.exists(os.path.join(ROOT, path)), path)

    def test_exit_codes_are_those_of_the_tool(self):
        codes = dict(re.findall(r"exit_(\w+) = (\d+)", read("cli/exit_code.h")))
        del codes["signal"]  # 128 and the signal's number
        rows = re.findall(r"^\| (\d+) \|", read("README.md").split("## Exit codes")[1], re.M)
        self.assertEqual(set(rows[: len(codes)]), set(codes.values()))

    def test_packages_are_those_that_setup_installs(self):
        setup = read("tests/setup.sh")
        lists = re.findall(r"^ *(?:packages|optional)\+?=\(([^)]+)\)", setup, re.M)
        installed = {name for names in lists for name in names.split()}
        table = read("README.md").split("## Dependencies")[1].split("\n## ")[0]
        named = {name for row in table.splitlines() if row.startswith("| ")
                 for name in re.findall(r"`([^`]+)`", row.split("|")[2])}
        self.assertEqual(named, installed)


class Version(unittest.TestCase):
    def test_is_the_same_everywhere(self):
        version = version_of_header()
        self.assertIn(f"project(hrad VERSION {version} ", read("CMakeLists.txt"))
        self.assertIn(f"\nversion: {version}\n", read("CITATION.cff"))
        newest = re.search(r"^## \[([^]]+)\]", read("CHANGELOG.md"), re.M).group(1)
        self.assertEqual(newest, version)
        constants = read("bindings/python/hrad/_constants.py")
        for part, number in zip(("MAJOR", "MINOR", "PATCH"), version.split(".")):
            self.assertIn(f"\nVERSION_{part} = {number}\n", constants)


if __name__ == "__main__":
    unittest.main()
