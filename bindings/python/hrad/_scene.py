"""The section "load" of hrad.h: materials, patches and what is doubtful in them."""

import ctypes

import numpy as np

from ._arrays import given
from ._calls import call, text, whole
from ._errors import ArgumentError
from ._handle import Handle
from ._structs import CMaterial, CPatch, Material, Patch, record, sized


def scene_name(index):
    """The name of built-in scene `index` (from 0), None past the last."""
    return call("scene_name", index)


def scene_names():
    """The names of all built-in scenes, a list."""
    names = []
    while True:
        name = scene_name(len(names))
        if name is None:
            return names
        names.append(name)


class Scene(Handle):
    """Scenes from arrays, OBJ files or built-in ones."""

    def add_material(self, reflectance=None, emission=None, flags=0, name=None):
        """[C] Adds a material and returns its number (from 0). reflectance: (bands,), in [0, 1),
        None: 0.5 in every band; emission: (bands,), W/m2: 0, or 1e-30 to 1e30, None: 0; flags:
        hrad.TWO_SIDED | hrad.BLOCKER. Errors: ARGUMENT for a value out of range or not finite, or a
        blocker with emission; STATE after partition()."""
        material, number = sized(CMaterial), ctypes.c_int32()
        pointer, bands = ctypes.POINTER(ctypes.c_double), self._bands()
        if reflectance is not None:
            reflectance = given("reflectance", reflectance, (bands,))
            material.reflectance = reflectance.ctypes.data_as(pointer)
        if emission is not None:
            emission = given("emission", emission, (bands,))
            material.emission = emission.ctypes.data_as(pointer)
        material.flags = whole("flags", flags, ctypes.c_int32)
        material.name = None if name is None else text("name", name)
        self._call("add_material", ctypes.byref(material), ctypes.byref(number))
        return number.value

    def add_patches(self, xyz, vertex, material=None):
        """[C] Adds patches: xyz (n_vertices, 3), corners in the scene's unit; vertex (n_triangles,
        3), whole numbers, indices into this call's vertices (from 0), anticlockwise seen from the
        front; material (n_triangles,), numbers of materials, None: the material added first, or
        reflectance 0.5 if there is none. May be called repeatedly; patch numbers go on. Arrays of
        float64, int64 and int32 in C order are read as they are, others are copied first. Errors:
        ARGUMENT for an index out of range, a coordinate not finite or beyond 1e30; STATE after
        partition(); MEMORY. Nothing is added then."""
        xyz = given("xyz", xyz, (None, 3))
        vertex = given("vertex", vertex, (None, 3), np.int64)
        if material is not None:
            material = given("material", material, (len(vertex),), np.int32)
        self._call("add_patches", len(xyz), xyz, len(vertex), vertex, material)

    def load_scene(self, path):
        """[C] Loads an OBJ file with its MTL files: what is read of them hrad.h tells. Needs bands
        = 1 or 3. Adds to what is there. Errors: FILE; SCENE with file:line; STATE after
        partition(), or for other bands; MEMORY. Nothing is added then."""
        self._call("load_scene", path)

    def make_scene(self, name):
        """[C] Makes a built-in scene (see hrad.scene_names) in an empty solver. Errors: ARGUMENT
        for an unknown name; STATE if there are patches or materials already."""
        self._call("make_scene", name)

    def scene_size(self):
        """[L] The number of patches (dropped ones included) and of materials, a pair."""
        patches, materials = ctypes.c_int64(), ctypes.c_int64()
        self._call("scene_size", ctypes.byref(patches), ctypes.byref(materials))
        return patches.value, materials.value

    def get_patch(self, patch):
        """[L] One patch (from 0), as a Patch. Errors: ARGUMENT for a number out of range."""
        out = sized(CPatch)
        self._call("get_patch", patch, ctypes.byref(out))
        return record(Patch, out)

    def get_material(self, material):
        """[L] One material (from 0), as a Material. Errors: ARGUMENT for a number out of range."""
        reflectance, emission = np.empty((2, self._bands()))
        flags = ctypes.c_int32()
        name = self._text("get_material", material, after=(reflectance, emission,
                                                           ctypes.byref(flags)))
        return Material(reflectance, emission, flags.value, name)

    def get_diagnostic(self, index):
        """[L] Diagnostic `index` (from 0) of the scene: something doubtful that was kept, repaired
        or dropped, one sentence. More is known after partition(), and after solve(). Errors:
        ARGUMENT past the last."""
        return self._text("get_diagnostic", index)

    def diagnostics(self):
        """[L] All diagnostics of the scene, a list of text."""
        found = []
        while True:
            try:
                found.append(self.get_diagnostic(len(found)))
            except ArgumentError:
                return found

    def set_emission(self, first_patch, emission):
        """[C] Sets the emission of patches from `first_patch` on: (count, bands), W/m2: 0, or 1e-30
        to 1e30. Also after a solve: the next solve() then starts from B = E, with refine = 0 on the
        mesh and the links as they are. Errors: ARGUMENT for ranges and values; STATE for a blocker
        with emission."""
        emission = given("emission", emission, (None, self._bands()))
        self._call("set_emission", first_patch, len(emission), emission)

    def set_reflectance(self, first_patch, reflectance):
        """[C] Sets the reflectance, in [0, 1), of patches from `first_patch` on: (count, bands).
        Else like set_emission."""
        reflectance = given("reflectance", reflectance, (None, self._bands()))
        self._call("set_reflectance", first_patch, len(reflectance), reflectance)
