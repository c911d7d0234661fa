"""The structs of hrad.h for ctypes, and the named tuples as which Python programs see them."""

import ctypes
from ctypes import c_char_p, c_double, c_int32, c_int64, c_size_t
from typing import NamedTuple, Optional

import numpy as np


class CParam(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("name", c_char_p), ("type", c_int32),
                ("is_result", c_int32), ("default_text", c_char_p), ("minimum", c_double),
                ("maximum", c_double), ("choices", c_char_p), ("unit", c_char_p),
                ("help", c_char_p)]


class CMaterial(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("reflectance", ctypes.POINTER(c_double)),
                ("emission", ctypes.POINTER(c_double)), ("flags", c_int32), ("name", c_char_p)]


class CPatch(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("corners_xyz", c_double * 9), ("area", c_double),
                ("face", c_int64), ("material", c_int32), ("flags", c_int32)]


class CRankLoad(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("patches", c_int64), ("work", c_double),
                ("lower", c_double * 3), ("upper", c_double * 3), ("remote", c_double)]


class CProgress(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("stage", c_char_p), ("iteration", c_int64),
                ("fraction", c_double), ("seconds", c_double), ("seconds_left", c_double)]


class CStats(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("converged", c_int32), ("ranks", c_int32),
                ("threads", c_int32), ("up_axis", c_int32), ("rounds", c_int64),
                ("iterations", c_int64), ("patches", c_int64), ("elements", c_int64),
                ("leaves", c_int64), ("links", c_int64), ("rays", c_int64), ("pairs", c_int64),
                ("area", c_double), ("sealed_area", c_double), ("back_share", c_double),
                ("error_estimate", c_double), ("error_standard_error", c_double),
                ("seconds_load", c_double), ("seconds_initial", c_double),
                ("seconds_linking", c_double), ("seconds_iterative", c_double),
                ("seconds_output", c_double), ("cpu_seconds", c_double),
                ("memory_peak_bytes", c_int64), ("link_bytes", c_int64), ("node_bytes", c_int64),
                ("messages", c_int64 * 3), ("message_bytes", c_int64 * 3),
                ("swept_links", c_int64)]


class Param(NamedTuple):
    """One row of the table of parameters."""

    name: str
    type: int  # hrad.PARAM_INT, PARAM_DOUBLE, PARAM_TEXT
    is_result: int  # 1: decides the bits of the result; 0: a run parameter
    default_text: str  # the default, as Solver.set_text takes it
    minimum: float  # allowed range, both included; 0, 0 for text
    maximum: float
    choices: Optional[str]  # for text: the allowed words separated by '|', or None: any text
    unit: str  # "" where there is none
    help: str  # one sentence


class Material(NamedTuple):
    """A material, as loaded."""

    reflectance: np.ndarray  # (bands,), in [0, 1)
    emission: np.ndarray  # (bands,), W/m2
    flags: int  # hrad.TWO_SIDED | hrad.BLOCKER
    name: str


class Patch(NamedTuple):
    """One patch."""

    corners_xyz: np.ndarray  # (3, 3): corner, axis; anticlockwise seen from the front
    area: float  # of one side, in the square of the scene's unit; 0 when dropped
    face: int  # number of the face in its OBJ file, from 0; else the patch's number
    material: int
    flags: int  # hrad.PATCH_DROPPED | PATCH_TWO_SIDED | PATCH_BLOCKER


class Progress(NamedTuple):
    """How far a solve has come."""

    stage: str  # "initial", "linking", "refine", "sweep", "measure"
    iteration: int  # sweeps done
    fraction: float  # of the whole solve, 0 to 1, never falling within one solve
    seconds: float  # since the solve began
    seconds_left: float  # estimate; negative while unknown


class Stats(NamedTuple):
    """Counts and times so far."""

    converged: int  # 1 when the last solve returned hrad.OK
    ranks: int
    threads: int  # of this rank; rays to pairs below are those of all ranks
    up_axis: int  # of the scene: 1 y, 2 z; 0 where nobody has said
    rounds: int  # of refinement
    iterations: int  # sweeps
    patches: int
    elements: int  # all nodes of the hierarchy
    leaves: int
    links: int
    rays: int  # visibility, exposure and measuring rays together
    pairs: int  # pairs of patches whose form factor the linking stage computed
    area: float  # in the square of the scene's unit, both sides of two-sided surfaces
    sealed_area: float
    back_share: float  # of measuring rays: those that met a black back, 0 to 1
    error_estimate: float  # what `accuracy` promises; negative when not measured
    error_standard_error: float
    seconds_load: float
    seconds_initial: float
    seconds_linking: float
    seconds_iterative: float
    seconds_output: float
    cpu_seconds: float  # user CPU spent in solves, of all ranks together
    memory_peak_bytes: int  # of the rank that needed most, as the next two
    link_bytes: int
    node_bytes: int
    # (3,), between ranks: ids of elements asked for; their radiosity; totals.
    messages: np.ndarray
    message_bytes: np.ndarray
    swept_links: int  # of the links, those that sweeps read; the rest is for single points


class Leaves(NamedTuple):
    """Leaves in key order (patch, side, path); None for what was not asked for."""

    patch: np.ndarray  # (count,), int64
    face: np.ndarray  # (count,), int64
    side: np.ndarray  # (count,), int32: hrad.FRONT, hrad.BACK
    corners_xyz: np.ndarray  # (count, 3, 3): leaf, corner, axis; anticlockwise seen from its side
    area: np.ndarray  # (count,), in the square of the scene's unit
    radiosity: np.ndarray  # (count, bands), W/m2, means


class PowerBalance(NamedTuple):
    """Power in W, (bands,) each: emitted = absorbed + absorbed_back + escaped."""

    emitted: np.ndarray
    absorbed: np.ndarray  # by fronts
    absorbed_back: np.ndarray  # by black backs, blockers and inside sealed contacts
    escaped: np.ndarray  # to the outside


def sized(struct):
    """An empty struct of this class that knows its size."""
    return struct(struct_size=ctypes.sizeof(struct))


def record(kind, struct):
    """The named tuple with the values of a struct, which are copied."""
    values = {}
    for name in kind._fields:
        value = getattr(struct, name)
        if isinstance(value, bytes):
            value = value.decode()
        elif isinstance(value, ctypes.Array):
            value = np.array(value).reshape((3, -1) if name == "corners_xyz" else -1)
        values[name] = value
    return kind(**values)
