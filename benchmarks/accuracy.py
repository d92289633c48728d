"""Accuracy of order 2 on implicit shapes, in the set-up of a survey of curvature estimators.

    uv run python benchmarks/accuracy.py [--queries 2000]

50,000 points on each shape inside [-1, 1]^3, neighbourhoods of radius 0.1, Gaussian noise of
standard deviation sigma along the normal or none (Arnal-Anger et al., Computer Graphics Forum,
2026). For each degree and norm: medians over the shapes of the median error of the larger principal
curvature (by modulus, K1) and of its direction in degrees (D1), against the exact values from
gradient and Hessian of the implicit function; and the coverage of one standard deviation.
"""

from __future__ import annotations

import argparse

import numpy as np
import sympy as sp

from pdtheory.pointset import estimate_directions

X, Y, Z = VARIABLES = sp.symbols("x y z")
SHAPES = {
    "ellipsoid": X**2 / sp.Rational(64, 100) + Y**2 / sp.Rational(36, 100) + Z**2 / 0.2 - 1,
    "torus": (X**2 + Y**2 + Z**2 + 0.36 - 0.0625) ** 2 - 1.44 * (X**2 + Y**2),
    "goursat": X**4 + Y**4 + Z**4 - 0.6 * (X**2 + Y**2 + Z**2) + 0.1,
    "peanut": (4 * X**2 + 6 * Y**2 + 6 * Z**2) ** 2 - 8 * (X**2) - 0.2,
    "blob": X**2 + Y**2 + Z**2 + 0.15 * sp.sin(4 * X) * sp.sin(4 * Y) * sp.sin(4 * Z) - 0.5,
}
COUNT, RADIUS = 50_000, 0.1


class Implicit:
    """An implicit surface with its first and second derivatives as fast functions."""

    def __init__(self, expression: sp.Expr) -> None:
        gradient = [sp.diff(expression, v) for v in VARIABLES]
        hessian = [[sp.diff(g, v) for v in VARIABLES] for g in gradient]
        self._value = sp.lambdify(VARIABLES, expression)
        self._gradient = [sp.lambdify(VARIABLES, g) for g in gradient]
        self._hessian = [[sp.lambdify(VARIABLES, h) for h in row] for row in hessian]

    def gradient(self, p: np.ndarray) -> np.ndarray:
        """Gradient at points, (n, 3)."""
        one = np.ones(len(p))
        return np.column_stack([f(*p.T) * one for f in self._gradient])

    def sample(self, count: int, rng: np.random.Generator) -> np.ndarray:
        """Points of the surface, even to first order: those of a thin shell, projected."""
        kept: list[np.ndarray] = []
        while sum(map(len, kept)) < count:
            p = rng.uniform(-1, 1, (20 * count, 3))
            size = np.linalg.norm(self.gradient(p), axis=1)
            p = p[np.abs(self._value(*p.T)) < 0.02 * size]
            for _ in range(20):
                g = self.gradient(p)
                p = p - (self._value(*p.T) / np.sum(g * g, axis=1))[:, None] * g
            kept.append(p[(np.abs(p) < 1).all(axis=1) & (np.abs(self._value(*p.T)) < 1e-12)])
        return np.concatenate(kept)[:count]

    def principal(self, p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Principal curvature larger by modulus (for the normal -gradient), and its direction."""
        g = self.gradient(p)
        size = np.linalg.norm(g, axis=1)
        n = g / size[:, None]
        one = np.ones(len(p))
        hessian = np.array([[f(*p.T) * one for f in row] for row in self._hessian])
        hessian = hessian.transpose(2, 0, 1)
        plane = np.eye(3) - n[:, :, None] * n[:, None, :]
        shape = plane @ hessian @ plane / size[:, None, None]
        values, vectors = np.linalg.eigh(shape)
        # The normal is an eigenvector for zero; the curvature of larger modulus is at an end.
        end = np.where(np.abs(values[:, 0]) > np.abs(values[:, 2]), 0, 2)
        rows = np.arange(len(p))
        return -values[rows, end], vectors[rows, :, end]


def errors(shape: Implicit, points: np.ndarray, clean: np.ndarray, queries: int, **how) -> list:
    """Median errors of K1 and D1, and the share of directions within one standard deviation."""
    field = estimate_directions(
        points, radius=RADIUS, orders=(2,), queries=np.arange(queries),
        normals=shape.gradient(clean), **how,
    )  # fmt: skip
    k1, d1 = shape.principal(clean[:queries])
    rows = field[2]
    found = np.full(queries, np.nan)
    angle = np.full(queries, np.nan)
    inside = np.zeros(queries, bool)
    for i in range(queries):
        at = rows.at(i)
        if at.start == at.stop:
            continue
        j = at.start + int(np.argmax(np.abs(rows.eigenvalue[at])))
        found[i] = rows.eigenvalue[j]
        cross = np.linalg.norm(np.cross(rows.vector[j], d1[i]))
        angle[i] = np.arctan2(cross, abs(rows.vector[j] @ d1[i]))
        inside[i] = angle[i] <= rows.angle_std[j]
    return [
        float(np.nanmedian(np.abs(found - k1))),
        float(np.degrees(np.nanmedian(angle))),
        float(inside.mean()),
    ]


def main() -> None:
    """Print one row for every degree, norm and noise level."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--queries", type=int, default=2000)
    queries = parser.parse_args().queries
    shapes = {name: Implicit(expression) for name, expression in SHAPES.items()}
    rng = np.random.default_rng(1)
    clean = {name: shape.sample(COUNT, rng) for name, shape in shapes.items()}
    print("sigma   degree norm      K1        D1 deg    within one std")
    for sigma in (0.0, 0.001, 0.005):
        noisy = {}
        for name, shape in shapes.items():
            g = shape.gradient(clean[name])
            step = sigma * rng.normal(size=(COUNT, 1))
            noisy[name] = clean[name] + step * g / np.linalg.norm(g, axis=1, keepdims=True)
        for degree, norm in ((2, "l2"), (4, "l2"), (6, "l2"), (10, "l2"), (4, "l1")):
            table = [
                errors(shape, noisy[name], clean[name], queries, degree=degree, norm=norm)
                for name, shape in shapes.items()
            ]
            k1, d1, share = np.median(table, axis=0)
            print(
                f"{sigma:<7g} {degree:<6d} {norm}   {k1:.3g}   {d1:.3g}   {share:.2f}", flush=True
            )


if __name__ == "__main__":
    main()
