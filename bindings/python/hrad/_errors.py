"""Failures of the library as exceptions."""

from . import _constants


class Error(Exception):
    """A call that failed: `status` is a negative constant such as hrad.ERROR_FILE, `message` says what
    happened, where, and what to do. The solver is as it was before the call, unless the method says
    otherwise."""

    def __init__(self, status, message):
        super().__init__(status, message)
        self.status = status
        self.message = message

    def __str__(self):
        return f"{self.message} ({_NAMES.get(self.status, self.status)})"


class ArgumentError(Error, ValueError):
    """The Error for hrad.ERROR_ARGUMENT: a value out of range, an unknown name, an array of another
    shape or type."""

    def __init__(self, status, message=None):
        # One argument: found by this module, before the library was called.
        if message is None:
            status, message = _constants.ERROR_ARGUMENT, status
        super().__init__(status, message)


_NAMES = {value: "HRAD_" + name for name, value in vars(_constants).items()
          if name.startswith("ERROR_")}


def failure(status, message):
    """The exception for a negative status."""
    kind = ArgumentError if status == _constants.ERROR_ARGUMENT else Error
    return kind(status, message)
