"""The extension: every operator, on every kind of object, as scripts call it."""

from __future__ import annotations

import math

import numpy as np
import pytest
from blender_objects import QUICK, add_mesh, refused

pytestmark = pytest.mark.blender


def world_points(thing):
    """Return the vertices of a mesh object in world coordinates, as shown."""
    import bpy

    bpy.context.view_layer.update()
    evaluated = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    points = np.array([evaluated.matrix_world @ v.co for v in mesh.vertices])
    evaluated.to_mesh_clear()
    return points


def shown(thing):
    """Return (world positions, world directions, order, kind, point) of an object's strokes."""
    import bpy

    from pdtheory.blender.result import strokes_of

    strokes = strokes_of(thing)
    bpy.context.view_layer.update()
    count = len(strokes.data.vertices)
    arrays = {}
    for name, kind, width in (
        ("position", "vector", 3),
        ("direction", "vector", 3),
        ("order", "value", 1),
        ("kind", "value", 1),
        ("point", "value", 1),
    ):
        values = np.empty(count * width, dtype=np.float32 if width == 3 else np.int32)
        strokes.data.attributes[name].data.foreach_get(kind, values)
        arrays[name] = values.reshape(count, width).squeeze()
    matrix = np.array(strokes.matrix_world)
    place = arrays["position"] @ matrix[:3, :3].T + matrix[:3, 3]
    return (place, arrays["direction"] @ matrix[:3, :3].T, *list(arrays.values())[2:])


def test_unregistering_leaves_nothing_and_can_be_repeated(operators):
    import bpy

    import blender_addon

    def traces():
        menus = [
            draw
            for name in ("VIEW3D_MT_mesh_add", "TOPBAR_MT_file_import", "TOPBAR_MT_file_export")
            for draw in getattr(bpy.types, name)._dyn_ui_initialize()
        ]
        return [
            *(name for name in dir(bpy.types) if "irections" in name or "DIRECTIONS" in name),
            *(name for name in dir(bpy.ops.principal_directions) if not name.startswith("_")),
            *(f for f in menus if f.__module__.startswith("blender_addon")),
            *(f for f in bpy.app.handlers.load_pre if f.__module__.startswith("blender_addon")),
            *(
                owner
                for owner in (bpy.types.Scene, bpy.types.Object, bpy.types.WindowManager)
                if hasattr(owner, "principal_directions")
            ),
        ]

    before = sorted(map(str, traces()))
    assert before
    for _ in range(2):
        blender_addon.unregister()
        assert traces() == []
        blender_addon.register()
        assert sorted(map(str, traces())) == before


def test_order_two_of_a_torus_follows_its_circles(operators):
    import bpy

    operators.add_torus(major=1.0, minor=0.4, resolution=40)
    torus = bpy.context.object
    assert operators.compute(neighbours=60, degree=6, orders={"2"}) == {"FINISHED"}
    place, direction, _, kind, _ = shown(torus)
    radial = np.stack((place[:, 0], place[:, 1], 0 * place[:, 0]), axis=1)
    radial /= np.linalg.norm(radial, axis=1, keepdims=True)
    parallel = np.stack((-radial[:, 1], radial[:, 0], 0 * radial[:, 0]), axis=1)
    # With the outward normal both curvatures are negative outside, and the parallel bends less.
    along = np.abs((direction * parallel).sum(axis=1))
    assert np.degrees(np.arccos(np.clip(along[kind == 1], 0, 1))).max() < 0.2
    assert np.degrees(np.arcsin(np.clip(along[kind == -1], 0, 1))).max() < 0.2
    assert "points answered" in torus.principal_directions.summary


