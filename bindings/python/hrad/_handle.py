"""The sections "create" and "log" of hrad.h: the solver's handle and its life."""

import ctypes
import warnings

from . import _callbacks, _mpi
from ._calls import call, error_message, text_of
from ._constants import ERROR_STATE, LOG_INFO
from ._errors import Error
from ._prototypes import LOG_FUNCTION


class Handle:
    """What all sections stand on: the handle, and calls with it."""

    def __init__(self, communicator=None):
        self._solver = ctypes.c_void_p()
        self._ranks_agree = communicator is not None
        if communicator is None:
            call("create", ctypes.byref(self._solver))
        else:
            _mpi.create(communicator, self._solver)
        # C has the two callbacks: they must live as long as the solver.
        self._listener = _callbacks.Listener()
        self._progress_callback = _callbacks.progress_callback(self._listener)
        self._log_callback = _callbacks.log_callback(self._listener)
        self._call("set_progress", self._progress_callback, None)

    def _call(self, name, *arguments):
        """Calls hrad_<name> of this solver; what a callback raised meanwhile is raised here."""
        try:
            return call(name, self._solver, *arguments)
        finally:
            self._listener.raise_again()

    def _text(self, name, *before, after=()):
        """The text that hrad_<name> of this solver gives."""
        return text_of(self._call, name, *before, after=after)

    def _bands(self):
        bands = ctypes.c_int64()
        self._call("get_int", "bands", ctypes.byref(bands))
        return bands.value

    def destroy(self):
        """[C] Frees the solver and everything in it; all its methods but this one fail from then
        on. The end of a `with` block does it, and so does Python when it drops a solver, except one
        over MPI, whose ranks must do it together. Errors: STATE from a callback of the same solver,
        which lives on."""
        call("destroy", ctypes.byref(self._solver))
        if self._solver:
            raise Error(ERROR_STATE, error_message())

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.destroy()

    def __del__(self):
        if getattr(self, "_solver", None):
            if self._ranks_agree:
                warnings.warn("a solver over MPI was dropped: destroy it, or use it in a `with` "
                              "block", ResourceWarning, source=self)
            else:
                self.destroy()

    def set_log(self, function, level=LOG_INFO):
        """[L] From now on every message of a level up to `level` (hrad.LOG_ERROR, LOG_WARNING,
        LOG_INFO, LOG_DEBUG) goes to function(level, message), without a newline at its end, on the
        thread that called the solver; None turns messages off (the default). What the function
        raises, the method raises that was called. Errors: ARGUMENT for another level."""
        self._call("set_log", self._log_callback if function else LOG_FUNCTION(), None, level)
        self._listener.log = function
