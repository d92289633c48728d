# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of a computation, and what is shown while and after it runs."""

import bpy
from bpy.props import (
    BoolProperty,
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from pdtheory.blender.result import strokes_of
from pdtheory.drawing.glyphs import ORDERS

from .translations import CONTEXT

#: The orders that can be computed in Blender.
CHOICES = tuple(order for order in ORDERS if order <= 8)


class ComputeSettings:
    """What a computation needs to know; shared by the panel and the operator."""

    source: EnumProperty(
        name="Points",
        description="What the directions are computed on",
        items=(
            ("VERTICES", "Vertices", "Compute at the vertices of the object"),
            ("SAMPLES", "Samples", "Spread points over the surface and compute at them"),
        ),
        default="VERTICES",
        translation_context=CONTEXT,
    )
    samples: IntProperty(
        name="Samples",
        translation_context=CONTEXT,
        description="Number of points spread over the surface",
        min=8,
        soft_max=1_000_000,
        default=20_000,
    )
    seed: IntProperty(name="Seed", description="Seed of the samples", min=0, default=0)
    evaluated: BoolProperty(
        name="With Modifiers",
        description="Compute on the object as it is shown, with modifiers and shape keys",
        default=True,
    )
    neighbourhood: EnumProperty(
        name="Neighbourhood",
        description="How the size of the neighbourhood of a point is chosen",
        items=(
            ("NEIGHBOURS", "Neighbours", "So many nearest points"),
            ("RADIUS", "Radius", "All points within a distance"),
        ),
        default="NEIGHBOURS",
    )
    neighbours: IntProperty(
        name="Neighbours",
        description="Number of nearest points, the point itself among them",
        min=8,
        soft_max=500,
        max=100_000,
        default=80,
    )
    radius: FloatProperty(
        name="Radius",
        description="Radius of the neighbourhood",
        min=0.0,
        default=0.1,
        subtype="DISTANCE",
        precision=4,
    )
    degree: IntProperty(
        name="Degree",
        description="Degree of the fitted polynomial; it limits the orders and amplifies noise",
        min=2,
        max=14,
        default=6,
    )
    orders: EnumProperty(
        name="Orders",
        description="Orders of the directions",
        items=tuple((str(k), str(k), f"Directions of order {k}", 1 << k) for k in CHOICES),
        options={"ENUM_FLAG"},
        default={"2", "3"},
    )
    norm: EnumProperty(
        name="Norm",
        description="Norm of the residuals of the fit",
        items=(
            ("l2", "Least Squares", "Fast; for clean surfaces"),
            ("l1", "Least Deviations", "Withstands outliers; several times slower"),
        ),
        default="l2",
    )


SETTING_NAMES = tuple(ComputeSettings.__annotations__)


class DirectionsSettings(ComputeSettings, bpy.types.PropertyGroup):
    """Settings of the panel, kept in the scene."""


class DirectionsProgress(bpy.types.PropertyGroup):
    """What the panel shows while a computation runs; kept with the window, not in files."""

    running: BoolProperty(options={"SKIP_SAVE", "HIDDEN"})
    fraction: FloatProperty(options={"SKIP_SAVE", "HIDDEN"})
    text: StringProperty(options={"SKIP_SAVE", "HIDDEN"})


def _kept(key, empty, least=None):
    """Return what gets and sets a property of an object that is kept with its strokes.

    An object linked from another file keeps nothing, and strokes are local. What is set before
    there are strokes stays with the object. Blender keeps to no ``min`` where a function sets what
    is given, so the least value is a matter of the function.
    """

    def get(group):
        places = (strokes_of(group.id_data), group.id_data)
        return next((place[key] for place in places if place is not None and key in place), empty)

    def put(group, value):
        kept = value if least is None else max(least, value)
        (strokes_of(group.id_data) or group.id_data)[key] = kept

    return {"get": get, "set": put}


class DirectionsResult(bpy.types.PropertyGroup):
    """What is known about the result on an object."""

    summary: StringProperty(
        description="The result in words, one line each", **_kept("pdtheory_summary", "")
    )
    comparison: StringProperty(
        description="Estimated against exact directions, one line each",
        **_kept("pdtheory_comparison", ""),
    )
    point: IntProperty(
        name="Vertex",
        description="Vertex whose directions are listed",
        translation_context=CONTEXT,
        min=0,
        **_kept("pdtheory_point", 0, least=0),
    )
    surface: StringProperty(description="Recipe of the synthetic surface the object was made from")


def _get_colour(material):
    return material.diffuse_color[:3]


def _set_colour(material, colour):
    whole = (*colour, 1.0)
    material.diffuse_color = whole
    tree = material.node_tree
    for node in tree.nodes if tree is not None else ():
        if node.type == "BSDF_PRINCIPLED":
            node.inputs["Base Color"].default_value = whole


_CLASSES = (DirectionsSettings, DirectionsProgress, DirectionsResult)


def register():
    for each in _CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Scene.principal_directions = PointerProperty(type=DirectionsSettings)
    bpy.types.WindowManager.principal_directions = PointerProperty(type=DirectionsProgress)
    bpy.types.Object.principal_directions = PointerProperty(type=DirectionsResult)
    bpy.types.Material.principal_directions_colour = FloatVectorProperty(
        name="Colour",
        description="Colour of the strokes, in the viewport and in pictures",
        subtype="COLOR",
        size=3,
        min=0.0,
        max=1.0,
        get=_get_colour,
        set=_set_colour,
    )


def unregister():
    del bpy.types.Material.principal_directions_colour
    del bpy.types.Object.principal_directions
    del bpy.types.WindowManager.principal_directions
    del bpy.types.Scene.principal_directions
    for each in reversed(_CLASSES):
        bpy.utils.unregister_class(each)
