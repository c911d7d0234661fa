"""The section "query" of hrad.h. Results are new arrays, or those given as out, straight from C."""

import ctypes

import numpy as np

from ._arrays import given, result, span
from ._constants import FRONT
from ._errors import ArgumentError
from ._scene import Scene
from ._structs import Leaves, PowerBalance


class Queries(Scene):
    """Quantities: hrad.RADIOSITY (leaving), IRRADIANCE (arriving), EMISSION, NET_FLUX (leaving
    minus arriving), in W/m2. Sides: hrad.FRONT, BACK."""

    def query_patches(self, quantity, side=FRONT, first=0, count=None, out=None):
        """[C] The mean of a quantity over each of `count` patches (None: all) from `first` on:
        (count, bands). The back of a one-sided patch and a blocker answer 0. out: a float64 array
        of this shape to write to. Errors: ARGUMENT for ranges; STATE before a solve (EMISSION
        always works)."""
        count = span("patches", first, count, self.scene_size()[0])
        out = result("out", out, (count, self._bands()))
        self._call("query_patches", quantity, side, first, count, out)
        return out

    def query_points(self, quantity, patch, uv, side=FRONT, out=None):
        """[C] A quantity at points of patches: point i lies at (1-u-v)*corner0 + u*corner1 +
        v*corner2 of patch[i] with u, v = uv[i], u, v >= 0, u + v <= 1. patch (count,), whole
        numbers; uv (count, 2); returns (count, bands). Linear reconstruction from the leaves; a
        sealed point answers B = E, H = 0. Errors: as for query_patches."""
        patch = given("patch", patch, (None,), np.int64)
        uv = given("uv", uv, (len(patch), 2))
        out = result("out", out, (len(patch), self._bands()))
        self._call("query_points", quantity, side, len(patch), patch, uv, out)
        return out

    def query_sensors(self, xyz, normal, irradiance=None, standard_error=None):
        """[C] Irradiance in W/m2 at free points: xyz and normal (count, 3), in the scene's unit (a
        normal need not have length 1, but not 0). Returns (irradiance, standard_error), (count,
        bands) each; the arguments of these names are float64 arrays of this shape to write to. By
        rays to the solved leaves; their number grows as accuracy falls. Errors: ARGUMENT; STATE
        before a solve."""
        xyz = given("xyz", xyz, (None, 3))
        normal = given("normal", normal, (len(xyz), 3))
        shape = (len(xyz), self._bands())
        irradiance = result("irradiance", irradiance, shape)
        standard_error = result("standard_error", standard_error, shape)
        self._call("query_sensors", len(xyz), xyz, normal, irradiance, standard_error)
        return irradiance, standard_error

    def leaf_count(self):
        """[C] The number of leaves (a two-sided patch has those of both sides). Errors: STATE
        before a solve."""
        count = ctypes.c_int64()
        self._call("leaf_count", ctypes.byref(count))
        return count.value

    def query_leaves(self, first=0, count=None, fields=Leaves._fields):
        """[C] `count` leaves (None: all) from `first` on, as Leaves. fields: the names of the
        arrays that are wanted; the others are None. Errors: ARGUMENT for ranges; STATE before a
        solve."""
        unknown = set(fields) - set(Leaves._fields)
        if unknown:
            raise ArgumentError(f"leaves have no field {unknown.pop()!r}: they have "
                                f"{', '.join(Leaves._fields)}")
        count = span("leaves", first, count, self.leaf_count())
        shapes = Leaves(patch=(), face=(), side=(), corners_xyz=(3, 3), area=(),
                        radiosity=(self._bands(),))
        types = Leaves(patch=np.int64, face=np.int64, side=np.int32, corners_xyz=np.float64,
                       area=np.float64, radiosity=np.float64)
        leaves = Leaves(*(np.empty((count, *shape), dtype) if name in fields else None
                          for name, shape, dtype in zip(Leaves._fields, shapes, types)))
        self._call("query_leaves", first, count, *leaves)
        return leaves

    def power_balance(self):
        """[C] Power in W per band, as PowerBalance: emitted, absorbed by fronts, absorbed by backs
        and the like, escaped; each is measured by its own links or rays. Errors: STATE before a
        solve, or when emission or reflectance changed before a solve with refine = 0 was asked for
        it."""
        balance = PowerBalance(*np.empty((4, self._bands())))
        self._call("power_balance", *balance)
        return balance
