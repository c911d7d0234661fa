# The headers are the manual: every function stands under a comment that says [C] or [L] and names its
# errors by their statuses; and whatever else says which functions are collective says the same: the
# manual pages, the docstrings of Python, the head of the Fortran module.
import ast
import glob
import os
import re
import unittest

ROOT = os.environ["HRAD_SOURCE_DIR"]

# Functions that have no errors to name, and why.
WITHOUT_ERRORS = {
    "hrad_version": "can't fail",
    "hrad_version_text": "can't fail",
    "hrad_status_name": "answers every number",
    "hrad_error_message": "can't fail",
    "hrad_scene_name": "answers NULL past the last",
    "hrad_destroy": "returns nothing",
    "hrad_request_stop": "returns nothing",
}


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


class Function:
    """A declaration with the comment above it."""

    def __init__(self, comment, prototype):
        self.name = re.search(r"\b(hrad_\w+)\s*\(", prototype).group(1)
        self.returns_status = prototype.startswith("HRAD_API hrad_status")
        self.takes_solver = re.search(r"\bhrad_solver \*solver\b", prototype) is not None
        self.comment = " ".join(re.sub(r"^[ /]\*+|\*/$", "", line).strip()
                                for line in comment.splitlines())
        # Some are collective until something has happened, and local after that.
        head = re.match(r" ?\[([CL])\]( [^:.]*\[([CL])\])?", self.comment)
        self.kinds = {mark for mark in head.group(1, 3) if mark} if head else set()


def functions_of(header):
    """Every function; those on lines without a gap between them share a comment."""
    found = []
    comment = ""
    for part in re.finditer(r"/\*.*?\*/|\bHRAD_API\b[^;{]*?\([^;]*?\);|\n[ \t]*\n", read(header), re.S):
        text = part.group()
        if text.startswith("/*"):
            comment = text
        elif text.startswith("HRAD_API"):
            found.append(Function(comment, re.sub(r"\s+", " ", text)))
        else:
            comment = ""
    return found


FUNCTIONS = functions_of("include/hrad/hrad.h") + functions_of("include/hrad/hrad_mpi.h")
KINDS = {function.name: function.kinds for function in FUNCTIONS}
STATUSES = set(re.findall(r"\bHRAD_ERROR_([A-Z]+) = ", read("include/hrad/hrad.h")))


def paragraphs_of_page(text):
    """The running text of a page of mdoc, names without their macros."""
    lines = [re.sub(r"^\.(?:Fn|Xr|Fa|Dv|Va|Sy|Em|Vt|Pa|Cm) ", "", line) for line in text.splitlines()
             if not line.startswith('.\\"')]
    text = re.sub(r" ([,.;:)])", r"\1", "\n".join(lines))
    return [" ".join(part.split())
            for part in re.split(r"^\.(?:Pp|Sh|Ss|Bl|El|Bd|Ed).*$", text, flags=re.M)]


def kinds_on_page(page):
    """Function -> what sentences of the page say of it: "X, Y and Z are collective", "All of these are
    local", "the others are collective", and of some "... collective before ..., and local after it"."""
    text = read(page)
    names = re.findall(r"^\.Nm (hrad_\w+)", text, re.M)
    said = {}
    for paragraph in paragraphs_of_page(text.split("\n.Sh DESCRIPTION\n")[1].split("\n.Sh ")[0]):
        for part in re.finditer(
                r"(All of these|the others|(?:hrad_\w+(?:, and |, | and )?)+) (?:is|are) "
                r"(collective|local)"
                r"(?: before [^.,]*, and (collective|local) after)?", paragraph):
            who, *kinds = part.groups()
            kinds = {kind[0].upper() for kind in kinds if kind}
            if who == "All of these":
                meant = names
            elif who == "the others":
                meant = [name for name in names if name not in said]
            else:
                meant = re.findall(r"hrad_\w+", who)
            for name in meant:
                said.setdefault(name, set()).update(kinds)
    return names, said


class Comments(unittest.TestCase):
    def test_every_function_is_found(self):
        declared = [read(f"include/hrad/{name}.h").count("\nHRAD_API ") for name in ("hrad", "hrad_mpi")]
        self.assertEqual(len(FUNCTIONS), sum(declared))
        self.assertEqual(len(KINDS), len(FUNCTIONS))
        self.assertGreater(len(FUNCTIONS), 40)

    def test_each_says_whether_it_is_collective(self):
        for function in FUNCTIONS:
            self.assertTrue(function.kinds, f"{function.name}: no [C] or [L] at the comment's head")

    def test_each_names_its_errors(self):
        for function in FUNCTIONS:
            named = function.comment.partition("Errors: ")[2]
            if function.name in WITHOUT_ERRORS:
                self.assertFalse(function.returns_status or named, function.name)
                continue
            statuses = set(re.findall(r"\b[A-Z]+\b", named)) & STATUSES
            others = re.search(r"\b(?:those of|as for|as) (hrad_\w+|above)", named)
            if others and others.group(1) != "above":
                self.assertIn(others.group(1), KINDS, function.name)
            self.assertTrue(statuses or others, f"{function.name} names no errors: {function.comment}")
        self.assertLessEqual(set(WITHOUT_ERRORS), set(KINDS))


class Collective(unittest.TestCase):
    def test_manual_pages_agree(self):
        seen = set()
        for path in sorted(glob.glob(os.path.join(ROOT, "man", "hrad_*.3"))):
            names, said = kinds_on_page(os.path.relpath(path, ROOT))
            for name in names:
                self.assertEqual(said.get(name), KINDS[name], f"{os.path.basename(path)} on {name}")
            seen.update(names)
        self.assertEqual(seen, set(KINDS))

    def test_docstrings_of_python_agree(self):
        seen = set()
        for path in glob.glob(os.path.join(ROOT, "bindings", "python", "hrad", "*.py")):
            for node in ast.walk(ast.parse(read(os.path.relpath(path, ROOT)))):
                name = f"hrad_{getattr(node, 'name', '')}"
                if not isinstance(node, ast.FunctionDef) or name not in KINDS:
                    continue
                marks = re.match(r"\[([CL])\]( [^:.]*\[([CL])\])?", ast.get_docstring(node) or "")
                if marks:
                    self.assertEqual({mark for mark in marks.group(1, 3) if mark}, KINDS[name], name)
                    seen.add(name)
        # What is no method of a solver has no ranks.
        wanted = {function.name for function in FUNCTIONS if function.takes_solver}
        renamed = {"hrad_create_mpi", "hrad_create_mpi_f", "hrad_destroy"}
        self.assertEqual(wanted - seen - renamed, set())

    def test_head_of_the_fortran_module_agrees(self):
        text = read("bindings/fortran/hrad.f90")
        head = " ".join(re.findall(r"^! ?(.*)$", text, re.M))
        listed = re.search(r"what hrad\.h marks \[C\]: all but (.*?), and what asks for no solver", head)
        named, prefix = set(), ""
        for name in re.findall(r"\b(?:hrad)?_\w+", listed.group(1)):
            if name.startswith("hrad"):
                prefix = re.match(r"hrad_[a-z]+", name).group()
            named.add(name if name.startswith("hrad") else prefix + name)
        local = {name for name, kinds in KINDS.items() if kinds == {"L"}}
        self.assertEqual(named - local, set())
        of_solvers = {function.name for function in FUNCTIONS if function.takes_solver}
        self.assertEqual(local & of_solvers - named, set())


if __name__ == "__main__":
    unittest.main()
