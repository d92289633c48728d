"""The extension as it is handled: edits meanwhile, switching it off, presets, files."""

from __future__ import annotations

import pytest
from blender_objects import QUICK, refused, written

pytestmark = pytest.mark.blender


@pytest.fixture
def monkey(operators):
    """A monkey saddle."""
    import bpy

    operators.add_monkey(resolution=10)
    return bpy.context.object


def meanwhile(monkeypatch, change):
    """Let something happen between reading an object and showing the result."""
    from pdtheory.blender.background import Job

    run = Job.run_here

    def both(job):
        change()
        return run(job)

    monkeypatch.setattr(Job, "run_here", both)


def move_a_vertex(thing):
    thing.data.vertices[7].co.z += 0.1


def add_a_modifier(thing):
    import bpy

    thing.modifiers.new("taper", "SIMPLE_DEFORM").deform_method = "TAPER"
    bpy.context.view_layer.update()


@pytest.mark.parametrize("change", [move_a_vertex, add_a_modifier])
def test_an_edit_meanwhile_is_noticed_though_the_counts_stay(
    operators, monkey, monkeypatch, change
):
    operators.compute(**QUICK)
    assert "meanwhile" not in monkey.principal_directions.summary
    meanwhile(monkeypatch, lambda: change(monkey))
    operators.compute(**QUICK)
    lines = monkey.principal_directions.summary.splitlines()
    assert lines[0] == "monkey was edited meanwhile; compute again."
    assert "points answered" in lines[1]


def test_moving_an_object_meanwhile_is_no_edit(operators, monkey, monkeypatch):
    import bpy

    def move():
        monkey.location.x = 3.0
        monkey.rotation_euler.z = 1.0
        bpy.context.view_layer.update()

    meanwhile(monkeypatch, move)
    operators.compute(**QUICK)
    assert "meanwhile" not in monkey.principal_directions.summary


def test_switching_off_ends_the_computation_on_the_panel(operators):
    import bpy

    import blender_addon
    from blender_addon import jobs
    from pdtheory.blender.background import Job

    running = jobs.Prepared(Job(lambda report: None), 0, "nothing")
    jobs._running = running
    bpy.context.window_manager.principal_directions.running = True
    blender_addon.unregister()
    blender_addon.register()
    assert jobs._running is None
    assert running.job.cancelled
    assert not bpy.context.window_manager.principal_directions.running


def test_presets_are_kept_taken_and_removed(operators, tmp_path, monkeypatch):
    import bpy

    monkeypatch.setenv("BLENDER_USER_SCRIPTS", str(tmp_path))
    settings = bpy.context.scene.principal_directions
    settings.neighbours, settings.orders = 123, {"2", "5"}
    assert operators.preset_add(name="Rough scan") == {"FINISHED"}
    (kept,) = (tmp_path / "presets" / "principal_directions").iterdir()
    settings.neighbours, settings.orders = 30, {"3"}
    menu = bpy.types.DIRECTIONS_PT_presets
    assert menu.preset_add_operator == "principal_directions.preset_add"
    assert bpy.ops.script.execute_preset(filepath=str(kept), menu_idname=menu.__name__) == {
        "FINISHED"
    }
    assert settings.neighbours == 123
    assert settings.orders == {"2", "5"}
    assert operators.preset_add(name="Rough scan", remove_name=True) == {"FINISHED"}
    assert not kept.exists()


def test_what_needs_a_result_says_so(operators, monkey):
    for operator in (operators.export_field, operators.copy_row, operators.show_ball):
        refused(operator, "Compute the directions of this object first")


def test_files_beside_the_blend_file(operators, monkey, tmp_path):
    import bpy

    operators.compute(**QUICK)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "monkey.blend"))
    assert operators.export_field(filepath="//directions") == {"FINISHED"}
    assert (tmp_path / "directions.npz").is_file()
    bpy.data.objects.remove(monkey.children[0])
    assert monkey.principal_directions.summary == ""
    assert operators.import_field(filepath="//directions.npz") == {"FINISHED"}
    assert "points answered" in monkey.principal_directions.summary


def subdivide(thing):
    import bpy

    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide()
    bpy.ops.object.mode_set(mode="OBJECT")


def remesh(thing):
    import bpy

    thing.modifiers.new("remesh", "REMESH").voxel_size = 0.1
    bpy.ops.object.modifier_apply(modifier="remesh")


def stretch(thing):
    thing.scale.z = 2.0


def smooth_for_the_picture(thing):
    thing.modifiers.new("smooth", "SUBSURF")


def turn(thing):
    thing.scale = (3.0, -3.0, 3.0)
    thing.rotation_euler = (0.3, 0.2, 0.1)
    thing.location.x = 4.0


@pytest.mark.parametrize(
    ("change", "stale"),
    [
        (subdivide, True),
        (remesh, True),
        (stretch, True),
        (smooth_for_the_picture, False),
        (turn, False),
    ],
)
def test_a_result_that_is_no_longer_of_the_object_is_known(operators, monkey, change, stale):
    import bpy

    from pdtheory.blender.matching import changed_since
    from pdtheory.blender.result import strokes_of

    operators.compute(**QUICK)
    assert not changed_since(monkey, strokes_of(monkey))
    change(monkey)
    bpy.context.view_layer.update()
    assert changed_since(monkey, strokes_of(monkey)) == stale
    operators.compute(**QUICK)
    assert not changed_since(monkey, strokes_of(monkey))


def test_a_result_with_modifiers_is_known_by_what_they_make(operators, monkey):
    import bpy

    from pdtheory.blender.matching import changed_since
    from pdtheory.blender.result import strokes_of

    finer = monkey.modifiers.new("finer", "SUBSURF")
    operators.compute(**QUICK)
    assert not changed_since(monkey, strokes_of(monkey))
    finer.levels = 2
    bpy.context.view_layer.update()
    assert changed_since(monkey, strokes_of(monkey))


def test_the_panel_says_that_the_object_has_changed(operators, monkey):
    operators.compute(**QUICK)
    lines = written("DIRECTIONS_PT_result")
    assert "331 of 331 points answered." in lines
    assert "changed" not in " ".join(lines)
    subdivide(monkey)
    assert "monkey has changed since; compute" in " ".join(written("DIRECTIONS_PT_result"))


@pytest.mark.parametrize("scale", [1e-9, 1.0, 1e9])
def test_the_table_of_a_point_is_short_whatever_the_size(torus_field, scale):
    from dataclasses import replace

    from blender_addon.inspect_point import table

    field = torus_field[1]
    rows = replace(
        field[3], eigenvalue=-1.23456 * scale * field[3].eigenvalue, eigenvalue_std=field[3].angle
    )
    for order, kind, angle, eigenvalue in table(replace(field, directions={3: rows}), 0):
        assert order == 3
        # What is longer is cut off in a sidebar of the width that Blender gives it at first.
        assert len(kind) <= 5
        assert len(angle) <= 13
        assert len(eigenvalue) <= 18
        first = field[3].eigenvalue[0]
        assert abs(float(eigenvalue.split()[0])) == pytest.approx(1.23456 * scale * first, rel=5e-4)


def test_the_panel_of_a_point_names_each_order_once(operators, monkey):
    operators.compute(**QUICK)
    lines = written("DIRECTIONS_PT_point")
    assert lines[:3] == ["Kind", "Angle (°)", "Eigenvalue"]
    assert [line for line in lines if line.startswith("Order")] == ["Order 2", "Order 3"]
    assert {"max", "min"} <= set(lines)
