"""How the module finds its library: what HRAD_LIBRARY names, beside the package, where it was installed
and moved to; what it says where there is none, or another version; and what is installed."""

import ctypes.util
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import support


def run(code, packages=support.PACKAGES, **environment):
    """Runs a line of Python in a process of its own."""
    surroundings = {name: value for name, value in os.environ.items()
                    if name not in ("HRAD_LIBRARY", "LD_LIBRARY_PATH")}
    surroundings.update(environment, PYTHONPATH=packages, PYTHONDONTWRITEBYTECODE="1")
    return subprocess.run([sys.executable, "-c", code], env=surroundings, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, universal_newlines=True, timeout=300)


# Says where the library is that was loaded.
WHERE = "import hrad, hrad._library; print(hrad._library.LIBRARY._name)"
NAME = "libhrad.so.0.1"


class Loading(unittest.TestCase):
    def setUp(self):
        self.folder = os.path.realpath(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def build(self, name, code):
        """A shared library of one line of C."""
        with open(self.path("source.c"), "w", encoding="utf-8") as file:
            file.write(code)
        subprocess.run(["cc", "-shared", "-fPIC", "-o", self.path(name), self.path("source.c")],
                       check=True)
        return self.path(name)

    def assert_refused(self, done, *words):
        self.assertNotEqual(done.returncode, 0)
        last = done.stderr.strip().splitlines()[-1]
        for word in ("ImportError: ", "HRAD_LIBRARY", "BUILD_SHARED_LIBS=ON", *words):
            self.assertIn(word, last)

    def test_environment_names_it(self):
        done = run(WHERE, HRAD_LIBRARY=support.LIBRARY)
        self.assertEqual(done.stdout.strip(), support.LIBRARY, done.stderr)

    def test_environment_may_name_it_from_the_current_folder(self):
        shutil.copy(support.LIBRARY, self.path("mine.so"))
        done = run("import os; os.chdir(%r); %s" % (self.folder, WHERE), HRAD_LIBRARY="mine.so")
        self.assertEqual(done.stdout.strip(), self.path("mine.so"), done.stderr)

    def test_what_the_environment_names_is_not_there(self):
        missing = self.path("missing.so")
        self.assert_refused(run(WHERE, HRAD_LIBRARY=missing), missing)

    def test_there_is_none_anywhere(self):
        if not ctypes.util.find_library("hrad"):
            self.assert_refused(run(WHERE), "can't be loaded", NAME)

    def test_another_version(self):
        for version in (0, 200, 10100):
            old = self.build("old.so", "int hrad_version(void) { return %d; }" % version)
            self.assert_refused(run(WHERE, HRAD_LIBRARY=old), old, "needs 0.1")

    def test_another_patch_of_the_version_will_do(self):
        newer = self.build("newer.so", "int hrad_version(void) { return 107; }")
        self.assert_refused(run(WHERE, HRAD_LIBRARY=newer), "hrad_version_text")  # the next function

    def test_another_library(self):
        other = self.build("other.so", "int nothing(void) { return 0; }")
        self.assert_refused(run(WHERE, HRAD_LIBRARY=other), other, "no libhrad 0.1")

    def test_beside_the_package(self):
        shutil.copytree(support.PACKAGES, self.path("packages"))
        shutil.copy(support.LIBRARY, self.path("packages", "hrad", NAME))
        done = run(WHERE, self.path("packages"))
        self.assertEqual(done.stdout.strip(), self.path("packages", "hrad", NAME), done.stderr)

    def test_by_the_loader(self):
        shutil.copy(support.LIBRARY, self.path(NAME))
        done = run(WHERE, LD_LIBRARY_PATH=self.folder)
        self.assertEqual(done.stdout.strip(), NAME, done.stderr)

    def test_installed_and_moved(self):
        for libdir, python_dir in (("lib/some-machine-gnu", "lib/python3/dist-packages"),
                                   ("lib", "python")):
            before, after = self.path("before"), self.path("after")
            subprocess.run(
                ["cmake", "-S", support.SOURCE, "-B", self.path("configured"), "-DHRAD_TESTS=OFF",
                 "-DHRAD_EMBREE=OFF", "-DHRAD_FORTRAN=OFF", "-DHRAD_MPI=OFF",
                 "-DBUILD_SHARED_LIBS=ON", "-DCMAKE_INSTALL_LIBDIR=" + libdir,
                 "-DHRAD_PYTHON_DIR=" + python_dir], check=True, stdout=subprocess.DEVNULL)
            subprocess.run(["cmake", "--install", self.path("configured"), "--prefix", before,
                            "--component", "python"], check=True, stdout=subprocess.DEVNULL)
            os.rename(before, after)
            os.makedirs(os.path.join(after, libdir), exist_ok=True)
            library = os.path.join(after, libdir, NAME)
            shutil.copy(support.LIBRARY, library)
            done = run(WHERE, os.path.join(after, python_dir))
            self.assertEqual(done.stdout.strip(), library, done.stderr)
            # The whole package and nothing else.
            wanted = {name for name in os.listdir(os.path.join(support.PACKAGES, "hrad"))
                      if name.endswith(".py")}
            installed = set(os.listdir(os.path.join(after, python_dir, "hrad")))
            self.assertEqual(installed, wanted | {"_place.py"})
            self.assertEqual(os.listdir(os.path.join(after, python_dir)), ["hrad"])
            shutil.rmtree(after)
            shutil.rmtree(self.path("configured"))

    def test_without_the_other_library_there_is_no_mpi(self):
        shutil.copy(support.LIBRARY, self.path(NAME))
        done = run("import hrad; hrad.Solver(object())", HRAD_LIBRARY=self.path(NAME))
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("ImportError: the shared library libhrad_mpi", done.stderr)


if __name__ == "__main__":
    unittest.main()
