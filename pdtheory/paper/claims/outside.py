"""Eigenpairs known from elsewhere, computed again."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any

import flint
import sympy as sp

from pdtheory.paper.claims.core import CONFIGURATION, Orders, Section, Step
from pdtheory.paper.claims.kit import angular, fact, identity, t, x, y
from pdtheory.paper.claims.sturm import count_maxima, critical, form_of_expression, real_lines

section = Section("Cases from elsewhere")

#: Components a111, a112, a122, a222 of the tensor of De Lathauwer, De Moor and Vandewalle (2000).
TENSOR = ("1.5578", "-2.4443", "-1.0982", "1.1226")


@section.claim(
    "de-lathauwer",
    place="De Lathauwer, De Moor, Vandewalle (SIAM J. Matrix Anal. Appl. 21, 2000), an example of "
    "order 3",
    statement=r"The symmetric tensor $a_{111} = 1.5578$, $a_{112} = -2.4443$, $a_{122} = "
    r"-1.0982$, $a_{222} = 1.1226$ has the E-eigenvalue 3.1155 with $v = (0.9264, -0.3764)$; the "
    r"others are $-2.8311$ and $-1.4020$, up to the sign they share with $v$.",
    scope=CONFIGURATION,
)
def de_lathauwer(
    orders: Orders,
    components: tuple[str, ...] = TENSOR,
    expected: tuple[float, ...] = (3.1155, 2.8311, 1.4020),
    vector: tuple[float, float] = (0.9264, -0.3764),
) -> Iterator[Step]:
    a = [sp.Rational(c) for c in components]
    f = a[0] * x**3 + 3 * a[1] * x**2 * y + 3 * a[2] * x * y**2 + a[3] * y**3
    p = form_of_expression(f)
    lines = real_lines(3, critical(3, p))
    yield fact(
        "Sturm count: three simple critical lines, so exactly three real E-eigenpairs up to sign.",
        lines == {1: 3},
        lines_by_multiplicity=lines,
    )
    slopes = sp.Poly(sp.expand(angular(f).subs({x: 1, y: t})), t).nroots(n=30)
    pairs = []
    for slope in slopes:
        c = 1 / sp.sqrt(1 + slope**2)
        value = f.subs({x: c, y: c * slope})
        sign = 1 if value > 0 else -1
        pairs.append((abs(value), sign * c, sign * c * slope))
    pairs.sort(reverse=True)
    yield fact(
        r"All printed digits agree (30 digits computed).",
        all(abs(pair[0] - value) < 5e-5 for pair, value in zip(pairs, expected, strict=True))
        and all(abs(pair - value) < 5e-5 for pair, value in zip(pairs[0][1:], vector, strict=True)),
        eigenpairs=[tuple(str(sp.N(v, 12)) for v in pair) for pair in pairs],
    )


@section.claim(
    "power-sums",
    place="Known families (Qi; best rank-one approximation)",
    statement=r"$x^d + y^d$, $d$ even: $\lambda = 1$ on the axes and $2^{1 - d/2}$ on the "
    r"diagonals. $\mathrm{Re}\,(x + i y)^d$ has the best rank-one ratio $2^{-(d - 1)/2}$.",
)
def power_sums(
    orders: Orders,
    diagonal: Callable[[Any], Any] = lambda d: 2 ** (1 - d / 2),
    ratio: Callable[[Any], Any] = lambda d: 2 ** (-(d - 1) / 2),
) -> Iterator[Step]:
    d = sp.Symbol("d", integer=True, positive=True)
    f = x**d + y**d
    yield identity(
        r"$F = d\, x y\, (y^{d-2} - x^{d-2})$: on the axes $F = 0$, $f = 1$; on the diagonals $F "
        r"= 0$ (symbolic $d$).",
        x * sp.Derivative(f, y) - y * sp.Derivative(f, x),
        d * x * y * (y ** (d - 2) - x ** (d - 2)),
    )
    yield identity(
        r"$f(1, 1) / \sqrt 2^{\,d} = 2^{1 - d/2}$.",
        lambda: (1 / sp.sqrt(2)) ** d + (1 / sp.sqrt(2)) ** d,
        diagonal(d),
    )
    counts = {
        o: real_lines(o, critical(o, form_of_expression(x**o + y**o)))
        for o in orders
        if o % 2 == 0 and o >= 4
    }
    yield fact(
        r"There are no other real ones: the axes, of multiplicity 1, and the two diagonals (Sturm "
        r"counts; for even $d \geq 4$).",
        all(sum(found.values()) == 4 for found in counts.values()),
        lines=counts,
    )
    total = {o: sum(math.comb(o, j) for j in range(0, o + 1, 2)) for o in orders}
    yield identity(
        r"$\|T\|^2 = \sum_{j \text{ even}} \binom{d}{j} = \frac12 [(1 + 1)^d + (1 - 1)^d] = "
        r"2^{d-1}$, and $|f| \leq 1$ on the circle is attained: the ratio is $2^{-(d-1)/2}$.",
        lambda: 1 / sp.sqrt(2 ** (d - 1)),
        ratio(d),
    )
    yield fact(
        "The binomial sums of the orders asked for.",
        all(value == 2 ** (o - 1) for o, value in total.items()),
        norm_squared=total,
    )


@section.claim(
    "expected-eigenlines",
    place="Draisma, Horobet (Bombieri norm), after Kac and Rice",
    statement=r"A random binary form of degree $d$ in the Bombieri norm has $\sqrt{3 d - 2}$ real "
    r"E-eigenlines on average. So $P(3 \text{ maxima, order } 3) = (\sqrt 7 - 1)/2$ and $P(4 "
    r"\text{ maxima, order } 4) = (\sqrt{10} - 2)/2$.",
)
def expected_eigenlines(
    orders: Orders, average: Callable[[Any], Any] = lambda d: sp.sqrt(3 * d - 2), samples: int = 600
) -> Iterator[Step]:
    d = sp.Symbol("d", positive=True)
    tau = sp.Symbol("tau", real=True)
    covariance = sp.cos(tau) ** d
    second, fourth = (sp.Subs(sp.Derivative(covariance, (tau, j)), tau, 0) for j in (2, 4))
    yield identity(
        r"On the circle the form is a stationary Gaussian process with covariance $\cos^d \tau$. "
        r"By Kac and Rice its derivative has $\frac{1}{\pi} \sqrt{r''''(0) / (-r''(0))}$ zeros "
        r"per unit of angle, so $\sqrt{(3 d^2 - 2 d) / d}$ lines (symbolic $d$).",
        sp.sqrt(fourth / -second),
        average(d),
    )
    yield identity(
        r"Order 3 has 1 or 3 lines, $1 + 2 P = \sqrt 7$; order 4 has 2 or 4, $2 + 2 P = "
        r"\sqrt{10}$.",
        lambda: 1 + 2 * ((sp.sqrt(7) - 1) / 2) + 2 + 2 * ((sp.sqrt(10) - 2) / 2),
        average(sp.Integer(3)) + average(sp.Integer(4)),
    )
    generator = random.Random(29)
    means = {}
    inside = True
    for degree in (3, 4, 7):
        counts = []
        for _ in range(samples):
            p = flint.fmpq_poly(
                [
                    _dyadic(generator.gauss(0, math.sqrt(math.comb(degree, j))))
                    for j in range(degree + 1)
                ]
            )
            counts.append(count_maxima(degree, p) or 0)
        mean = sum(counts) / samples
        spread = math.sqrt(sum((c - mean) ** 2 for c in counts) / samples / samples)
        expected = float(average(sp.Integer(degree)))
        inside = inside and abs(mean - expected) < 3 * spread
        means[degree] = (round(mean, 4), round(expected, 4), round(spread, 4))
    yield fact(
        rf"Sturm counts of {samples} random forms: mean, expected, standard error; within three "
        rf"standard errors.",
        inside,
        mean_expected_error=means,
    )


def _dyadic(value: float) -> Any:
    exact = Fraction(value).limit_denominator(10**6)
    return flint.fmpq(exact.numerator, exact.denominator)
