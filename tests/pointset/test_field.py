"""A field as it reads in Python: orders, points, summaries, other libraries."""

from __future__ import annotations

import doctest
import importlib
import json
import sys
from dataclasses import fields, replace
from math import degrees, factorial, radians

import numpy as np
import pytest
import trimesh

from pdtheory.conventions import ORDER_COLOURS, Status
from pdtheory.errors import InputError, MissingDependencyError
from pdtheory.pointset import DirectionField, estimate_directions
from pdtheory.pointset.directions import ROW_ARRAYS, Ragged
from pdtheory.pointset.summary import order_summaries
from pdtheory.pointset.words import STATUS_WORDS, angle_with_error, status_words, with_error
from tests.pointset.surfaces import torus


@pytest.fixture(scope="module")
def field() -> DirectionField:
    """A torus and, as the last point, one far away without an answer."""
    points = np.concatenate([torus(1500, 1.0, 0.4, 3)[0], [[9.0, 0.0, 0.0]]])
    return estimate_directions(points, radius=0.35, degree=4, orders=(2, 3, 4))


@pytest.mark.parametrize("name", ["directions", "words"])
def test_examples(name):
    module = importlib.import_module(f"pdtheory.pointset.{name}")
    result = doctest.testmod(module)
    assert result.attempted > 0
    assert result.failed == 0


def test_plural_names_are_the_flat_columns_point_by_point(field):
    maxima = field[3].maxima
    for plural, flat in (("vectors", "vector"), ("angles", "angle"), ("strengths", "strength")):
        ragged = getattr(maxima, plural)
        assert len(ragged) == len(field)
        np.testing.assert_array_equal(np.concatenate(list(ragged)), getattr(maxima, flat))
    assert maxima.vectors[7].shape == (maxima.counts[7], 3)
    assert maxima.vectors[-1].shape == (0, 3)
    np.testing.assert_array_equal(maxima.eigenvalues[3], maxima.eigenvalue[maxima.rows_of(3)])
    assert [len(part) for part in maxima.vectors[2:5]] == maxima.counts[2:5].tolist()
    with pytest.raises(IndexError):
        maxima.vectors[len(field)]


def test_padded_rows_hold_the_same(field):
    vectors = field[2].vectors
    padded = vectors.padded()
    assert padded.shape == (len(field), vectors.counts.max(), 3)
    assert np.isfinite(padded).all(axis=2).sum() == len(vectors.flat)
    np.testing.assert_array_equal(padded[5, : vectors.counts[5]], vectors[5])
    assert np.isnan(padded[-1]).all()
    empty = Ragged(np.zeros((0, 3)), np.zeros(1, np.int64))
    assert empty.padded().shape == (0, 0, 3)
    assert repr(empty) == "<no points>"


@pytest.mark.parametrize(
    "points",
    [slice(10, 20), slice(None, None, -7), [5, 3, 3, -1], np.arange(1501) % 4 == 0, []],
    ids=["slice", "backwards", "indices", "mask", "none"],
)
def test_points_are_taken(field, points):
    index = np.arange(len(field))[points if len(np.atleast_1d(points)) else []]
    part = field.take(points)
    assert len(part) == len(index)
    assert part.orders == field.orders
    np.testing.assert_array_equal(part.points, field.points[index])
    np.testing.assert_array_equal(part.phi, field.phi[index])
    np.testing.assert_array_equal(part.phi_order, field.phi_order)
    for order in field.orders:
        assert part[order].offsets[-1] == len(part[order])
        for name in ROW_ARRAYS:
            for row, source in enumerate(index):
                np.testing.assert_array_equal(
                    getattr(part[order], name)[part[order].rows_of(row)],
                    getattr(field[order], name)[field[order].rows_of(int(source))],
                )


def test_a_part_is_saved_and_read_like_a_whole(field, tmp_path):
    part = field.take([4, 2])
    part.save(tmp_path / "part.npz")
    back = DirectionField.load(tmp_path / "part.npz")
    for entry in fields(field):
        if entry.name != "directions":
            np.testing.assert_array_equal(getattr(back, entry.name), getattr(part, entry.name))
    np.testing.assert_array_equal(back[3].vector, part[3].vector)


@pytest.mark.parametrize(
    ("points", "words"),
    [
        ([1501], "there is no point 1501; the field has 1501 points, counted from 0"),
        ([-1502], "there is no point -1502"),
        ([True, False], "the mask has 2 entries for 1501 points"),
        ([1.5], "float64"),
        ("abc", "choose nothing"),
        ([[1, 2]], r"shape \(1, 2\)"),
        ([[1], [2, 3]], "rows of different lengths choose nothing"),
    ],
)
def test_bad_choices_of_points_are_refused(field, points, words):
    with pytest.raises(InputError, match=words):
        field.take(points)


