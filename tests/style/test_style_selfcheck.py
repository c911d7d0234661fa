"""Tests the style test: a small clean tree passes, and one violation of each kind is found at its
file and line, with nothing else reported.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
COMPILER = os.environ.get("CXX") or shutil.which("c++") or shutil.which("g++") or "clang++"

# A tree that keeps every rule, full of things that only look like violations.
CLEAN = {
    "include/hrad/hrad.h": """/* The public header. */
HRAD_API int hrad_one(void);
/* HRAD_API int hrad_comment(void); */
HRAD_API const char *hrad_two(int index,
                              int other);
""",
    "lib/base/good.h": """// Says printf(\"\") and exit(1) in a comment. Floor 1 (base).
#pragma once
#include <cstdio>
namespace hrad {
struct Door { void exit() {} int log() const { return 1'000'000; } };
inline void leave(Door& d, Door* e) { d.exit(); e->exit(); }
inline const char* words() { return "abort(); std::cout << sin(1)"; }
inline const char* raw() { return R"(exit(1); ")"; } /* abort(); */
inline int print(char* text) { return std::snprintf(text, 9, "%d", '"'); }
}
""",
    "lib/machine/topology.cpp": """/* What hwloc sees.
 * Floor 2
 * (machine). */
#include <hwloc.h>
#include "base/good.h"
#include "machine/topology.h"
namespace hrad {
const char* const table[] = {"one", "two"};
thread_local int scratch;
const Door& door() {
  static const Door& made_once = *new Door();
  return made_once;
}
int size() { return table[0][0] + scratch; }
}
""",
    "lib/machine/topology.h": "// Its interface. Floor 2 (machine).\n",
    "lib/machine/fast_avx2.cpp": "// Kernels. Floor 2 (machine).\n"
                                 "namespace hrad { int fast() { return 1; } }\n",
    "lib/api/api.cpp": """// The functions of hrad.h. Floor 9 (api).
