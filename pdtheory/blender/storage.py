"""A direction field as attributes of Blender meshes, in single precision, and back."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pdtheory.errors import InputError
from pdtheory.pointset.cloud import IntArray
from pdtheory.pointset.directions import OrderDirections
from pdtheory.pointset.field import DirectionField

#: Property of a stroke object that refers to its points.
POINTS_KEY: Final = "pdtheory_points"

#: Property of the points: the number of vertices of the mesh that was computed on.
VERTICES_KEY: Final = "pdtheory_vertices"

#: Attribute of the points that says to which vertex of the surface each belongs.
VERTEX: Final = "vertex"

_POINT_FLOATS: Final = ("radius", "residual_rms", "condition")
_POINT_INTS: Final = ("degree", "neighbours", "status")
_ROW_FLOATS: Final = ("eigenvalue", "eigenvalue_std", "strength", "angle_std")


def put(mesh: Any, name: str, kind: str, values: npt.NDArray[np.generic]) -> None:
    """Put values onto the vertices of a mesh; an attribute of that name is replaced."""
    key = {"FLOAT": "value", "INT": "value", "FLOAT_VECTOR": "vector", "FLOAT2": "vector"}[kind]
    attribute = mesh.attributes.get(name)
    if attribute is not None and (attribute.data_type != kind or attribute.domain != "POINT"):
        mesh.attributes.remove(attribute)
        attribute = None
    if attribute is None:
        attribute = mesh.attributes.new(name, kind, "POINT")
    # A vertex group of the user may have taken the name.
    if attribute is not None and len(values):
        dtype = np.int32 if kind == "INT" else np.float32
        attribute.data.foreach_set(key, np.ascontiguousarray(values, dtype=dtype).ravel())


def take(mesh: Any, name: str, width: int, *, whole: bool = False) -> npt.NDArray[Any]:
    """Return an attribute of so many components, in double precision.

    Raises
    ------
    InputError
        If the mesh lacks it.
    """
    attribute = mesh.attributes.get(name)
    if attribute is None:
        raise InputError(f"the result lacks {name}: it was made by another version; compute again.")
    values = np.empty(len(attribute.data) * width, dtype=np.int32 if whole else np.float32)
    if len(values):
        attribute.data.foreach_get("value" if width == 1 else "vector", values)
    wide = values.astype(np.int64 if whole else np.float64)
    return wide if width == 1 else wide.reshape(-1, width)


def fill_points(mesh: Any, field: DirectionField, vertex: IntArray | None = None) -> None:
    """Put what belongs to the points of a field onto an empty mesh.

    Parameters
    ----------
    mesh
        `bpy` mesh.
    field
        The field.
    vertex : (P,) int64, optional
        For each point its vertex on the surface; left out for samples.
    """
    mesh.vertices.add(len(field))
    put(mesh, "position", "FLOAT_VECTOR", field.points)
    for axis, name in enumerate(("t1", "t2", "surface_normal")):
        put(mesh, name, "FLOAT_VECTOR", field.frames[:, axis])
    for name in _POINT_FLOATS:
        put(mesh, name, "FLOAT", getattr(field, name))
    for name in _POINT_INTS:
        put(mesh, name, "INT", getattr(field, name))
    for k, n, column in zip(field.phi_order, field.phi_frequency, field.phi.T, strict=True):
        put(mesh, f"phi_{k}_{n}", "FLOAT2", np.stack((column.real, column.imag), axis=1))
    for order, rows in field.directions.items():
        put(mesh, f"isotropic_{order}", "INT", rows.isotropic.astype(np.int32))
    if vertex is not None:
        put(mesh, VERTEX, "INT", vertex)


def read_field(strokes: Any, points: Any) -> DirectionField:
    """Rebuild a field from a file, in the single precision it was saved in.

    Parameters
    ----------
    strokes
        `bpy` mesh of the stroke object (:func:`pdtheory.blender.glyphs.fill_mesh`).
    points
        The mesh of its points.

    Raises
    ------
    InputError
        If something is missing.
    """
    place = take(points, "position", 3)
    frames = np.stack([take(points, name, 3) for name in ("t1", "t2", "surface_normal")], axis=1)
    names = [a.name for a in points.attributes if a.name.startswith("phi_")]
    pairs = sorted(tuple(map(int, name.split("_")[1:])) for name in names)
    phi = np.stack([_complex(points, k, n) for k, n in pairs], axis=1)
    row_order = take(strokes, "order", 1, whole=True)
    row_point = take(strokes, "point", 1, whole=True)
    kind = take(strokes, "kind", 1, whole=True).astype(np.int8)
    vector = take(strokes, "direction", 3)
    floats = {name: take(strokes, name, 1) for name in _ROW_FLOATS}
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
            isotropic=take(points, f"isotropic_{order}", 1, whole=True).astype(bool),
            **{name: values[here] for name, values in floats.items()},
        )
    return DirectionField(
        points=place,
        frames=frames,
        phi=phi,
        phi_order=np.array([k for k, _ in pairs], dtype=np.int64),
        phi_frequency=np.array([n for _, n in pairs], dtype=np.int64),
        directions=directions,
        **{name: take(points, name, 1) for name in _POINT_FLOATS},
        **{name: take(points, name, 1, whole=True) for name in _POINT_INTS},
    )


def _complex(mesh: Any, order: int, frequency: int) -> npt.NDArray[np.complex128]:
    both = take(mesh, f"phi_{order}_{frequency}", 2)
    return np.asarray(both[:, 0] + 1j * both[:, 1])
