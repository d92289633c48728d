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


def test_no_vertex_is_below_the_first(operators, monkey):
    for computed in (False, True):
        if computed:
            operators.compute(**QUICK)
        monkey.principal_directions.point = 3
        monkey.principal_directions.point = -5
        assert monkey.principal_directions.point == 0


def test_a_new_vertex_has_a_number_but_no_result(operators, monkey):
    import bpy

    from blender_addon.inspect_point import active_point, active_vertex

    count = len(monkey.data.vertices)
    bpy.ops.object.mode_set(mode="EDIT")
    edited = select_vertex(monkey, 5)
    assert active_point(monkey)[1] == 5
    edited.select_history.clear()
    edited.select_history.add(edited.verts.new((0.0, 0.0, 9.0)))
    refused(operators.copy_row, f"has {count + 1} vertices in edit mode, and {count} where")
    assert active_vertex(monkey) == count
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


def test_a_linked_duplicate_gets_strokes_of_its_own(operators, monkey):
    import bpy

    from pdtheory.blender.result import field_of, strokes_of

    strokes = strokes_of(monkey)
    copies = [monkey.copy(), strokes.copy()]
    copies[1].parent = copies[0]
    for each in copies:
        bpy.context.collection.objects.link(each)
    before = [tuple(v.co) for v in strokes.data.vertices]
    copies[0].scale = (1.0, 3.0, 1.0)
    bpy.context.view_layer.objects.active = copies[0]
    bpy.context.view_layer.update()
    operators.compute(neighbours=40, degree=4, orders={"2"})
    assert copies[1].data != strokes.data
    assert [tuple(v.co) for v in strokes.data.vertices] == before
    assert field_of(strokes).orders == (2, 3)
    assert field_of(copies[1]).orders == (2,)


def test_strokes_land_where_they_are_seen(operators):
    import bpy

    from pdtheory.blender.result import strokes_of

    scene = bpy.context.scene
    for name in ("nowhere", "excluded", "seen"):
        bpy.data.collections.new(name)
    for name in ("excluded", "seen"):
        scene.collection.children.link(bpy.data.collections[name])
    bpy.context.view_layer.layer_collection.children["excluded"].exclude = True
    operators.add_monkey(resolution=8)
    thing = bpy.context.object
    for name in ("nowhere", "excluded", "seen"):
        bpy.data.collections[name].objects.link(thing)
    scene.collection.objects.unlink(thing)
    operators.compute(**QUICK)
    assert [c.name for c in strokes_of(thing).users_collection] == ["seen"]


@pytest.mark.parametrize("overridden", [False, True])
def test_strokes_of_a_linked_object_are_local(operators, tmp_path, overridden):
    import bpy

    from pdtheory.blender.result import strokes_of
    from pdtheory.blender.scene import new_file

    library = str(tmp_path / "library.blend")
    operators.add_monkey(resolution=8)
    shared = bpy.data.collections.new("shared")
    shared.objects.link(bpy.context.object)
    bpy.context.scene.collection.children.link(shared)
    bpy.ops.wm.save_as_mainfile(filepath=library)
    scene = new_file()
    with bpy.data.libraries.load(library, link=True) as (_, wanted):
        wanted.collections = ["shared"]
    (collection,) = wanted.collections
    scene.collection.children.link(collection)
    if overridden:
        collection = collection.override_hierarchy_create(scene, bpy.context.view_layer)
    thing = collection.all_objects[0]
    bpy.context.view_layer.objects.active = thing
    assert operators.compute(**QUICK) == {"FINISHED"}
    (home,) = strokes_of(thing).users_collection
    assert home.library is None
    assert home.override_library is None
    assert len([o for o in bpy.data.objects if "directions" in o.name]) == 1
    thing.principal_directions.point = 7
    before = thing.principal_directions.summary
    assert "points answered" in before
    user = str(tmp_path / "user.blend")
    bpy.ops.wm.save_as_mainfile(filepath=user)
    bpy.ops.wm.open_mainfile(filepath=user)
    (thing,) = (o for o in bpy.data.objects if o.name == "monkey" and strokes_of(o))
    assert thing.principal_directions.summary == before
    assert thing.principal_directions.point == 7


def test_linked_strokes_are_not_overwritten(operators, tmp_path, monkey):
    import bpy

    from pdtheory.blender.result import strokes_of
    from pdtheory.blender.scene import new_file

    library = str(tmp_path / "library.blend")
    names = [monkey.name, strokes_of(monkey).name]
    bpy.ops.wm.save_as_mainfile(filepath=library)
    scene = new_file()
    with bpy.data.libraries.load(library, link=True) as (_, wanted):
        wanted.objects = names
    for each in wanted.objects:
        scene.collection.objects.link(each)
    bpy.context.view_layer.objects.active = wanted.objects[0]
    bpy.context.view_layer.update()
    count = len(wanted.objects[1].data.vertices)
    refused(operators.compute, "is linked from another file", neighbours=40, degree=4, orders={"2"})
    assert len(wanted.objects[1].data.vertices) == count


def test_strokes_in_edit_mode_are_refused_at_once(operators, monkey):
    import bpy

    from pdtheory.blender.result import strokes_of

    bpy.context.view_layer.objects.active = strokes_of(monkey)
    bpy.ops.object.mode_set(mode="EDIT")
    refused(operators.compute, "is in edit mode", **QUICK)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert operators.compute(**QUICK) == {"FINISHED"}


def test_a_vertex_group_may_have_the_name_of_a_strength(operators):
    import bpy

    operators.add_monkey(resolution=10)
    thing = bpy.context.object
    thing.vertex_groups.new(name="directions_strength_2")
    assert operators.compute(**QUICK) == {"FINISHED"}
    assert "directions_strength_3" in thing.data.attributes
    assert [group.name for group in thing.vertex_groups] == ["directions_strength_2"]


