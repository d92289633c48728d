"""Whether points lie on an object, and whether an object is still what was computed on."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Final

import bpy
import numpy as np
from mathutils.bvhtree import BVHTree

from pdtheory.blender.source import Source, linear_part, read_object
from pdtheory.blender.storage import POINTS_KEY, VERTICES_KEY
from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray, IntArray
from pdtheory.pointset.field import DirectionField

#: Of many points so many are asked whether they lie on a surface.
_ASKED: Final = 2000

#: Points this near are the same, relative to their size: single precision with a margin.
_TOLERANCE: Final = 1e-5


def source_for(thing: Any, field: DirectionField) -> Source:
    """Find out how the points of a field from a file lie on an object, at its vertices or between.

    Raises
    ------
    InputError
        If they do not lie on it.
    """
    for evaluated in (False, True):
        source = read_object(thing, evaluated=evaluated)
        local = source.cloud.points @ np.linalg.inv(source.linear).T
        for points, linear in ((local, np.eye(3)), (source.cloud.points, source.linear)):
            if same_points(field.points, points):
                return replace(source, linear=linear)
            if source.cloud.faces is not None and on_surface(
                field.points, points, source.cloud.faces
            ):
                return replace(source, linear=linear, vertex=None)
    raise InputError(
        f"the field of {len(field)} points does not lie on {thing.name} "
        f"({source.vertices} vertices); import it on the object it was computed on."
    )


def same_points(wanted: FloatArray, points: FloatArray) -> bool:
    """Return True if points agree in number and place, within single precision."""
    if len(wanted) != len(points):
        return False
    finite = np.isfinite(wanted).all(axis=1)
    apart = np.abs(wanted[finite] - points[finite]).max(initial=0.0)
    return bool(apart <= _nearness(points))


def on_surface(wanted: FloatArray, points: FloatArray, faces: IntArray) -> bool:
    """Return True if points lie on triangles, within single precision; some of many are asked."""
    finite = wanted[np.isfinite(wanted).all(axis=1)]
    if not len(finite):
        return False
    near = _nearness(points)
    tree = BVHTree.FromPolygons(points.tolist(), faces.tolist(), all_triangles=True)
    some = finite[:: -(-len(finite) // _ASKED)]
    return all(tree.find_nearest(point, near)[0] is not None for point in some.tolist())


def _nearness(points: FloatArray) -> float:
    """Return the distance within which a place is that of one of the points."""
    size = float(np.ptp(points, axis=0).max()) + float(np.abs(points).max())
    return _TOLERANCE * size


def changed_since(thing: Any, strokes: Any) -> bool:
    """Return True if an object is seen not to be the one that its result was computed on.

    Asked often, so vertices are only counted: those of the mesh, and those after its modifiers.
    """
    since = linear_part(thing.matrix_world) @ linear_part(strokes.matrix_parent_inverse)
    if not is_similarity(since):
        return True
    computed = strokes[POINTS_KEY].get(VERTICES_KEY)
    if computed is None or thing.type != "MESH" or thing.mode == "EDIT":
        return False
    shown = thing.evaluated_get(bpy.context.view_layer.depsgraph)
    return all(len(mesh.vertices) != computed for mesh in (thing.data, shown.data))


def is_similarity(linear: FloatArray) -> bool:
    """Return True if a matrix turns, mirrors and scales, by the same along all axes."""
    gram = linear.T @ linear
    return bool(np.abs(gram - gram[0, 0] * np.eye(3)).max() <= _TOLERANCE * gram[0, 0])
