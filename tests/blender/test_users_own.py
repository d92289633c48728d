"""The extension among things of the user's own: materials, attributes, modifiers, edits."""

from __future__ import annotations

import json

import pytest
from blender_objects import QUICK, refused

pytestmark = pytest.mark.blender


@pytest.fixture
def monkey(operators):
    """A monkey saddle with its directions."""
    import bpy

    operators.add_monkey(resolution=10)
    operators.compute(**QUICK)
    return bpy.context.object


def new_material(name):
    import bpy

    return bpy.data.materials.new(name)


def strength_shown(slot):
    """Return the attribute that the material of a slot shows, None if it shows none."""
    nodes = slot.material.node_tree.nodes if slot.material else ()
    return next((node.attribute_name for node in nodes if node.type == "ATTRIBUTE"), None)


def test_strength_covers_all_materials_and_gives_them_back(operators, monkey, tmp_path):
    import bpy

    mesh = monkey.data
    own = [new_material("clay"), new_material("gold")]
    for material in own:
        mesh.materials.append(material)
    for face in list(mesh.polygons)[::2]:
        face.material_index = 1
    brass, hidden = new_material("brass"), new_material("hidden")
    monkey.material_slots[0].link = "OBJECT"
    monkey.material_slots[0].material = hidden
    monkey.material_slots[0].link = "DATA"
    monkey.material_slots[1].link = "OBJECT"
    monkey.material_slots[1].material = brass
    for order in ("2", "3", "3"):
        assert operators.show_strength(order=order) == {"FINISHED"}
        shown = [strength_shown(slot) for slot in monkey.material_slots]
        assert shown == [f"directions_strength_{order}"] * 2
    assert list(mesh.materials) == own
    # Nothing that is covered gets lost with the file.
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "covered.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "covered.blend"))
    monkey = bpy.data.objects["monkey"]
    assert operators.show_strength(order="NONE") == {"FINISHED"}
    slots = monkey.material_slots
    assert [(slot.link, slot.material.name) for slot in slots] == [
        ("DATA", "clay"),
        ("OBJECT", "brass"),
    ]
    slots[0].link = "OBJECT"
    assert slots[0].material.name == "hidden"
    assert [face.material_index for face in list(monkey.data.polygons)[:2]] == [1, 0]
    assert not [key for key in monkey.keys() if "covered" in key]  # noqa: SIM118


def test_strength_on_a_surface_without_materials(operators, monkey):
    operators.show_strength(order="2")
    assert strength_shown(monkey.material_slots[0]) == "directions_strength_2"
    operators.show_strength(order="NONE")
    assert [slot.material for slot in monkey.material_slots] == [None]


def test_a_material_chosen_meanwhile_is_not_taken_away(operators, monkey):
    operators.show_strength(order="2")
    monkey.material_slots[0].material = new_material("clay")
    operators.show_strength(order="NONE")
    assert monkey.material_slots[0].material.name == "clay"


def test_attributes_of_the_user_are_left_alone(operators, monkey):
    from pdtheory.blender.shading import strength_orders

    mesh = monkey.data
    for name in ("strength_map", "strength_2", "directions_strength_map"):
        mesh.attributes.new(name, "FLOAT", "POINT")
    mesh.attributes.new("strength_3", "FLOAT_COLOR", "CORNER")
    assert operators.show_strength.poll()
    operators.compute(neighbours=40, degree=4, orders={"2", "4"})
    assert {a.name: a.data_type for a in mesh.attributes if a.name.startswith("strength")} == {
        "strength_map": "FLOAT",
        "strength_2": "FLOAT",
        "strength_3": "FLOAT_COLOR",
    }
    assert not any(value.value for value in mesh.attributes["strength_2"].data)
    # Order 3 was computed before, but not by what is shown now.
    assert strength_orders(mesh) == (2, 4)


def test_strength_in_edit_mode_is_refused(operators, monkey):
    import bpy

    bpy.ops.object.mode_set(mode="EDIT")
    assert not operators.show_strength.poll()
    bpy.ops.object.mode_set(mode="OBJECT")
    assert operators.show_strength.poll()


def test_computing_again_finds_the_modifier_of_the_strokes(operators, monkey):
    from pdtheory.blender import compat
    from pdtheory.blender.glyphs import find_modifier
    from pdtheory.blender.result import strokes_of

    strokes = strokes_of(monkey)
    strokes.modifiers[0].name = "renamed"
    strokes.modifiers.new("finer", "SUBSURF")
    strokes.modifiers.new("empty", "NODES")
    strokes.modifiers.move(1, 0)
    strokes.modifiers.move(2, 0)
    operators.compute(neighbours=40, degree=4, orders={"2"})
    assert operators.show_exact() == {"FINISHED"}
    modifier = find_modifier(strokes)
    assert modifier.name == "renamed"
    assert not compat.get_input(modifier, "Order 3")
    assert len(strokes.modifiers) == 3


