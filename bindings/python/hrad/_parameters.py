"""The section "parameters" of hrad.h."""

import ctypes

from ._calls import call
from ._constants import PARAM_DOUBLE, PARAM_INT, PARAM_TEXT
from ._errors import ArgumentError
from ._handle import Handle
from ._structs import CParam, Param, record, sized


def describe_param(index):
    """Row `index` (from 0) of the table of parameters, as a Param. Errors: ARGUMENT past its end."""
    row = sized(CParam)
    call("describe_param", index, ctypes.byref(row))
    return record(Param, row)


def params():
    """The whole table of parameters, a list of Param."""
    rows = []
    while True:
        try:
            rows.append(describe_param(len(rows)))
        except ArgumentError:
            return rows


class Parameters(Handle):
    """Parameters by their names: solver["accuracy"] = 0.05, or by the functions of C."""

    def __setitem__(self, name, value):
        """[C] Sets a parameter to a number or text; Errors: as for set_int."""
        if isinstance(value, bool):
            value = int(value)
        self.set_text(name, str(value))

    def __getitem__(self, name):
        """[L] A parameter as int, float or str, whichever is its type. Errors: ARGUMENT for an
        unknown name."""
        kind = next((row.type for row in params() if row.name == name), PARAM_TEXT)
        read = {PARAM_INT: self.get_int, PARAM_DOUBLE: self.get_double, PARAM_TEXT: self.get_text}
        return read[kind](name)

    def set_int(self, name, value):
        """[C] Sets a parameter whose type is int. Errors: ARGUMENT for an unknown name, a wrong
        type or a value out of range (the message names the range); STATE for a result parameter
        after solve() has begun, unless it is a smaller `accuracy`, a larger `max_iterations`,
        `refine`, or the value it already has. `bands` only before the first material, `visibility`
        only before partition()."""
        self._call("set_int", name, value)

    def set_double(self, name, value):
        """[C] Sets a parameter whose type is double. Errors: as for set_int."""
        self._call("set_double", name, value)

    def set_text(self, name, value):
        """[C] Sets a parameter of any type from its text form ("0.02", "rows"). Errors: as for
        set_int."""
        self._call("set_text", name, value)

    def get_int(self, name):
        """[L] A parameter whose type is int. Errors: ARGUMENT for an unknown name or another type."""
        value = ctypes.c_int64()
        self._call("get_int", name, ctypes.byref(value))
        return value.value

    def get_double(self, name):
        """[L] A parameter whose type is double. Errors: ARGUMENT for an unknown name or another
        type."""
        value = ctypes.c_double()
        self._call("get_double", name, ctypes.byref(value))
        return value.value

    def get_text(self, name):
        """[L] A parameter of any type as text. Errors: ARGUMENT for an unknown name."""
        return self._text("get_text", name)
