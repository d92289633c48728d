"""Cones z = r h(theta), piecewise linear: edges, corners, junctions, planes that meet.

At the apex nothing is differentiable, yet the weighted least squares fit of degree K over the disc
is exact and decouples by frequency: phi_{k,n} = c_{k,n}(K) h_n R^(1-k), where h_n are the Fourier
coefficients of h and c solves a small moment system of the weight. An estimator that is right
converges to these numbers as the density of the samples grows.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise
from typing import Any, Literal

import numpy as np
import sympy as sp

from pdtheory.conventions import DEFAULT_DEGREE, SIGMA_RATIO
from pdtheory.errors import InputError
from pdtheory.exact.coefficients import exact

Weight = Literal["gaussian", "uniform"]
Measure = Literal["flat", "surface"]

_Q, _E = sp.symbols("q E", positive=True)


@dataclass(frozen=True)
class Cone:
    """A piecewise linear cone z = r h(theta), given by rays with linear sectors between.

    Parameters
    ----------
    rays
        Pairs (angle in degrees, slope of h along the ray), exact; in any order.

    Raises
    ------
    InputError
        If there are fewer than three rays, two at one angle, or a sector of 180 degrees or more.

    Examples
    --------
    >>> Cone.ridge().fourier(2)
    2/(3*pi)
    """

    rays: tuple[tuple[Any, Any], ...]

    def __post_init__(self) -> None:
        rays = [(exact(angle), exact(slope)) for angle, slope in self.rays]
        for value in (v for ray in rays for v in ray):
            if not value.is_real:
                raise InputError(f"The ray value {value} is not a real number.")
        rays = sorted(
            ((a - 360 * sp.floor(a / 360), s) for a, s in rays), key=lambda r: float(r[0])
        )
        if len(rays) < 3:
            raise InputError(f"A cone needs at least three rays, not {len(rays)}.")
        object.__setattr__(self, "rays", tuple(rays))
        for (a, _), width in zip(rays, self.widths, strict=True):
            if width == 0:
                raise InputError(f"Two rays have the angle {a} degrees; give each ray once.")
            if width >= 180:
                raise InputError(
                    f"The sector after the ray at {a} degrees spans {width} degrees; it must be "
                    "below 180 for the plane to be determined, so add a ray inside."
                )

    @classmethod
    def ridge(cls, slope: Any = 1) -> Cone:
        """Return z = -slope |y|, with its crest along 0 and 180 degrees."""
        s = exact(slope)
        return cls(((0, 0), (90, -s), (180, 0), (270, -s)))

    @classmethod
    def corner(cls, slope: Any = None) -> Cone:
        """Return a corner with edges at 0, 120 and 240 degrees, falling with the slope.

        By default 1/sqrt(2), that of a cube seen along its diagonal.
        """
        s = 1 / sp.sqrt(2) if slope is None else exact(slope)
        return cls(((0, -s), (120, -s), (240, -s)))

    @classmethod
    def t_junction(cls, slope: Any = 1) -> Cone:
        """Return the union of three gable roofs: ridges at 0, 90, 180, valleys at 45 and 135."""
        s = exact(slope)
        valley = -s / sp.sqrt(2)
        return cls(((0, 0), (45, valley), (90, 0), (135, valley), (180, 0), (270, -s)))

    @property
    def widths(self) -> list[Any]:
        """The widths of the sectors after each ray, in degrees."""
        angles = [a for a, _ in self.rays]
        return [b - a for a, b in pairwise([*angles, angles[0] + 360])]

    @cached_property
    def gradients(self) -> list[tuple[Any, Any]]:
        """The gradient (a, b) of z = a x + b y in the sector after each ray."""
        result = []
        for (angle, slope), (following, end) in pairwise([*self.rays, self.rays[0]]):
            c, s, c1, s1 = (
                f(sp.pi * a / 180) for a in (angle, following) for f in (sp.cos, sp.sin)
            )
            determinant = c * s1 - s * c1
            result.append(
                (
                    _tidy((slope * s1 - end * s) / determinant),
                    _tidy((end * c - slope * c1) / determinant),
                )
            )
        return result

    @cached_property
    def jumps(self) -> list[Any]:
        """The jump of h' at each ray: negative at a crest, positive at a valley."""
        result = []
        for (angle, _), before, after in zip(
            self.rays, [self.gradients[-1], *self.gradients], self.gradients, strict=False
        ):
            c, s = sp.cos(sp.pi * angle / 180), sp.sin(sp.pi * angle / 180)
            result.append(_tidy((after[1] - before[1]) * c - (after[0] - before[0]) * s))
        return result

    def fourier(self, n: int) -> Any:
        """Return h_n = (1 / 2 pi) times the integral of h exp(-i n theta), exactly."""
        real, imaginary = self.fourier_parts(abs(n))
        return real + sp.I * (imaginary if n >= 0 else -imaginary)

    def fourier_parts(self, n: int) -> tuple[Any, Any]:
        """Return real and imaginary part of h_n, n >= 0.

        For n != 1 they follow from the jumps: (1 - n^2) h_n = sum_j J_j exp(-i n a_j) / (2 pi).
        """
        angles = [sp.pi * a / 180 for a, _ in self.rays]
        real, imaginary = [], []
        if n != 1:
            for jump, a in zip(self.jumps, angles, strict=True):
                real.append(jump * sp.cos(n * a))
                imaginary.append(-jump * sp.sin(n * a))
            return tuple(_tidy(sum(p) / (2 * sp.pi * (1 - n**2))) for p in (real, imaginary))
        sectors = zip(pairwise([*angles, angles[0] + 2 * sp.pi]), self.gradients, strict=True)
        for (a, b), (p, q) in sectors:
            # The integrals of (p cos + q sin) cos and of (p cos + q sin) sin over the sector.
            c, s = ((f(2 * b) - f(2 * a)) / 4 for f in (sp.cos, sp.sin))
            real.append(p * ((b - a) / 2 + s) - q * c)
            imaginary.append(p * c - q * ((b - a) / 2 - s))
        return tuple(_tidy(sum(p) / (2 * sp.pi)) for p in (real, imaginary))

    def __call__(self, angle: float) -> float:
        """Return h at an angle in degrees, as a float."""
        turned = (angle - float(self.rays[0][0])) % 360 + float(self.rays[0][0])
        index = max(i for i, (a, _) in enumerate(self.rays) if float(a) <= turned)
        p, q = (float(c) for c in self.gradients[index])
        return p * float(np.cos(np.deg2rad(turned))) + q * float(np.sin(np.deg2rad(turned)))


