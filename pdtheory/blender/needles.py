"""The Geometry Nodes group that draws directions as strokes.

The glyph object is a mesh of loose vertices, one for each direction, whose named attributes say
what to draw (:mod:`pdtheory.blender.glyphs`). This group turns them into needles, arrows or lines.
All its inputs act at once, also in a file that is opened without pdtheory.
"""

from __future__ import annotations

from typing import Any, Final

import bpy

from pdtheory.blender import compat
from pdtheory.blender.nodes import Builder
from pdtheory.conventions import ORDER_COLOURS
from pdtheory.drawing.glyphs import ORDERS

#: Version of the group; a file with an older one keeps it, new objects get the new one.
VERSION: Final = 1
#: Property of a group that says which version it is.
VERSION_KEY: Final = "pdtheory_version"
GROUP_NAME: Final = f"Principal directions {VERSION}"

STYLES: Final = ("Needles", "Arrows", "Lines")

#: Minima are drawn thinner than maxima, so that both can be told apart where they cross.
_MINIMUM_WIDTH = 0.5

#: Cross sections of a stroke that is bent onto the surface.
_BENT_SEGMENTS = 5

_PER_DIRECTION = ("direction", "surface_normal", "bend", "spacing", "turn", "relative_strength")


def order_material(order: int) -> Any:
    """Return the material of one order, made on first use, in the colour of the paper."""
    name = f"Directions of order {order}"
    material = bpy.data.materials.get(name)
    if material is not None and material.library is None:
        return material
    colour = (*map(linear, ORDER_COLOURS[order]), 1.0)
    material = bpy.data.materials.new(name)
    tree = compat.enable_nodes(material)
    surface = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
    surface.inputs["Base Color"].default_value = colour
    surface.inputs["Roughness"].default_value = 0.6
    # Solid shading shows this one.
    material.diffuse_color = colour
    return material


def linear(component: float) -> float:
    """Return the linear value of one sRGB component."""
    if component <= 0.04045:
        return component / 12.92
    return ((component + 0.055) / 1.055) ** 2.4


def needle_group() -> Any:
    """Return the node group, built on first use in a file."""
    for group in bpy.data.node_groups:
        if group.get(VERSION_KEY) == VERSION and group.library is None:
            return group
    group = bpy.data.node_groups.new(GROUP_NAME, "GeometryNodeTree")
    group[VERSION_KEY] = VERSION
    group.is_modifier = True
    _interface(group)
    _fill(Builder(group))
    return group


