"""hrad_mpi.h: solvers over the processes of a communicator."""

import ctypes

from ._calls import check
from ._library import load_beside


def create(communicator, solver):
    """Calls hrad_create_mpi_f with a communicator of mpi4py, or with any that has its py2f()."""
    try:
        function = load_beside("hrad_mpi").hrad_create_mpi_f
    except (OSError, AttributeError) as error:
        raise ImportError(f"the shared library libhrad_mpi, which belongs beside libhrad, can't be "
                          f"loaded ({error}): build it with cmake -DHRAD_MPI=ON",
                          name="hrad") from None
    function.restype = ctypes.c_int32
    function.argtypes = [ctypes.c_int, ctypes.POINTER(ctypes.c_void_p)]
    check(function(communicator.py2f(), ctypes.byref(solver)))
