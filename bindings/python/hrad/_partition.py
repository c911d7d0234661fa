"""The section "partition and machine" of hrad.h."""

import ctypes

import numpy as np

from ._constants import MOST_RANKS
from ._calls import whole
from ._scene import Scene
from ._structs import CRankLoad


class Partition(Scene):
    """Who owns which patch, plans for several ranks, and this machine."""

    def partition(self):
        """[C] Closes the scene, builds the visibility structure and gives every patch an owner.
        Optional: solve() does it. Errors: SCENE for a scene without patches, smaller than 1e-8,
        larger than 1e11 or more than 1e10 of its radii from the origin; MEMORY."""
        self._call("partition")

    def patch_owner(self, patch):
        """[L] The rank that owns a patch: 0 in a solver of one process. Errors: ARGUMENT for a
        patch out of range, STATE before partition()."""
        rank = ctypes.c_int32()
        self._call("patch_owner", patch, ctypes.byref(rank))
        return rank.value

    def plan_partition(self, method, ranks):
        """[C] before partition(), [L] after it: plans a partition for so many ranks without
        starting them, by the method "grid" or "cost". Returns (owner, loads): owner (patches,),
        int32, a rank per patch, 0 for patches that exchange no light; loads (ranks,), a structured
        array with the fields `patches` (that exchange light), `work` (predicted, in rays), `lower`
        and `upper` (3 each, the box around its patches, in the scene's unit) and `remote` (0 to 1:
        of the light that reaches it, the share from other ranks). Closes the scene as partition()
        does. Errors: those of partition(); ARGUMENT for an unknown method or ranks outside 1 to
        hrad.MOST_RANKS."""
        ranks = whole("ranks", ranks, ctypes.c_int32)
        owner = np.empty(self.scene_size()[0], np.int32)
        loads = np.zeros(min(max(ranks, 1), MOST_RANKS), CRankLoad)
        loads["struct_size"] = loads.itemsize
        self._call("plan_partition", method, ranks, owner, loads)
        return owner, loads[[name for name in loads.dtype.names if name != "struct_size"]]

    def export_partition(self, method, ranks, path):
        """[C] or [L] likewise: writes such a plan as a .vtu file: the patches with `owner`, `work`
        and `patch` as cell data. Errors: those of plan_partition; FILE; ARGUMENT for another
        ending."""
        self._call("export_partition", method, ranks, path)

    def describe_machine(self):
        """[L] What hwloc sees of this machine and the thread pool that this solver would start, as
        text, one `name: value` a line. Works on an empty solver."""
        return self._text("describe_machine")
