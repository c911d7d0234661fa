"""The module hrad has all of hrad.h, and of hrad_mpi.h, by name: every function with its arguments and
their types, under a docstring, called by a test; every constant; every struct with its fields and their
types."""

import ctypes
import glob
import inspect
import os
import re
import unittest

import support

import hrad
from hrad import _prototypes, _structs


def read(path):
    with open(os.path.join(support.SOURCE, path), encoding="utf-8") as file:
        return file.read()


HEADER = re.sub(r"/\*.*?\*/", "", read("include/hrad/hrad.h"), flags=re.S)
FUNCTION = r"\bHRAD_API\s+([^;(]*?)\bhrad_(\w+)\s*\(([^)]*)\)"
FUNCTIONS = re.findall(FUNCTION, HEADER)
MPI_HEADER = re.sub(r"/\*.*?\*/", "", read("include/hrad/hrad_mpi.h"), flags=re.S)
MPI_FUNCTIONS = re.findall(FUNCTION, MPI_HEADER)
STRUCTS = dict(re.findall(r"typedef struct hrad_(\w+) \{(.*?)\}", HEADER, re.S))
TESTS = "".join(read(os.path.relpath(path, support.SOURCE)) for path in glob.glob(
    os.path.join(support.SOURCE, "tests", "python", "test_*.py")))

# How hrad.h spells the types that ctypes has; `const` aside.
TYPES = {"int32_t": ctypes.c_int32, "int64_t": ctypes.c_int64, "uint64_t": ctypes.c_uint64,
         "double": ctypes.c_double, "size_t": ctypes.c_size_t, "char*": ctypes.c_char_p,
         "hrad_status": ctypes.c_int32, "void": None, "void*": ctypes.c_void_p,
         "hrad_solver*": ctypes.c_void_p, "hrad_log_function": _prototypes.LOG_FUNCTION,
         "hrad_progress_function": _prototypes.PROGRESS_FUNCTION}
RECORDS = {"param": hrad.Param, "material": hrad.Material, "patch": hrad.Patch,
           "progress": hrad.Progress, "stats": hrad.Stats}


def c_struct(name):
    return getattr(_structs, "C" + name.title().replace("_", ""))


def type_of(text):
    text = re.sub(r"\bconst\b|\s", "", text)
    if text in TYPES:
        return TYPES[text]
    pointed = text[:-1]
    if pointed.startswith("hrad_") and pointed not in TYPES:
        return ctypes.POINTER(c_struct(pointed[len("hrad_"):]))
    return ctypes.POINTER(TYPES[pointed])


def declared(text):
    """(name, type) of "const double *xyz"."""
    kind, name = re.fullmatch(r"\s*(.*?[\s*])(\w+)\s*", text, re.S).groups()
    return name, type_of(kind)


def fields_of(body):
    fields = []
    for declaration in filter(str.strip, body.split(";")):
        first, *others = declaration.split(",")
        kind = re.match(r"\s*((?:const )?\w+ )", first).group(1)
        for one in [first.replace(kind, "", 1), *others]:
            count = re.search(r"\[(\d+)\]", one)
            name, found = declared(kind + re.sub(r"\[\d+\]", "", one))
            fields.append((name, found * int(count.group(1)) if count else found))
    return fields


def of_python(name):
    """Where a function of C is in Python."""
    if name == "create":
        return hrad.Solver
    return getattr(hrad, name, None) or getattr(hrad.Solver, name)


