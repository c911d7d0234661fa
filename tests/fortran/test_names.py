"""The modules hrad and hrad_mpi have all of hrad.h and hrad_mpi.h by name: every function, constant
and struct with its fields, under a documenting comment; and the Fortran tests call every function."""

import glob
import os
import re
import unittest

ROOT = os.environ["HRAD_SOURCE_DIR"]


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def read_all(pattern):
    paths = sorted(glob.glob(os.path.join(ROOT, pattern)))
    return {os.path.relpath(path, ROOT): read(path) for path in paths}


def code_of(text):
    """Fortran text without comments and literals, continued lines joined."""
    text = re.sub(r'"[^"\n]*"', '""', text)
    text = re.sub(r"!.*", "", text)
    return re.sub(r"&\s*\n\s*&?", " ", text)


def functions_of(header):
    return re.findall(r"\bHRAD_API\b[^;(]*?\b(hrad_\w+)\s*\(", header)


HEADER = re.sub(r"/\*.*?\*/", "", read("include/hrad/hrad.h"), flags=re.S)
FUNCTIONS = functions_of(HEADER)
MPI_FUNCTIONS = functions_of(re.sub(r"/\*.*?\*/", "", read("include/hrad/hrad_mpi.h"), flags=re.S))
BINDING = read_all("bindings/fortran/*.f90")
MPI_MODULE = BINDING.pop("bindings/fortran/hrad_mpi.f90")
MODULE = code_of(BINDING["bindings/fortran/hrad.f90"])
CODE = {path: code_of(text) for path, text in BINDING.items()}
TESTS = {path: code_of(text) for path, text in read_all("tests/fortran/test_*.f90").items()}


class Names(unittest.TestCase):
    def test_every_function_has_a_binding(self):
        self.assertGreater(len(FUNCTIONS), 40)
        bound = set()
        for text in BINDING.values():
            bound.update(re.findall(r'bind\(c, name="(hrad_\w+)"\)', text))
        self.assertEqual(set(FUNCTIONS), bound)
        for name in FUNCTIONS:
            self.assertRegex(MODULE, r"only:[^\n]*\b%s\b" % name)

    def test_every_function_is_called_by_a_test(self):
        for name in FUNCTIONS:
            called = any(re.search(r"\b%s\s*\(" % name, text) for text in TESTS.values())
            self.assertTrue(called, name + " is called by no Fortran test")

    def test_every_function_has_a_comment(self):
        for name in FUNCTIONS:
            head = re.compile(
                r"^  +!.*\n *(?:interface %s\n|(?:subroutine|function) %s\()" % (name, name), re.M)
            self.assertTrue(any(head.search(text) for text in BINDING.values()), name)

    def test_module_hrad_mpi_has_the_functions_of_its_header(self):
        # What takes a communicator of C has a sister hrad_..._f for that of Fortran, which there has
        # the name without the ending.
        sisters = {name for name in MPI_FUNCTIONS if name.endswith("_f")}
        self.assertEqual(set(MPI_FUNCTIONS), sisters | {name[:-2] for name in sisters})
        self.assertEqual(set(re.findall(r'bind\(c, name="(hrad_\w+)"\)', MPI_MODULE)), sisters)
        public = re.findall(r"^ +public :: (.*)$", code_of(MPI_MODULE), re.M)
        names = {name.strip() for names in public for name in names.split(",")}
        self.assertEqual(names, {name[:-2] for name in sisters})
        tests = [code_of(text) for text in read_all("tests/mpi/test_*.f90").values()]
        for name in names:
            self.assertRegex(MPI_MODULE, r"(?m)^  +!.*\n *subroutine %s\(" % name)
            self.assertTrue(any(re.search(r"\b%s\s*\(" % name, text) for text in tests), name)

    def test_every_constant_has_its_value(self):
        constants = dict(re.findall(r"\b(HRAD_[A-Z_]+) = (-?\d+)\b", HEADER))
        constants.update(re.findall(r"#define (HRAD_VERSION_\w+) (\d+)", HEADER))
        self.assertGreater(len(constants), 30)
        ours = dict(re.findall(r"parameter :: (HRAD_[A-Z_]+) = (-?\d+)\b",
                               CODE["bindings/fortran/hrad_constants.f90"]))
        self.assertEqual(constants, ours)

    def test_every_struct_has_its_fields(self):
        structs = re.findall(r"typedef struct (hrad_\w+) \{(.*?)\}", HEADER, re.S)
        self.assertEqual(len(structs), 6)
        for name, body in structs:
            fields = []
            for declaration in filter(str.strip, body.split(";")):
                names = re.sub(r"\[\d+\]|\*", " ", declaration).split(",")
                fields += [n.split()[-1] for n in names]
            ours = re.search(r"type(?:, bind\(c\))? :: %s\n(.*?)end type %s" % (name, name),
                             CODE["bindings/fortran/hrad_types.f90"], re.S).group(1)
            found = re.findall(r":: (\w+)", ours)
            if "struct_size" not in found:  # a type of Fortran's own, translated
                fields.remove("struct_size")
            self.assertEqual(fields, found, name)


if __name__ == "__main__":
    unittest.main()