def test_brackets_are_for_orders(field):
    for wrong in (slice(0, 3), [1, 2], np.array([1])):
        with pytest.raises(InputError, match=r"field.take"):
            field[wrong]
    with pytest.raises(InputError, match="the orders 2, 3, 4"):
        field[5]
    assert field.only([3]).orders == (3,)
    with pytest.raises(InputError, match="order 9 was not computed"):
        field.only([9])


def test_one_line_each(field):
    assert repr(field) == "<DirectionField: 1,501 points, 1,500 answered, orders 2, 3, 4>"
    texts = [repr(field), repr(field[3]), repr(field[3].vectors), repr(field.at(3))]
    assert all(text.count("\n") == 0 and len(text) < 100 for text in texts)


def test_a_point_holds_what_the_field_says(field):
    point = field.at(11)
    assert point.orders == (2, 3, 4)
    rows = field[3]
    part = rows.rows_of(11)
    assert [row.angle for row in point[3]] == rows.angle[part].tolist()
    assert [int(row.kind) for row in point[3]] == rows.kind[part].tolist()
    assert point.phi[3, 1] == field.coefficient(3, 1)[11]
    assert point.status == Status(int(field.status[11]))
    assert field.at(-1).index == 1500
    with pytest.raises(InputError, match="order 7 was not computed"):
        point[7]
    for wrong in (1501, -1502):
        with pytest.raises(InputError, match="there is no point"):
            field.at(wrong)
    for wrong in ("3", 1.0, True):
        with pytest.raises(InputError, match="is not an index"):
            field.at(wrong)


def test_the_table_of_a_point(field):
    text = str(field.at(11))
    lines = text.splitlines()
    assert lines[3].split() == ["order", "kind", "angle", "(degrees)", "lambda", "strength"]
    count = sum(int(field[order].counts[11]) for order in field.orders)
    assert len(lines) == 4 + count
    first = field.at(11)[2][0]
    assert with_error(degrees(first.angle), degrees(first.angle_std)) in lines[4]
    assert with_error(first.eigenvalue, first.eigenvalue_std) in lines[4]
    assert first.kind.label in lines[4].split()


def test_a_point_without_an_answer_says_why(field):
    point = field.at(1500)
    assert "no answer: the point has too few distinct neighbours (enlarge" in str(point)
    assert "1 neighbour within R = 0.35" in str(point)
    assert "kind" not in str(point)
    assert "<svg" not in point._repr_html_()
    with pytest.raises(InputError, match=r"nothing to plot; choose another"):
        point.plot()


def test_orders_above_a_lowered_degree_and_isotropic_orders_are_named():
    rng = np.random.default_rng(2)
    flat = np.column_stack([rng.uniform(-1, 1, (400, 2)), np.zeros(400)])
    point = estimate_directions(flat, radius=0.8, degree=4, orders=(2,), queries=[[0.0, 0, 0]])
    assert point.at(0).isotropic == (2,)
    assert "every direction" in str(point.at(0))
    few = torus(1500, 1.0, 0.4, 3)[0]
    field = estimate_directions(few, neighbours=20, degree=6, orders=(2, 6), queries=[0])
    assert field.degree[0] < 6
    assert f"above degree {field.degree[0]}" in str(field.at(0))
    assert [term.order for term in field.at(0).polar_terms()] == [2]


def test_where_every_direction_is_one_no_rounding_is_plotted():
    turn = np.linalg.qr(np.random.default_rng(4).normal(size=(3, 3)))[0]
    sphere = np.random.default_rng(1).normal(size=(2000, 3))
    sphere /= np.linalg.norm(sphere, axis=1, keepdims=True)
    for points, constant in ((sphere * [1.0, 1.0, 0.0] @ turn, 0.0), (sphere @ turn, 0.5)):
        field = estimate_directions(points, radius=0.4, degree=10, orders=(2, 3))
        both = np.flatnonzero(field[2].isotropic & field[3].isotropic)
        if constant:
            # No polynomial is a sphere; say that this one is.
            index = 0
            point = replace(field.at(0), isotropic=(2, 3))
        else:
            index = int(both[0])
            point = field.at(index)
        two, three = point.polar_terms()
        assert abs(two.phi[0]) == pytest.approx(constant * 0.4, abs=1e-3)
        assert two.phi[1] == 0.0
        assert not three.phi.any()
        assert two.quantity == "strength"


