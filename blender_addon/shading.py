# SPDX-License-Identifier: GPL-3.0-or-later
"""A material that shows the strength of one order on the surface."""

import bpy
from bpy.props import EnumProperty

from pdtheory.blender.shading import strength_material, strength_orders

from .jobs import surface_object


def _orders(self, context):
    thing = surface_object(context)
    found = strength_orders(thing.data) if thing is not None and thing.type == "MESH" else ()
    # Blender keeps no reference to dynamic items.
    _orders.items = [(str(k), f"Order {k}", f"Strength of order {k}") for k in found] or [
        ("0", "None", "No result")
    ]
    return _orders.items


class ShowStrength(bpy.types.Operator):
    """Give the surface a material that shows how strong the directions are"""

    bl_idname = "principal_directions.show_strength"
    bl_label = "Show Strength"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012

    order: EnumProperty(name="Order", description="Order whose strength is shown", items=_orders)

    @classmethod
    def poll(cls, context):
        thing = surface_object(context)
        return thing is not None and thing.type == "MESH" and bool(strength_orders(thing.data))

    def execute(self, context):
        thing = surface_object(context)
        material = strength_material(thing.data, int(self.order))
        if thing.data.materials:
            thing.data.materials[0] = material
        else:
            thing.data.materials.append(material)
        return {"FINISHED"}


register, unregister = bpy.utils.register_classes_factory((ShowStrength,))