@pytest.mark.parametrize(
    "change",
    [
        {"scale": (1.0, 2.0, 0.5)},
        {"scale": (1.0, 1.0, -1.0)},
        {"rotation_euler": (0.3, 1.0, -0.4), "location": (3.0, -2.0, 1.0)},
        {"scale": (2.0, 0.7, -1.3), "rotation_euler": (1.0, 0.2, 0.5)},
    ],
)
@pytest.mark.parametrize("parented", [False, True])
def test_transforms_are_computed_as_they_look(operators, change, parented):
    import bpy

    operators.add_polynomial(resolution=12)
    thing = bpy.context.object
    if parented:
        parent = bpy.data.objects.new("parent", None)
        parent.scale = (1.0, 1.5, 1.0)
        parent.rotation_euler = (0.0, 0.0, 0.6)
        bpy.context.collection.objects.link(parent)
        thing.parent = parent
    for name, value in change.items():
        setattr(thing, name, value)
    bpy.context.view_layer.update()
    look = world_points(thing)
    settings = {"radius": 1.1, "degree": 4, "orders": {"2", "3"}}
    operators.compute(**settings)
    place, direction, order, kind, point = shown(thing)
    assert place == pytest.approx(look[point], abs=1e-5)

    faces = [tuple(p.vertices) for p in thing.data.polygons]
    applied = add_mesh(look, faces, "applied")
    if np.linalg.det(np.array(thing.matrix_world)[:3, :3]) < 0:
        applied.data.flip_normals()
    operators.compute(**settings)
    there = shown(applied)
    assert len(place) == pytest.approx(len(there[0]), rel=0.005)
    # The angle at which a frame starts is free: a direction is looked for among those of its kind.
    key = np.stack((point, order, kind), axis=1)
    other = np.stack((there[4], there[2], there[3]), axis=1)
    cosine = np.array(
        [
            (there[1][(other == k).all(axis=1)] @ d).max(initial=-1.0)
            for k, d in zip(key, direction, strict=True)
        ]
    )
    # Where two directions nearly merge, single precision moves them.
    assert np.quantile(cosine, 0.03) > math.cos(math.radians(0.5))


def test_computing_again_keeps_what_was_tuned(operators):
    import bpy

    from pdtheory.blender import compat
    from pdtheory.blender.result import strokes_of

    operators.add_monkey(resolution=10)
    thing = bpy.context.object
    operators.compute(**QUICK)
    strokes = strokes_of(thing)
    compat.set_input(strokes.modifiers[0], "Width", 0.5)
    compat.set_input(strokes.modifiers[0], "Style", "Lines")
    operators.compute(neighbours=40, degree=4, orders={"2", "4"})
    assert [child.name for child in thing.children] == [strokes.name]
    assert compat.get_input(strokes.modifiers[0], "Width") == 0.5
    assert compat.get_input(strokes.modifiers[0], "Style") == "Lines"
    assert compat.get_input(strokes.modifiers[0], "Order 4")
    assert not compat.get_input(strokes.modifiers[0], "Order 3")
    assert bpy.context.object == thing
    assert len([m for m in bpy.data.meshes if "directions points" in m.name]) == 1


def test_modifiers_count_only_if_asked(operators):
    import bpy

    operators.add_monkey(resolution=8)
    thing = bpy.context.object
    thing.modifiers.new("finer", "SUBSURF").levels = 1
    operators.compute(evaluated=False, **QUICK)
    assert shown(thing)[4].max() == len(thing.data.vertices) - 1
    operators.compute(evaluated=True, **QUICK)
    assert shown(thing)[4].max() == len(world_points(thing)) - 1


def test_shape_keys_are_seen(operators):
    import bpy

    operators.add_monkey(resolution=10)
    thing = bpy.context.object
    thing.shape_key_add(name="Basis")
    key = thing.shape_key_add(name="high")
    for vertex in key.data:
        vertex.co.z += 2.0 + vertex.co.x
    key.value = 1.0
    operators.compute(**QUICK)
    place, *_, point = shown(thing)
    assert place == pytest.approx(world_points(thing)[point], abs=1e-5)
    assert place[:, 2].mean() > 1.5


def test_edit_mode_sees_unsaved_edits(operators):
    import bmesh
    import bpy

    operators.add_monkey(resolution=10)
    thing = bpy.context.object
    bpy.ops.object.mode_set(mode="EDIT")
    edited = bmesh.from_edit_mesh(thing.data)
    bmesh.ops.translate(edited, verts=edited.verts, vec=(0.0, 0.0, 5.0))
    bmesh.update_edit_mesh(thing.data)
    operators.compute(**QUICK)
    place = shown(thing)[0]
    bpy.ops.object.mode_set(mode="OBJECT")
    assert place[:, 2].mean() == pytest.approx(5.0, abs=0.2)


