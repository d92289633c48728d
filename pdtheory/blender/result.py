"""A computed field in a Blender file: kept, found again, shown on its surface, put into words.

The directions live on the stroke object (:mod:`pdtheory.blender.glyphs`). What belongs to points
rather than to directions lives on a mesh of loose vertices that the stroke object refers to, so
that a file holds the whole field and needs no extension to be opened.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Final

import bpy
import numpy as np
import numpy.typing as npt
from mathutils import Matrix

from pdtheory.blender.glyphs import add_glyphs, fill_mesh, offer_orders
from pdtheory.blender.source import Source, read_object
from pdtheory.conventions import Status
from pdtheory.drawing.glyphs import GlyphData, glyph_data
from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray
from pdtheory.pointset.directions import OrderDirections
from pdtheory.pointset.field import DirectionField
from pdtheory.pointset.summary import order_summaries, status_sentences

#: Property of a stroke object that refers to its points.
POINTS_KEY: Final = "pdtheory_points"

#: Property of a stroke object that tells several fields on one surface apart.
SUFFIX_KEY: Final = "pdtheory_suffix"

_POINT_FLOATS: Final = ("radius", "residual_rms", "condition")
_POINT_INTS: Final = ("degree", "neighbours", "status")
_ROW_FLOATS: Final = ("eigenvalue", "eigenvalue_std", "strength", "angle_std")

#: Fields of this session in double precision, by the name of their points; a file holds single.
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
    strokes: int = 300,
    suffix: str = "",
) -> Any:
    """Put a field onto the object it was computed on, in place of an earlier one.

    An earlier stroke object keeps its modifier with all that was tuned.

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
    children = [child for child in thing.children if child.get(SUFFIX_KEY) == suffix]
    if children:
        shown = children[0]
        fill_mesh(shown.data, data)
        offer_orders(shown, data)
    else:
        home = (thing.users_collection or (bpy.context.scene.collection,))[0]
        shown = add_glyphs(data, name=name, collection=home, parent=thing, strokes=strokes)
        shown[SUFFIX_KEY] = suffix
    # The strokes were computed in world orientation: undo what the parent does to them.
    shown.matrix_parent_inverse = Matrix(np.linalg.inv(source.linear).tolist()).to_4x4()
    before = shown.get(POINTS_KEY)
    points = bpy.data.meshes.new(f"{name} points")
    _fill_points(points, field)
    if source.vertex is not None:
        _put(points, "vertex", "INT", source.vertex)
    shown[POINTS_KEY] = points
    if before is not None and before.users == 0:
        bpy.data.meshes.remove(before)
    _remember(points, field)
    if not suffix:
        _show_on_surface(thing, source, field)
    return shown


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
    field = _read_field(strokes.data, points)
    _remember(points, field)
    return field


def point_of_vertex(strokes: Any, vertex: int) -> int | None:
    """Return the point of a field that was computed at a vertex, None where there is none."""
    points = strokes[POINTS_KEY]
    attribute = points.attributes.get("vertex")
    if attribute is None:
        # Samples: they are numbered by themselves.
        return vertex if vertex < len(points.vertices) else None
    if vertex < len(attribute.data) and attribute.data[vertex].value == vertex:
        return vertex
    found = np.flatnonzero(_take(points, "vertex", 1, whole=True) == vertex)
    return int(found[0]) if len(found) else None


def source_for(thing: Any, field: DirectionField) -> Source:
    """Find out how the points of a field from a file lie on an object.

    Raises
    ------
    InputError
        If they do not lie on it.
    """
    for evaluated in (False, True):
        source = read_object(thing, evaluated=evaluated)
        local = source.cloud.points @ np.linalg.inv(source.linear).T
        for points, linear in ((local, np.eye(3)), (source.cloud.points, source.linear)):
            if _same_points(field.points, points):
                return replace(source, linear=linear)
    raise InputError(
        f"the field of {len(field)} points does not lie on {thing.name} "
        f"({source.vertices} vertices); import it on the object it was computed on."
    )


def _same_points(wanted: FloatArray, points: FloatArray) -> bool:
    """Return True if points agree in number and place, within single precision."""
    if len(wanted) != len(points):
        return False
    size = float(np.ptp(points, axis=0).max()) + float(np.abs(points).max())
    finite = np.isfinite(wanted).all(axis=1)
    return bool(np.abs(wanted[finite] - points[finite]).max(initial=0.0) <= 1e-5 * size)


def forget_all() -> None:
    """Drop the fields kept in memory; what the file holds stays."""
    _exact.clear()


def _remember(points: Any, field: DirectionField) -> None:
    alive = {mesh.session_uid for mesh in bpy.data.meshes}
    for uid in [uid for uid in _exact if uid not in alive]:
        del _exact[uid]
    _exact[points.session_uid] = field


def _put(mesh: Any, name: str, kind: str, values: npt.NDArray[np.generic]) -> None:
    key = {"FLOAT": "value", "INT": "value", "FLOAT_VECTOR": "vector", "FLOAT2": "vector"}[kind]
    attribute = mesh.attributes.get(name)
    if attribute is not None and (attribute.data_type != kind or attribute.domain != "POINT"):
        mesh.attributes.remove(attribute)
        attribute = None
    if attribute is None:
        attribute = mesh.attributes.new(name, kind, "POINT")
    if len(values):
        dtype = np.int32 if kind == "INT" else np.float32
        attribute.data.foreach_set(key, np.ascontiguousarray(values, dtype=dtype).ravel())


