"""The functions of a program that the library calls back, and what they raise."""

import threading

from ._prototypes import LOG_FUNCTION, PROGRESS_FUNCTION
from ._structs import Progress, record


class Listener:
    """What one solver's callbacks share: the program's functions, and the exception of one of them,
    which must not fly through the library and waits until the call returns."""

    def __init__(self):
        self.progress = None
        self.log = None
        self._raised = None
        self._thread = None

    def keep(self, error):
        self._raised, self._thread = error, threading.get_ident()

    @property
    def failed(self):
        return self._raised is not None

    def raise_again(self):
        """To be called on return from the library: raises what a callback raised on this thread."""
        if self.failed and self._thread == threading.get_ident():
            error, self._raised = self._raised, None
            raise error


def progress_callback(listener):
    """The progress callback for C; it must be kept as long as C has it."""
    watch = _watch(listener)
    next(watch)
    return PROGRESS_FUNCTION(watch.send)


def _watch(listener):
    """Is sent progress, and answers 1 to stop the solve. What signals raise, as Ctrl-C does, Python
    raises where a function is entered: before its first line, where nobody could catch it. A
    generator is entered inside the `try` in which it waits. It also is there without a function of
    the program's, so that Ctrl-C always works."""
    answer = 0
    while True:
        try:
            while True:
                progress = yield answer
                answer = int(listener.failed)
                if listener.progress and not answer:
                    answer = int(bool(listener.progress(record(Progress, progress.contents))))
        except GeneratorExit:
            return
        except BaseException as error:
            # Without this frame in its traceback: who clears the frames of that, as unittest does,
            # would end the generator.
            listener.keep(error.with_traceback(error.__traceback__.tb_next))
            answer = 1


def log_callback(listener):
    """The log callback for C; it must be kept as long as C has it. An exception stops a solve at
    its next call of the progress callback."""
    def write(level, message, _):
        try:
            if listener.log and not listener.failed:
                listener.log(level, message.decode(errors="surrogateescape"))
        except BaseException as error:
            listener.keep(error)
    return LOG_FUNCTION(write)