def test_loose_vertices_are_left_out_and_said(operators):
    import bpy

    operators.add_monkey(resolution=10)
    thing = bpy.context.object
    count = len(thing.data.vertices)
    thing.data.vertices.add(3)
    for vertex in list(thing.data.vertices)[count:]:
        vertex.co = (9.0, 9.0, 9.0)
    operators.compute(**QUICK)
    assert "3 loose vertices left out" in thing.principal_directions.summary
    assert shown(thing)[0].max() < 5.0


def test_shared_meshes_each_get_their_own_strokes(operators):
    import bpy

    operators.add_monkey(resolution=10)
    first = bpy.context.object
    second = bpy.data.objects.new("second", first.data)
    second.location.x = 4.0
    bpy.context.collection.objects.link(second)
    for thing in (first, second):
        bpy.context.view_layer.objects.active = thing
        operators.compute(**QUICK)
    assert len(first.children) == len(second.children) == 1
    assert shown(second)[0][:, 0].mean() == pytest.approx(4.0, abs=0.1)


def test_a_surface_through_itself_and_a_fan_of_three_are_answered_or_flagged(operators):
    side = np.linspace(-1.0, 1.0, 12)
    grid = np.stack(np.meshgrid(side, side, indexing="ij"), axis=-1).reshape(-1, 2)
    i = np.arange(11 * 12).reshape(11, 12)[:, :-1].ravel()
    faces = np.stack((i, i + 12, i + 13, i + 1), axis=1)
    flat, upright = np.insert(grid, 2, 0.0, axis=1), np.insert(grid, 1, 0.0, axis=1)
    thing = add_mesh(np.concatenate((flat, upright)), np.concatenate((faces, faces + 144)))
    operators.compute(**QUICK)
    assert "points answered" in thing.principal_directions.summary


@pytest.mark.parametrize("kind", ["text", "curve"])
def test_curves_and_text_are_computed_on_their_surface(operators, kind):
    import bpy

    if kind == "text":
        bpy.ops.object.text_add()
        bpy.context.object.data.extrude = 0.2
        bpy.context.object.data.resolution_u = 24
    else:
        bpy.ops.curve.primitive_bezier_circle_add()
        bpy.context.object.data.bevel_depth = 0.3
        bpy.context.object.data.bevel_resolution = 12
    thing = bpy.context.object
    operators.compute(**QUICK)
    assert len(shown(thing)[0])
    assert thing.principal_directions.summary


def test_point_clouds_are_computed_without_faces(operators):
    import bpy

    operators.add_monkey(resolution=12)
    source = bpy.context.object
    wanted = world_points(source)
    if not hasattr(bpy.data, "pointclouds"):
        pytest.skip("this Blender has no point clouds")
    try:
        bpy.ops.object.convert(target="POINTCLOUD")
    except (TypeError, RuntimeError):
        pytest.skip("this Blender does not convert to point clouds")
    thing = bpy.context.object
    assert thing.type == "POINTCLOUD"
    operators.compute(**QUICK)
    place, *_, point = shown(thing)
    assert place == pytest.approx(wanted[point], abs=1e-5)


def test_samples_of_the_surface(operators):
    import bpy

    operators.add_torus(resolution=24)
    torus = bpy.context.object
    operators.compute(samples=3000, seed=5, neighbours=60, degree=4, orders={"2"})
    place = shown(torus)[0]
    assert len(np.unique(place.round(6), axis=0)) == 3000
    ring = np.hypot(np.hypot(place[:, 0], place[:, 1]) - 1.0, place[:, 2])
    assert ring == pytest.approx(0.4, abs=0.02)


@pytest.mark.parametrize(
    ("points", "message"),
    [([], "has no vertices"), ([(0, 0, 0), (1, 0, 0)], "2 finite points are too few")],
)
def test_too_little_is_a_sentence(operators, points, message):
    add_mesh(points)
    refused(operators.compute, message)


