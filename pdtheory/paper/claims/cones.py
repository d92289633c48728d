"""Corrected theorems: what a fit sees at edges, corners and junctions, z = r h(theta)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any

import sympy as sp

from pdtheory.paper.claims.core import Orders, Section, Step
from pdtheory.paper.claims.fits import (
    E,
    Q,
    basis,
    fit,
    gaussian_moment,
    gaussian_values,
    normal_residuals,
    uniform_moment,
)
from pdtheory.paper.claims.kit import fact, identity, n, t

section = Section("Corrected theorems: edges, corners and junctions")

#: Degree of the regression in the paper.
DEGREE = 10


@section.claim(
    "cone-fit",
    place="Behind Section 7, Figures 4 to 6, and Section 8, Figure 13",
    statement=r"At the apex of a cone $z = r\, h(\theta)$, where $z$ is not differentiable, the "
    r"continuous weighted least squares fit of degree $K$ is $\phi_{k,n} = c_{k,n}(K)\, h_n "
    r"R^{1-k}$: it decouples by frequency, and $c$ solves a small moment system of the weight "
    r"(rational for the uniform weight, $c_{33}(10) = 28/3$; rational in $q = e^{-9/2}$ and $E = "
    r"\sqrt{2\pi}\, \mathrm{erf}(3/\sqrt 2)$ for the Gaussian).",
)
def cone_fit(
    orders: Orders,
    c33: Fraction = Fraction(28, 3),
    exponent: Callable[[Any], Any] = lambda k: 1 - k,
) -> Iterator[Step]:
    yield identity(
        r"$\int_0^{2\pi} e^{i n \theta} = 0$ for $n \neq 0$: with a weight of the distance the "
        r"normal equations of different frequencies do not mix.",
        sp.Integral(sp.exp(sp.I * n * t), (t, 0, 2 * sp.pi)),
    )
    R, c = sp.symbols("R c", positive=True)
    row, column = sp.symbols("k l", integer=True, positive=True)
    yield identity(
        r"In $\rho = r / R$ the equations are $\sum_l \mu_{k+l+1} c_l = \mu_{k+2}$ for $\phi_l = "
        r"c_l h_n R^{1-l}$: a matrix entry $R^{k+l+2}$ times $R^{1-l}$ is $R^{k+3}$, as on the "
        r"right side (symbolic $k$, $l$).",
        R ** (row + column + 2) * c * R ** exponent(column),
        R ** (row + 3) * c,
    )
    r = sp.Symbol("rho", positive=True)
    weight = sp.exp(-sp.Rational(9, 2) * r**2)
    power = sp.Symbol("m", integer=True, positive=True)
    yield identity(
        r"Gaussian moments: $\mu_m = \frac19 ((m - 1) \mu_{m-2} - q)$, by parts (symbolic $m$).",
        sp.Derivative(-weight * r ** (power - 1) / 9, r),
        weight * (r**power - (power - 1) * r ** (power - 2) / 9),
        over=weight,
    )
    start = [sp.integrate(weight * r**j, (r, 0, 1)) for j in (0, 1)]
    exact = {Q: sp.exp(-sp.Rational(9, 2)), E: sp.sqrt(2 * sp.pi) * sp.erf(3 / sp.sqrt(2))}
    yield fact(
        r"They start with $\mu_0 = E / 6$ and $\mu_1 = (1 - q) / 9$.",
        all(
            sp.simplify(value - gaussian_moment(j).subs(exact)) == 0
            for j, value in enumerate(start)
        ),
        moments=start,
    )
    powers = basis(DEGREE, 3)
    solution = fit(uniform_moment, powers, 1)
    yield fact(
        r"$c_{33}(10) = 28/3$ for the uniform weight: the system of four equations and its "
        r"solution.",
        solution[3] == sp.Rational(c33)
        and not any(normal_residuals(uniform_moment, powers, 1, solution)),
        matrix=[[uniform_moment(a + b + 1) for b in powers] for a in powers],
        right_side=[uniform_moment(a + 2) for a in powers],
        solution=solution,
    )
    residuals = {
        (degree, frequency): normal_residuals(
            moment, basis(degree, frequency), 1, fit(moment, basis(degree, frequency), 1)
        )
        for moment in (uniform_moment, gaussian_moment)
        for degree in {DEGREE}
        for frequency in range(degree + 1)
    }
    values = gaussian_values()
    table = {
        f"c_{o},{m}": sp.N(fit(gaussian_moment, basis(DEGREE, m), 1)[o].subs(values), 12)
        for o in range(2, 8)
        for m in range(o % 2, o + 1, 2)
        if m != 1
    }
    yield fact(
        rf"All normal equations of degree {DEGREE} are satisfied exactly, for both weights.",
        not any(any(rest) for rest in residuals.values()),
        gaussian=table,
    )


@section.claim(
    "cone-order3",
    place="Behind Section 7, Figures 4 and 6, and Section 8, Figure 13",
    statement=r"For $n = 1$ the fit of a cone is exact: $c_{11} = 1$ and every other $c_{k,1} = "
    r"0$. Hence order 3 of any cone is an exact 3-RoSy or vanishes, for every degree and every "
    r"weight of the distance.",
)
def cone_order3(orders: Orders, data: int = 1) -> Iterator[Step]:
    a = sp.Symbol("k", integer=True, positive=True)
    mu = sp.Function("mu")
    yield identity(
        r"$r h_1 e^{i \theta}$ is itself in the basis ($k = n = 1$), so $c_{l1} = \delta_{l1}$ "
        r"solves the system: the equation of $r^k$ reads $\mu_{k+1+1} = \mu_{k+2}$; the solution "
        r"is unique (a positive weight).",
        lambda: mu(a + 1 + 1) * 1,
        lambda: mu(a + data + 1),
    )
    solutions = {
        (degree, name): fit(moment, basis(degree, 1), data)
        for degree in orders
        for name, moment in (("uniform", uniform_moment), ("gaussian", gaussian_moment))
        if name == "uniform" or degree <= 12
    }
    yield fact(
        r"Solved: $c_{11} = 1$ and the others 0, for all degrees asked for.",
        all(
            value == (1 if order == 1 else 0)
            for solution in solutions.values()
            for order, value in solution.items()
        ),
        degrees=list(orders),
    )
    third = sp.Symbol("theta", real=True)
    phi = sp.Symbol("phi_33", positive=True)
    g = 2 * phi * sp.cos(3 * third)
    yield identity(
        r"So $\phi_{31} = 0$ and $g_3 = 2\, \mathrm{Re}\, \phi_{33} e^{3 i \theta}$, which a turn "
        r"by 120 degrees leaves alone.",
        lambda: 2 * phi * sp.cos(3 * (third + 2 * sp.pi / 3)),
        g,
    )


@section.claim(
    "cone-creases",
    place="Behind Section 7, Figures 4 to 6, and Section 8, Figure 13",
    statement=r"A cone of planes with the jumps $J_j$ of $h'$ at the angles $a_j$ has $h_n = "
    r"-\sum_j J_j e^{-i n a_j} / (2\pi (n^2 - 1))$ for $n \neq \pm 1$, and $\sum_j J_j e^{i a_j} "
    r"= 0$.",
)
def cone_creases(
    orders: Orders, denominator: Callable[[Any], Any] = lambda n: n**2 - 1
) -> Iterator[Step]:
    A, B = sp.symbols("A B", real=True)
    h = A * sp.cos(t) + B * sp.sin(t)
    yield identity(
        r"A plane is $h = A \cos\theta + B \sin\theta$, so $h'' + h = 0$ between creases.",
        sp.Derivative(h, (t, 2)) + h,
    )
    wave = sp.exp(-sp.I * n * t)
    boundary = (sp.diff(h, t) + sp.I * n * h) * wave
    yield identity(
        r"$\frac{\mathrm d}{\mathrm d\theta} [(h' + i n h) e^{-i n \theta}] = (n^2 - 1)\, h\, "
        r"e^{-i n \theta}$ (symbolic $n$). Summed over the sectors the terms with $h$ cancel, as "
        r"$h$ is continuous, and those with $h'$ leave $-\sum_j J_j e^{-i n a_j}$.",
        sp.Derivative(boundary, t),
        denominator(n) * h * wave,
        over=wave,
    )
    yield identity(
        r"For $n = \pm 1$ the left side is 0: $\sum_j J_j e^{\mp i a_j} = 0$.",
        sp.Derivative(boundary.subs(n, 1), t),
        denominator(sp.Integer(1)) * h,
    )
    m = 2
    integral = sp.Integral(-sp.sin(t) * sp.cos(m * t), (t, 0, sp.pi)) / sp.pi
    jumps = [(0, -2), (sp.pi, -2)]
    formula = -sum(j * sp.exp(-sp.I * m * a) for a, j in jumps) / (2 * sp.pi * denominator(m))
    yield identity(
        r"The ridge $h = -|\sin\theta|$, jumps $-2$ at 0 and 180 degrees: $h_2 = 2 / (3 \pi)$ "
        r"both ways.",
        integral,
        sp.simplify(formula),
    )


@section.claim(
    "cone-three-planes",
    place="Section 8, last paragraph, and Figure 13",
    statement=r"Three planes never make a perfect T: the closure of *cone-creases* forces $J_{90} "
    r"= 0$. A T of ridges needs valleys between them; the gabled T with ridges at 0, 90, 180 and "
    r"valleys at 45 and 135 degrees exists, and its order 3 is a 3-RoSy.",
    scope="configuration",
)
def cone_three_planes(
    orders: Orders, angles: tuple[int, ...] = (0, 90, 180), valley_squared: int = 2
) -> Iterator[Step]:
    J = [sp.Symbol(f"J_{angle}", real=True) for angle in angles]
    closure = sp.expand_complex(
        sum(j * sp.exp(sp.I * sp.pi * sp.Rational(a, 180)) for j, a in zip(J, angles, strict=True))
    )
    solution = sp.solve([sp.re(closure), sp.im(closure)], J, dict=True)
    middle = J[angles.index(90)] if 90 in angles else J[0]
    yield fact(
        r"$J_0 + i J_{90} - J_{180} = 0$ has only $J_{90} = 0$, $J_0 = J_{180}$: a straight ridge "
        r"without a stem.",
        len(solution) == 1 and solution[0].get(middle, middle) == 0,
        solution=solution,
    )
    p, v = sp.symbols("p v", real=True)
    gabled = {0: -p, 180: -p, 90: -p, 45: v, 135: v}
    total = sp.expand_complex(
        sum(j * sp.exp(sp.I * sp.pi * sp.Rational(a, 180)) for a, j in gabled.items())
    )
    value = sp.solve(sp.im(total), v)
    yield fact(
        r"With valleys of jump $v$ at 45 and 135 degrees the closure is $\sqrt 2\, v - p = 0$: $v "
        r"= p / \sqrt 2 > 0$.",
        sp.re(total) == 0
        and len(value) == 1
        and sp.expand(value[0] ** 2 * valley_squared - p**2) == 0
        and value[0].subs(p, 1) > 0,
        valley_jump=value,
    )
    third = -sum(
        j * sp.exp(-3 * sp.I * sp.pi * sp.Rational(a, 180)) for a, j in gabled.items()
    ).subs(v, value[0]) / (16 * sp.pi)
    modulus = sp.simplify(sp.expand_complex(third))
    yield fact(
        r"Its $h_3$ is not 0, so order 3 is a true 3-RoSy (*cone-order3*): the strokes do not "
        r"make the T.",
        modulus.subs(p, 1) != 0,
        h_3=modulus,
    )