class Names(unittest.TestCase):
    def test_prototypes_are_those_of_the_header(self):
        self.assertGreater(len(FUNCTIONS), 40)
        wanted = {}
        for result, name, arguments in FUNCTIONS:
            listed = [] if arguments == "void" else [declared(a) for a in arguments.split(",")]
            wanted[name] = (type_of(result), listed)
        ours = {name: (result, list(arguments.items()))
                for name, (result, arguments) in _prototypes.PROTOTYPES.items()}
        self.assertEqual(set(ours), set(wanted))
        for name in wanted:
            self.assertEqual(ours[name], wanted[name], name)

    def test_every_function_is_there_with_its_arguments_under_a_docstring(self):
        # What C returns through pointers, what an array tells of itself, and what ctypes needs.
        left_out = {"solver", "size", "needed", "text", "user", "number", "n_vertices", "n_triangles",
                    "out", "param", "stats", "hash", "value", "rank", "owner", "loads", "patches",
                    "materials"}
        for _, name, _ in FUNCTIONS:
            function = of_python(name)
            self.assertTrue(function.__doc__, name)
            if name in ("create", "get_material", "leaf_count", "power_balance", "add_material"):
                continue  # their arguments are a tuple's fields, or results
            ours = set(inspect.signature(function).parameters) - {"self"}
            theirs = set(_prototypes.PROTOTYPES[name][1])
            self.assertLessEqual(ours - {"fields"}, theirs, name)
            self.assertLessEqual(theirs - ours - set(hrad.Leaves._fields), left_out | {"count"}, name)

    def test_every_function_is_called_by_a_test(self):
        for _, name, _ in FUNCTIONS:
            called = "Solver" if name == "create" else name
            self.assertTrue(re.search(r"\.%s\b" % called, TESTS), name)

    def test_functions_of_hrad_mpi_are_in_the_solver(self):
        # Both are behind Solver(communicator): the one for C by name in its docstring, the one for
        # Fortran, whose communicator is an integer as mpi4py gives it, called with its types.
        names = {name for _, name, _ in MPI_FUNCTIONS}
        self.assertEqual(names, {"create_mpi", "create_mpi_f"})
        self.assertIn("hrad_create_mpi", hrad.Solver.__doc__)
        _, _, arguments = next(one for one in MPI_FUNCTIONS if one[1] == "create_mpi_f")
        self.assertEqual(arguments, "MPI_Fint comm, hrad_solver **solver")
        called = read("bindings/python/hrad/_mpi.py")
        self.assertIn('load_beside("hrad_mpi").hrad_create_mpi_f\n', called)
        self.assertIn("argtypes = [ctypes.c_int, ctypes.POINTER(ctypes.c_void_p)]", called)
        self.assertIn("Solver(MPI.COMM_WORLD)", read("tests/python/ranks.py"))

    def test_everything_public_has_a_docstring(self):
        for name in hrad.__all__:
            value = getattr(hrad, name)
            if not isinstance(value, int):
                self.assertTrue(value.__doc__, name)
        for name, value in inspect.getmembers(hrad.Solver, inspect.isfunction):
            self.assertTrue(name.startswith("_") or value.__doc__, name)

    def test_every_constant_has_its_value(self):
        constants = dict(re.findall(r"\bHRAD_([A-Z_]+) = (-?\d+)\b", HEADER))
        constants.update(re.findall(r"#define HRAD_(VERSION_\w+) (\d+)", HEADER))
        self.assertGreater(len(constants), 30)
        ours = {name: str(getattr(hrad, name)) for name in hrad.__all__ if name.isupper()}
        self.assertEqual(ours, constants)

    def test_every_struct_has_its_fields(self):
        self.assertEqual(len(STRUCTS), 6)
        for name, body in STRUCTS.items():
            struct = c_struct(name)
            self.assertEqual(struct._fields_, fields_of(body), name)
            if name in RECORDS:  # a rank's load is a row of an array
                kept = [field for field, _ in struct._fields_
                        if field != "struct_size"]
                self.assertEqual(list(RECORDS[name]._fields), kept)

    def test_version_is_that_of_the_header(self):
        self.assertEqual(hrad.version_text(), hrad.__version__)
        self.assertEqual(hrad.version(), hrad.VERSION_MAJOR * 10000 + hrad.VERSION_MINOR * 100 +
                         hrad.VERSION_PATCH)


if __name__ == "__main__":
    unittest.main()