def test_bad_settings_are_sentences(operators):
    import bpy

    operators.add_monkey(resolution=8)
    refused(operators.compute, "no order is chosen", orders=set())
    refused(operators.compute, "order 8 is above the degree 4", orders={"8"}, degree=4)
    refused(operators.compute, "radius", radius=0.0)
    refused(operators.compute, "catches at most", radius=1e-6)
    bpy.context.object.scale.z = 0.0
    bpy.context.view_layer.update()
    refused(operators.compute, "scaled to zero")
    bpy.ops.object.camera_add()
    bpy.ops.object.armature_add()
    for operator in (operators.compute, operators.propose_radius, operators.import_field):
        refused(operator, "Select a mesh, curve, text, metaball or point cloud")


def test_strengths_lie_on_the_surface_and_can_be_shown(operators):
    import bpy

    from pdtheory.blender.result import field_of, strokes_of

    operators.add_monkey(resolution=10)
    thing = bpy.context.object
    operators.compute(**QUICK)
    values = np.empty(len(thing.data.vertices), dtype=np.float32)
    thing.data.attributes["directions_strength_3"].data.foreach_get("value", values)
    rows = field_of(strokes_of(thing))[3]
    expected = np.zeros(len(values))
    np.maximum.at(expected, rows.point_index, rows.strength)
    assert values == pytest.approx(expected, rel=1e-5)
    assert operators.show_strength(order="3") == {"FINISHED"}
    material = thing.active_material
    assert any(
        node.type == "ATTRIBUTE" and node.attribute_name == "directions_strength_3"
        for node in material.node_tree.nodes
    )


def test_saved_and_opened_again_the_result_is_complete(operators, tmp_path):
    import bpy

    from pdtheory.blender.result import field_of, forget_all, strokes_of

    operators.add_monkey(resolution=10)
    operators.compute(**QUICK)
    before = field_of(strokes_of(bpy.context.object))
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "saved.blend"))
    forget_all()
    thing = bpy.data.objects["monkey"]
    after = field_of(strokes_of(thing))
    assert after is not before
    assert after.points == pytest.approx(before.points, abs=1e-6)
    assert after.phi == pytest.approx(before.phi, rel=1e-6, abs=1e-9)
    assert np.array_equal(after.phi_order, before.phi_order)
    assert np.array_equal(after.status, before.status)
    for order in (2, 3):
        assert np.array_equal(after[order].offsets, before[order].offsets)
        assert np.array_equal(after[order].kind, before[order].kind)
        turned = np.angle(np.exp(1j * (after[order].angle - before[order].angle)))
        assert np.abs(turned).max() < 1e-5
        assert after[order].eigenvalue == pytest.approx(before[order].eigenvalue, rel=1e-6)
    assert thing.principal_directions.summary


@pytest.mark.parametrize("link", [True, False])
def test_linked_or_appended_strokes_still_draw(operators, tmp_path, link):
    import bpy

    from pdtheory.blender.result import strokes_of
    from pdtheory.blender.scene import new_file

    operators.add_monkey(resolution=10)
    operators.compute(**QUICK)
    name = strokes_of(bpy.context.object).name
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "library.blend"))
    scene = new_file()
    with bpy.data.libraries.load(str(tmp_path / "library.blend"), link=link) as (_, wanted):
        wanted.objects = [name]
    scene.collection.objects.link(wanted.objects[0])
    graph = bpy.context.evaluated_depsgraph_get()
    drawn = wanted.objects[0].evaluated_get(graph).data
    assert len(drawn.polygons) > 100
    assert {m.name for m in drawn.materials if m} >= {"Directions of order 2"}


