"""Sums up what gcov found in a build folder: the lines of lib/ that were run, per file and in all.
Usage: coverage.py FOLDER [--lines]"""

import collections
import json
import os
import subprocess
import sys


def documents(folder):
    """The JSON documents of gcov for every object of the library."""
    counts = [os.path.join(root, name) for root, _, names in os.walk(os.path.join(folder, "lib"))
              for name in sorted(names) if name.endswith(".gcda")]
    if not counts:
        sys.exit("%s: no counts: build with the preset coverage and run the tests" % folder)
    for path in counts:
        found = subprocess.run(["gcov", "--json-format", "--stdout", os.path.abspath(path)],
                               cwd=folder, capture_output=True, text=True, check=True).stdout
        for line in found.splitlines():
            if line:
                yield json.loads(line)


def runs_of_lines(folder, source):
    """{file of lib/: {line: how often it was run}}; a header's lines count once for all users."""
    lib = os.path.join(source, "lib") + os.sep
    runs = collections.defaultdict(collections.Counter)
    for document in documents(folder):
        for entry in document["files"]:
            path = os.path.normpath(os.path.join(document["current_working_directory"],
                                                 entry["file"]))
            if path.startswith(lib):
                for line in entry["lines"]:
                    runs[path[len(source) + 1:]][line["line_number"]] += line["count"]
    return runs


def ranges(numbers):
    """[1, 2, 3, 7] as "1-3 7"."""
    parts = []
    for number in sorted(numbers):
        if parts and parts[-1][1] == number - 1:
            parts[-1][1] = number
        else:
            parts.append([number, number])
    return " ".join(str(a) if a == b else "%d-%d" % (a, b) for a, b in parts)


def main():
    source = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    total = run = 0
    for path, lines in sorted(runs_of_lines(sys.argv[1], source).items()):
        missed = [number for number, count in lines.items() if count == 0]
        total += len(lines)
        run += len(lines) - len(missed)
        print("%6.1f %%  %4d of %4d  %s" % (100 - 100 * len(missed) / len(lines),
                                            len(lines) - len(missed), len(lines), path))
        if missed and "--lines" in sys.argv:
            print("%28s%s" % ("", ranges(missed)))
    print("%6.1f %%  %d of %d lines of lib/" % (100 * run / total, run, total))


main()
