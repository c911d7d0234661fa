"""hrad - hierarchical radiosity: the light (or heat) that bounces between diffuse surfaces.

All of libhrad for Python, under the names of C less hrad_ and HRAD_; hrad.h is the manual of what the
functions do, the docstrings here tell shapes, units and errors. A whole program:

    import hrad

    with hrad.Solver() as solver:
        solver.make_scene("cornell")
        solver["accuracy"] = 0.05
        solver.solve()
        power, front, back, escaped = solver.power_balance()
        print(f"emitted {power[0]:.3f} W, absorbed {front[0] + back[0]:.3f} W")

FUNCTIONS of a solver are methods of Solver; what they give back in C through pointers they return,
several values as a tuple, structs as named tuples. Counts that an array tells are no arguments.
params(), scene_names(), Solver.diagnostics() and solver["name"] are beyond C.

ARRAYS are NumPy's, of float64 (int64 for numbers of patches and vertices, int32 for materials and
sides), one row a patch or point: values (count, bands), xyz (count, 3). C reads them where they lie,
if they are of this type and in C order; anything else that NumPy makes an array of is copied first.
C writes results straight into arrays that are new, or given as `out`. Patches, vertices, materials,
leaves and rows of tables count from 0.

ERRORS are raised as Error with the library's message and its status, ArgumentError (a ValueError too)
where that is ERROR_ARGUMENT. Nothing has changed then. Positive statuses are no errors: solve()
returns them.

CALLBACKS: Solver.set_progress, Solver.set_log. What they raise stops the solve and is raised by the
method that was called; so is KeyboardInterrupt.

THREADS of Python run while the library works. Different solvers may be used from different threads at
the same time; one solver is used by one thread at a time, but for Solver.request_stop.

THE LIBRARY is a shared libhrad of the same version, 0.1: the file that the environment variable
HRAD_LIBRARY names, else the one beside this package or where it was installed with it, else the
system's.
"""

from ._calls import error_message, status_name, version, version_text
from ._constants import (
    BACK, BLOCKER, EMISSION, ERROR_ARGUMENT, ERROR_FILE, ERROR_FORMAT, ERROR_INTERNAL, ERROR_MEMORY,
    ERROR_MPI, ERROR_SCENE, ERROR_STATE, ERROR_UNSUPPORTED, FRONT, IRRADIANCE, LOG_DEBUG, LOG_ERROR,
    LOG_INFO, LOG_WARNING, MOST_RANKS, NET_FLUX, NOT_CONVERGED, OK, PARAM_DOUBLE, PARAM_INT,
    PARAM_TEXT, PATCH_BLOCKER, PATCH_DROPPED, PATCH_TWO_SIDED, RADIOSITY, STOPPED, TWO_SIDED,
    VERSION_MAJOR, VERSION_MINOR, VERSION_PATCH)
from ._errors import ArgumentError, Error
from ._files import describe_checkpoint
from ._parameters import describe_param, params
from ._scene import scene_name, scene_names
from ._solver import Solver
from ._structs import Leaves, Material, Param, Patch, PowerBalance, Progress, Stats

__version__ = f"{VERSION_MAJOR}.{VERSION_MINOR}.{VERSION_PATCH}"
__all__ = [name for name in dir() if not name.startswith("_")]