extern "C" {
#include "hrad/hrad.h"
int hrad_one(void) { return 1; }
const char* hrad_two(int, int) { return ""; }
}
""",
    "cli/main.cpp": '#include "words.h"\n#include <hrad/hrad.h>\n#include <unistd.h>\n'
                    "int main() { return hrad_one(); }\n",
    "cli/words.h": "// The CLI may print.\n",
    "tests/api/test_api.cpp": '#include "support/check.h"\n#include "hrad/hrad.h"\n'
                              "int a = hrad_one();\n",
    "tests/api/test_api.py": "library.hrad_two(0, 1)\n",
    "bindings/fortran/good.f90": "! A module.\nmodule good\ncontains\n  ! Does nothing.\n"
                                 "  subroutine hrad_good()\n  end subroutine hrad_good\n"
                                 "end module good\n",
    "tests/support/check.h": "// For tests.\n",
    "README.md": "Run it in your home/ or /usr folder; a user's session may last.\n",
}

HEAD = "// A file. Floor %d (%s).\n"

# Rule, file, text, lines that offend.
VIOLATIONS = [
    ("includes_point_down", "lib/base/up.cpp",
     HEAD % (1, "base") + '#include "machine/topology.h"\n', [2]),
    ("includes_point_down", "lib/links/sideways.h",
     HEAD % (6, "links") + '#include "partition/grid.h"\n', [2]),
    ("includes_point_down", "lib/scene/public.h",
     HEAD % (3, "scene") + '#include <hrad/hrad.h>\n#include "loose.h"\n#include "base/none.h"\n',
     [2, 3, 4]),
    ("includes_point_down", "lib/cellar/lost.h", HEAD % (0, "cellar"), [1]),
    ("outside_sees_only_the_public_header", "cli/inside.cpp", '#include "base/good.h"\n', [1]),
    ("outside_sees_only_the_public_header", "tests/physics/inside.h",
     '#include <vector>\n#include <base/good.h>\n', [2]),
    ("outside_sees_only_the_public_header", "tests/api/around.c",
     '#include "../../lib/base/good.h"\n', [1]),
    ("foreign_headers_stay_in_their_files", "lib/solver/all.cpp",
     HEAD % (8, "solver") +
     "#include <hwloc.h>\n#include <mpi.h>\n#include <zlib.h>\n#include <iostream>\n", [2, 3, 5]),
    ("foreign_headers_stay_in_their_files", "lib/solver/second.cpp",
     HEAD % (8, "solver") + "#include <zlib.h>\n", [2]),
    ("foreign_headers_stay_in_their_files", "cli/drawn.cpp", "#include <png.h>\n", [1]),
    ("library_is_silent_and_harmless", "lib/stages/loud.cpp",
     HEAD % (7, "stages") + "void f() {\n  std::printf(\"a\");\n  fprintf(file, \"\");\n"
     "  puts(\"\");\n  std::cerr << 1;\n  std::exit(1);\n  ::_Exit (2);\n  std::terminate();\n"
     "  signal(2, f);\n  raise(3);\n  MPI_Init(0, 0);\n  assert(f);\n}\n", list(range(3, 14))),
    ("no_transcendentals", "lib/scene/curved.cpp",
     HEAD % (3, "scene") + "double a = std::sin(1), b = fabs(sqrt(2));\nfloat c = powf(2, 3);\n"
     "double d = cbrt(8) + floor(2);\ndouble e = exp (1);\n", [2, 3, 4, 5]),
    ("files_are_short", "tests/scene/long.py", "pass\n" * 401, [401]),
    ("fortran_keeps_its_form", "bindings/fortran/headless.f90", "module headless\n", [1]),
    ("fortran_keeps_its_form", "bindings/fortran/long.f90", "! A file.\n" * 301, [301]),
    ("fortran_keeps_its_form", "tests/fortran/wide.f90", "! A file.\n! " + "x" * 99 + "\n", [2]),
    ("fortran_keeps_its_form", "bindings/fortran/mute.f90",
     "! A file.\n  interface hrad_mute\n  end interface hrad_mute\n  integer :: i\n"
     "  pure integer function hrad_dumb()\n", [2, 5]),
    ("heads_name_the_floor", "lib/scene/headless.h", "#pragma once\n// Floor 3 (scene).\n", [1]),
    ("heads_name_the_floor", "lib/scene/nameless.h", "// A file.\n", [1]),
    ("heads_name_the_floor", "lib/scene/misplaced.h", HEAD % (4, "visibility"), [1]),
    ("a_name_means_one_type", "lib/base/zz_again.h",
     HEAD % (1, "base") + "namespace hrad {\nstruct Door {\n};\nnamespace {\nstruct Bytes {\n};\n"
     "}  // namespace\n}  // namespace hrad\n", [3]),
    ("words_fit_the_tree", "lib/base/unfinished.h",
     HEAD % (1, "base") + "// TO" "DO: more\n// see /tmp/notes\n", [2, 3]),
    ("words_fit_the_tree", "docs/notes.md",
     "as on /home/someone/here\nfound in the last session\nfixes #12\n", [1, 2, 3]),
]

BAD_SOURCES = {
    "globals.cpp": "namespace hrad { int counter = 1;\n"
                   "int& count() { static int calls; return calls; }\n"
                   "struct S { S(); int i; }; S once() { static S made; return made; } }\n",
    "names.cpp": "int outside() { return 1; }\nextern \"C\" int hrad_secret(void) { return 1; }\n",
    "wide_avx2.cpp": "namespace hrad { inline int shared(int i) { return i; }\n"
                     "int (*use())(int) { return shared; } }\n",
}
BAD_SYMBOLS = {
    ("no_mutable_globals", "globals.cpp.o", "hrad::counter"),
    ("no_mutable_globals", "globals.cpp.o", "hrad::count()::calls"),
    ("no_mutable_globals", "globals.cpp.o", "hrad::once()::made"),
    ("no_mutable_globals", "globals.cpp.o", "guard variable for hrad::once()::made"),
    ("exported_names_are_ours", "names.cpp.o", "outside()"),
    ("exported_names_are_ours", "names.cpp.o", "hrad_secret"),
    ("special_code_stays_apart", "wide_avx2.cpp.o", "hrad::shared(int)"),
}


def write(root, files):
    for path, text in files.items():
        path = os.path.join(root, path)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)


def build_archive(root, sources):
    """lib/libhrad.a of the folder build/ from files given by path."""
    out = os.path.join(root, "build", "lib")
    os.makedirs(out)
    # Stands in for the foreign header, which need not be here.
    write(root, {"build/include/hwloc.h": ""})
    objects = []
    for source in sources:
        objects.append(os.path.join(out, os.path.basename(source) + ".o"))
        folders = ["-I" + os.path.join(root, f) for f in ("include", "lib", "build/include")]
        subprocess.run([COMPILER, "-std=c++17", "-O0", "-fPIC", "-DHRAD_API="] + folders +
                       ["-c", source, "-o", objects[-1]], check=True)
    subprocess.run(["ar", "rcs", os.path.join(out, "libhrad.a")] + objects, check=True)


def run_style_test(root):
    """Exit status, last line, and the offences as (rule, path, line, text)."""
    run = subprocess.run([sys.executable, os.path.join(HERE, "test_style.py")],
                         stdout=subprocess.PIPE, env=dict(
                             os.environ, HRAD_SOURCE_DIR=root,
                             HRAD_BINARY_DIR=os.path.join(root, "build")))
    lines = run.stdout.decode().splitlines()
    rule, offences = None, []
    for line in lines:
        head = re.match(r"\[.{6}\] (\w+)$", line)
        offence = re.match(r"  ([^:]+):(\d+): (.*)$", line)
        if head:
            rule = head.group(1)
        elif offence:
            offences.append((rule, offence.group(1), int(offence.group(2)), offence.group(3)))
    return run.returncode, lines[-1] if lines else "", offences


def clean_tree_passes(root):
    write(root, CLEAN)
    build_archive(root, [os.path.join(root, path) for path in CLEAN
                         if path.startswith("lib/") and path.endswith(".cpp")])
    status, last, offences = run_style_test(root)
    return [str(o) for o in offences] + ([] if status == 0 and last == "15 passed, 0 failed" else
                                         ["status %d, '%s'" % (status, last)])


def every_violation_is_found(root):
    write(root, CLEAN)
    write(root, {path: text for _, path, text, _ in VIOLATIONS})
    write(root, {"lib/partition/grid.h": HEAD % (6, "partition")})
    # hrad_two loses its test; the archive has neither of the two functions.
    os.remove(os.path.join(root, "tests/api/test_api.py"))
    write(root, {"build-bad/" + name: text for name, text in BAD_SOURCES.items()})
    build_archive(root, [os.path.join(root, "build-bad", name) for name in BAD_SOURCES])
    expected = {(rule, path, line) for rule, path, _, lines in VIOLATIONS for line in lines}
    # What lies in no folder of the plan has a head that fits none.
    expected.add(("heads_name_the_floor", "lib/cellar/lost.h", 1))
    expected.add(("public_functions_are_tested", "include/hrad/hrad.h", 4))
    expected |= {("public_functions_are_defined", "include/hrad/hrad.h", line) for line in (2, 4)}
    expected |= {(rule, member, 0) for rule, member, _ in BAD_SYMBOLS}

    status, last, offences = run_style_test(root)
    found = {offence[:3] for offence in offences}
    problems = ["not found: %s" % (e,) for e in sorted(expected - found)]
    problems += ["found but not there: %s" % (e,) for e in sorted(found - expected)]
    for rule, member, name in BAD_SYMBOLS:
        if not any(o[0] == rule and o[1] == member and o[3].startswith(name + " ")
                   for o in offences):
            problems.append("not found: %s in %s" % (name, member))
    if status == 0 or last != "0 passed, 15 failed":
        problems.append("status %d, '%s'" % (status, last))
    return problems


def missing_archive_fails(root):
    write(root, CLEAN)
    status, last, _ = run_style_test(root)
    return [] if status != 0 and last == "11 passed, 4 failed" else [last]


def main():
    passed = failed = 0
    for test in (clean_tree_passes, every_violation_is_found, missing_archive_fails):
        with tempfile.TemporaryDirectory() as root:
            problems = test(root)
        print("[%s] %s" % ("FAILED" if problems else "  OK  ", test.__name__))
        for problem in problems:
            print("  " + problem)
        passed, failed = passed + (not problems), failed + bool(problems)
    print("%d passed, %d failed" % (passed, failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
