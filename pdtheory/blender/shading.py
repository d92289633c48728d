"""Strengths on the vertices of a surface, and materials that show them over those of the user."""

from __future__ import annotations

from typing import Any, Final

import bpy
import numpy as np

from pdtheory.blender import compat
from pdtheory.blender.needles import linear
from pdtheory.blender.source import Source
from pdtheory.blender.storage import put
from pdtheory.conventions import ORDER_COLOURS, Status
from pdtheory.pointset.field import DirectionField

#: Attribute of a surface with the largest strength of an order at each vertex, less the order.
STRENGTH: Final = "directions_strength_"

#: Attribute of a surface with the status of each vertex.
_STATUS: Final = "directions_status"

#: Property of an object: for each slot the link and the object's material that a strength covers.
COVERED_KEY: Final = "pdtheory_covered"

#: Property of a material that shows strengths: their order.
_ORDER_KEY: Final = "pdtheory_strength"


def strength_orders(mesh: Any) -> tuple[int, ...]:
    """Return the orders whose strength a mesh carries, ascending."""
    ours = {a.name for a in mesh.attributes if (a.domain, a.data_type) == ("POINT", "FLOAT")}
    return tuple(order for order in sorted(ORDER_COLOURS) if f"{STRENGTH}{order}" in ours)


def store_strengths(thing: Any, source: Source, field: DirectionField) -> None:
    """Put the largest strength of each order, and the status, onto the vertices of the surface.

    Those of an earlier field are removed, also where the new one was not computed at the vertices.
    """
    mesh = thing.data
    if thing.type != "MESH" or mesh.library is not None or thing.mode == "EDIT":
        return
    stale = [_STATUS, *(f"{STRENGTH}{order}" for order in strength_orders(mesh))]
    for name in stale:
        if name in mesh.attributes:
            mesh.attributes.remove(mesh.attributes[name])
    if source.vertex is None or len(mesh.vertices) != source.vertices:
        return
    status = np.full(source.vertices, int(Status.TOO_FEW_NEIGHBOURS))
    status[source.vertex] = field.status
    put(mesh, _STATUS, "INT", status)
    for order in field.orders:
        rows = field[order]
        largest = np.zeros(len(field))
        np.maximum.at(largest, rows.point_index, rows.strength)
        values = np.zeros(source.vertices)
        values[source.vertex] = largest
        put(mesh, f"{STRENGTH}{order}", "FLOAT", values)
    mesh.update()


def cover_with_strength(thing: Any, order: int) -> None:
    """Show the strength of an order on an object, in place of its materials.

    The mesh keeps its materials and which face has which: in every slot one of the object stands
    before that of the mesh.

    Parameters
    ----------
    thing
        `bpy` mesh object that carries the strength.
    order
        The order.
    """
    material = strength_material(thing.data, order)
    if not thing.material_slots:
        thing.data.materials.append(None)
    if COVERED_KEY not in thing:
        thing[COVERED_KEY] = {}
    covered = thing[COVERED_KEY]
    for number, slot in enumerate(thing.material_slots):
        link, slot.link = slot.link, "OBJECT"
        if not _shows_strength(slot):
            # A property has no room for None.
            held = {} if slot.material is None else {"material": slot.material}
            covered[str(number)] = {"link": link, **held}
        slot.material = material


def uncover(thing: Any) -> None:
    """Give an object back the materials that :func:`cover_with_strength` covered."""
    covered = thing.get(COVERED_KEY, {})
    for number, slot in enumerate(thing.material_slots):
        before = covered.get(str(number))
        if before is not None and slot.link == "OBJECT" and _shows_strength(slot):
            slot.material = before.get("material")
            slot.link = before["link"]
    thing.pop(COVERED_KEY, None)


def _shows_strength(slot: Any) -> bool:
    return slot.material is not None and _ORDER_KEY in slot.material


def strength_material(mesh: Any, order: int) -> Any:
    """Return a material that goes from grey to the colour of an order with its strength.

    The full colour is reached at the 95 % quantile of the strengths on this mesh.

    Parameters
    ----------
    mesh
        `bpy` mesh with the attribute ``directions_strength_{order}``.
    order
        The order.
    """
    values = np.empty(len(mesh.vertices), dtype=np.float32)
    mesh.attributes[f"{STRENGTH}{order}"].data.foreach_get("value", values)
    full = float(np.quantile(values, 0.95)) if len(values) else 1.0
    name = f"Strength of order {order} on {mesh.name}"
    material = bpy.data.materials.get(name)
    if material is None or _ORDER_KEY not in material:
        material = bpy.data.materials.new(name)
        material[_ORDER_KEY] = order
    tree = compat.enable_nodes(material)
    tree.nodes.clear()
    attribute = tree.nodes.new("ShaderNodeAttribute")
    attribute.attribute_name = f"{STRENGTH}{order}"
    span = tree.nodes.new("ShaderNodeMapRange")
    span.inputs["From Max"].default_value = full or 1.0
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    ramp.color_ramp.elements[0].color = (0.75, 0.75, 0.75, 1.0)
    ramp.color_ramp.elements[1].color = (*map(linear, ORDER_COLOURS[order]), 1.0)
    surface = tree.nodes.new("ShaderNodeBsdfPrincipled")
    surface.inputs["Roughness"].default_value = 0.6
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(attribute.outputs["Fac"], span.inputs["Value"])
    tree.links.new(span.outputs["Result"], ramp.inputs["Fac"])
    tree.links.new(ramp.outputs["Color"], surface.inputs["Base Color"])
    tree.links.new(surface.outputs["BSDF"], output.inputs["Surface"])
    for place, node in enumerate((attribute, span, ramp, surface, output)):
        node.location = (240.0 * place, 0.0)
    return material
