"""Rules on source text: floors and includes, what the library must not do, head comments, length,
words. Each rule takes a Tree and returns its offences."""

import os
import re

from tree import CODE, FLOORS, OWN_FOLDER, SOURCE, Offence

MAX_LINES = 400
FORTRAN_MAX_LINES = 300
FORTRAN_MAX_COLUMNS = 100
PUBLIC_ONLY = ("cli/", "tests/api/", "tests/physics/", "tests/consumers/")

# Output, process control and signals; formatting into memory is fine. An assert prints and aborts.
FORBIDDEN_CALLS = ("printf vprintf fprintf vfprintf dprintf vdprintf puts fputs fputc putc "
                   "putchar perror psignal exit _exit _Exit quick_exit at_quick_exit atexit "
                   "abort terminate set_terminate assert signal sigaction raise kill system fork "
                   "vfork popen execv execvp execl execlp setenv putenv unsetenv setlocale "
                   "MPI_Init MPI_Init_thread MPI_Finalize MPI_Abort").split()

# libm chooses variants of these by processor, so their last bits differ between machines.
TRANSCENDENTALS = ("sin cos tan asin acos atan atan2 sincos sinh cosh tanh asinh acosh atanh exp "
                   "exp2 exp10 expm1 log log2 log10 log1p pow hypot cbrt erf erfc tgamma "
                   "lgamma").split()


def called(names):
    """A call of one of these functions, plain or from std; not a member, not another namespace's,
    and not a declaration, which a type's name precedes."""
    no_declaration = "".join(r"(?<!\b%s )" % word for word in ("void", "bool", "int", "double"))
    return no_declaration + r"(?<![\w.:>])(?:(?:std)?\s*::\s*)?\b(%s)\s*\(" % "|".join(names)


def lib_folder(path):
    """The folder below lib/, or None for a file that lies in none."""
    parts = path.split("/")
    return parts[1] if len(parts) > 2 else None


def includes_point_down(tree):
    """A file in lib/ includes only floors below its own, or its own folder."""
    offences = []
    for path in tree.under("lib/", suffixes=CODE):
        own = lib_folder(path)
        if own not in FLOORS:
            offences.append(Offence(path, 1, "lies in no folder of the floor plan"))
            continue
        for line, name, quoted in tree.includes(path):
            folder = name.split("/")[0]
            if folder == "hrad" and own != "api":
                offences.append(Offence(path, line, "only lib/api includes %s" % name))
            elif folder in FLOORS and "/" in name:
                if not tree.exists("lib/" + name):
                    offences.append(Offence(path, line, "%s is not in lib/" % name))
                elif folder != own and FLOORS[folder] >= FLOORS[own]:
                    offences.append(Offence(path, line, "floor %d (%s) includes %s of floor %d" % (
                        FLOORS[own], own, name, FLOORS[folder])))
            elif quoted and folder != "hrad":
                offences.append(Offence(path, line,
                                        "%s is not named from lib/ as folder/file" % name))
    return offences


def outside_sees_only_the_public_header(tree):
    """The CLI and the tests of the public interface include hrad/*.h, their own and the system's
    headers."""
    offences = []
    for path in tree.under(*PUBLIC_ONLY, suffixes=CODE):
        own = os.path.dirname(path)
        homes = [own + "/", path.split("/")[0] + "/", "include/"]
        for line, name, quoted in tree.includes(path):
            found = [home for home in homes if tree.exists(os.path.normpath(home + name))]
            if not found and tree.exists("lib/" + name):
                offences.append(Offence(path, line, "includes %s of lib/" % name))
            elif "../" in name and os.path.normpath(own + "/" + name).startswith("lib/"):
                offences.append(Offence(path, line, "includes %s of lib/" % name))
            elif quoted and not found:
                offences.append(Offence(path, line, "%s is neither its own nor public" % name))
    return offences


