"""Strokes: the data on the glyph object, and what its modifier makes of them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pdtheory.errors import InputError

pytestmark = pytest.mark.blender

#: Less than half the way between two points of the torus.
LENGTH = 0.03


@pytest.fixture
def strokes(scene, torus_field):
    """Strokes at every point, all of one length, on their tangents."""
    from pdtheory.blender.glyphs import add_glyphs
    from pdtheory.drawing.glyphs import glyph_data

    glyphs = add_glyphs(glyph_data(torus_field[1]), name="strokes", collection=scene.collection)
    tune(glyphs, **{"Spacing": 0.0, "Length": LENGTH, "Lift": 0.0, "One Order Per Point": False})
    return glyphs


def tune(glyphs, **inputs):
    from pdtheory.blender import compat

    for name, value in inputs.items():
        compat.set_input(glyphs.modifiers[0], name, value)
    glyphs.update_tag()


def drawn(glyphs):
    """Return (vertices (V, 3), order of each face, material name of each face)."""
    import bpy

    graph = bpy.context.evaluated_depsgraph_get()
    graph.update()
    mesh = glyphs.evaluated_get(graph).data
    vertices = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", vertices)
    slot = np.empty(len(mesh.polygons), dtype=np.int32)
    mesh.polygons.foreach_get("material_index", slot)
    corner = np.empty(len(mesh.polygons), dtype=np.int32)
    mesh.polygons.foreach_get("loop_start", corner)
    vertex = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.loops.foreach_get("vertex_index", vertex)
    order = np.empty(len(mesh.vertices), dtype=np.int32)
    if len(order):
        mesh.attributes["order"].data.foreach_get("value", order)
    names = [material.name if material else "" for material in mesh.materials]
    return (
        vertices.reshape(-1, 3).astype(float),
        order[vertex[corner]],
        np.array(names)[slot] if names else np.empty(0, dtype=str),
    )


def pieces(vertices, points):
    """Return for each vertex the nearest of the given points."""
    from scipy.spatial import cKDTree

    return cKDTree(points).query(vertices)[1]


def test_one_vertex_with_all_attributes_for_each_direction(strokes, torus_field):
    field = torus_field[1]
    mesh = strokes.data
    rows = len(field[2]) + len(field[3])
    assert len(mesh.vertices) == rows
    eigenvalue = np.empty(rows, dtype=np.float32)
    mesh.attributes["eigenvalue"].data.foreach_get("value", eigenvalue)
    assert np.allclose(eigenvalue, np.concatenate((field[2].eigenvalue, field[3].eigenvalue)))
    direction = np.empty(3 * rows, dtype=np.float32)
    mesh.attributes["direction"].data.foreach_get("vector", direction)
    assert np.allclose(
        direction.reshape(-1, 3), np.concatenate((field[2].vector, field[3].vector)), atol=1e-6
    )
    point = np.empty(rows, dtype=np.int32)
    mesh.attributes["point"].data.foreach_get("value", point)
    assert np.array_equal(point[: len(field[2])], field[2].point_index)


def test_strokes_run_along_their_directions(strokes, torus_field):
    field = torus_field[1]
    tune(strokes, **{"Order 3": False, "Follow Surface": False, "Width": 0.01})
    vertices, _, _ = drawn(strokes)
    owner = pieces(vertices, field.points)
    offset = vertices - field.points[owner]
    # Maxima of order 2 follow the parallels, the second axis of the frames.
    parallel, meridian = field.frames[owner, 1], field.frames[owner, 0]
    assert np.abs((offset * parallel).sum(axis=1)).max() == pytest.approx(LENGTH, rel=1e-4)
    assert np.abs((offset * meridian).sum(axis=1)).max() < 0.006 * LENGTH
    maxima = field[2].maxima
    assert len(vertices) % len(maxima) == 0


def test_strokes_bend_onto_the_surface(strokes):
    tune(strokes, **{"Order 3": False, "Maxima": False, "Minima": True, "Width": 0.001})
    vertices, _, _ = drawn(strokes)
    # Along a meridian, a circle of radius r, every vertex stays at distance r from the core.
    ring = np.hypot(vertices[:, 0], vertices[:, 1])
    distance = np.hypot(ring - 1.0, vertices[:, 2])
    # A parabola leaves its circle by L^4 / (8 r^3), a stroke by half its width.
    assert np.abs(distance - 0.4).max() < LENGTH**4 / (8 * 0.4**3) + 0.001 * LENGTH


def test_every_order_has_its_material(strokes):
    _, order, material = drawn(strokes)
    assert set(order) == {2, 3}
    for k in (2, 3):
        assert set(material[order == k]) == {f"Directions of order {k}"}


def test_solid_shading_shows_the_colours_of_the_paper(strokes):
    import bpy

    blue = bpy.data.materials["Directions of order 2"].diffuse_color
    green = bpy.data.materials["Directions of order 3"].diffuse_color
    assert blue[2] > 2 * max(blue[:2])
    assert green[1] > 2 * max(green[0], green[2])


@pytest.mark.parametrize("style", ["Needles", "Arrows", "Lines"])
def test_styles_are_built_for_every_direction(strokes, torus_field, style):
    tune(strokes, Style=style)
    vertices, order, _ = drawn(strokes)
    shown = len(torus_field[1][2].maxima) + len(torus_field[1][3].maxima)
    assert len(vertices) % shown == 0
    assert len(vertices) // shown >= 4
    assert set(order) == {2, 3}


def test_what_is_shown_follows_the_inputs(strokes, torus_field):
    field = torus_field[1]
    tune(strokes, Style="Lines")
    per_stroke = len(drawn(strokes)[0]) // (len(field[2].maxima) + len(field[3].maxima))

    def count():
        return len(drawn(strokes)[0]) // per_stroke

    tune(strokes, Minima=True)
    assert count() == len(field[2]) + len(field[3])
    tune(strokes, **{"Order 2": False})
    assert count() == len(field[3])
    tune(strokes, **{"Least Strength": 1.0})
    assert count() == 0
    tune(strokes, **{"Least Strength": 0.0, "Largest Uncertainty": 0.001})
    assert count() == 0
    tune(strokes, **{"Largest Uncertainty": 3.15, "Maxima": False})
    assert count() == len(field[3].minima)


def test_one_order_per_point_deals_all_points(strokes, torus_field):
    tune(strokes, **{"One Order Per Point": True, "Style": "Lines", "Follow Surface": False})
    _, order, _ = drawn(strokes)
    points = torus_field[1].points
    # One order has 2 maxima at a point, the other 3, and a line is one face.
    shares = np.array([np.sum(order == 2) / 2, np.sum(order == 3) / 3])
    assert shares.sum() == len(points)
    assert shares == pytest.approx([len(points) / 2] * 2, rel=0.05)
    tune(strokes, **{"Order 3": False})
    assert len(drawn(strokes)[1]) == 2 * len(points)


def test_spacing_thins_without_computing_again(strokes):
    everywhere = len(drawn(strokes)[0])
    tune(strokes, Spacing=0.4)
    few = len(drawn(strokes)[0])
    tune(strokes, Spacing=0.2)
    assert 0 < few < len(drawn(strokes)[0]) < everywhere


def test_strength_can_set_the_length(strokes, torus_field):
    field = torus_field[1]
    tune(strokes, **{"Order 3": False, "Follow Surface": False, "By Strength": 1.0, "Width": 0.001})
    vertices, _, _ = drawn(strokes)
    owner = pieces(vertices, field.points)
    along = np.abs(((vertices - field.points[owner]) * field.frames[owner, 1]).sum(axis=1))
    reach = np.zeros(len(field))
    np.maximum.at(reach, owner, along)
    strength = field[2].maxima.strength[::2]
    typical = np.quantile(field[2].strength, 0.9)
    assert reach == pytest.approx(LENGTH * np.minimum(strength / typical, 1.5), abs=1e-6)


def test_an_order_that_was_not_computed_is_refused(torus_field, scene):
    from pdtheory.drawing.glyphs import glyph_data

    with pytest.raises(InputError, match="order 5 was not computed"):
        glyph_data(torus_field[1], (2, 5))


def test_one_node_group_serves_all(scene, torus_field):
    import bpy

    from pdtheory.blender.glyphs import add_glyphs
    from pdtheory.drawing.glyphs import glyph_data

    data = glyph_data(torus_field[1])
    first, second = (
        add_glyphs(data, name="strokes", collection=scene.collection) for _ in range(2)
    )
    assert first.modifiers[0].node_group == second.modifiers[0].node_group
    assert len(bpy.data.node_groups) == 1


def test_undetermined_angles_are_named(torus_field):
    from blender_addon.inspect_point import table
    from pdtheory.blender.result import describe

    field = torus_field[1]
    loose = replace(field[3], angle_std=np.full(len(field[3]), 1600.0))
    field = replace(field, directions={2: field[2], 3: loose})
    angles = {row[0]: row[2] for row in table(field, 7)}
    assert angles == {2: "270.0 ± 0.6", 3: "undetermined"}
    *_, two, three = describe(field)
    assert two.endswith("± 0.57°")
    assert three.endswith("angles undetermined")


def test_a_table_tells_no_more_of_eigenvalues_than_the_text_of_the_point(torus_field):
    from blender_addon.inspect_point import table

    field = torus_field[1]
    rows = field[2]

    def cells(**changed):
        changed = replace(field, directions={2: replace(rows, **changed)})
        shown = [row[2:] for row in table(changed, 7)]
        return shown, str(changed.at(7)).splitlines()[-len(shown) :]

    lost, text = cells(eigenvalue_std=np.abs(rows.eigenvalue) * 1e6)
    assert {value for _, value in lost} == {"undetermined"}
    assert all("(undetermined)" in line for line in text)
    for unknown in (np.nan, np.inf):
        alone = np.full(len(rows), unknown)
        bare, text = cells(eigenvalue_std=alone, angle_std=alone)
        assert not any(" ± " in line for line in text)
        for angle, value in bare:
            float(angle), float(value)
