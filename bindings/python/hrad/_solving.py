"""The section "solve" of hrad.h."""

import ctypes

from ._calls import call
from ._handle import Handle
from ._structs import CStats, Stats, record, sized


class Solving(Handle):
    """The solve, what it tells meanwhile, and its counts afterwards."""

    def set_progress(self, function):
        """[L] Sets the progress function, None for none: function(progress) is called with a
        Progress at every safe point, which may be a thousand times a second, on the thread that
        called solve(), on rank 0; what is true stops the solve. What it raises stops the solve too,
        and solve() raises it. It must not call methods of the solver that called it, which answer
        STATE, except request_stop and write_checkpoint."""
        self._listener.progress = function

    def solve(self):
        """[C] Solves: linking, then refinement and sweeps until the radiosity transported stands
        still and the accuracy is met; goes on from the present state if there is one. With the
        parameter refine = 0, for a new emission or reflectance: sweeps from B = E over the present
        mesh and links alone. Returns hrad.OK, hrad.NOT_CONVERGED or hrad.STOPPED (call it again to
        go on; the queries answer from the last whole round, or STATE when there is none).

        Other threads of Python run meanwhile, and may use other solvers. An exception of a callback,
        and of a signal such as Ctrl-C, stops the solve and is raised here; it can go on afterwards.

        Errors: SCENE for an empty scene, STATE for refine = 0 without links, UNSUPPORTED for a method
        that is not in this build, MEMORY; after MEMORY the solution is gone and the scene and the
        parameters stay."""
        return self._call("solve")

    def request_stop(self):
        """[L] Asks a running solve() to stop at the next safe point; the flag is taken back when a
        solve returns. From any thread."""
        call("request_stop", self._solver)

    def get_stats(self):
        """[C] Counts and times so far, as Stats; zeros before a solve. After a solve with refine =
        0 the first call measures error and balance by rays."""
        stats = sized(CStats)
        self._call("get_stats", ctypes.byref(stats))
        return record(Stats, stats)

    def state_hash(self):
        """[C] A hash of scene, result parameters, tree, links and radiosity, a number of 64 bits,
        which the tool `hrad` prints as f"{hash:016x}"; the same for any number of ranks and
        threads. Errors: STATE before a solve."""
        value = ctypes.c_uint64()
        self._call("state_hash", ctypes.byref(value))
        return value.value
