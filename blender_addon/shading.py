# SPDX-License-Identifier: GPL-3.0-or-later
"""A material that shows the strength of one order on the surface."""

import bpy
from bpy.props import EnumProperty

from pdtheory.blender.shading import COVERED_KEY, cover_with_strength, strength_orders, uncover

from .jobs import surface_object
from .translations import CONTEXT

_NONE = "NONE"


def _orders(self, context):
    thing = surface_object(context)
    found = strength_orders(thing.data) if thing is not None and thing.type == "MESH" else ()
    # Blender keeps no reference to dynamic items.
    _orders.items = [
        *((str(k), f"Order {k}", f"Strength of order {k}") for k in found),
        (_NONE, "None", "The materials that the object had before"),
    ]
    return _orders.items


class ShowStrength(bpy.types.Operator):
    """Cover the materials of the surface with one that shows how strong the directions are"""

    bl_idname = "principal_directions.show_strength"
    bl_label = "Show Strength"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012

    order: EnumProperty(
        name="Order",
        description="Order whose strength is shown",
        items=_orders,
        translation_context=CONTEXT,
    )

    @classmethod
    def poll(cls, context):
        thing = surface_object(context)
        known = thing is not None and thing.type == "MESH"
        if not known or not (strength_orders(thing.data) or COVERED_KEY in thing):
            cls.poll_message_set("Compute directions at the vertices of a mesh first")
            return False
        if thing.mode == "EDIT":
            cls.poll_message_set("Leave edit mode first")
            return False
        return True

    def execute(self, context):
        thing = surface_object(context)
        if self.order == _NONE:
            uncover(thing)
        else:
            cover_with_strength(thing, int(self.order))
        return {"FINISHED"}


register, unregister = bpy.utils.register_classes_factory((ShowStrength,))
