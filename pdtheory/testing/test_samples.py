"""Properties of directions estimated from samples of random polynomial surfaces."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import sympy as sp
from hypothesis import assume, given
from hypothesis import strategies as st

from pdtheory.exact import BinaryForm
from pdtheory.pointset import estimate_directions
from pdtheory.testing.profiles import examples

#: Degree of the regression, at least that of the surfaces.
DEGREE = 6
RADIUS = 1.0

FloatArray = npt.NDArray[np.float64]


def _disc(count: int = 700) -> FloatArray:
    """Return points spread evenly over the disc of radius 1.2, the centre among them."""
    index = np.arange(count)
    radius = 1.2 * np.sqrt(index / count)
    angle = index * np.pi * (3 - np.sqrt(5))
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])


DISC = _disc()


@st.composite
def surfaces(draw: st.DrawFn, *, tilted: bool = False) -> dict[int, BinaryForm]:
    """Draw the terms T_k v^k / k! of a polynomial height, by order; gentle slopes."""
    degree = draw(st.integers(2, 5))
    terms = {}
    for order in range(1 if tilted else 2, degree + 1):
        integers = draw(st.lists(st.integers(-9, 9), min_size=order + 1, max_size=order + 1))
        terms[order] = BinaryForm([sp.Rational(c, 100) for c in integers])
    return terms


def _heights(terms: dict[int, BinaryForm], xy: FloatArray) -> FloatArray:
    total = np.zeros(len(xy))
    for order, form in terms.items():
        for j, c in enumerate(form.coefficients):
            total += float(c) * xy[:, 0] ** (order - j) * xy[:, 1] ** j
    return total


def _estimate(terms: dict[int, BinaryForm], **options: Any) -> Any:
    points = np.column_stack([DISC, _heights(terms, DISC)])
    normals = np.tile([0.0, 0.0, 1.0], (len(points), 1))
    return estimate_directions(
        points,
        radius=RADIUS,
        degree=DEGREE,
        orders=tuple(range(2, DEGREE + 1)),
        normals=normals,
        queries=[0],
        threads=1,
        **options,
    )


def _term(terms: dict[int, BinaryForm], order: int) -> BinaryForm:
    """Return T_k v^k, with its factor k!."""
    zero = BinaryForm([0] * (order + 1))
    return terms.get(order, zero) * sp.factorial(order)


def _turn(frame: FloatArray) -> float:
    """Return the angle from the x axis to t1."""
    return float(np.arctan2(frame[0, 1], frame[0, 0]))


@examples
@given(surfaces(tilted=True))
def test_coefficients_in_given_planes(terms: dict[int, BinaryForm]) -> None:
    """Every phi_{k,n} of a polynomial of degree <= K is recovered to rounding."""
    field = _estimate(terms, frame="given")
    turn = _turn(field.frames[0])
    for order in range(1, DEGREE + 1):
        for n, phi in _term(terms, order).row.phi.items():
            expected = complex(phi) * np.exp(1j * n * turn)
            assert abs(field.coefficient(order, n)[0] - expected) < 1e-9


@examples
@given(surfaces())
def test_directions_over_the_tangent_plane(terms: dict[int, BinaryForm]) -> None:
    """Angles, eigenvalues and kinds agree with the exact ones wherever those are well defined."""
    field = _estimate(terms)
    np.testing.assert_allclose(field.frames[0, 2], [0, 0, 1], atol=1e-9)
    turn = _turn(field.frames[0])
    for order in terms:
        form = _term(terms, order)
        pairs = form.eigenpairs()
        assume(pairs.status == "ok")
        slopes = form.angular_derivative().angular_derivative()
        scale = max(abs(float(c)) for c in form.coefficients)
        exact = [
            (np.radians(float(p.angle_degrees(17))), float(p.eigenvalue_float(17)), int(p.kind))
            for p in pairs
        ]
        # Near a double direction an error of rounding in phi moves the angle by its root.
        firm = all(
            abs(float(slopes(sp.Float(np.cos(a)), sp.Float(np.sin(a))))) > 1e-2 * scale
            for a, _, _ in exact
        )
        if not firm:
            continue
        rows = field[order]
        assert len(rows) == len(exact)
        for angle, value, kind in exact:
            gaps = np.abs((rows.angle + turn - angle + np.pi) % (2 * np.pi) - np.pi)
            nearest = int(np.argmin(gaps))
            assert gaps[nearest] < 1e-5
            assert abs(rows.eigenvalue[nearest] - value) < 1e-6 * max(scale, 1)
            assert rows.kind[nearest] == kind


@examples
@given(surfaces(), st.floats(0.1, 10.0), st.floats(0.0, 6.28))
def test_motion_and_scale(terms: dict[int, BinaryForm], scale: float, angle: float) -> None:
    """A rotation about the normal and a scaling change the coefficients as they must."""
    points = np.column_stack([DISC, _heights(terms, DISC)])
    c, s = np.cos(angle), np.sin(angle)
    rotation = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    fields = [
        estimate_directions(
            cloud,
            radius=radius,
            degree=DEGREE,
            orders=(2, 3),
            queries=[0],
            normals=np.tile([0.0, 0.0, 1.0], (len(cloud), 1)),
            threads=1,
        )
        for cloud, radius in ((points, RADIUS), (scale * points @ rotation.T, scale * RADIUS))
    ]
    for order in (2, 3):
        for n in range(order % 2, order + 1, 2):
            before, after = (abs(field.coefficient(order, n)[0]) for field in fields)
            assert abs(after * scale ** (order - 1) - before) < 1e-9
