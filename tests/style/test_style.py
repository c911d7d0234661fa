"""Holds the source tree and the built library to the project's rules.

HRAD_SOURCE_DIR and HRAD_BINARY_DIR say where they are; by default the tree is the one this file
lies in, and the build folder is its build/. Every offence is printed as file:line.
"""

import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True
sys.path.insert(0, HERE)

import archive_rules  # noqa: E402
import source_rules  # noqa: E402
from tree import Offence, Tree  # noqa: E402


def report(rule, offences):
    """Prints one rule's outcome; true when it is kept."""
    print("[%s] %s" % ("FAILED" if offences else "  OK  ", rule.__name__))
    for offence in offences:
        print("  %s:%d: %s" % offence)
    return not offences


def is_sanitized(binary):
    """Whether the library was built with a sanitizer, which adds symbols and globals of its own: the
    rules on archives are for the ordinary one."""
    try:
        with open(os.path.join(binary, "CMakeCache.txt")) as cache:
            return any(line.startswith("CMAKE_CXX_FLAGS:") and "-fsanitize" in line for line in cache)
    except OSError:
        return False


def main():
    source = os.environ.get("HRAD_SOURCE_DIR") or os.path.dirname(os.path.dirname(HERE))
    binary = os.environ.get("HRAD_BINARY_DIR") or os.path.join(source, "build")
    archive = os.path.join(binary, "lib", "libhrad.a")
    tree = Tree(source)
    kept = [report(rule, rule(tree)) for rule in source_rules.RULES]
    rules = [] if is_sanitized(binary) else archive_rules.RULES
    try:
        symbols = archive_rules.read_archive(archive)
        kept += [report(rule, rule(tree, symbols)) for rule in rules]
    except archive_rules.ArchiveError as error:
        kept += [report(rule, [Offence(archive, 0, str(error))]) for rule in rules]
    print("%d passed, %d failed" % (kept.count(True), kept.count(False)))
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main())
