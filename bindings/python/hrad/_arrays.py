"""Arrays between NumPy and C: checked, and passed as they are wherever C can use them so."""

import numpy as np

from ._errors import ArgumentError


def _require_shape(name, found, wanted):
    """wanted: extents, None for any."""
    if len(found) != len(wanted) or any(w not in (None, f) for f, w in zip(found, wanted)):
        extents = ", ".join("any" if w is None else str(w) for w in wanted)
        comma = "," if len(wanted) == 1 else ""
        raise ArgumentError(f"{name} has the shape {tuple(found)}: it must be ({extents}{comma})")


def given(name, value, shape, dtype=np.float64):
    """What a caller gives as an array of this shape, for C to read: itself if it is one of this type in
    C order, else a copy. Numbers are never cut: a real number is no index."""
    try:
        array = np.asarray(value)
    except ValueError:
        raise ArgumentError(f"{name} is no array: its rows differ in length") from None
    if array.size == 0 and not isinstance(value, np.ndarray):
        array = array.astype(dtype)  # an empty list has no type
    if not np.can_cast(array.dtype, dtype, "same_kind"):
        raise ArgumentError(f"{name} has values of type {array.dtype}: it must have "
                            f"{np.dtype(dtype)}")
    _require_shape(name, array.shape, shape)
    made = np.require(array, dtype, ("C_CONTIGUOUS", "ALIGNED"))
    if made.dtype.kind == "i" and made is not array and (made != array).any():
        raise ArgumentError(f"{name} has a number beyond {made.dtype}")
    return made


def result(name, out, shape, dtype=np.float64):
    """The array for C to write a result to: `out` as it is, or a new one for None."""
    if out is None:
        return np.empty(shape, dtype)
    if not isinstance(out, np.ndarray):
        raise ArgumentError(f"{name} is {type(out).__name__}: it must be a NumPy array")
    _require_shape(name, out.shape, shape)
    if out.dtype != dtype:
        raise ArgumentError(f"{name} has values of type {out.dtype}: it must have "
                            f"{np.dtype(dtype)}")
    if not (out.flags.c_contiguous and out.flags.aligned and out.flags.writeable):
        raise ArgumentError(f"{name} must be writeable and in C order, without gaps")
    return out


def span(noun, first, count, total):
    """How many items from `first` on: count, or all that follow for None; they must be there."""
    if count is None:
        count = max(total - first, 0)
    if first < 0 or count < 0 or first + count > total:
        raise ArgumentError(f"{count} {noun} from {first} on: there are {total}, from 0 on")
    return count
