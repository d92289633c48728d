"""Phase diagrams of orders 3 and 4: the deltoid and the astroid, against exact counts."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy as np

from pdtheory.exact import WavejetsRow, real_eigenpairs
from pdtheory.paper.figures.order3 import discriminant
from pdtheory.paper.figures.outcome import Check, Figure, Job, Outcome, at_most, equal
from pdtheory.paper.figures.plots import colour, new_plot, pyplot, save
from pdtheory.pointset.cloud import FloatArray


def discriminant4(p2: complex, p4: complex) -> float:
    """Return D4, negative exactly where order 4 has four maxima."""
    return (abs(p2) ** 2 - 16 * abs(p4) ** 2) ** 3 + 108 * (p2**2 * np.conj(p4)).imag ** 2


def boundary(order: int, turn: FloatArray) -> FloatArray:
    """Return the curve on which a maximum and a minimum die together, as complex numbers.

    For order 3 the values of phi_31 at phi_33 = 1, for order 4 those of phi_42 at phi_44 = 1.
    """
    if order == 3:
        return np.asarray(-3 * (2 * np.exp(1j * turn) + np.exp(-2j * turn)))
    return np.asarray(-4 * (np.cos(turn) ** 3 + 1j * np.sin(turn) ** 3))


def counted(order: int, value: tuple[Fraction, Fraction]) -> int:
    """Return the exact number of maxima with the low frequency `value` and the high one 1."""
    import sympy as sp

    number = sp.Rational(value[0]) + sp.I * sp.Rational(value[1])
    row = WavejetsRow(order, {order: 1, order - 2: number})
    return len(real_eigenpairs(row).maxima)


def _compute(job: Job, order: int) -> Outcome:
    reach = {3: 10.0, 4: 5.0}[order]
    many, few = order, order - 2
    rng = np.random.default_rng(job.seed)
    count = job.pick(60, 600, 1500)
    ticks = rng.integers(-round(64 * reach), round(64 * reach) + 1, (count, 2))
    points = [(Fraction(int(a), 64), Fraction(int(b), 64)) for a, b in ticks]
    found = np.array([counted(order, point) for point in points])
    sign = discriminant if order == 3 else discriminant4
    values = np.array([complex(float(a), float(b)) for a, b in points])
    predicted = np.array([many if sign(value, 1.0) < 0 else few for value in values])
    turn = np.linspace(0, 2 * np.pi, 2000)
    curve = boundary(order, turn)
    size = reach ** (4 if order == 3 else 6)
    # Every cusp of the boundary, and the point where it is nearest to the origin.
    radii = np.abs(curve)
    checks: list[Check] = [
        equal("points whose exact number of maxima differs from the sign of the discriminant",
              int(np.sum(found != predicted)), 0, "corrected theorem"),
        at_most("largest discriminant on the boundary curve, over reach^degree",
                max(abs(sign(value, 1.0)) for value in curve) / size, 1e-10,
                "the curve is the zero set of the discriminant"),
        at_most("distance of the cusps from their radius",
                abs(radii.max() - (9.0 if order == 3 else 4.0)), 1e-4, "closed form"),
        at_most("distance of the inner radius from its value",
                abs(radii.min() - (3.0 if order == 3 else 2.0)), 1e-4, "closed form"),
    ]  # fmt: skip
    numbers = {f"points with {many} maxima": int(np.sum(found == many)), "points": count}
    parameters = {"points": count, "seed": job.seed, "reach": reach}
    return Outcome(checks, parameters, numbers, (values, found, curve, reach))


def _draw(job: Job, outcome: Outcome, folder: Path, order: int, name: str) -> list[Path]:
    values, found, curve, reach = outcome.scene
    pyplot()
    figure = new_plot(4.4, 4.4)
    axes = figure.add_axes((0.17, 0.11, 0.80, 0.80))
    axes.fill(curve.real, curve.imag, color=(*colour(order), 0.14), lw=0)
    axes.plot(curve.real, curve.imag, color=colour(order))
    for count, marker, filled in ((order, "o", True), (order - 2, "o", False)):
        here = values[found == count]
        axes.plot(
            here.real,
            here.imag,
            marker,
            ms=3.0,
            mew=0.5,
            mec=colour(order) if filled else "0.45",
            mfc=colour(order) if filled else "none",
            label=f"{count} maxi{'mum' if count == 1 else 'ma'}",
        )
    low = order - 2
    axes.set_xlabel(rf"$\mathrm{{Re}}\,\phi_{{{order},{low}}}\,/\,\phi_{{{order},{order}}}$")
    axes.set_ylabel(rf"$\mathrm{{Im}}\,\phi_{{{order},{low}}}\,/\,\phi_{{{order},{order}}}$")
    axes.set_aspect("equal")
    axes.set_xlim(-reach, reach)
    axes.set_ylim(-reach, reach)
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=2)
    return save(figure, folder / f"{name}.png", vector=True)


DELTOID = Figure(
    "deltoid",
    "beyond the paper",
    "How many maxima order 3 has, with phi_33 = 1: three inside the deltoid, one outside. "
    "Every dot is an exact count.",
    lambda job: _compute(job, 3),
    lambda job, outcome, folder: _draw(job, outcome, folder, 3, "deltoid"),
)
ASTROID = Figure(
    "astroid",
    "beyond the paper",
    "How many maxima order 4 has, with phi_44 = 1: four inside the astroid, two outside. "
    "Every dot is an exact count.",
    lambda job: _compute(job, 4),
    lambda job, outcome, folder: _draw(job, outcome, folder, 4, "astroid"),
)
