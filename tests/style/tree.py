"""The source tree as the style rules see it: its files, their text, and their text without comments
and literals."""

import os
import re
import subprocess
from collections import namedtuple

Offence = namedtuple("Offence", "path line text")

CODE = (".c", ".cpp", ".h", ".inl")
SOURCE = CODE + (".py", ".sh", ".f90", ".F90", ".cmake")
OWN_FOLDER = "tests/style/"

# The floor on which each folder of lib/ stands; links and partition stand side by side.
FLOORS = {"base": 1, "machine": 2, "scene": 3, "visibility": 4, "hierarchy": 5, "links": 6,
          "partition": 6, "stages": 7, "solver": 8, "api": 9}

_COMMENTS_AND_LITERALS = re.compile(
    r'(?P<raw>\bu?8?[uUL]?R"(?P<delimiter>[^()\\\s]{0,16})\(.*?\)(?P=delimiter)")'
    r'|(?P<string>"(?:\\.|[^"\\\n])*")'
    r"|(?P<character>(?<![0-9A-Za-z_])'(?:\\.|[^'\\\n])+')"
    r"|(?P<comment>//(?:\\\n|[^\n])*|/\*.*?\*/)",
    re.DOTALL)


def without_comments(text, keep_literals=False):
    """C or C++ text with comments (and the insides of literals) blanked; lines stay where they
    are."""

    def blank(match):
        newlines = "\n" * match.group().count("\n")
        if match.group("comment") is not None:
            return " " + newlines
        return match.group() if keep_literals else '""' + newlines

    return _COMMENTS_AND_LITERALS.sub(blank, text)


class Tree:
    """All files of a source folder that belong to the project, by path relative to it."""

    def __init__(self, root):
        self.root = os.path.abspath(root)
        self._texts = {}
        self.paths = [path for path in sorted(self._list()) if self._read(path) is not None]

    def _list(self):
        """What git tracks or would track; without git every file outside build folders."""
        if os.path.exists(os.path.join(self.root, ".git")):
            try:
                listed = subprocess.run(
                    ["git", "-C", self.root, "ls-files", "-z", "--cached", "--others",
                     "--exclude-standard"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                    check=True).stdout.decode()
                return set(filter(None, listed.split("\0")))
            except (OSError, subprocess.CalledProcessError):
                pass
        found = set()
        for folder, folders, files in os.walk(self.root):
            folders[:] = [f for f in folders if not f.startswith((".", "build")) and
                          not os.path.exists(os.path.join(folder, f, "CMakeCache.txt"))]
            for name in files:
                path = os.path.relpath(os.path.join(folder, name), self.root)
                found.add(path.replace(os.sep, "/"))
        return found

    def _read(self, path):
        """Keeps a text file; data that is not text, and files that are gone, don't count."""
        try:
            with open(os.path.join(self.root, path), "rb") as file:
                data = file.read()
            self._texts[path] = data.decode("utf-8") if b"\0" not in data else None
        except (OSError, UnicodeDecodeError):
            self._texts[path] = None
        return self._texts[path]

    def text(self, path):
        return self._texts[path]

    def exists(self, path):
        return path in self._texts

    def under(self, *folders, suffixes=SOURCE):
        """Paths in the given folders (each "name/") with one of the suffixes."""
        return [path for path in self.paths
                if path.startswith(folders) and (path.endswith(suffixes) or
                                                 os.path.basename(path) == "CMakeLists.txt" and
                                                 suffixes is SOURCE)]

    def includes(self, path):
        """(line, name, quoted) of every #include."""
        text = without_comments(self.text(path), keep_literals=True)
        for match in re.finditer(r'^[ \t]*#[ \t]*include[ \t]*(["<])([^">\n]+)[">]', text, re.M):
            yield line_of(text, match.start(2)), match.group(2), match.group(1) == '"'

    def code_matches(self, path, pattern):
        """(line, match) of a pattern in code, outside comments and literals."""
        text = without_comments(self.text(path))
        for match in re.finditer(pattern, text):
            yield line_of(text, match.start(match.lastindex or 0)), match

    def public_functions(self, path="include/hrad/hrad.h"):
        """Name -> line of every function that a header exports."""
        if not self.exists(path):
            return {}
        pattern = r"\bHRAD_API\b[^;(]*?\b(hrad_\w+)\s*\("
        return {match.group(1): line for line, match in self.code_matches(path, pattern)}


def line_of(text, position):
    return text.count("\n", 0, position) + 1