@pytest.mark.parametrize("offset", [0.0, 1e4, 1e7])
def test_the_rounding_of_a_plane_is_not_plotted(offset):
    rng = np.random.default_rng(0)
    flat = np.column_stack([rng.uniform(-1, 1, (3000, 2)), np.zeros(3000)])
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    points = flat @ turn + offset * np.array([1.0, 0.3, 0.2])
    field = estimate_directions(points, neighbours=150, degree=6, orders=(2, 4))
    assert field[2].isotropic.all()
    assert field[4].isotropic.all()
    for index in range(len(field)):
        assert not any(term.phi.any() for term in field.at(index).polar_terms())


def test_the_constants_of_a_sphere_far_away_are_plotted():
    sphere = np.random.default_rng(0).normal(size=(3000, 3))
    sphere /= np.linalg.norm(sphere, axis=1, keepdims=True)
    field = estimate_directions(
        sphere + 1e7 * np.eye(3)[0], neighbours=150, degree=6, orders=(2, 4)
    )
    both = np.flatnonzero(field[2].isotropic & field[4].isotropic)
    assert len(both) > 100
    for index in both:
        point = field.at(index)
        two, four = (term.phi for term in point.polar_terms())
        # z = r^2 / 2 + r^4 / 8 + ...
        assert abs(two[0]) == pytest.approx(point.radius / 2, rel=1e-3)
        assert abs(four[0]) == pytest.approx(point.radius**3 / 8, rel=0.1)
        assert not two[1:].any()
        assert not four[1:].any()


def test_html_has_the_table_and_the_plot(field):
    html = field.at(11)._repr_html_()
    assert html.count("<svg") == 1
    assert html.count("<tr>") == 1 + sum(len(rows) for rows in field.at(11).directions.values())
    whole = field._repr_html_()
    assert whole.count("<tr>") == 1 + len(field.orders)
    assert "1,500 of 1,501 points answered." in whole
    assert "1 point has too few distinct neighbours" in whole


def test_html_without_matplotlib_is_the_table_alone(field, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    html = field.at(11)._repr_html_()
    assert "<table>" in html
    assert "<svg" not in html
    with pytest.raises(MissingDependencyError, match="extra figures"):
        field.at(11).plot()


def test_json_keeps_all_numbers(field):
    data = json.loads(json.dumps(field.at(11).to_dict(), allow_nan=False))
    assert data["point"] == 11
    assert len(data["directions"]) == sum(len(rows) for rows in field.at(11).directions.values())
    assert data["directions"][0]["eigenvalue"] == field.at(11)[2][0].eigenvalue
    nothing = json.loads(json.dumps(field.at(1500).to_dict(), allow_nan=False))
    assert nothing["status"][0] == "TOO_FEW_NEIGHBOURS"
    assert nothing["frame"][0] == [None, None, None]
    assert nothing["directions"] == []


def test_dataframe(field):
    pandas = pytest.importorskip("pandas", reason="pandas is not installed")
    frame = field.to_dataframe()
    assert len(frame) == sum(len(field[order]) for order in field.orders)
    names = "point x y z order kind angle dx dy dz eigenvalue strength angle_std eigenvalue_std"
    assert " ".join(frame.columns) == names
    maxima = frame[(frame.order == 3) & (frame.kind == 1)]
    np.testing.assert_array_equal(maxima.angle, field[3].maxima.angle)
    np.testing.assert_array_equal(maxima[["x", "y", "z"]], field.points[maxima.point])
    assert isinstance(frame, pandas.DataFrame)


def test_pyvista(field):
    pytest.importorskip("pyvista", reason="PyVista is not installed (extra viewer)")
    mesh = field.to_pyvista()
    three = mesh["order"] == 3
    np.testing.assert_array_equal(mesh["direction"][three], field[3].vector)
    np.testing.assert_array_equal(mesh.points[three], field.points[field[3].point_index])
    assert mesh.points.dtype == np.float64


def test_trimesh(field):
    strokes = field.to_trimesh(length=0.25)
    assert isinstance(strokes, trimesh.path.Path3D)
    total = sum(len(field[order]) for order in field.orders)
    assert len(strokes.entities) == total
    ends = strokes.vertices.reshape(-1, 2, 3)
    np.testing.assert_allclose(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1), 0.25)
    first = strokes.entities[len(field[2])]
    assert first.color[:3].tolist() == [round(255 * part) for part in ORDER_COLOURS[3]]
    third = field.radius[0] / 3
    lengths = np.linalg.norm(np.diff(field.to_trimesh().vertices.reshape(-1, 2, 3), axis=1), axis=2)
    np.testing.assert_allclose(lengths, third)
    for wrong in (0.0, -1.0, float("nan")):
        with pytest.raises(InputError, match="length"):
            field.to_trimesh(length=wrong)