def test_without_the_extension_the_strokes_still_draw(operators, tmp_path):
    import subprocess
    import sys

    import bpy

    operators.add_monkey(resolution=10)
    operators.compute(**QUICK)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "plain.blend"))
    script = (
        "import bpy, sys\n"
        "bpy.ops.wm.open_mainfile(filepath=sys.argv[1])\n"
        "assert 'pdtheory' not in sys.modules\n"
        "graph = bpy.context.evaluated_depsgraph_get()\n"
        "shown = [o.evaluated_get(graph).data for o in bpy.data.objects if o.modifiers]\n"
        "print('polygons', len(shown[0].polygons))\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script, str(tmp_path / "plain.blend")],
        capture_output=True,
        text=True,
        check=True,
    )
    line = next(line for line in done.stdout.splitlines() if line.startswith("polygons"))
    assert int(line.split()[1]) > 100


def test_duplicating_and_deleting_behave_as_for_any_object(operators):
    import bpy

    from pdtheory.blender.result import field_of, strokes_of

    operators.add_monkey(resolution=10)
    thing = bpy.context.object
    operators.compute(**QUICK)
    strokes = strokes_of(thing)
    copy = strokes.copy()
    copy.data = strokes.data.copy()
    bpy.context.collection.objects.link(copy)
    assert len(field_of(copy)) == len(field_of(strokes))
    bpy.data.objects.remove(strokes)
    bpy.data.objects.remove(copy)
    assert strokes_of(thing) is None
    operators.compute(**QUICK)
    assert strokes_of(thing) is not None


@pytest.mark.parametrize("suffix", [".npz", ".ply", ".csv"])
def test_export(operators, tmp_path, suffix):
    operators.add_monkey(resolution=10)
    operators.compute(**QUICK)
    path = tmp_path / f"field{suffix}"
    assert operators.export_field(filepath=str(path)) == {"FINISHED"}
    assert path.stat().st_size > 1000
    refused(operators.export_field, "does not exist", filepath=str(tmp_path / "no" / "field.npz"))


def test_import_of_a_field_computed_elsewhere(operators, tmp_path):
    import bpy

    from pdtheory.pointset.estimate import estimate_directions

    operators.add_monkey(resolution=10)
    thing = bpy.context.object
    points = np.array([v.co for v in thing.data.vertices], dtype=np.float64)
    thing.rotation_euler = (math.pi / 2, 0.0, 0.3)
    bpy.context.view_layer.update()
    field = estimate_directions(points, neighbours=40, degree=4, orders=(2, 3))
    field.save(tmp_path / "field.npz")
    assert operators.import_field(filepath=str(tmp_path / "field.npz")) == {"FINISHED"}
    place, direction, order, _, point = shown(thing)
    assert place == pytest.approx(world_points(thing)[point], abs=1e-5)
    turn = np.array(thing.matrix_world)[:3, :3]
    assert direction[order == 2] == pytest.approx(field[2].vector @ turn.T, abs=1e-5)

    operators.add_torus(resolution=10)
    refused(operators.import_field, "does not lie on", filepath=str(tmp_path / "field.npz"))


def test_every_synthetic_surface_can_be_added(operators):
    import bpy

    import synthetic_surfaces

    for name in synthetic_surfaces.names():
        operator = getattr(operators, "add_" + name.replace("-", "_"))
        assert operator(resolution=6) == {"FINISHED"}, name
        thing = bpy.context.object
        assert len(thing.data.polygons), name
        assert name in thing.principal_directions.surface


def test_parameters_of_a_surface(operators):
    import bpy

    operators.add_torus(major=2.0, minor=0.5, resolution=12)
    assert max(bpy.context.object.dimensions) == pytest.approx(5.0, abs=0.05)
    refused(operators.add_torus, "minor", major=1.0, minor=3.0)


def test_the_selected_point_of_the_monkey_saddle(operators):
    import bpy

    from blender_addon.inspect_point import active_point, table, wavejets_row

    operators.add_monkey(resolution=16)
    thing = bpy.context.object
    operators.compute(neighbours=80, degree=6, orders={"3"})
    thing.principal_directions.point = int(np.argmin([v.co.length for v in thing.data.vertices]))
    field, point = active_point(thing)
    rows = table(field, point)
    assert [row[1] for row in rows] == ["max", "min"] * 3 or [row[1] for row in rows] == [
        "min",
        "max",
    ] * 3
    for row in rows:
        value = float(row[3].split()[0])
        assert abs(value) == pytest.approx(6.0, rel=1e-3)
    lines = wavejets_row(field, point).splitlines()
    assert len(lines) == 1 + len(field.phi_order)
    real, imaginary = next(line for line in lines if line.startswith("phi_3_3")).split()[2:]
    assert abs(complex(float(real), float(imaginary[:-1]))) == pytest.approx(0.5, rel=1e-4)


