"""What is refused, what gets a status, and what changes nothing."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

from pdtheory.conventions import Status
from pdtheory.errors import Cancelled, InputError
from pdtheory.pointset import PointCloud, estimate_directions
from tests.pointset.surfaces import torus


@pytest.fixture(scope="module")
def cloud():
    return torus(4000, 1.0, 0.4, 7)[0]


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({}, "exactly one of radius"),
        ({"radius": 0.3, "neighbours": 50}, "exactly one of radius"),
        ({"radius": -1.0}, "positive"),
        ({"radius": np.nan}, "positive and finite"),
        ({"radius": "0.3"}, "must be a number"),
        ({"neighbours": 7}, "7 neighbours are too few; the smallest fit needs 8"),
        ({"radius_relative": 0.0}, "relative radius must be positive"),
        ({"neighbours": 10.5}, "whole number"),
        ({"radius": 1e-6}, "radius of"),
        ({"radius": 0.3, "degree": 4, "orders": (5,)}, "above the degree"),
        ({"radius": 0.3, "degree": 40}, "degree 40"),
        ({"radius": 0.3, "orders": (0,)}, "order 0"),
        ({"radius": 0.3, "norm": "l3"}, "norm 'l3'"),
        ({"radius": 0.3, "orders": 3}, "orders must be a list of orders"),
        ({"radius": 0.3, "orders": None}, "orders must be a list of orders"),
        ({"radius": 0.3, "orders": [2, "3"]}, "order '3' is not available"),
        ({"radius": 0.3, "orders": [[2], [3]]}, r"order \[2\] is not available"),
        ({"radius": 0.3, "threads": 0}, "threads"),
        ({"radius": 0.3, "threads": "4"}, "threads must be a whole number or None, not '4'"),
        ({"radius": 0.3, "threads": 2.5}, "threads must be a whole number or None, not 2.5"),
        ({"radius": 0.3, "frame": ["tangent"]}, "frame .* is not known"),
        ({"radius": 0.3, "norm": np.array(["l1", "l2"])}, "norm .* is not known"),
        ({"radius": 0.3, "weight_distance": None}, "weight_distance None is not known"),
        ({"radius": 0.3, "orient": [1, [2]]}, "the viewpoint must be an array of real numbers"),
        ({"radius": 0.3, "orient": [1, 2]}, "a viewpoint is three numbers"),
        ({"radius": 0.3, "queries": [[1, 2], [3]]}, "queries must be an array of real numbers"),
        ({"radius": 0.3, "queries": ["a"]}, "queries must be an array of real numbers"),
        ({"radius": 0.3, "queries": [4000]}, "outside 0..3999"),
        ({"radius": 0.3, "normals": np.ones((3, 3))}, "3 normals for 4000 points"),
        ({"radius": 0.3, "frame": "given"}, "give normals"),
    ],
)
def test_unusable_options_are_refused(cloud, options, words):
    with pytest.raises(InputError, match=words):
        estimate_directions(cloud, **options)


@pytest.mark.parametrize(
    ("points", "words"),
    [
        (np.zeros((0, 3)), "too few"),
        (np.eye(3), "too few"),
        (np.ones((50, 3)), "all 50 points are equal"),
        (np.ones((50, 2)), "shape"),
        (np.ones((50, 3), complex), "real numbers"),
        ([["a", "b", "c"]], "real numbers"),
        (1e25 * np.random.default_rng(0).random((50, 3)), "choose units"),
    ],
)
def test_unusable_points_are_refused(points, words):
    with pytest.raises(InputError, match=words):
        estimate_directions(points, radius=0.3)


def test_non_finite_points_are_refused_or_dropped(cloud):
    broken = cloud.copy()
    broken[17, 1] = np.nan
    broken[99, 0] = np.inf
    with pytest.raises(InputError, match=r"2 of 4000 points.*number 17"):
        estimate_directions(broken, radius=0.3, degree=4)
    field = estimate_directions(broken, radius=0.3, degree=4, non_finite="drop")
    assert np.flatnonzero(field.status & Status.NON_FINITE).tolist() == [17, 99]
    assert np.isnan(field.frames[17]).all()
    whole = estimate_directions(np.delete(cloud, [17, 99], axis=0), radius=0.3, degree=4)
    np.testing.assert_array_equal(np.delete(field.phi, [17, 99], axis=0), whole.phi)


def test_progress_reaches_one_and_can_cancel(cloud):
    seen = []
    estimate_directions(
        cloud, radius=0.2, degree=4, progress=lambda fraction, text: seen.append((fraction, text))
    )
    assert seen[0][0] == 0.0
    assert seen[-1][0] == 1.0
    assert all(isinstance(text, str) and text for _, text in seen)

    def stop(fraction, text):
        raise Cancelled("stopped")

    with pytest.raises(Cancelled):
        estimate_directions(cloud, radius=0.2, degree=4, progress=stop)


@pytest.mark.parametrize("how", [{"radius": 0.3}, {"neighbours": 90}])
def test_threads_change_no_bit(cloud, how):
    one = estimate_directions(cloud, degree=6, threads=1, **how)
    three = estimate_directions(cloud, degree=6, threads=3, **how)
    np.testing.assert_array_equal(one.phi, three.phi)
    for order in one.orders:
        np.testing.assert_array_equal(one[order].angle, three[order].angle)
        np.testing.assert_array_equal(one[order].offsets, three[order].offsets)


def test_numbers_may_be_arrays_without_axes(cloud):
    plain = estimate_directions(cloud, radius=0.3, degree=4, queries=[0, 1])
    for radius in (np.array(0.3), [np.array(0.3)]):
        same = estimate_directions(cloud, radius=radius, degree=4, queries=[0, 1])
        np.testing.assert_array_equal(same.phi, plain.phi)
    by_count = estimate_directions(cloud, neighbours=np.array(80), degree=4, queries=[0, 1])
    assert by_count.neighbours.tolist() == [80, 80]


def test_queries_by_index_position_and_mask_agree(cloud):
    mask = np.zeros(len(cloud), bool)
    mask[[5, 700, 3999]] = True
    normals = cloud * [1, 1, 0.3]
    fields = [
        estimate_directions(cloud, radius=0.3, degree=5, normals=normals, queries=queries)
        for queries in ([5, 700, 3999], cloud[[5, 700, 3999]], mask)
    ]
    for other in fields[1:]:
        np.testing.assert_array_equal(fields[0].phi, other.phi)
    whole = estimate_directions(cloud, radius=0.3, degree=5, normals=normals)
    np.testing.assert_array_equal(fields[0].phi, whole.phi[[5, 700, 3999]])


def test_layouts_and_types_of_arrays_change_nothing(cloud):
    reference = estimate_directions(cloud, radius=0.3, degree=4).phi
    read_only = cloud.copy()
    read_only.setflags(write=False)
    for same in (np.asfortranarray(cloud), read_only, cloud.tolist(), PointCloud(cloud)):
        np.testing.assert_array_equal(
            estimate_directions(same, radius=0.3, degree=4).phi, reference
        )
    whole = np.round(1000 * cloud).astype(np.int32)
    assert np.array_equal(
        estimate_directions(whole, radius=300, degree=4).phi,
        estimate_directions(whole.astype(float), radius=300, degree=4).phi,
    )


def test_missing_numba_is_one_sentence_and_fields_are_read_without_it():
    code = """
import sys
sys.modules["numba"] = None
from pdtheory.errors import MissingDependencyError
from pdtheory.pointset import DirectionField, PointCloud, load_parts
try:
    from pdtheory.pointset import estimate_directions
except MissingDependencyError as error:
    print(error)
"""
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert out.stdout.startswith("estimating directions needs Numba")
    assert len(out.stdout.splitlines()) == 1