def _interface(group: Any) -> None:
    new = group.interface.new_socket
    new("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    new("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
    new("Style", in_out="INPUT", socket_type="NodeSocketMenu")

    def number(name: str, value: float, low: float, high: float, text: str, kind: str = "") -> None:
        socket = new(name, in_out="INPUT", socket_type="NodeSocketFloat")
        if kind:
            socket.subtype = kind
        socket.default_value = value
        socket.min_value, socket.max_value = low, high
        socket.description = text

    def switch(name: str, value: bool, text: str) -> None:
        socket = new(name, in_out="INPUT", socket_type="NodeSocketBool")
        socket.default_value = value
        socket.description = text

    huge = 3.4e38
    number("Length", 0.1, 0.0, huge, "Length of a stroke from its point", "DISTANCE")
    number("By Strength", 0.0, 0.0, 1.0, "0 draws equal strokes, 1 lets strength set the length")
    number("Width", 0.32, 0.0, 1.0, "Thickness of a stroke, as a part of the length")
    number("Taper", 0.35, 0.0, 1.0, "How much thinner a stroke gets towards its tip")
    number("Lift", 0.06, -1.0, 1.0, "Height above the surface, as a part of the length")
    switch("Follow Surface", True, "Bend strokes along the curvature of the surface")
    number("Spacing", 0.0, 0.0, huge, "Smallest distance between points with strokes", "DISTANCE")
    switch("One Order Per Point", True, "Deal the points to the orders in turn")
    switch("Maxima", True, "Draw maximum principal directions")
    switch("Minima", False, "Draw minimum principal directions, thinner than maxima")
    switch("Inflections", False, "Draw E-eigenvectors that are neither maximum nor minimum")
    number("Least Strength", 0.0, 0.0, huge, "Hide directions that are weaker than this")
    number("Largest Uncertainty", 3.15, 0.0, 3.15, "Hide directions less certain", "ANGLE")
    for order in ORDERS:
        switch(f"Order {order}", True, f"Draw the directions of order {order}")
    for order in ORDERS:
        socket = new(f"Material {order}", in_out="INPUT", socket_type="NodeSocketMaterial")
        socket.description = f"Material of the strokes of order {order}"


def _fill(b: Builder) -> None:
    group_in = b.node("NodeGroupInput")

    def given(name: str) -> Any:
        return group_in.outputs[name]

    order = b.attribute("order", "INT")
    kind = b.attribute("kind", "INT")
    normal = b.attribute("surface_normal", "FLOAT_VECTOR")

    shown = b.all_of(
        _dealt(b, given, order),
        b.any_of(
            *(
                b.both(b.compare("EQUAL", kind, number, "INT"), given(name))
                for name, number in (("Maxima", 1), ("Minima", -1), ("Inflections", 0))
            )
        ),
        b.compare("GREATER_EQUAL", b.attribute("strength"), given("Least Strength")),
        b.compare("LESS_EQUAL", b.attribute("angle_std"), given("Largest Uncertainty")),
        b.compare("GREATER_EQUAL", b.attribute("spacing"), given("Spacing")),
        b.compare("GREATER_THAN", b.attribute("spacing"), 0.0),
    )

    share = b.mix(given("By Strength"), 1.0, b.attribute("relative_strength"))
    length = b.math("MULTIPLY", given("Length"), share)
    drop = b.math("MULTIPLY", b.attribute("bend"), b.math("MULTIPLY", length, length))
    # A stroke never leaves its tangent by more than 45 degrees on average.
    drop = b.math("MINIMUM", drop, length)
    drop = b.math("MAXIMUM", drop, b.math("MULTIPLY", length, -1.0))
    lift = b.math("MULTIPLY", given("Length"), given("Lift"))
    points = b.store(given("Geometry"), "sag", b.scale(normal, drop), "FLOAT_VECTOR")
    points = b.lift(points, b.scale(normal, lift))

    width = b.math("MULTIPLY", given("Length"), given("Width"))
    segments = b.switch(given("Follow Surface"), 1, _BENT_SEGMENTS, "INT")
    stroke = _stroke(b, given, width, segments)
    thin = b.both(b.compare("EQUAL", kind, -1, "INT"), given("Maxima"))
    thickness = b.switch(thin, 1.0, _MINIMUM_WIDTH, "FLOAT")

    place = b.node("GeometryNodeInstanceOnPoints")
    b.feed(place, "Points", points)
    b.feed(place, "Selection", shown)
    b.feed(place, "Instance", stroke)
    b.feed(place, "Rotation", b.axes(b.attribute("direction", "FLOAT_VECTOR"), normal))
    b.feed(place, "Scale", b.combine(thickness, thickness, length))
    mesh = place.outputs["Instances"]
    for name in _PER_DIRECTION:
        mesh = b.forget(mesh, name)
    realize = b.node("GeometryNodeRealizeInstances")
    b.feed(realize, "Geometry", mesh)
    mesh = realize.outputs["Geometry"]

    along = b.attribute("along")
    bow = b.scale(b.attribute("sag", "FLOAT_VECTOR"), b.math("MULTIPLY", along, along))
    mesh = b.lift(mesh, bow, given("Follow Surface"))
    mesh = b.forget(b.forget(mesh, "sag"), "along")
    for number in ORDERS:
        paint = b.node("GeometryNodeSetMaterial")
        b.feed(paint, "Geometry", mesh)
        b.feed(paint, "Selection", b.compare("EQUAL", order, number, "INT"))
        b.feed(paint, "Material", given(f"Material {number}"))
        mesh = paint.outputs["Geometry"]
    group_out = b.node("NodeGroupOutput")
    b.feed(group_out, "Geometry", mesh)
    b.arrange()


def _dealt(b: Builder, given: Any, order: Any) -> Any:
    """Say whether a direction's order is on, and has its turn at the point if turns are taken."""
    enabled: Any = 0.0
    position: Any = 0.0
    is_on: Any = None
    for number in ORDERS:
        here = b.compare("EQUAL", order, number, "INT")
        on_here = b.both(here, given(f"Order {number}"))
        is_on = on_here if is_on is None else b.any_of(is_on, on_here)
        present = b.math("MULTIPLY", given(f"Order {number}"), 1.0)
        # `enabled` counts the orders that are on below this one.
        position = b.switch(here, position, enabled, "FLOAT")
        enabled = b.math("ADD", enabled, present)
    turn = b.math("FLOOR", b.math("MULTIPLY", b.attribute("turn"), enabled))
    mine = b.compare("EQUAL", turn, position)
    everyone = b.negate(given("One Order Per Point"))
    return b.both(is_on, b.any_of(everyone, mine))


def _stroke(b: Builder, given: Any, width: Any, segments: Any) -> Any:
    """Return one stroke of unit length along z, with its height stored as `along`."""
    half = b.math("MULTIPLY", width, 0.5)
    tip = b.math("MULTIPLY", half, b.math("SUBTRACT", 1.0, given("Taper")))

    needle = b.cone(6, segments, half, tip, 1.0)

    shaft = b.cone(5, segments, b.math("MULTIPLY", half, 0.7), b.math("MULTIPLY", half, 0.7), 0.7)
    head = b.shift(b.cone(6, 1, b.math("MULTIPLY", half, 2.0), 0.0, 0.4), (0.0, 0.0, 0.6))
    arrow = b.join(shaft, head)

    grid = b.node("GeometryNodeMeshGrid")
    b.feed(grid, "Size X", b.math("MULTIPLY", width, 0.6))
    b.feed(grid, "Size Y", 1.0)
    b.feed(grid, "Vertices X", 2)
    b.feed(grid, "Vertices Y", b.math("ADD", segments, 1.0))
    # x is turned to y and y to z: the ribbon lies flat on the surface, whose normal is x here.
    quarter = 1.5707963267948966
    line = b.shift(grid.outputs["Mesh"], (0.0, 0.0, 0.5), (quarter, 0.0, quarter))

    menu = b.node("GeometryNodeMenuSwitch")
    menu.data_type = "GEOMETRY"
    compat.name_menu_items(menu, STYLES)
    b.feed(menu, "Menu", given("Style"))
    for name, mesh in zip(STYLES, (needle, arrow, line), strict=True):
        b.feed(menu, name, mesh)
    position = b.node("GeometryNodeInputPosition")
    height = b.separate(position.outputs["Position"], "Z")
    return b.store(b.smooth(menu.outputs["Output"]), "along", height, "FLOAT")