def test_the_polar_plots_of_the_monkey_saddle(operators):
    import time

    import bpy

    from blender_addon import polar_plot

    operators.add_monkey(resolution=16)
    thing = bpy.context.object
    operators.compute(neighbours=80, degree=6, orders={"2", "3"})
    started = time.monotonic()
    assert polar_plot.plots_of(thing, 200) == ([], "Drawing ...")
    # The panel may not wait for matplotlib, whose import alone takes a good part of a second.
    assert time.monotonic() - started < 0.2
    plots = polar_plot._plots
    while plots._look() is not None:
        time.sleep(0.02)
    bpy.app.timers.unregister(plots._timer)
    icons, sentence = polar_plot.plots_of(thing, 200)
    assert (len(icons), sentence) == (2, "")
    assert list(plots.icons) == ["2", "3"]
    for order, icon in plots.icons.items():
        width, height = icon.image_size
        assert (width, height) == (177, 200)
        values = np.array(icon.image_pixels[:], np.int32).view(np.uint8).reshape(height, width, 4)
        assert (values[..., 3] == 255).all()
        # Upright: the heading with the order's colour is at the top, whose rows come last.
        coloured = np.ptp(values[..., :3].astype(int), axis=-1) > 60
        assert coloured[-14:].sum() > 20 > coloured[:14].sum(), order
    # Another vertex has other plots, and nothing is drawn twice at once.
    thing.principal_directions.point = 40
    assert polar_plot.plots_of(thing, 200) == ([], "Drawing ...")
    job = plots._job
    polar_plot.plots_of(thing, 300)
    assert plots._job is job
    job.wait()


def test_the_polar_plot_as_an_image(operators):
    import bpy

    operators.add_monkey(resolution=10)
    thing = bpy.context.object
    refused(operators.plot_point, "there is no result on this object")
    operators.compute(**QUICK)
    for vertex in (0, 5):
        thing.principal_directions.point = vertex
        assert operators.plot_point() == {"FINISHED"}
        (image,) = bpy.data.images
        assert image.name == "monkey polar plot"
        assert tuple(image.size) == (960, 610)
        assert image.packed_file
    pixels = np.array(image.pixels[:]).reshape(610, 960, 4)
    # White at the edges, the blue of order 2 on the left, the green of order 3 on the right.
    assert pixels[0].min() == 1.0
    left, right = pixels[:, :480], pixels[:, 480:]
    assert (left[..., 2] > left[..., :2].max(axis=-1) + 0.3).mean() > 0.002
    assert (right[..., 1] > right[..., [0, 2]].max(axis=-1) + 0.3).mean() > 0.002
    thing.principal_directions.point = 10**6
    refused(operators.plot_point, "vertex 1000000 has no result")
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    refused(operators.plot_point, "no vertex is active")
    refused(operators.copy_row, "no vertex is active")
    bpy.ops.object.mode_set(mode="OBJECT")


def test_a_point_without_an_answer_has_no_plot(operators):
    import bpy

    operators.add_monkey(resolution=10)
    thing = bpy.context.object
    thing.data.vertices[3].co = (1e3, 1e3, 1e3)
    operators.compute(radius=0.6, degree=4, orders={"2"})
    thing.principal_directions.point = 3
    refused(operators.plot_point, "too few distinct neighbours")


