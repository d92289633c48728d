"""A direction field as a Blender object: one loose vertex with attributes for each direction."""

from __future__ import annotations

from typing import Any, Final

import bpy
import numpy as np

from pdtheory.blender import compat
from pdtheory.blender.needles import VERSION_KEY, needle_group, order_material
from pdtheory.drawing.glyphs import ORDERS, REACH, GlyphData, single
from pdtheory.pointset.cloud import FloatArray

MODIFIER_NAME: Final = "Principal directions"

#: Property of a stroke object: the orders it holds.
ORDERS_KEY: Final = "pdtheory_orders"

#: Property of a stroke object: the inputs that were set by the size of its surface.
_PROPOSED_KEY: Final = "pdtheory_proposed"

_KIND: Final = {"FLOAT": "value", "INT": "value", "FLOAT_VECTOR": "vector"}


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
    add_modifier(glyphs, data, strokes)
    return glyphs


def find_modifier(glyphs: Any) -> Any | None:
    """Return the modifier that draws the strokes of an object, whatever its name and place.

    None if the user has removed it.
    """
    for modifier in glyphs.modifiers:
        group = modifier.node_group if modifier.type == "NODES" else None
        if group is not None and VERSION_KEY in group:
            return modifier
    return None


def add_modifier(glyphs: Any, data: GlyphData, strokes: int) -> Any:
    """Add the modifier that draws `data`, at about so many points, and return it."""
    modifier = glyphs.modifiers.new(MODIFIER_NAME, "NODES")
    modifier.node_group = needle_group()
    for order in ORDERS:
        compat.set_input(modifier, f"Material {order}", order_material(order))
    compat.set_input(modifier, "Style", "Needles")
    glyphs[_PROPOSED_KEY] = {}
    glyphs[ORDERS_KEY] = []
    propose(glyphs, data, strokes)
    offer_orders(glyphs, data)
    return modifier


def propose(glyphs: Any, data: GlyphData, strokes: int) -> None:
    """Set what depends on the size of the surface, unless it was tuned since the last proposal."""
    modifier = find_modifier(glyphs)
    spacing = data.spots.spacing_for(strokes)
    before = glyphs.get(_PROPOSED_KEY)
    if before is None:
        # From a file of a version that kept no account of it.
        return
    for name, value in {"Spacing": spacing, "Length": REACH * spacing}.items():
        if name not in before or compat.get_input(modifier, name) == before[name]:
            compat.set_input(modifier, name, value)
            # As the modifier holds it: in single precision.
            before[name] = compat.get_input(modifier, name)


def offer_orders(glyphs: Any, data: GlyphData) -> None:
    """Switch on the orders that are new on an object, and off those it does not hold."""
    modifier = find_modifier(glyphs)
    before = set(glyphs.get(ORDERS_KEY, ()))
    present = set(np.unique(data.attributes["order"]).tolist()) if len(data) else set()
    for order in ORDERS:
        if order not in present or order not in before:
            compat.set_input(modifier, f"Order {order}", order in present)
    glyphs[ORDERS_KEY] = sorted(present)


def fill_mesh(mesh: Any, data: GlyphData, origin: FloatArray | None = None) -> None:
    """Replace the content of a mesh by one vertex with attributes for each direction."""
    mesh.clear_geometry()
    mesh.vertices.add(len(data))
    position = data.position if origin is None else data.position - origin
    if len(data):
        mesh.attributes["position"].data.foreach_set("vector", single(position).ravel())
    for name, values in data.attributes.items():
        whole = np.issubdtype(values.dtype, np.integer)
        kind = "FLOAT_VECTOR" if values.ndim == 2 else "INT" if whole else "FLOAT"
        attribute = mesh.attributes.get(name) or mesh.attributes.new(name, kind, "POINT")
        if len(data):
            attribute.data.foreach_set(_KIND[kind], values.ravel())
    mesh.update()