def foreign_headers_stay_in_their_files(tree):
    """hwloc.h, zlib.h and png.h in one file each, mpi.h where messages are; no <iostream> in lib/."""
    offences = []
    zlib_files = []
    for path in tree.under("lib/", "cli/", "tests/", "include/", suffixes=CODE):
        stem = os.path.splitext(os.path.basename(path))[0]
        for line, name, _ in tree.includes(path):
            if name.split("/")[0] in ("hwloc.h", "hwloc"):
                if path != "lib/machine/topology.cpp":
                    offences.append(Offence(path, line, "hwloc belongs to machine/topology.cpp"))
            elif name == "png.h":
                if path != "cli/render/png_file.cpp":
                    offences.append(Offence(path, line, "png.h belongs to cli/render/png_file.cpp"))
            elif name == "mpi.h":
                if not (stem in ("comm_mpi", "file_mpi", "api_mpi") or stem == "hrad_mpi" or
                        path.startswith("cli/launcher") or path.startswith("tests/mpi/")):
                    offences.append(Offence(path, line, "mpi.h belongs to comm_mpi, file_mpi, "
                                            "api_mpi and the CLI's launcher"))
            elif name == "zlib.h":
                if path.startswith("lib/"):
                    zlib_files.append((path, line))
                elif not path.startswith("tests/"):
                    offences.append(Offence(path, line, "zlib belongs to lib/"))
            elif name == "iostream" and path.startswith("lib/"):
                offences.append(Offence(path, line, "lib/ needs no standard streams"))
    for path, line in zlib_files[1:]:
        offences.append(Offence(path, line, "zlib.h is included by %s already" % zlib_files[0][0]))
    return offences


def library_is_silent_and_harmless(tree):
    """No output, no process control, no signal handlers and no MPI_Init inside lib/."""
    pattern = called(FORBIDDEN_CALLS) + r"|\b(stdout|stderr|std\s*::\s*(?:cout|cerr|clog))\b"
    return [Offence(path, line, "%s in the library" % (match.group(1) or match.group(2)))
            for path in tree.under("lib/", suffixes=CODE)
            for line, match in tree.code_matches(path, pattern)]


def no_transcendentals(tree):
    """Results in lib/ must not depend on which variant of libm the processor gets."""
    # Without arguments it is somebody else's function of that name.
    names = [name + suffix for name in TRANSCENDENTALS for suffix in ("", "f", "l")]
    return [Offence(path, line, "%s gives other bits on other processors" % match.group(1))
            for path in tree.under("lib/", suffixes=CODE)
            for line, match in tree.code_matches(path, called(names) + r"\s*(?!\))")]


def files_are_short(tree):
    """No source file is longer than MAX_LINES; the public header is the manual and may be."""
    offences = []
    for path in tree.under("lib/", "cli/", "include/", "bindings/", "tests/"):
        lines = tree.text(path).count("\n")
        if lines > MAX_LINES and path != "include/hrad/hrad.h":
            offences.append(Offence(path, MAX_LINES + 1, "%d lines, more than %d" % (
                lines, MAX_LINES)))
    return offences


def fortran_keeps_its_form(tree):
    """Fortran files are short, have short lines and begin with a comment that says what they are
    for; every public procedure of the binding has one too."""
    offences = []
    for path in tree.under("bindings/", "tests/", suffixes=(".f90", ".F90")):
        lines = tree.text(path).splitlines()
        if not re.match(r"! \w", lines[0] if lines else ""):
            offences.append(Offence(path, 1, "has no head comment"))
        if len(lines) > FORTRAN_MAX_LINES:
            offences.append(Offence(path, FORTRAN_MAX_LINES + 1, "%d lines, more than %d" % (
                len(lines), FORTRAN_MAX_LINES)))
        for number, line in enumerate(lines, 1):
            if len(line) > FORTRAN_MAX_COLUMNS:
                offences.append(Offence(path, number, "%d columns, more than %d" % (
                    len(line), FORTRAN_MAX_COLUMNS)))
            public = re.match(r" +(?:interface|subroutine|(?:\w+ )*function) (hrad_\w+)", line)
            if (path.startswith("bindings/") and public and not line.lstrip().startswith("end ") and
                    not re.match(r" +! ", lines[number - 2])):
                offences.append(Offence(path, number, "%s has no comment" % public.group(1)))
    return offences


