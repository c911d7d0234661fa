"""Calls of the library: arguments are checked, which ctypes would cut to size without a word, and
statuses become exceptions."""

import ctypes
import operator
import os
from ctypes import c_char_p, c_double, c_int32, c_int64

import numpy as np

from ._errors import ArgumentError, failure
from ._library import LIBRARY
from ._prototypes import PROTOTYPES

_RANGES = {c_int32: (-2**31, 2**31 - 1), c_int64: (-2**63, 2**63 - 1)}


def text(name, value):
    """Text or a path, as C takes it."""
    made = os.fsencode(value)
    if b"\0" in made:
        raise ArgumentError(f"{name} holds the character NUL, which would end it: {value!r}")
    return made


def whole(name, value, kind=c_int64):
    """A whole number that fits in its type in C."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} is {value!r}: it must be a whole number") from None
    lowest, highest = _RANGES[kind]
    if not lowest <= number <= highest:
        raise ArgumentError(f"{name} is {number}: it must be from {lowest} to {highest}")
    return number


def _passed(name, kind, value):
    """An argument in the form in which ctypes hands it to C."""
    if kind in _RANGES:
        return whole(name, value, kind)
    if kind is c_double:
        return float(value)
    if kind is c_char_p and value is not None and not isinstance(value, ctypes.Array):
        return text(name, value)
    if isinstance(value, np.ndarray):
        return value.ctypes.data_as(kind)  # keeps the array alive
    return value


def check(status):
    """The status, if it is no error."""
    if status < 0:
        raise failure(status, error_message())
    return status


def call(name, *arguments):
    """Calls hrad_<name>: its status, which is no error, or what else it returns."""
    result, kinds = PROTOTYPES[name]
    passed = [_passed(*kind, value) for kind, value in zip(kinds.items(), arguments)]
    answer = getattr(LIBRARY, "hrad_" + name)(*passed)
    if isinstance(answer, bytes):
        return answer.decode(errors="surrogateescape")
    return check(answer) if result is c_int32 else answer


def text_of(caller, name, *before, after=()):
    """The whole text that hrad_<name> gives, which takes (text, size, needed) between these."""
    size, needed = 1024, c_int64()
    while True:
        buffer = ctypes.create_string_buffer(size)
        caller(name, *before, buffer, size, ctypes.byref(needed), *after)
        if needed.value <= size:
            return os.fsdecode(buffer.value)
        size = needed.value


def version():
    """The library's version as major*10000 + minor*100 + patch."""
    return call("version")


def version_text():
    """The library's version as text, "0.1.0"."""
    return call("version_text")


def status_name(status):
    """The name of a status, "HRAD_OK" for 0; "HRAD_UNKNOWN" for a value not listed."""
    return call("status_name", status)


def error_message():
    """What this thread's last failing call said, "" if none failed: also the message of its Error."""
    return call("error_message")
