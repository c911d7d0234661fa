# hrad-fortran(3) has every public procedure of the Fortran modules with its arguments, their order, shapes
# and types and which may be left out, and every type with its components, as the modules declare them.
import glob
import os
import re
import unittest

ROOT = os.environ["HRAD_SOURCE_DIR"]


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def code_of(text):
    """Fortran text without comments and literals, continued lines joined."""
    text = re.sub(r'"[^"\n]*"', '""', text)
    text = re.sub(r"!.*", "", text)
    return re.sub(r"&\s*\n\s*&?", " ", text)


BINDING = {os.path.basename(path): code_of(read(os.path.relpath(path, ROOT)))
           for path in glob.glob(os.path.join(ROOT, "bindings", "fortran", "*.f90"))}
CODE = "\n".join(BINDING.values())
PAGE = read("man/hrad-fortran.3")


def split_list(text):
    """What commas outside parentheses separate."""
    return [part.strip() for part in re.split(r",(?![^()]*\))", text) if part.strip()]


# ---- what the modules declare


def public_names():
    listed = re.findall(r"^ *use hrad_\w+, only: (.*)$", BINDING["hrad.f90"], re.M)
    return [name for names in listed for name in split_list(names)] + ["hrad_create_mpi"]


def declarations(body):
    """Name -> (type, rank, is optional) of what a text declares."""
    found = {}
    for line in re.findall(r"^ *([a-z].*::.*)$", body, re.M):
        kind, names = line.split("::", 1)
        attributes = split_list(kind)
        for name in split_list(names):
            shape = re.search(r"\((.*)\)", name.split("=")[0])
            text = attributes[0]
            if "allocatable" in attributes:
                text += ", allocatable"
            found[re.match(r"\w+", name).group()] = (
                text, len(split_list(shape.group(1))) if shape else 0, "optional" in attributes)
    return found


class Procedure:
    """A public procedure over all of its specific ones: arguments in order, each with its rank, whether
    it is optional in any, and its types in all."""

    def __init__(self, name):
        self.arguments = {}
        generic = re.search(rf"^ *interface {name}\n *module procedure (.*)$", CODE, re.M)
        for specific in split_list(generic.group(1)) if generic else [name]:
            head = re.search(rf"^ *(?:logical )?(subroutine|function) {specific}\(([^)]*)\).*\n"
                             rf"((?:.*\n)*?) *end \1 {specific}$", CODE, re.M)
            declared = declarations(head.group(3))
            for argument in split_list(head.group(2)):
                kind, rank, optional = declared[argument]
                old = self.arguments.setdefault(argument, (rank, set(), set()))
                assert old[0] == rank, (name, argument)
                old[1].add(optional)
                old[2].add(kind)

    def shape(self):
        return [(name, rank, True in optional) for name, (rank, optional, _) in self.arguments.items()]


def is_procedure(name):
    return not re.search(rf"^ *type(?:, bind\(c\))? :: {name}$", CODE, re.M)


PROCEDURES = {name: Procedure(name) for name in public_names() if is_procedure(name)}

# How the page's list of types names those of the binding.
TYPES = {frozenset({"real(c_double)"}): "double precision",
         frozenset({"integer(c_int32_t)", "integer(c_int64_t)"}): "integer of either kind",
         frozenset({"integer(c_int32_t)"}): "integer",
         frozenset({"integer"}): "integer",
         frozenset({"integer(c_int64_t)"}): "integer(int64)",
         frozenset({"character(len=*)"}): "character(len=*)",
         frozenset({"character(len=:), allocatable"}): "character(len=:), allocatable"}


# ---- what the page says


def shown_procedures():
    """Name -> [(argument, rank, is optional)] of the lines `call hrad_...(...)` and `... = hrad_...(...)`,
    which may be continued."""
    text = re.sub(r"&\n *", "", PAGE.split("\n.Sh PROCEDURES\n")[1].split("\n.Sh ")[0])
    shown = {}
    for name, arguments in re.findall(
            r"^(?:call|text =|logical function|subroutine|version =) (hrad_\w+)\((.*)\)$", text, re.M):
        listed = []
        plain = re.sub(r"\[, ([^]]*)\]", r", ?\1", arguments)
        for argument in split_list(plain):
            optional = argument.startswith("?")
            shape = re.search(r"\((.*)\)", argument)
            listed.append((re.match(r"\w+", argument.lstrip("?")).group(),
                           len(split_list(shape.group(1))) if shape else 0, optional))
        assert name not in shown, name
        shown[name] = listed
    return shown


class Page(unittest.TestCase):
    def test_every_procedure_is_shown_as_it_is(self):
        shown = shown_procedures()
        self.assertEqual(set(shown), set(PROCEDURES))
        self.assertGreater(len(shown), 40)
        for name, procedure in PROCEDURES.items():
            self.assertEqual(shown[name], procedure.shape(), name)

    def test_every_argument_has_its_type(self):
        section = PAGE.split("\n.Sh ARGUMENTS\n")[1].split("\n.Sh ")[0]
        listed = set()
        for head, text in re.findall(r"^\.It Vt \"?([^\"\n]*)\"?\n((?:\.Fa .*\n)+)", section, re.M):
            listed |= {(name, head) for line in re.findall(r"^\.Fa (.*)$", text, re.M)
                       for name in re.findall(r"\w+", line)}
        wanted = set()
        for procedure in PROCEDURES.values():
            for name, (_, _, kinds) in procedure.arguments.items():
                if frozenset(kinds) in TYPES:
                    wanted.add((name, TYPES[frozenset(kinds)]))
                else:  # types of the module, procedures, and objects of any type
                    (kind,) = kinds
                    self.assertRegex(kind, r"^(type|procedure|class)\(")
        self.assertEqual(listed, wanted)

    def test_every_type_has_its_components(self):
        types = [name for name in public_names() if name not in PROCEDURES and name != "hrad_solver"]
        self.assertEqual(len(types), 6)
        for name in types:
            body = re.search(rf"^ *type(?:, bind\(c\))? :: {name}\n(.*?)end type {name}$",
                             CODE, re.M | re.S).group(1)
            shown = re.search(rf"^type :: {name}\n(.*?)^end type {name}$", PAGE, re.M | re.S)
            self.assertTrue(shown, name)
            wanted = {field: rank for field, (_, rank, _) in declarations(body).items()
                      if field != "struct_size"}
            ours = {field: rank for field, (_, rank, _) in
                    declarations(code_of(shown.group(1))).items()}
            self.assertEqual(ours, wanted, name)


if __name__ == "__main__":
    unittest.main()