def heads_name_the_floor(tree):
    """Every file of lib/ begins with a comment that says what it is for and names its floor."""
    offences = []
    for path in tree.under("lib/", suffixes=CODE):
        own = lib_folder(path)
        head = re.match(r"(?:[ \t]*//[^\n]*\n)+|\s*/\*.*?\*/", tree.text(path), re.DOTALL)
        if not head:
            offences.append(Offence(path, 1, "has no head comment"))
            continue
        words = " ".join(re.sub(r"^\s*(//+|/\*+|\*+/?)", "", line)
                         for line in head.group().splitlines())
        floor = re.search(r"\bFloor\s+(\d+)\s+\((\w+)\)\s*\.", words)
        if not floor:
            offences.append(Offence(path, 1, "head comment without 'Floor N (folder).'"))
        elif floor.group(2) != own or int(floor.group(1)) != FLOORS.get(own):
            offences.append(Offence(path, 1, "'%s' in folder %s, floor %s" % (
                floor.group(), own, FLOORS.get(own))))
    return offences


def a_name_means_one_type(tree):
    """No two types of one namespace have the same name, unless each is one file's own: a linker takes
    the functions of either for both."""
    defined, offences = {}, []
    for path in tree.under("lib/", "cli/", suffixes=CODE):
        inside = []
        for number, line in enumerate(tree.text(path).splitlines(), 1):
            opened = re.match(r"(?:inline )?namespace ?([\w:]*) ?\{$", line)
            if opened:
                inside.append(opened.group(1))
            elif re.match(r"\}  // (?:inline )?namespace", line) and inside:
                inside.pop()
            made = re.match(r"(?:struct|class|enum(?: class)?) (?:alignas\(.*?\) )?(\w+)\b(?!::)[^;]*\{",
                            line)
            if not made or "" in inside:
                continue
            name = "::".join(inside + [made.group(1)])
            if name in defined and defined[name] != path:
                offences.append(Offence(path, number, "%s is a type of %s too" % (name, defined[name])))
            defined.setdefault(name, path)
    return offences


_MARKS = r"\b(?:%s)\b" % "|".join(("TO" "DO", "FIX" "ME", "XX" "X", "HA" "CK"))
_MACHINE_PATH = r"(?<![\w.$}~-])/(?:home|work|root|Users)/\w+"
_TEMPORARY_PATH = r"(?<![\w.$}~-])/(?:var/)?tmp\b"
_WORKPLACE = (r"(?i)\b(?:this|previous|last|next|earlier|current) session\b|\bsub-?agents?\b"
              r"|\b(?:issue|closes|fixes|fixed in) #\d+"
              r"|\bhttps?://[^/\s]*(?:artifactory|registry|mirror|proxy)[^/\s]*")


def words_fit_the_tree(tree):
    """No marks of unfinished work, no paths of one machine, no word about where it was written."""
    offences = []
    for path in tree.paths:
        patterns = [(_MARKS, "a mark of unfinished work"), (_MACHINE_PATH, "a path of one machine"),
                    (_WORKPLACE, "a word about the workplace")]
        if path.startswith(("lib/", "include/")):
            patterns.append((_TEMPORARY_PATH, "a path of one machine"))
        if path.startswith(OWN_FOLDER):
            continue  # the rules and their bad examples
        for number, text in enumerate(tree.text(path).splitlines(), 1):
            for pattern, what in patterns:
                found = re.search(pattern, text)
                if found:
                    offences.append(Offence(path, number, "%s: %s" % (what, found.group())))
    return offences


def public_functions_are_tested(tree):
    """Every function of the public headers is called by name in at least one test."""
    called_names = set()
    for path in tree.under("tests/", suffixes=SOURCE):
        if path.startswith(OWN_FOLDER):
            continue
        if path.endswith(CODE):
            called_names.update(match.group(1) for _, match in
                                tree.code_matches(path, r"\b(hrad_\w+)\s*\("))
        else:
            called_names.update(re.findall(r"\b(hrad_\w+)\s*\(", tree.text(path)))
    return [Offence(header, line, "%s is called by no test" % name)
            for header in ("include/hrad/hrad.h", "include/hrad/hrad_mpi.h")
            for name, line in tree.public_functions(header).items() if name not in called_names]


RULES = [includes_point_down, outside_sees_only_the_public_header,
         foreign_headers_stay_in_their_files, library_is_silent_and_harmless, no_transcendentals,
         files_are_short, fortran_keeps_its_form, heads_name_the_floor, a_name_means_one_type,
         words_fit_the_tree, public_functions_are_tested]