@pytest.mark.parametrize(("method", "library"), [("dataframe", "pandas"), ("pyvista", "pyvista")])
def test_absent_libraries_are_named(field, monkeypatch, method, library):
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(MissingDependencyError, match="pip install"):
        getattr(field, f"to_{method}")()


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (12.3456, 0.0237, "12.346 ± 0.024"),
        (-0.000012345, 1.2e-7, "(-1.234 ± 0.012)e-05"),
        (12345.6, 678.0, "12350 ± 680"),
        (0.3, 25.0, "0 ± 25"),
        (1.0, 0.0996, "1.000 ± 0.100"),
        (2.5e8, 3e7, "(2.50 ± 0.30)e+08"),
        (1.0, 1e-20, "1.00000000000000 ± 1e-20"),
        (float("nan"), 1.0, "-"),
        (3.0, float("inf"), "3"),
        (0.0, 0.0, "0"),
        (-0.2, 25.0, "0 ± 25"),
        (-3.1e12, 8e14, "(0.0 ± 8.0)e+14"),
    ],
)
def test_no_digit_more_than_the_error_justifies(value, error, text):
    assert with_error(value, error) == text


def test_deviations_that_say_nothing_are_words():
    assert with_error(300.4, 6900.0, limit=90.0) == "300 (undetermined)"
    assert with_error(300.4, 90.0, limit=90.0) == "300 ± 90"
    assert angle_with_error(radians(40.12), radians(90.1)) == "40.1 (undetermined)"
    assert angle_with_error(radians(40.12), radians(89.0)) == "40 ± 89"
    assert angle_with_error(radians(40.12), float("nan")) == "40.12"


def test_undetermined_angles_and_eigenvalues_are_named(field):
    point = field.at(11)
    # The height of the term at R is R times the strength: an error of 2 R there.
    unit = 2.0 * factorial(3) / point.radius**2
    rows = tuple(
        row._replace(angle_std=3.0, eigenvalue=value, eigenvalue_std=unit)
        for row, value in zip(point[3], (0.05 * unit, 0.2 * unit), strict=False)
    )
    lost, rough = replace(point, directions={3: rows}).__str__().splitlines()[-2:]
    assert lost.count("(undetermined)") == 2
    assert rough.count("(undetermined)") == 1
    assert " ± " in rough
    small = tuple(row._replace(eigenvalue=0.0, eigenvalue_std=0.4 * unit) for row in rows)
    assert "0 ± " in str(replace(point, directions={3: small}))


def test_the_summary_calls_angles_undetermined(field):
    rows = field[2]
    loose = replace(field, directions={2: replace(rows, angle_std=np.full(len(rows), 1.6))})
    (row,) = order_summaries(loose)
    assert row.undetermined
    assert row.cells[-1] == "undetermined"
    assert "<td>undetermined</td>" in loose._repr_html_()
    (row,) = order_summaries(field.only([2]))
    assert not row.undetermined
    assert row.cells[-1] == f"{np.median(np.degrees(rows.angle_std)):.3g}"


def test_survey_coordinates_keep_their_digits(field):
    far = replace(field, points=field.points + np.array([500_000.0, 5_412_000.0, 0.0]))
    x, y, z = field.points[11]
    heading = str(far.at(11)).splitlines()[0]
    # The radius is 0.35, and a thousandth of it counts.
    assert f"({500_000 + x:.4f}".rstrip("0") in heading
    assert f"{5_412_000 + y:.4f}".rstrip("0") in heading
    assert f" {z:.6g})" in heading


def test_neighbours_in_one_place_are_named():
    points = np.repeat(np.random.default_rng(0).random((30, 3)), 20, axis=0)
    points = np.concatenate([points, torus(300, 1.0, 0.4, 3)[0]])
    point = estimate_directions(points, neighbours=15, degree=2, orders=(2,)).at(4)
    assert "15 neighbours at the same place" in str(point)
    with pytest.raises(InputError, match=r"^[^;]*; choose another point\.$"):
        point.plot()


def test_numbers_with_errors_read_back_within_them():
    rng = np.random.default_rng(1)
    for value, error in zip(
        rng.normal(size=300) * 10.0 ** rng.integers(-12, 12, 300),
        10.0 ** rng.uniform(-12, 12, 300),
        strict=True,
    ):
        text = with_error(value, error)
        mantissa, _, power = text.partition(")e")
        middle, deviation = (float(part) for part in mantissa.lstrip("(").split(" ± "))
        scale = 10.0 ** int(power or 0)
        assert abs(middle * scale - value) <= 0.06 * error + 1e-14 * abs(value)
        assert abs(deviation * scale - error) <= 0.06 * error


def test_every_flag_has_words():
    assert set(STATUS_WORDS) == set(Status) - {Status.OK}
    assert status_words(Status.OK) == []
    assert len(status_words(Status.REFINED | Status.ONE_SIDED)) == 2
