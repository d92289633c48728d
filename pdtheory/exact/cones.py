"""Cones z = r h(theta), piecewise linear: edges, corners, junctions, planes that meet.

At the apex nothing is differentiable, yet the weighted least squares fit of degree K over the disc
is exact and decouples by frequency: phi_{k,n} = c_{k,n}(K) h_n R^(1-k), where h_n are the Fourier
coefficients of h and c solves a small moment system of the weight. An estimator that is right
converges to these numbers as the density of the samples grows.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
import sympy as sp

from pdtheory.errors import InputError
from pdtheory.exact.coefficients import exact
from pdtheory.exact.zeros import is_zero

#: Cosine and sine of an angle in degrees.
CosSin = Callable[[Any], tuple[Any, Any]]


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
        return [(_tidy(p), _tidy(q)) for p, q in self._gradients(_cos_sin)]

    def _gradients(self, cos_sin: CosSin) -> list[tuple[Any, Any]]:
        result = []
        for (angle, slope), (following, end) in pairwise([*self.rays, self.rays[0]]):
            (c, s), (c1, s1) = cos_sin(angle), cos_sin(following)
            determinant = c * s1 - s * c1
            result.append(
                ((slope * s1 - end * s) / determinant, (end * c - slope * c1) / determinant)
            )
        return result

    @cached_property
    def jumps(self) -> list[Any]:
        """The jump of h' at each ray: negative at a crest, positive at a valley."""
        return [_tidy(jump) for jump in self._jumps(_cos_sin)]

    def _jumps(self, cos_sin: CosSin) -> list[Any]:
        gradients = self.gradients if cos_sin is _cos_sin else self._gradients(cos_sin)
        result = []
        for (angle, _), before, after in zip(
            self.rays, [gradients[-1], *gradients], gradients, strict=False
        ):
            c, s = cos_sin(angle)
            result.append((after[1] - before[1]) * c - (after[0] - before[0]) * s)
        return result

    @cached_property
    def _plain_jumps(self) -> list[Any]:
        return self._jumps(_plain_cos_sin)

    @property
    def is_plane(self) -> bool:
        """True if no ray is a crease."""
        return all(is_zero(jump) for jump in self._plain_jumps)

    def jump_sum(self, n: int) -> tuple[Any, Any]:
        """Return 2 pi (1 - n^2) h_n = sum_j J_j exp(-i n a_j) by its parts, nothing simplified.

        The expressions are quick to make, to enclose and to decide about, whatever the angles are.
        """
        real, imaginary = [], []
        for jump, (a, _) in zip(self._plain_jumps, self.rays, strict=True):
            c, s = _plain_cos_sin(n * a)
            real.append(jump * c)
            imaginary.append(-jump * s)
        return sp.Add(*real), sp.Add(*imaginary)

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


def _cos_sin(degrees: Any) -> tuple[Any, Any]:
    return sp.cos(sp.pi * degrees / 180), sp.sin(sp.pi * degrees / 180)


def _plain_cos_sin(degrees: Any) -> tuple[Any, Any]:
    """Return cosine and sine without SymPy's search for a closed form, which is slow."""
    if degrees % 90 == 0:
        return _cos_sin(degrees)
    angle = sp.pi * degrees / 180
    return sp.cos(angle, evaluate=False), sp.sin(angle, evaluate=False)


def _tidy(value: Any) -> Any:
    """Simplify radicals; sines of angles without radicals are left as they are."""
    return value if value.has(sp.cos, sp.sin) else sp.radsimp(sp.expand(value))
