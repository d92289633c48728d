"""A computed field in a Blender file: kept, found again, shown on its surface, put into words.

The directions live on the stroke object (:mod:`pdtheory.blender.glyphs`). What belongs to points
rather than to directions lives on a mesh of loose vertices that the stroke object refers to
(:mod:`pdtheory.blender.storage`), so that a file holds the whole field and needs no extension to be
opened.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Final

import bpy
import numpy as np
from mathutils import Matrix

from pdtheory.blender.glyphs import (
    add_glyphs,
    add_modifier,
    fill_mesh,
    find_modifier,
    offer_orders,
    propose,
)
from pdtheory.blender.shading import store_strengths
from pdtheory.blender.source import Source
from pdtheory.blender.storage import (
    POINTS_KEY,
    VERTEX,
    VERTICES_KEY,
    fill_points,
    read_field,
    take,
)
from pdtheory.drawing.glyphs import GlyphData, glyph_data
from pdtheory.errors import InputError
from pdtheory.pointset.field import DirectionField
from pdtheory.pointset.summary import order_summaries, status_sentences

#: Property of a stroke object that tells several fields on one surface apart.
SUFFIX_KEY: Final = "pdtheory_suffix"

#: Property of a stroke object: the name that it was given here; the user may have changed it.
_NAME_KEY: Final = "pdtheory_name"

#: Property of the object that shows the neighbourhood of a point.
BALL_KEY: Final = "pdtheory_ball"

#: About how many points of a result carry strokes at first.
STROKES: Final = 300

#: Fields of this session in double precision, by the `session_uid` of their points; a file holds
#: single.
_exact: dict[int, DirectionField] = {}


def strokes_of(thing: Any) -> Any | None:
    """Return the stroke object of an object: itself, or the first of its children that is one."""
    if thing is None:
        return None
    if POINTS_KEY in thing:
        return thing
    mine = (child for child in thing.children if POINTS_KEY in child)
    return next((child for child in mine if child.get(SUFFIX_KEY) == ""), None)


def show_result(
    thing: Any,
    source: Source,
    field: DirectionField,
    data: GlyphData | None = None,
    *,
    strokes: int = STROKES,
    suffix: str = "",
) -> Any:
    """Put a field onto the object it was computed on, in place of an earlier one.

    An earlier stroke object keeps its modifier with all that was tuned; it gets a new one if that
    was removed.

    Parameters
    ----------
    thing
        The object.
    source
        What was computed on.
    field
        The result.
    data
        Its layout, if it was made before (it takes a second or two and needs no Blender).
    strokes
        About how many points carry strokes at first.
    suffix
        Distinguishes several fields on one object; each replaces its own.

    Returns
    -------
    bpy.types.Object
        The stroke object.
    """
    if data is None:
        data = glyph_data(field)
    name = f"{thing.name} directions{suffix}"
    shown = replaceable_strokes(thing, suffix)
    if shown is not None:
        if shown.data.users > 1:
            # A linked duplicate shows its own result.
            shown.data = bpy.data.meshes.new(name)
        fill_mesh(shown.data, data)
        if find_modifier(shown) is None:
            add_modifier(shown, data, strokes)
        else:
            propose(shown, data, strokes)
            offer_orders(shown, data)
    else:
        home = collection_of(thing)
        shown = add_glyphs(data, name=name, collection=home, parent=thing, strokes=strokes)
        shown[SUFFIX_KEY] = suffix
    if shown.get(_NAME_KEY, shown.name) == shown.name:
        # The surface may have another name by now, and Blender numbers equal ones.
        shown.name = name
        shown[_NAME_KEY] = shown.name
    # The strokes were computed in world orientation: undo what the parent does to them.
    shown.matrix_parent_inverse = Matrix(np.linalg.inv(source.linear).tolist()).to_4x4()
    before = shown.get(POINTS_KEY)
    points = bpy.data.meshes.new(f"{name} points")
    fill_points(points, field, source.vertex)
    points[VERTICES_KEY] = source.vertices
    shown[POINTS_KEY] = points
    if before is not None and before.users == 0:
        bpy.data.meshes.remove(before)
    _remember(points, field)
    for child in [child for child in shown.children if BALL_KEY in child]:
        # It shows a neighbourhood of the earlier result.
        bpy.data.objects.remove(child)
    if not suffix:
        store_strengths(thing, source, field)
    return shown


def replaceable_strokes(thing: Any, suffix: str = "") -> Any | None:
    """Return the stroke object that the next result on an object replaces, None if there is none.

    Raises
    ------
    InputError
        If it cannot be replaced now.
    """
    for child in thing.children:
        if child.get(SUFFIX_KEY) != suffix:
            continue
        if child.library is not None or child.data.library is not None:
            raise InputError(
                f"{child.name} is linked from another file; make it local, delete it, or compute "
                "in its own file."
            )
        if child.mode == "EDIT":
            raise InputError(f"{child.name} is in edit mode; leave it first.")
        return child
    return None


def collection_of(thing: Any) -> Any:
    """Return the collection for what belongs to an object: one that can be seen and added to.

    That is one of its own in the current view layer, else the active one, else the scene's.
    """
    layer = bpy.context.view_layer.layer_collection
    seen = {each.collection for each in _visible(layer)}
    for collection in (*thing.users_collection, bpy.context.collection):
        linked = collection.library is not None or collection.override_library is not None
        if collection in seen and not linked:
            return collection
    return layer.collection


def _visible(layer: Any) -> Iterator[Any]:
    """Give a layer collection and those below it, but those that are excluded or hidden."""
    if layer.is_visible and not layer.exclude:
        yield layer
    for child in layer.children:
        yield from _visible(child)


def field_of(strokes: Any) -> DirectionField:
    """Return the field a stroke object shows: as computed in this session, else from the file.

    Raises
    ------
    InputError
        If the object holds no field.
    """
    points = None if strokes is None else strokes.get(POINTS_KEY)
    if points is None:
        raise InputError("there is no result on this object; compute directions first.")
    known = _exact.get(points.session_uid)
    if known is not None:
        return known
    field = read_field(strokes.data, points)
    _remember(points, field)
    return field


def at_samples(strokes: Any) -> bool:
    """Return True if a result belongs to samples of the surface and not to its vertices."""
    return VERTEX not in strokes[POINTS_KEY].attributes


def point_of_vertex(strokes: Any, vertex: int) -> int | None:
    """Return the point of a field that was computed at a vertex, None where there is none.

    Samples belong to no vertex; they are numbered by themselves.
    """
    points = strokes[POINTS_KEY]
    attribute = points.attributes.get(VERTEX)
    if attribute is None:
        return vertex if 0 <= vertex < len(points.vertices) else None
    if 0 <= vertex < len(attribute.data) and attribute.data[vertex].value == vertex:
        return vertex
    found = np.flatnonzero(take(points, VERTEX, 1, whole=True) == vertex)
    return int(found[0]) if len(found) else None


def forget_all() -> None:
    """Drop the fields kept in memory; what the file holds stays."""
    _exact.clear()


def _remember(points: Any, field: DirectionField) -> None:
    alive = {mesh.session_uid for mesh in bpy.data.meshes}
    for uid in [uid for uid in _exact if uid not in alive]:
        del _exact[uid]
    _exact[points.session_uid] = field


def describe(field: DirectionField, *, loose: int = 0) -> list[str]:
    """Put a result into sentences: points, what could not be answered and why, median strengths.

    Parameters
    ----------
    field
        The result.
    loose
        Vertices that were left out since they belong to no face.
    """
    lines = status_sentences(field.status)
    if loose:
        lines.insert(1, f"{loose:,} loose vertices left out.")
    for row in order_summaries(field):
        angles = "angles undetermined" if row.undetermined else f"± {row.angle_std:.2g}°"
        found = f"strength {row.strength:.2g}, {angles}"
        lines.append(f"Order {row.order}: {found if len(field[row.order]) else 'no directions'}")
    return lines
