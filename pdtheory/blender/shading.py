"""Materials that show what was stored on the surface."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

from pdtheory.blender import compat
from pdtheory.blender.needles import linear
from pdtheory.conventions import ORDER_COLOURS

_PREFIX = "strength_"


def strength_orders(mesh: Any) -> tuple[int, ...]:
    """Return the orders whose strength a mesh carries."""
    names = [a.name for a in mesh.attributes if a.name.startswith(_PREFIX)]
    return tuple(sorted(int(name[len(_PREFIX) :]) for name in names))


def strength_material(mesh: Any, order: int) -> Any:
    """Return a material that goes from grey to the colour of an order with its strength.

    The full colour is reached at the 95 % quantile of the strengths on this mesh.

    Parameters
    ----------
    mesh
        `bpy` mesh with the attribute ``strength_{order}``.
    order
        The order.
    """
    values = np.empty(len(mesh.vertices), dtype=np.float32)
    mesh.attributes[f"{_PREFIX}{order}"].data.foreach_get("value", values)
    full = float(np.quantile(values, 0.95)) if len(values) else 1.0
    name = f"Strength of order {order} on {mesh.name}"
    material = bpy.data.materials.get(name) or bpy.data.materials.new(name)
    tree = compat.enable_nodes(material)
    tree.nodes.clear()
    attribute = tree.nodes.new("ShaderNodeAttribute")
    attribute.attribute_name = f"{_PREFIX}{order}"
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