def _tidy(value: Any) -> Any:
    """Simplify radicals; sines of angles without radicals are left as they are."""
    return value if value.has(sp.cos, sp.sin) else sp.radsimp(sp.expand(value))


def radial_moment(m: int, weight: Weight = "gaussian") -> Any:
    """Return the integral of w(rho) rho^m over [0, 1], exactly.

    For the Gaussian w = exp(-9 rho^2 / 2) it is a polynomial in q = exp(-9/2) for odd m, and
    linear in E = sqrt(2 pi) erf(3 / sqrt 2) besides for even m.
    """
    return _closed(_moment(m, weight))


def _closed(expression: Any) -> Any:
    # sigma = R / SIGMA_RATIO = R / 3 gives the 9/2 and the 3 / sqrt 2.
    return expression.subs(
        {_Q: sp.exp(-sp.Rational(9, 2)), _E: sp.sqrt(2 * sp.pi) * sp.erf(3 / sp.sqrt(2))}
    )


@lru_cache(maxsize=1024)
def _moment(m: int, weight: Weight) -> Any:
    if weight == "uniform":
        return sp.Rational(1, m + 1)
    square = sp.Integer(int(SIGMA_RATIO)) ** 2
    if m == 0:
        return _E / (2 * sp.Integer(int(SIGMA_RATIO)))
    if m == 1:
        return (1 - _Q) / square
    return sp.expand(((m - 1) * _moment(m - 2, weight) - _Q) / square)


@lru_cache(maxsize=256)
def _solution(n: int, degree: int, weight: Weight, constant: bool) -> dict[int, Any]:
    """Return c_{k,n} by k for one frequency, rational functions of q and E."""
    orders = [k for k in range(n, degree + 1, 2) if constant or k > 0]
    if not orders:
        return {}
    if n == 1:
        return {k: sp.Integer(int(k == 1)) for k in orders}
    field = sp.QQ.frac_field(_Q, _E)
    moments = {m: field.from_sympy(_moment(m, weight)) for m in range(1, 2 * degree + 3)}
    matrix = sp.polys.matrices.DomainMatrix(
        [[moments[k + j + 1] for j in orders] for k in orders], (len(orders),) * 2, field
    )
    right = sp.polys.matrices.DomainMatrix(
        [[moments[k + 2]] for k in orders], (len(orders), 1), field
    )
    solved = matrix.lu_solve(right).to_list()
    return {k: field.to_sympy(row[0]) for k, row in zip(orders, solved, strict=True)}


def cone_coefficient(
    order: int,
    frequency: int,
    degree: int = DEFAULT_DEGREE,
    weight: Weight = "gaussian",
    *,
    constant: bool = True,
) -> Any:
    """Return c_{k,n}(K): the fit of degree K to r exp(i n theta) has phi_{k,n} = c R^(1-k).

    Parameters
    ----------
    order, frequency
        k and n >= 0, of the same parity, n <= k <= K.
    degree
        Degree K of the fit.
    weight
        "gaussian": exp(-9 rho^2 / 2); "uniform": 1.
    constant
        Whether the fit has a constant term.

    Raises
    ------
    InputError
        If k and n do not fit, or the weight is not known.

    Examples
    --------
    >>> cone_coefficient(3, 3, 10, "uniform")
    28/3
    """
    check_fit(degree, weight)
    if not (0 <= frequency <= order <= degree and (order - frequency) % 2 == 0):
        raise InputError(
            f"There is no coefficient of order {order} and frequency {frequency} in a fit of "
            f"degree {degree}."
        )
    if order == 0 and not constant:
        raise InputError("A fit without constant term has no coefficient of order 0.")
    return _closed(_solution(frequency, degree, weight, constant)[order])


def check_fit(degree: int, weight: str) -> None:
    """Refuse a degree or a weight that the closed forms do not cover."""
    if int(degree) != degree or not 1 <= degree <= 30:
        raise InputError(f"The degree is {degree}; it must be an integer from 1 to 30.")
    if weight not in ("gaussian", "uniform"):
        raise InputError(f"The weight {weight!r} is not known; use 'gaussian' or 'uniform'.")