def test_a_removed_modifier_comes_back_with_the_next_result(operators, monkey):
    from pdtheory.blender import compat
    from pdtheory.blender.glyphs import find_modifier
    from pdtheory.blender.result import strokes_of

    strokes = strokes_of(monkey)
    length = compat.get_input(strokes.modifiers[0], "Length")
    strokes.modifiers.clear()
    operators.compute(**QUICK)
    modifier = find_modifier(strokes)
    assert compat.get_input(modifier, "Length") == pytest.approx(length)
    assert [compat.get_input(modifier, f"Order {order}") for order in (2, 3, 4)] == [1, 1, 0]
    operators.show_exact()
    exact = next(child for child in monkey.children if child != strokes)
    for each in (strokes, exact):
        each.modifiers.clear()
    assert operators.show_exact() == {"FINISHED"}
    assert compat.get_input(find_modifier(strokes), "Length") == pytest.approx(length)
    assert compat.get_input(find_modifier(exact), "Length") == pytest.approx(1.5 * length)


def test_a_surface_added_in_edit_mode_is_joined(operators):
    import bpy

    operators.add_monkey(resolution=6)
    monkey = bpy.context.object
    before = len(monkey.data.vertices)
    assert json.loads(monkey.principal_directions.surface)["name"] == "monkey"
    bpy.ops.object.mode_set(mode="EDIT")
    assert operators.add_torus(resolution=6) == {"FINISHED"}
    assert bpy.context.object == monkey
    assert monkey.mode == "EDIT"
    bpy.ops.object.mode_set(mode="OBJECT")
    assert list(bpy.data.objects) == [monkey]
    assert len(monkey.data.vertices) > before
    assert monkey.principal_directions.surface == ""
    operators.add_torus(resolution=6)
    assert bpy.context.object != monkey
    assert json.loads(bpy.context.object.principal_directions.surface)["name"] == "torus"


def select_vertex(thing, number):
    """Make one vertex of a mesh in edit mode the active one; return it."""
    import bmesh

    edited = bmesh.from_edit_mesh(thing.data)
    edited.verts.ensure_lookup_table()
    edited.select_history.add(edited.verts[number])
    return edited


def test_samples_are_named_by_number_and_not_by_a_vertex(operators):
    import bpy

    from blender_addon.inspect_point import active_point

    operators.add_torus(resolution=12)
    torus = bpy.context.object
    operators.compute(samples=300, neighbours=40, degree=4, orders={"2"})
    torus.principal_directions.point = 7
    assert active_point(torus)[1] == 7
    bpy.ops.object.mode_set(mode="EDIT")
    select_vertex(torus, 5)
    refused(operators.copy_row, "the result is at samples; leave edit mode")
    bpy.ops.object.mode_set(mode="OBJECT")


def test_a_new_vertex_has_a_number_but_no_result(operators, monkey):
    import bpy

    from blender_addon.inspect_point import active_point

    count = len(monkey.data.vertices)
    bpy.ops.object.mode_set(mode="EDIT")
    edited = select_vertex(monkey, 5)
    assert active_point(monkey)[1] == 5
    edited.select_history.clear()
    edited.select_history.add(edited.verts.new((0.0, 0.0, 9.0)))
    refused(operators.copy_row, f"vertex {count} has no result")
    bpy.ops.object.mode_set(mode="OBJECT")


@pytest.mark.parametrize("samples", [None, 50])
def test_there_is_no_point_below_zero(operators, samples):
    import bpy

    from pdtheory.blender.result import point_of_vertex, strokes_of

    operators.add_torus(resolution=12)
    given = {} if samples is None else {"samples": samples}
    operators.compute(**given, **QUICK)
    assert point_of_vertex(strokes_of(bpy.context.object), -1) is None
    assert point_of_vertex(strokes_of(bpy.context.object), 49) == 49


def test_the_ball_shows_where_the_strokes_are_in_no_collection(operators, monkey):
    import bpy

    from pdtheory.blender.result import strokes_of

    strokes = strokes_of(monkey)
    for home in strokes.users_collection:
        home.objects.unlink(strokes)
    assert operators.show_ball() == {"FINISHED"}
    (ball,) = strokes.children
    assert ball.users_collection == (bpy.context.scene.collection,)


def test_without_a_file_nothing_is_read_or_written(operators, monkey):
    for operator in (operators.export_field, operators.import_field):
        refused(operator, "no file is chosen", filepath="")
