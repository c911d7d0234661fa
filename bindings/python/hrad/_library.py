"""The shared library: where it is, and whether it is the one that this module is for."""

import ctypes
import ctypes.util
import os
import sys

from . import _constants
from ._prototypes import PROTOTYPES

try:
    from ._place import LIBRARY_FOLDER  # written when the module was installed
except ImportError:
    LIBRARY_FOLDER = "."

_VERSION = f"{_constants.VERSION_MAJOR}.{_constants.VERSION_MINOR}"
_FILE = f"libhrad.{_VERSION}.dylib" if sys.platform == "darwin" else f"libhrad.so.{_VERSION}"
_ADVICE = ("set the environment variable HRAD_LIBRARY to the path of libhrad.so, which cmake "
           "-DBUILD_SHARED_LIBS=ON builds")


def _candidates():
    """Where to look, in this order."""
    chosen = os.environ.get("HRAD_LIBRARY")
    if chosen:
        yield os.path.abspath(chosen)
        return
    here = os.path.dirname(os.path.abspath(__file__))
    for folder in (here, os.path.normpath(os.path.join(here, LIBRARY_FOLDER))):
        path = os.path.join(folder, _FILE)
        if os.path.exists(path):
            yield path
    yield _FILE  # wherever this system has its libraries
    found = ctypes.util.find_library("hrad")
    if found:
        yield found


def _declare(library):
    """Tells ctypes what the functions take and return."""
    for name, (result, arguments) in PROTOTYPES.items():
        function = getattr(library, "hrad_" + name)
        function.restype = result
        function.argtypes = list(arguments.values())


def _load():
    failures = []
    for path in _candidates():
        try:
            library = ctypes.CDLL(path)
        except OSError as error:
            failures.append(str(error))
            continue
        try:
            version = library.hrad_version()
            # While the first number is 0, the second one marks changes that break programs.
            if version // 100 != _constants.VERSION_MAJOR * 100 + _constants.VERSION_MINOR:
                raise ImportError(f"{path} is libhrad {version // 10000}.{version // 100 % 100}, and "
                                  f"this module needs {_VERSION}: {_ADVICE}", name="hrad")
            _declare(library)
        except AttributeError as error:
            raise ImportError(f"{path} is no libhrad {_VERSION} ({error}): {_ADVICE}",
                              name="hrad") from None
        return library
    raise ImportError("the shared library libhrad can't be loaded ({}): {}".format(
        "; ".join(failures), _ADVICE), name="hrad")


def load_beside(name):
    """Another library of the same build, by its name: hrad_mpi."""
    folder, file = os.path.split(LIBRARY._name)
    return ctypes.CDLL(os.path.join(folder, file.replace("libhrad", "lib" + name, 1)))


LIBRARY = _load()