def test_strokes_grow_with_their_surface_unless_they_were_tuned(operators, monkey):
    import bpy

    from pdtheory.blender import compat
    from pdtheory.blender.glyphs import find_modifier
    from pdtheory.blender.result import strokes_of

    modifier = find_modifier(strokes_of(monkey))
    length, spacing = (compat.get_input(modifier, name) for name in ("Length", "Spacing"))
    monkey.scale = (10.0, 10.0, 10.0)
    bpy.context.view_layer.update()
    operators.compute(**QUICK)
    assert compat.get_input(modifier, "Length") == pytest.approx(10.0 * length, rel=1e-3)
    assert compat.get_input(modifier, "Spacing") == pytest.approx(10.0 * spacing, rel=1e-3)
    compat.set_input(modifier, "Length", 0.5)
    monkey.scale = (1.0, 1.0, 1.0)
    bpy.context.view_layer.update()
    operators.compute(**QUICK)
    assert compat.get_input(modifier, "Length") == 0.5
    assert compat.get_input(modifier, "Spacing") == pytest.approx(spacing, rel=1e-3)


def test_strokes_follow_the_name_of_their_surface_unless_they_have_one(operators, monkey):
    from pdtheory.blender.result import strokes_of

    strokes = strokes_of(monkey)
    for name in ("head", "face"):
        monkey.name = name
        operators.compute(**QUICK)
        assert strokes.name == f"{name} directions"
    strokes.name = "hair"
    operators.compute(**QUICK)
    assert strokes.name == "hair"


def test_orders_that_were_switched_off_stay_off(operators, monkey):
    from pdtheory.blender import compat
    from pdtheory.blender.glyphs import find_modifier
    from pdtheory.blender.result import strokes_of

    modifier = find_modifier(strokes_of(monkey))

    def on():
        return [order for order in (2, 3, 4) if compat.get_input(modifier, f"Order {order}")]

    compat.set_input(modifier, "Order 2", False)
    operators.compute(**QUICK)
    assert on() == [3]
    operators.compute(neighbours=40, degree=4, orders={"2", "3", "4"})
    assert on() == [3, 4]
    operators.compute(neighbours=40, degree=4, orders={"3", "4"})
    operators.compute(neighbours=40, degree=4, orders={"2", "3", "4"})
    assert on() == [2, 3, 4]


def test_strengths_go_with_the_result_they_belong_to(operators, monkey):
    operators.show_strength(order="2")
    operators.compute(samples=200, **QUICK)
    assert not [a.name for a in monkey.data.attributes if a.name.startswith("directions_")]
    # The way back stays open.
    assert operators.show_strength(order="NONE") == {"FINISHED"}
    assert not operators.show_strength.poll()


def test_a_field_at_samples_can_be_imported_again(operators, tmp_path):
    import bpy

    from pdtheory.blender.result import field_of, strokes_of

    operators.add_torus(resolution=20)
    torus = bpy.context.object
    torus.scale = (1.0, 2.0, 0.5)
    torus.rotation_euler = (0.3, 0.1, 0.2)
    bpy.context.view_layer.update()
    operators.compute(samples=500, **QUICK)
    before = [tuple(v.co) for v in strokes_of(torus).data.vertices]
    operators.export_field(filepath=str(tmp_path / "field.npz"))
    bpy.data.objects.remove(strokes_of(torus))
    assert operators.import_field(filepath=str(tmp_path / "field.npz")) == {"FINISHED"}
    assert len(field_of(strokes_of(torus))) == 500
    assert [tuple(v.co) for v in strokes_of(torus).data.vertices] == before
    for vertex in torus.data.vertices:
        vertex.co.z += 0.01
    refused(operators.import_field, "does not lie on", filepath=str(tmp_path / "field.npz"))


def test_numbers_of_another_mesh_are_not_taken_for_vertices(operators):
    import bpy

    operators.add_monkey(resolution=12)
    thing = bpy.context.object
    thing.modifiers.new("fewer", "DECIMATE").ratio = 0.5
    operators.compute(**QUICK)
    bpy.ops.object.mode_set(mode="EDIT")
    select_vertex(thing, 5)
    refused(operators.copy_row, "compute without them")
    bpy.ops.object.mode_set(mode="OBJECT")
    operators.compute(evaluated=False, **QUICK)
    bpy.ops.object.mode_set(mode="EDIT")
    select_vertex(thing, 5)
    assert operators.copy_row() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")


def test_strokes_are_no_surface(operators, monkey):
    import bpy

    from pdtheory.blender.result import strokes_of

    strokes = strokes_of(monkey)
    bpy.data.objects.remove(monkey)
    bpy.context.view_layer.objects.active = strokes
    refused(operators.compute, "select the surface they belong to", **QUICK)


def test_finer_levels_under_sculpting_are_not_passed_over(operators):
    import bpy

    operators.add_monkey(resolution=6)
    thing = bpy.context.object
    thing.modifiers.new("finer", "MULTIRES")
    bpy.ops.object.multires_subdivide(modifier="finer")
    operators.compute(**QUICK)
    bpy.ops.object.mode_set(mode="SCULPT")
    refused(operators.compute, "leave Sculpt Mode", **QUICK)
    assert operators.compute(evaluated=False, **QUICK) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")


def test_the_ball_goes_with_the_result_it_belongs_to(operators, monkey):
    from pdtheory.blender.result import strokes_of

    operators.show_ball()
    assert strokes_of(monkey).children
    operators.compute(neighbours=60, degree=4, orders={"2"})
    assert not strokes_of(monkey).children
