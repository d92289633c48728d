"""Where the camera stands: on the side of a graph that its normals point to."""

from __future__ import annotations

import numpy as np
import pytest

from pdtheory.drawing.view import View, natural_view
from pdtheory.errors import InputError
from pdtheory.pointset import PointCloud, estimate_directions


@pytest.fixture(scope="module")
def graph():
    """Samples of a graph over x and y."""
    xy = np.random.default_rng(2).uniform(-1, 1, (1500, 2))
    return np.column_stack([xy, 0.2 * np.sin(3 * xy[:, 0]) * xy[:, 1]])


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_graph_is_seen_from_the_side_of_its_normals(graph, axis, side):
    points = np.roll(graph, axis - 2, axis=1)
    eye = np.zeros(3)
    eye[axis] = 20.0 * side
    field = estimate_directions(points, neighbours=40, degree=3, orders=(2,), orient=eye)
    view = natural_view(field, None)
    assert (view.up, np.sign(view.elevation)) == ("xyz"[axis], side)
    assert natural_view(field, None, elevation=-10.0).elevation == -10.0


@pytest.mark.parametrize("elevation", [-90.1, 91.0, float("nan")])
def test_an_elevation_out_of_range_is_refused(elevation):
    with pytest.raises(InputError, match="give -90 to 90 degrees"):
        View(elevation=elevation)


@pytest.mark.parametrize("faces", [[[0, 1, 1500], [2, 1500, 3]], []])
def test_a_surface_without_a_finite_triangle_is_its_points(graph, faces):
    field = estimate_directions(graph, radius=0.3, degree=3, orders=(2,))
    points = np.vstack([graph, np.full(3, np.nan)])
    faces = np.array(faces, dtype=np.int64).reshape(-1, 3)
    assert natural_view(field, PointCloud(points, faces=faces)) == natural_view(field, None)
    with pytest.raises(InputError, match="lies elsewhere"):
        natural_view(field, PointCloud(points + 30.0, faces=faces))


@pytest.mark.parametrize("meshed", [True, False])
def test_a_surface_that_lies_elsewhere_is_refused(graph, meshed):
    field = estimate_directions(graph, radius=0.3, degree=3, orders=(2,))
    corners = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    faces = np.array([[0, 1, 2], [0, 2, 3]])

    def surface(scale, shift):
        if meshed:
            return PointCloud(scale * corners + shift, faces=faces)
        return PointCloud(scale * graph + shift)

    # Two triangles that no vertex of the field is near to are still its surface.
    for scale, shift in ((1.0, 0.0), (1.0, [1.0, 0, 0]), (1.0, [0, 0, 0.2]), (0.1, 0.0)):
        natural_view(field, surface(scale, shift))
    for scale, shift, words in (
        (1.0, [30.0, 0, 0], r"they are 2\d(\.\d+)? apart \(the field is 2\.8\d* across"),
        (1e-3, [0, 0, 5.0], r"they are 4\.\d+ apart .* the surface 0\.00"),
    ):
        with pytest.raises(InputError, match=words):
            natural_view(field, surface(scale, shift))
