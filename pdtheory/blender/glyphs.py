"""A direction field as a Blender object: one loose vertex with attributes for each direction."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Final

import bpy
import numpy as np
import numpy.typing as npt

from pdtheory.blender import compat
from pdtheory.blender.draw import CERTAIN
from pdtheory.blender.needles import ORDERS, needle_group, order_material
from pdtheory.blender.thinning import Spots, choose_spots
from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray
from pdtheory.pointset.field import DirectionField

MODIFIER_NAME: Final = "Principal directions"

#: Property of a stroke object: the orders it holds.
ORDERS_KEY: Final = "pdtheory_orders"

#: A stroke reaches this part of the way to the next spot.
_REACH = 0.46

_KIND: Final = {"FLOAT": "value", "INT": "value", "FLOAT_VECTOR": "vector"}


@dataclass(frozen=True)
class GlyphData:
    """Directions of several orders, flat: one row for each direction.

    Attributes
    ----------
    position : (M, 3) float64
        Where each direction stands.
    attributes : mapping of str to (M,) or (M, 3) array
        What is drawn: `direction` and `surface_normal` (unit vectors), `order`, `kind`, `point`
        (index in the field), `eigenvalue`, `eigenvalue_std`, `strength`, `angle_std`,
        `relative_strength` (by the 90 % quantile of its order, at most 1.5), `bend` (half the
        normal curvature in the direction, 1/length), `spacing` and `turn` of the point
        (:mod:`pdtheory.blender.thinning`).
    spots : Spots
        Spacing and turn of every point of the field.
    """

    position: FloatArray
    attributes: Mapping[str, npt.NDArray[np.generic]]
    spots: Spots

    def __len__(self) -> int:
        return len(self.position)


def glyph_data(field: DirectionField, orders: Iterable[int] | None = None) -> GlyphData:
    """Lay out the directions of a field for drawing.

    Parameters
    ----------
    field
        The directions.
    orders
        The orders to take; all of the field by default.

    Raises
    ------
    InputError
        If the field does not hold one of the orders, or an order has no colour to draw it in.
    """
    wanted = tuple(field.orders if orders is None else orders)
    for order in wanted:
        if order not in ORDERS:
            raise InputError(
                f"order {order} cannot be drawn; choose from {ORDERS[0]} to {ORDERS[-1]}."
            )
    rows = [field[order] for order in wanted]
    usable = np.zeros(len(field), dtype=bool)
    certain = np.zeros(len(field), dtype=np.int64)
    for row in rows:
        usable |= np.diff(row.offsets) > 0
        sure = row.point_index[row.angle_std <= CERTAIN]
        certain[np.unique(sure)] += 1
    spots = choose_spots(field.points, usable, preference=certain)
    columns: dict[str, list[npt.NDArray[np.generic]]] = {}

    def put(name: str, values: npt.NDArray[np.generic]) -> None:
        columns.setdefault(name, []).append(values)

    for row in rows:
        point = row.point_index
        typical = np.quantile(row.strength, 0.9) if len(row) else 1.0
        put("position", field.points[point])
        put("direction", row.vector)
        put("surface_normal", field.frames[point, 2])
        put("order", np.full(len(row), row.order))
        put("kind", row.kind)
        put("point", point)
        put("eigenvalue", row.eigenvalue)
        put("eigenvalue_std", row.eigenvalue_std)
        put("strength", row.strength)
        put("angle_std", row.angle_std)
        put("relative_strength", np.minimum(row.strength / typical if typical else 0.0, 1.5))
        put("bend", _bend(field, point, row.angle))
        put("spacing", spots.spacing[point])
        put("turn", spots.turn[point])
    arrays = {name: np.concatenate(parts) for name, parts in columns.items()}
    position = arrays.pop("position", np.empty((0, 3)))
    return GlyphData(np.asarray(position, dtype=np.float64), arrays, spots)


def _bend(field: DirectionField, point: npt.NDArray[np.int64], angle: FloatArray) -> FloatArray:
    """Return g_2 at the angle of each direction, the height of the surface per squared length."""
    constant = field.coefficient(2, 0)[point].real
    turning = field.coefficient(2, 2)[point]
    return np.asarray(constant + 2.0 * (turning * np.exp(2j * angle)).real)


def add_glyphs(
    data: GlyphData,
    *,
    name: str,
    collection: Any,
    parent: Any | None = None,
    origin: FloatArray | None = None,
    strokes: int = 800,
) -> Any:
    """Add the object that draws a field, with its modifier.

    Parameters
    ----------
    data
        The directions.
    name
        Name of the object.
    collection
        `bpy` collection to put it into.
    parent
        Object to hang it under.
    origin : (3,) float64, optional
        Subtracted from the positions before they become single precision.
    strokes
        About how many points carry strokes at first.

    Returns
    -------
    bpy.types.Object
        The object; its modifier holds all that can be tuned.
    """
    mesh = bpy.data.meshes.new(name)
    fill_mesh(mesh, data, origin)
    glyphs = bpy.data.objects.new(name, mesh)
    glyphs.parent = parent
    collection.objects.link(glyphs)
    modifier = glyphs.modifiers.new(MODIFIER_NAME, "NODES")
    modifier.node_group = needle_group()
    for order in ORDERS:
        compat.set_input(modifier, f"Material {order}", order_material(order))
    offer_orders(glyphs, data)
    compat.set_input(modifier, "Style", "Needles")
    spacing = data.spots.spacing_for(strokes)
    compat.set_input(modifier, "Spacing", spacing)
    compat.set_input(modifier, "Length", _REACH * spacing)
    return glyphs


def offer_orders(glyphs: Any, data: GlyphData) -> None:
    """Switch on the orders that an object holds, and off those it does not."""
    present = set(np.unique(data.attributes["order"]).tolist()) if len(data) else set()
    for order in ORDERS:
        compat.set_input(glyphs.modifiers[0], f"Order {order}", order in present)
    glyphs[ORDERS_KEY] = sorted(present)


def fill_mesh(mesh: Any, data: GlyphData, origin: FloatArray | None = None) -> None:
    """Replace the content of a mesh by one vertex with attributes for each direction."""
    mesh.clear_geometry()
    mesh.vertices.add(len(data))
    position = data.position if origin is None else data.position - origin
    if len(data):
        mesh.attributes["position"].data.foreach_set("vector", _flat(position, np.float32))
    for name, values in data.attributes.items():
        whole = np.issubdtype(values.dtype, np.integer)
        kind = "FLOAT_VECTOR" if values.ndim == 2 else "INT" if whole else "FLOAT"
        attribute = mesh.attributes.get(name) or mesh.attributes.new(name, kind, "POINT")
        if len(data):
            flat = _flat(values, np.int32 if whole else np.float32)
            attribute.data.foreach_set(_KIND[kind], flat)
    mesh.update()


def _flat(values: npt.NDArray[np.generic], dtype: type) -> npt.NDArray[np.generic]:
    """Return a contiguous flat copy in single precision; what is not finite becomes 0 or huge."""
    if np.issubdtype(values.dtype, np.floating):
        values = np.nan_to_num(values, nan=0.0, posinf=3e38, neginf=-3e38)
        values = np.clip(values, -3e38, 3e38)
    return np.ascontiguousarray(values, dtype=dtype).ravel()