def _take(mesh: Any, name: str, width: int, *, whole: bool = False) -> npt.NDArray[Any]:
    attribute = mesh.attributes.get(name)
    if attribute is None:
        raise InputError(f"the result lacks {name}: it was made by another version; compute again.")
    values = np.empty(len(attribute.data) * width, dtype=np.int32 if whole else np.float32)
    if len(values):
        attribute.data.foreach_get("value" if width == 1 else "vector", values)
    wide = values.astype(np.int64 if whole else np.float64)
    return wide if width == 1 else wide.reshape(-1, width)


def _fill_points(mesh: Any, field: DirectionField) -> None:
    mesh.vertices.add(len(field))
    _put(mesh, "position", "FLOAT_VECTOR", field.points)
    for axis, name in enumerate(("t1", "t2", "surface_normal")):
        _put(mesh, name, "FLOAT_VECTOR", field.frames[:, axis])
    for name in _POINT_FLOATS:
        _put(mesh, name, "FLOAT", getattr(field, name))
    for name in _POINT_INTS:
        _put(mesh, name, "INT", getattr(field, name))
    for k, n, column in zip(field.phi_order, field.phi_frequency, field.phi.T, strict=True):
        _put(mesh, f"phi_{k}_{n}", "FLOAT2", np.stack((column.real, column.imag), axis=1))
    for order, rows in field.directions.items():
        _put(mesh, f"isotropic_{order}", "INT", rows.isotropic.astype(np.int32))


def _read_field(strokes: Any, points: Any) -> DirectionField:
    """Rebuild a field from a file, in the single precision it was saved in."""
    place = _take(points, "position", 3)
    frames = np.stack([_take(points, name, 3) for name in ("t1", "t2", "surface_normal")], axis=1)
    names = [a.name for a in points.attributes if a.name.startswith("phi_")]
    pairs = sorted(tuple(map(int, name.split("_")[1:])) for name in names)
    phi = np.stack([_complex(points, k, n) for k, n in pairs], axis=1)
    row_order = _take(strokes, "order", 1, whole=True)
    row_point = _take(strokes, "point", 1, whole=True)
    kind = _take(strokes, "kind", 1, whole=True).astype(np.int8)
    vector = _take(strokes, "direction", 3)
    floats = {name: _take(strokes, name, 1) for name in _ROW_FLOATS}
    x, y = (np.einsum("ij,ij->i", vector, frames[row_point, axis]) for axis in (0, 1))
    angle = np.mod(np.arctan2(y, x), 2.0 * np.pi)
    directions = {}
    orders = sorted(
        int(a.name.split("_")[1]) for a in points.attributes if a.name.startswith("isotropic_")
    )
    for order in orders:
        here = row_order == order
        counts = np.bincount(row_point[here], minlength=len(place))
        directions[order] = OrderDirections(
            order=order,
            offsets=np.concatenate(([0], np.cumsum(counts))).astype(np.int64),
            angle=angle[here],
            vector=vector[here],
            kind=kind[here],
            isotropic=_take(points, f"isotropic_{order}", 1, whole=True).astype(bool),
            **{name: values[here] for name, values in floats.items()},
        )
    return DirectionField(
        points=place,
        frames=frames,
        phi=phi,
        phi_order=np.array([k for k, _ in pairs], dtype=np.int64),
        phi_frequency=np.array([n for _, n in pairs], dtype=np.int64),
        directions=directions,
        **{name: _take(points, name, 1) for name in _POINT_FLOATS},
        **{name: _take(points, name, 1, whole=True) for name in _POINT_INTS},
    )


def _complex(mesh: Any, order: int, frequency: int) -> npt.NDArray[np.complex128]:
    both = _take(mesh, f"phi_{order}_{frequency}", 2)
    return np.asarray(both[:, 0] + 1j * both[:, 1])


def _show_on_surface(thing: Any, source: Source, field: DirectionField) -> None:
    """Put the largest strength of each order, and the status, onto the vertices of the surface."""
    mesh = thing.data
    fits = thing.type == "MESH" and source.vertex is not None and mesh.library is None
    if not fits or len(mesh.vertices) != source.vertices or thing.mode == "EDIT":
        return
    status = np.full(source.vertices, int(Status.TOO_FEW_NEIGHBOURS))
    status[source.vertex] = field.status
    _put(mesh, "directions_status", "INT", status)
    for order in field.orders:
        rows = field[order]
        largest = np.zeros(len(field))
        np.maximum.at(largest, rows.point_index, rows.strength)
        values = np.zeros(source.vertices)
        values[source.vertex] = largest
        _put(mesh, f"strength_{order}", "FLOAT", values)
    mesh.update()


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
        found = f"strength {row.strength:.2g}, ± {row.angle_std:.2g}°"
        lines.append(f"Order {row.order}: {found if len(field[row.order]) else 'no directions'}")
    return lines
