"""Rules on the built library, read with nm: exported names, public functions, globals, and code for
special instruction sets. Each rule takes a Tree and the archive's symbols."""

import re
import subprocess
from collections import namedtuple

from tree import Offence

# kind: nm's letter; section: of the object file; member: the object file in the archive.
Symbol = namedtuple("Symbol", "name kind section member")

WEAK = "WwVvu"
# What sanitizers and coverage add to a program is not the library's.
_INSTRUMENTATION = re.compile(
    r"^(__odr_asan|__asan|__tsan|__ubsan|__sancov|__gcov|__prof|\.L|asan\.)")
_NAMESPACE = re.compile(r"^_Z(?:T[VISTCHW]|GV|GR|L|Th?n?\d*_)*(?:N[KVRO]*)?4hrad")


class ArchiveError(Exception):
    pass


def read_archive(path):
    """The defined symbols of a static library."""
    try:
        listing = subprocess.run(["nm", "--format=sysv", "--defined-only", path], check=True,
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE).stdout.decode()
    except OSError as error:
        raise ArchiveError("nm can't be run: %s" % error)
    except subprocess.CalledProcessError as error:
        raise ArchiveError("nm can't read %s: %s" % (path, error.stderr.decode().strip()))
    symbols = []
    member = ""
    for line in listing.splitlines():
        head = re.match(r"^(?:Symbols|Undefined symbols) from .*\[(.*)\]:$", line)
        if head:
            member = head.group(1)
        columns = [column.strip() for column in line.split("|")]
        if len(columns) == 7 and columns[2] and columns[0] != "Name":
            if not _INSTRUMENTATION.match(columns[0]):
                symbols.append(Symbol(columns[0], columns[2], columns[6], member))
    if not symbols:
        raise ArchiveError("%s has no symbols" % path)
    return symbols


def readable(name):
    """A C++ name as it stands in the source."""
    try:
        return subprocess.run(["c++filt", name], check=True,
                              stdout=subprocess.PIPE).stdout.decode().strip()
    except (OSError, subprocess.CalledProcessError):
        return name


def exported_names_are_ours(tree, symbols):
    """Every external name is a function of hrad.h, or of the seam to the library hrad_mpi, or lies in
    namespace hrad; templates of the standard library, which every program shares, are weak."""
    public = {*tree.public_functions(), *tree.public_functions("lib/api/create_over.h")}
    offences = []
    for symbol in symbols:
        if symbol.kind.islower() or symbol.kind in WEAK:
            continue
        if symbol.name in public or _NAMESPACE.match(symbol.name):
            continue
        what = ("is not declared in hrad.h" if symbol.name.startswith("hrad_") else
                "is neither hrad_* nor in namespace hrad")
        offences.append(Offence(symbol.member, 0, "%s %s" % (readable(symbol.name), what)))
    return offences


def public_functions_are_defined(tree, symbols):
    """Every function that hrad.h declares is in the library."""
    defined = {symbol.name for symbol in symbols if symbol.kind == "T"}
    return [Offence("include/hrad/hrad.h", line, "%s is not in the library" % name)
            for name, line in tree.public_functions().items() if name not in defined]


def is_constant_table(tree, symbol, name):
    """Whether a function's own variable is declared static const: filled once, at first use."""
    variable = re.match(r"(?:guard variable for )?.*\)(?: const)?::(\w+)$", name)
    source = re.sub(r"\.(o|obj)$", "", symbol.member)
    if not variable:
        return False
    pattern = r"\bstatic\s+const\b[^;=(){}]*\b%s\b" % variable.group(1)
    return any(path.endswith("/" + source) and any(tree.code_matches(path, pattern))
               for path in tree.under("lib/"))


def no_mutable_globals(tree, symbols):
    """No variable that outlives a call and can change, except one for each thread."""
    offences = []
    for symbol in symbols:
        if not re.match(r"^(\.data|\.bss|\*COM\*)(?!\.rel\.ro)", symbol.section):
            continue
        name = readable(symbol.name)
        if not symbol.name.startswith("DW.ref.") and not is_constant_table(tree, symbol, name):
            offences.append(Offence(symbol.member, 0, "%s can be written by every thread (%s)" % (
                name, symbol.section)))
    return offences


def special_code_stays_apart(_, symbols):
    """An object file for a special instruction set defines no weak name: the linker could take that
    copy of a shared inline function for all, and older processors would stumble over it."""
    return [Offence(symbol.member, 0, "%s is weak in code for a special instruction set" %
                    readable(symbol.name))
            for symbol in symbols
            if re.search(r"_avx\w*\.", symbol.member) and symbol.kind in WEAK and
            symbol.name != "DW.ref.__gxx_personality_v0"]


RULES = [exported_names_are_ours, public_functions_are_defined, no_mutable_globals,
         special_code_stays_apart]
