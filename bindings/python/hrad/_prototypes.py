"""The functions of hrad.h as ctypes must call them."""

import ctypes
from ctypes import POINTER, c_char_p, c_double, c_int32, c_int64, c_uint64, c_void_p

from ._structs import CMaterial, CParam, CPatch, CProgress, CRankLoad, CStats

LOG_FUNCTION = ctypes.CFUNCTYPE(None, c_int32, c_char_p, c_void_p)
# C hands on a second argument, `user`, which is NULL here and is left lying where arguments lie: what
# is called is the `send` of a generator, which takes one (see _callbacks.py).
PROGRESS_FUNCTION = ctypes.CFUNCTYPE(c_int32, POINTER(CProgress))

_SOLVER, _TEXT, _DOUBLES = c_void_p, c_char_p, POINTER(c_double)

# Name less hrad_ -> what it returns, and its arguments by name, in order, as in hrad.h.
PROTOTYPES = {
    "version": (c_int32, {}),
    "version_text": (c_char_p, {}),
    "status_name": (c_char_p, dict(status=c_int32)),
    "error_message": (c_char_p, {}),
    "set_log": (c_int32, dict(solver=_SOLVER, function=LOG_FUNCTION, user=c_void_p, level=c_int32)),
    "create": (c_int32, dict(solver=POINTER(_SOLVER))),
    "destroy": (None, dict(solver=POINTER(_SOLVER))),
    "set_int": (c_int32, dict(solver=_SOLVER, name=_TEXT, value=c_int64)),
    "set_double": (c_int32, dict(solver=_SOLVER, name=_TEXT, value=c_double)),
    "set_text": (c_int32, dict(solver=_SOLVER, name=_TEXT, value=_TEXT)),
    "get_int": (c_int32, dict(solver=_SOLVER, name=_TEXT, value=POINTER(c_int64))),
    "get_double": (c_int32, dict(solver=_SOLVER, name=_TEXT, value=_DOUBLES)),
    "get_text": (c_int32, dict(solver=_SOLVER, name=_TEXT, text=_TEXT, size=c_int64,
                               needed=POINTER(c_int64))),
    "describe_param": (c_int32, dict(index=c_int64, param=POINTER(CParam))),
    "add_material": (c_int32, dict(solver=_SOLVER, material=POINTER(CMaterial),
                                   number=POINTER(c_int32))),
    "add_patches": (c_int32, dict(solver=_SOLVER, n_vertices=c_int64, xyz=_DOUBLES,
                                  n_triangles=c_int64, vertex=POINTER(c_int64),
                                  material=POINTER(c_int32))),
    "load_scene": (c_int32, dict(solver=_SOLVER, path=_TEXT)),
    "make_scene": (c_int32, dict(solver=_SOLVER, name=_TEXT)),
    "scene_name": (c_char_p, dict(index=c_int64)),
    "scene_size": (c_int32, dict(solver=_SOLVER, patches=POINTER(c_int64),
                                 materials=POINTER(c_int64))),
    "get_patch": (c_int32, dict(solver=_SOLVER, patch=c_int64, out=POINTER(CPatch))),
    "get_material": (c_int32, dict(solver=_SOLVER, material=c_int32, name=_TEXT, size=c_int64,
                                   needed=POINTER(c_int64), reflectance=_DOUBLES,
                                   emission=_DOUBLES, flags=POINTER(c_int32))),
    "get_diagnostic": (c_int32, dict(solver=_SOLVER, index=c_int64, text=_TEXT, size=c_int64,
                                     needed=POINTER(c_int64))),
    "set_emission": (c_int32, dict(solver=_SOLVER, first_patch=c_int64, count=c_int64,
                                   emission=_DOUBLES)),
    "set_reflectance": (c_int32, dict(solver=_SOLVER, first_patch=c_int64, count=c_int64,
                                      reflectance=_DOUBLES)),
    "partition": (c_int32, dict(solver=_SOLVER)),
    "patch_owner": (c_int32, dict(solver=_SOLVER, patch=c_int64, rank=POINTER(c_int32))),
    "plan_partition": (c_int32, dict(solver=_SOLVER, method=_TEXT, ranks=c_int32,
                                     owner=POINTER(c_int32), loads=POINTER(CRankLoad))),
    "export_partition": (c_int32, dict(solver=_SOLVER, method=_TEXT, ranks=c_int32, path=_TEXT)),
    "describe_machine": (c_int32, dict(solver=_SOLVER, text=_TEXT, size=c_int64,
                                       needed=POINTER(c_int64))),
    "set_progress": (c_int32, dict(solver=_SOLVER, function=PROGRESS_FUNCTION, user=c_void_p)),
    "solve": (c_int32, dict(solver=_SOLVER)),
    "request_stop": (None, dict(solver=_SOLVER)),
    "get_stats": (c_int32, dict(solver=_SOLVER, stats=POINTER(CStats))),
    "state_hash": (c_int32, dict(solver=_SOLVER, hash=POINTER(c_uint64))),
    "query_patches": (c_int32, dict(solver=_SOLVER, quantity=c_int32, side=c_int32, first=c_int64,
                                    count=c_int64, out=_DOUBLES)),
    "query_points": (c_int32, dict(solver=_SOLVER, quantity=c_int32, side=c_int32, count=c_int64,
                                   patch=POINTER(c_int64), uv=_DOUBLES, out=_DOUBLES)),
    "query_sensors": (c_int32, dict(solver=_SOLVER, count=c_int64, xyz=_DOUBLES, normal=_DOUBLES,
                                    irradiance=_DOUBLES, standard_error=_DOUBLES)),
    "leaf_count": (c_int32, dict(solver=_SOLVER, count=POINTER(c_int64))),
    "query_leaves": (c_int32, dict(solver=_SOLVER, first=c_int64, count=c_int64,
                                   patch=POINTER(c_int64), face=POINTER(c_int64),
                                   side=POINTER(c_int32), corners_xyz=_DOUBLES, area=_DOUBLES,
                                   radiosity=_DOUBLES)),
    "power_balance": (c_int32, dict(solver=_SOLVER, emitted=_DOUBLES, absorbed=_DOUBLES,
                                    absorbed_back=_DOUBLES, escaped=_DOUBLES)),
    "write_checkpoint": (c_int32, dict(solver=_SOLVER, path=_TEXT)),
    "lock_checkpoint": (c_int32, dict(solver=_SOLVER, path=_TEXT)),
    "read_checkpoint": (c_int32, dict(solver=_SOLVER, path=_TEXT)),
    "describe_checkpoint": (c_int32, dict(path=_TEXT, text=_TEXT, size=c_int64,
                                          needed=POINTER(c_int64))),
    "export": (c_int32, dict(solver=_SOLVER, path=_TEXT)),
}
