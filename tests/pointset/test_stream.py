"""Runs to a folder: the same bits as in memory, also after an interruption."""

from __future__ import annotations

import numpy as np
import pytest

from pdtheory.errors import Cancelled, FileAccessError, FileFormatError, InputError
from pdtheory.pointset import (
    estimate_directions,
    estimate_to_disk,
    load_parts,
    load_points,
    stream,
    summary,
)
from tests.pointset.surfaces import torus

HOW = {"radius": 0.3, "degree": 5, "orders": (2, 3)}


@pytest.fixture(autouse=True)
def small_parts(monkeypatch):
    monkeypatch.setattr(stream, "PART", 700)


@pytest.fixture(scope="module")
def points():
    return torus(3000, 1.0, 0.4, 9)[0]


def _compare(folder, field):
    seen = np.zeros(len(field), bool)
    for where, part in load_parts(folder):
        seen[where] = True
        np.testing.assert_array_equal(part.phi, field.phi[where])
        np.testing.assert_array_equal(part.status, field.status[where])
        for order in field.orders:
            for row, i in enumerate(where[:50]):
                np.testing.assert_array_equal(part[order].vectors[row], field[order].vectors[i])
    assert seen.all()


def test_same_bits_as_in_memory(points, tmp_path):
    assert estimate_to_disk(points, tmp_path / "run", **HOW) == 5
    _compare(tmp_path / "run", estimate_directions(points, **HOW))


def test_resumed_run_has_the_same_bits(points, tmp_path, monkeypatch):
    # Far more parts than are under way at a time, all of which may be done before the next report.
    monkeypatch.setattr(stream, "PART", 100)
    folder = tmp_path / "run"

    def stop(fraction, text):
        if fraction > 0.5:
            raise Cancelled("stopped")

    with pytest.raises(Cancelled):
        estimate_to_disk(points, folder, progress=stop, threads=2, **HOW)
    names = sorted(path.name for path in folder.glob("part-*.npz"))
    assert 0 < len(names) < 30
    assert not list(folder.glob(".*"))
    with pytest.raises(FileFormatError, match="unfinished"):
        list(load_parts(folder))
    stamps = [(folder / name).stat().st_mtime_ns for name in names]
    with pytest.raises(InputError, match="resume"):
        estimate_to_disk(points, folder, **HOW)
    (folder / ".part-000004-killed.npz").write_bytes(b"half")
    estimate_to_disk(points, folder, resume=True, threads=1, **HOW)
    assert not list(folder.glob(".*"))
    assert [(folder / name).stat().st_mtime_ns for name in names] == stamps
    _compare(folder, estimate_directions(points, **HOW))


def test_other_input_is_refused(points, tmp_path):
    estimate_to_disk(points[:900], tmp_path / "run", **HOW)
    with pytest.raises(InputError, match="other input"):
        estimate_to_disk(points[1:901], tmp_path / "run", resume=True, **HOW)
    with pytest.raises(InputError, match="degree"):
        estimate_to_disk(points[:900], tmp_path / "run", resume=True, **(HOW | {"degree": 6}))


def test_some_points_are_read_in_the_order_asked_for(points, tmp_path):
    estimate_to_disk(points, tmp_path / "run", **HOW)
    field = estimate_directions(points, **HOW)
    chosen = np.array([2999, 0, 1234, 7])
    some, same = load_points(tmp_path / "run", chosen), field.take(chosen)
    np.testing.assert_array_equal(some.points, points[chosen])
    np.testing.assert_array_equal(some.phi, same.phi)
    for order in field.orders:
        np.testing.assert_array_equal(some[order].offsets, same[order].offsets)
        np.testing.assert_array_equal(some[order].vector, same[order].vector)
    with pytest.raises(InputError, match="no point 3000"):
        load_points(tmp_path / "run", [3000])


def test_run_without_neighbours_is_refused_and_leaves_the_folder_free(points, tmp_path):
    folder = tmp_path / "run"
    folder.mkdir()
    (folder / "notes.txt").write_text("mine")
    with pytest.raises(InputError, match="radius of"):
        estimate_to_disk(points, folder, **(HOW | {"radius": 1e-6}))
    assert [path.name for path in folder.iterdir()] == ["notes.txt"]
    estimate_to_disk(points, folder, **HOW)
    _compare(folder, estimate_directions(points, **HOW))


def test_without_queries_there_is_a_field_without_points(points, tmp_path):
    folder, none = tmp_path / "run", np.zeros((0, 3))
    assert estimate_to_disk(points, folder, queries=none, **HOW) == 1
    assert estimate_to_disk(points, folder, queries=none, resume=True, **HOW) == 1
    expected, found = estimate_directions(points, queries=none, **HOW), load_points(folder)
    assert len(found) == len(expected) == 0
    assert found.orders == expected.orders
    assert found.phi.shape == expected.phi.shape
    assert load_points(folder, []).orders == expected.orders


@pytest.mark.parametrize("numbers", [[1.5], [[1], [2, 3]], [[1, 2]], ["a"], None, 7])
def test_only_numbers_of_points_are_taken(points, tmp_path, numbers):
    if numbers is None:
        numbers = np.ones(3, bool)
    estimate_to_disk(points[:900], tmp_path / "run", **HOW)
    with pytest.raises(InputError, match="list of numbers of points"):
        load_points(tmp_path / "run", numbers)


def test_the_summary_of_a_run_is_that_of_its_field(points, tmp_path, monkeypatch):
    estimate_to_disk(points, tmp_path / "run", **HOW)
    field = estimate_directions(points, **HOW)
    expected = summary.order_summaries(field)
    assert summary.run_summaries(tmp_path / "run") == expected
    # Of many points some are enough for the medians, and all are counted.
    monkeypatch.setattr(summary, "_ENOUGH", 1500)
    for some, row in zip(summary.run_summaries(tmp_path / "run"), expected, strict=True):
        assert (some.order, some.maxima, some.minima) == (row.order, row.maxima, row.minima)
        assert some.strength != row.strength
        rows = field[row.order]
        assert np.mean(rows.strength < some.strength) == pytest.approx(0.5, abs=0.03)
        degrees = np.degrees(rows.angle_std)
        assert np.mean(degrees < some.angle_std) == pytest.approx(0.5, abs=0.03)


def test_a_run_needs_a_folder_around_its_own(points, tmp_path):
    with pytest.raises(FileAccessError, match=r"no does not exist; create it first\.$"):
        estimate_to_disk(points, tmp_path / "no" / "run", **HOW)
    (tmp_path / "file").touch()
    with pytest.raises(FileAccessError, match=r"cannot create .*; choose another place\.$"):
        estimate_to_disk(points, tmp_path / "file", **HOW)


def test_choices_go_to_disk_too(points, tmp_path):
    how = {"radius": (0.25, 0.35), "degree": "auto", "orders": (2, 3)}
    estimate_to_disk(points, tmp_path / "run", **how)
    _compare(tmp_path / "run", estimate_directions(points, **how))