def test_the_ball_shows_and_hides(operators):
    import bpy

    from pdtheory.blender.result import strokes_of

    operators.add_monkey(resolution=10)
    thing = bpy.context.object
    thing.location = (1.0, 2.0, 3.0)
    bpy.context.view_layer.update()
    operators.compute(radius=0.5, degree=4, orders={"2"})
    thing.principal_directions.point = 7
    operators.show_ball()
    bpy.context.view_layer.update()
    (ball,) = strokes_of(thing).children
    assert ball.empty_display_size == pytest.approx(0.5)
    assert tuple(ball.matrix_world.translation) == pytest.approx(
        tuple(thing.matrix_world @ thing.data.vertices[7].co), abs=1e-5
    )
    operators.show_ball()
    assert not strokes_of(thing).children


def test_the_proposed_radius_holds_twice_what_a_fit_needs(operators):
    import bpy

    side = np.arange(30.0)
    grid = np.stack(np.meshgrid(side, side, [0.0], indexing="ij"), axis=-1).reshape(-1, 3)
    add_mesh(grid)
    settings = bpy.context.scene.principal_directions
    settings.degree = 4
    operators.propose_radius()
    # 30 lattice points lie within 3 of one inside (29 do), the 30th at sqrt(10).
    assert 3.0 <= settings.radius <= 4.3
    assert settings.neighbourhood == "RADIUS"


def test_strokes_render_in_cycles(operators, tmp_path):
    import bpy

    from pdtheory.blender import compat
    from pdtheory.blender.result import strokes_of
    from pdtheory.blender.scene import render_picture, set_stage
    from pdtheory.drawing.view import View

    operators.add_monkey(resolution=16)
    thing = bpy.context.object
    operators.compute(neighbours=60, degree=4, orders={"3"})
    compat.set_input(strokes_of(thing).modifiers[0], "Width", 0.6)
    scene = bpy.context.scene
    scene.render.resolution_x = scene.render.resolution_y = 64
    set_stage(scene, world_points(thing), View("z", elevation=60.0))
    render_picture(scene, tmp_path / "small.png", samples=4)
    image = bpy.data.images.load(str(tmp_path / "small.png"))
    pixels = np.array(image.pixels[:]).reshape(-1, 4)
    green = pixels[:, 1] - np.maximum(pixels[:, 0], pixels[:, 2])
    assert (green > 0.1).mean() > 0.01


def test_colours_reach_viewport_and_pictures(operators):
    import bpy

    from pdtheory.blender.needles import order_material

    material = order_material(3)
    material.principal_directions_colour = (0.9, 0.1, 0.2)
    assert tuple(material.diffuse_color)[:3] == pytest.approx((0.9, 0.1, 0.2))
    shader = next(n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED")
    assert tuple(shader.inputs["Base Color"].default_value)[:3] == pytest.approx((0.9, 0.1, 0.2))
    assert tuple(material.principal_directions_colour) == pytest.approx((0.9, 0.1, 0.2))
    assert bpy.data.materials["Directions of order 3"] == material


def test_a_million_strokes_do_not_crash(operators):
    import bpy

    from pdtheory.blender.result import show_result
    from pdtheory.blender.source import read_object
    from pdtheory.pointset.estimate import estimate_directions

    operators.add_monkey(resolution=24)
    thing = bpy.context.object
    source = read_object(thing)
    field = estimate_directions(source.cloud, neighbours=40, degree=4, orders=(2, 3))
    from dataclasses import replace

    from pdtheory.blender import compat
    from pdtheory.drawing.glyphs import glyph_data

    data = glyph_data(field)
    times = -(-1_000_000 // len(data))
    many = replace(
        data,
        position=np.tile(data.position, (times, 1)),
        attributes={
            name: np.tile(values, (times, 1) if values.ndim == 2 else times)
            for name, values in data.attributes.items()
        },
    )
    strokes = show_result(thing, source, field, many)
    for name, value in {
        "Spacing": 0.0,
        "One Order Per Point": False,
        "Minima": True,
        "Style": "Lines",
        "Follow Surface": False,
    }.items():
        compat.set_input(strokes.modifiers[0], name, value)
    strokes.update_tag()
    graph = bpy.context.evaluated_depsgraph_get()
    graph.update()
    drawn = strokes.evaluated_get(graph).data
    assert len(drawn.polygons) >= 1_000_000
