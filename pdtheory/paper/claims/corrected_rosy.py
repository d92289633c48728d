"""Corrected theorems: when the directions form a k-RoSy, and which sets of maxima exist."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any

import sympy as sp

from pdtheory.paper.claims.core import Orders, Section, Step
from pdtheory.paper.claims.kit import fact, identity, k, n, product_of_sines, t
from pdtheory.paper.claims.sturm import (
    circle_point,
    count_maxima,
    critical,
    form_of_row,
    is_maximum,
    lines_are_maxima,
    row_of_lines,
    star,
)

section = Section("Corrected theorems: regularity and realizable maxima")

_U, _W = sp.symbols("u w", nonzero=True)


def _even(orders: Orders) -> list[int]:
    return sorted({2, 4, *(o for o in orders if o % 2 == 0)})


def _odd(orders: Orders) -> list[int]:
    return sorted({3, *(o for o in orders if o % 2)})


@section.claim(
    "k-rosy",
    place="Correction of Section 5, 'Regularity and link with N-RoSy'",
    statement=r"$k$ odd: the maxima form a $k$-RoSy $\Leftrightarrow$ the minima do "
    r"$\Leftrightarrow$ $\phi_n = 0$ for $n \neq \pm k$, $\phi_k \neq 0$. $k$ even: maxima *and* "
    r"minima do $\Leftrightarrow$ $\phi_n = 0$ for $n \notin \{0, \pm k\}$, $\phi_k \neq 0$.",
)
def k_rosy(
    orders: Orders, allowed: Callable[[int], set[int]] = lambda o: {0, o} if o % 2 == 0 else {o}
) -> Iterator[Step]:
    odd, even = _odd(orders), _even(orders)
    yield fact(
        r"$k$ odd: $\theta_0 + 2 \pi j / k$ and their opposites are $\theta_0 + \pi j / k$, all "
        r"$2k$ critical points: so the minima form the $k$-RoSy opposite to the maxima.",
        all(
            {2 * j % (2 * o) for j in range(o)} | {(2 * j + o) % (2 * o) for j in range(o)}
            == set(range(2 * o))
            for o in odd
        ),
        orders=odd,
    )
    yield identity(
        r"They give the $k$ different roots of $u^k = w$, $w = e^{2 i k \theta_0}$, so $P = c "
        r"(u^k - w)$: only $n = \pm k$ remain.",
        sp.exp(2 * sp.I * k * (t + sp.pi * sp.Symbol("j", integer=True) / k)),
        sp.exp(2 * sp.I * k * t),
    )
    A, B, c = sp.symbols("A B c")
    half = sp.Symbol("m", integer=True, positive=True)
    P = c * (_U**half - A) * (_U**half - B)
    yield identity(
        r"$k = 2 m$: the maxima are the roots of $u^m = A$, the minima of $u^m = B$, so $P = c "
        r"(u^m - A)(u^m - B)$. The coefficient of $u^m$ belongs to $n = 0$, and $n \phi_n = 0$ "
        r"there: $B = -A$ (minima halfway), and $P = c (u^k - A^2)$ (symbolic $m$).",
        P.subs(B, -A),
        c * (_U ** (2 * half) - A**2),
    )
    yield identity(r"That coefficient is $-c (A + B)$.", sp.expand(P).coeff(_U**half), -c * (A + B))
    results = {}
    for order in sorted({*odd, *even}):
        row: dict[int, tuple[Fraction, Fraction]] = {}
        for frequency in allowed(order):
            row[frequency] = (Fraction(1, 2 if frequency else 3), Fraction(0))
        p = form_of_row(order, row)
        results[order] = count_maxima(order, p), _is_star(order, p)
    yield fact(
        r"Conversely $g = \phi_0 + 2\,\mathrm{Re}\, \phi_k e^{i k \theta}$ has $k$ maxima at $2 "
        r"\pi j / k$: Sturm counts, and $F$ is a multiple of $\mathrm{Im}\,(x + i y)^k$.",
        all(found == (order, True) for order, found in results.items()),
        results=results,
    )


def _is_star(order: int, p: Any) -> bool:
    """Tell whether the critical lines are exactly the multiples of 180 / k degrees."""
    return critical(order, p) % star(order) == 0


@section.claim(
    "k-rosy-maxima",
    place="Correction of Section 5, 'Regularity and link with N-RoSy'",
    statement=r"$k$ even, maxima alone: with $\psi_n = \phi_n e^{i n \theta_0}$ they are "
    r"$\theta_0 + 2 \pi j / k$ exactly if $n \psi_n = (k - n) \overline{\psi_{k-n}}$ for $2 \leq "
    r"n \leq k - 2$, $\psi_k$ is real, and $2 k \psi_k + \sum_{n=2}^{k-2} n \psi_n e^{2 \pi i j n "
    r"/ k} > 0$ for every $j$. For $k = 4$: $\phi_2^2 \overline{\phi_4} \geq 0$ and $|\phi_2| < 4 "
    r"|\phi_4|$.",
)
def k_rosy_maxima(orders: Orders, weight: Any = k - n, bound: Any = 4) -> Iterator[Step]:
    a, b, c, d = sp.symbols("a b c d", real=True)
    psi, partner = a + sp.I * b, c + sp.I * d
    yield identity(
        r"$u^{k/2} - 1$ divides $P$: the exponents $(k + n)/2$ and $(k + n - k)/2$ agree mod "
        r"$k/2$, so the remainder has the coefficients $n \psi_n + (n - k) \psi_{n - k}$, "
        r"$\psi_{n-k} = \overline{\psi_{k-n}}$. It vanishes exactly if $n \psi_n = (k - n) "
        r"\overline{\psi_{k-n}}$.",
        n * psi + (n - k) * sp.conjugate(partner),
        n * psi - weight * sp.conjugate(partner),
    )
    yield identity(
        r"$n = \pm k$ and 0 together: $k \psi_k - k \overline{\psi_k} = 0$, so $\psi_k$ is real.",
        k * psi - k * sp.conjugate(psi),
        2 * sp.I * k * sp.im(psi),
    )
    yield identity(
        r"At $\theta_0 + 2 \pi j / k$ the terms $n$ and $n - k$ of $-g'' = \sum n^2 \psi_n e^{i n "
        r"\theta}$ add up, by the first condition, to $n^2 \psi_n + (k - n)\, n \psi_n = k n "
        r"\psi_n$; with $2 k^2 \psi_k$ and divided by $k$ this is the inequality. It is strict: "
        r"$P = (u^{k/2} - 1) R$, and $R$ must take alternate signs at the $k$ points, which uses "
        r"up all its $k$ zeros on the circle; a further double zero at one of them is one too "
        r"many.",
        n**2 * psi + weight * n * psi,
        k * n * psi,
    )
    lines = {}
    generator = random.Random(11)
    for order in (o for o in _even(orders) if o >= 4):
        row = _regular_maxima_row(order, generator)
        p = form_of_row(order, row)
        lines[order] = (count_maxima(order, p), lines_are_maxima(order, p, order // 2))
    yield fact(
        r"Random rows that satisfy the conditions with $\theta_0 = 0$: $k$ maxima (Sturm counts), "
        r"and they are $2 \pi j / k$: $\mathrm{Im}\,(x + i y)^{k/2}$ divides $F$ and $g''$ is "
        r"negative at its roots (Tarski queries).",
        all(found == (order, True) for order, found in lines.items()),
        results=lines,
    )
    e = sp.Symbol("e", real=True)
    g = sp.cos(4 * t) + e * sp.cos(2 * t)
    seconds = [sp.diff(g, t, 2).subs(t, j * sp.pi / 2) for j in range(4)]
    yield fact(
        r"$k = 4$: $2 \psi_2 = 2 \overline{\psi_2}$, so $\psi_2$ and $\psi_4$ are real, $8 \psi_4 "
        r"\pm 2 \psi_2 > 0$; free of $\theta_0$: $\phi_2^2 \overline{\phi_4} \geq 0$, $|\phi_2| < "
        r"4 |\phi_4|$. Example $\cos 4\theta + e \cos 2\theta$: $g'' = -16 \mp 4 e$ at the four "
        r"points, all maxima exactly for $|e| < 4$.",
        [sp.solve(s, e) for s in seconds[:2]] == [[-bound], [bound]]
        and sp.expand(seconds[0] - seconds[2]) == 0
        and all(s.subs(e, 0) < 0 for s in seconds),
        second_derivatives=seconds,
    )


def _regular_maxima_row(
    order: int, generator: random.Random
) -> dict[int, tuple[Fraction, Fraction]]:
    row: dict[int, tuple[Fraction, Fraction]] = {order: (Fraction(4), Fraction(0))}
    for frequency in range(2, order // 2 + 1, 2):
        re, im = (Fraction(generator.randint(-9, 9), 9 * order) for _ in "ab")
        if 2 * frequency == order:
            im = Fraction(0)
        row[frequency] = (re, im)
        ratio = Fraction(frequency, order - frequency)
        row[order - frequency] = (ratio * re, -ratio * im)
    return row


@section.claim(
    "order3-maxima",
    place="Correction of Section 5, 'Regularity and link with N-RoSy'",
    statement=r"Three angles distinct mod $\pi$ fix $\phi$ up to scale: $\phi_{33} = \frac{C}{24} "
    r"e^{-i s}$, $\phi_{31} = -\frac{C}{8} e^{-i s} \sum_j e^{2 i t_j}$, $s = t_1 + t_2 + t_3$. "
    r"All three are maxima exactly if every gap between neighbours is below 180 degrees; the T "
    r"$(0, 90, 180)$ is the boundary case $\sin^3$.",
    scope="order 3",
)
def order3_maxima(
    orders: Orders, factors: tuple[Any, Any] = (sp.Rational(1, 24), -sp.Rational(1, 8))
) -> Iterator[Step]:
    angles = sp.symbols("t1:4", real=True)
    C = sp.Symbol("C", positive=True)
    s = sum(angles)
    phi = {
        3: factors[0] * C * sp.exp(-sp.I * s),
        1: factors[1] * C * sp.exp(-sp.I * s) * sum(sp.exp(2 * sp.I * a) for a in angles),
    }
    slope = sum(
        sp.I * m * v * sp.exp(sp.I * m * t) - sp.I * m * sp.conjugate(v) * sp.exp(-sp.I * m * t)
        for m, v in phi.items()
    )
    yield identity(
        r"$g' = \sum_n i n \phi_n e^{i n \theta} = C \prod_j \sin(\theta - t_j)$.",
        slope,
        C * product_of_sines(angles),
    )
    a, b = sp.symbols("a b", real=True)
    c = 2 * sp.pi - a - b
    at = (sp.Integer(0), a, a + b)
    around = ((a, c), (a, b), (b, c))
    for j, (before, after) in enumerate(around):
        others = [at[m] for m in range(3) if m != j]
        yield identity(
            rf"With the gaps $a, b, c$, $a + b + c = 2\pi$: $g''(t_{j + 1}) / C$ is minus the "
            "product of the sines of its two gaps.",
            lambda j=j, others=others: sp.sin(at[j] - others[0]) * sp.sin(at[j] - others[1]),
            -sp.sin(before) * sp.sin(after),
        )
    p, q, r = sp.symbols("p q r", real=True)
    yield identity(
        r"The three products of two of the sines have a product that is a square, so they are not "
        r"all negative; all are positive exactly if the sines have one sign, which must be "
        r"positive as the gaps add up to $2 \pi$: all gaps below $\pi$. Then $C > 0$ makes all "
        r"three maxima; otherwise no sign of $C$ does.",
        lambda: (p * q) * (q * r) * (p * r),
        lambda: (p * q * r) ** 2,
    )
    yield identity(
        r"$(0, 90, 180)$: $g' = C \sin^2\theta \cos\theta$, $g = \frac{C}{3} \sin^3\theta$, one "
        r"gap of exactly 180 degrees.",
        lambda: sp.sin(t) * sp.sin(t - sp.pi / 2) * sp.sin(t - sp.pi),
        sp.Derivative(sp.sin(t) ** 3 / 3, t),
    )


@section.claim(
    "maxima-interlacing",
    place="Correction of Section 5, 'Regularity and link with N-RoSy'",
    statement=r"$k$ odd: a set $M$ of angles is the set of maxima of some $g_k$ exactly if $|M|$ "
    r"is odd, $|M| \leq k$ and $M$ interlaces $M + \pi$. $k$ even, $M$ not empty: exactly if $M = "
    r"M + \pi$ and $|M| \leq k$.",
)
def maxima_interlacing(
    orders: Orders, need_interlacing: bool = True, stretch: int = 1
) -> Iterator[Step]:
    yield identity(
        r"Necessary, $k$ odd: the minima are $M + \pi$ (parity), and maxima and minima alternate; "
        r"the counts are those of *count-max-min*. $k$ even: $g(\theta + \pi) = g(\theta)$.",
        lambda: (-1) ** (2 * n + 1),
        -1,
    )
    generator = random.Random(13)
    good, bad = {}, {}
    for order in _odd(orders):
        for size in range(1, order + 1, 2):
            halves = _interlaced(size, generator)
            points = [circle_point(h) for h in halves]
            if not need_interlacing:
                points = [circle_point(Fraction(j, 10 * size)) for j in range(size)]
            good[order, size] = any(_all_maxima(order, points, sign, stretch) for sign in (1, -1))
            if size >= 3:
                crowd = [circle_point(Fraction(j, 10 * size)) for j in range(size)]
                bad[order, size] = any(_all_maxima(order, crowd, sign, 1) for sign in (1, -1))
    yield fact(
        r"Sufficient, $k$ odd: $g' = \pm \prod_{t \in M} \sin(\theta - t)$ has odd frequencies "
        r"only, so it is the derivative of a $g$ of order $|M| \leq k$, and it changes sign "
        r"exactly at $M$ and $M + \pi$, down at $M$ if they interlace (exact, rational angles, "
        r"every size).",
        all(good.values()),
        sizes=sorted(good),
    )
    yield fact(
        "Angles crowded into less than a half circle do not interlace and are never all maxima.",
        not any(bad.values()),
        sizes=sorted(bad),
    )
    a, b = sp.symbols("a b", real=True)
    mean = sp.Integral(sp.sin(t - a) * sp.sin(t - b), (t, 0, sp.pi)) / sp.pi
    yield identity(
        r"Sufficient, $k$ even, $|M| = 2p$: put a minimum into each of the $p$ gaps, $g' = -\prod "
        r"\sin(\theta - t_j) \sin(\theta - s_j)$. It is a derivative if its mean is 0. As all "
        r"$s_j$ slide from $t_j$ to $t_{j+1}$ the product goes from $\prod \sin^2$ to $-\prod "
        r"\sin^2$ and its mean from positive to negative, so it is 0 in between (for $p = 1$ the "
        r"mean is $\frac12 \cos(t - s)$: 0 at 90 degrees).",
        mean,
        sp.cos(a - b) / 2,
    )
    even = {}
    for order in _even(orders):
        for lines in range(1, order // 2 + 1):
            even[order, lines] = _even_maxima(order, lines, generator, stretch)
    yield fact(
        r"Done exactly for even $k$: $p$ lines of maxima and $p - 1$ of minima are chosen, the "
        r"last line of minima solves the linear equation that the mean is 0; Sturm counts give "
        r"$2p$ maxima, and they are the chosen ones.",
        all(even.values()),
        sizes=sorted(even),
    )
    yield identity(
        r"$g$ has order $2p \leq k$ and multiplying its form by $(x^2 + y^2)^{(k - 2p)/2}$ makes "
        r"it one of order $k$ with the same values on the circle.",
        lambda: (sp.cos(t) ** 2 + sp.sin(t) ** 2) ** ((k - n) / 2),
        1,
    )


def _interlaced(size: int, generator: random.Random) -> list[Fraction]:
    """Return tan(t/2) of angles that interlace their opposites: j 360 / size, moved a little."""
    angles = [360 * j / size + generator.uniform(-40, 40) / size for j in range(size)]
    return [
        Fraction(math.tan(math.radians((a + 180) % 360 - 180) / 2)).limit_denominator(60 * size)
        for a in angles
    ]


def _all_maxima(
    order: int, points: list[tuple[Fraction, Fraction]], sign: int, stretch: int
) -> bool:
    if len(points) * stretch > order:
        return False
    p = form_of_row(order, row_of_lines(points, sign))
    return count_maxima(order, p) == len(points) and all(
        is_maximum(order, p, point) for point in points
    )


def _even_maxima(order: int, lines: int, generator: random.Random, stretch: int) -> bool:
    """Build g of even order with 2 `lines` maxima on lines drawn near to regular; check it."""
    if 2 * lines * stretch > order:
        return False
    width = 180 / lines
    for _ in range(50):
        jitter = [generator.uniform(-0.1, 0.1) * width for _ in range(2 * lines)]
        maxima = [_line(j * width + jitter[j]) for j in range(lines)]
        minima = [_line((j + 0.5) * width + jitter[lines + j]) for j in range(lines - 1)]
        # The mean of prod sin(t - t_j) is linear in the last factor, c sin t - s cos t.
        along = _mean([*maxima, *minima, (Fraction(1), Fraction(0))])
        across = _mean([*maxima, *minima, (Fraction(0), Fraction(1))])
        factors = [*maxima, *minima, (across, -along)]
        for sign in (1, -1):
            p = form_of_row(order, row_of_lines(factors, sign))
            if count_maxima(order, p) == 2 * lines and all(
                is_maximum(order, p, point) for point in maxima
            ):
                return True
    return False


def _line(degrees: float) -> tuple[Fraction, Fraction]:
    return circle_point(Fraction(math.tan(math.radians(degrees) / 2)).limit_denominator(300))


def _mean(factors: list[tuple[Fraction, Fraction]]) -> Fraction:
    """Return the mean of prod (c_j sin t - s_j cos t), up to a factor common to equal lengths."""
    product = {0: (Fraction(1), Fraction(0))}
    for c, s in factors:
        new: dict[int, tuple[Fraction, Fraction]] = {}
        for power, (a, b) in product.items():
            for shift, (re, im) in ((1, (c, -s)), (-1, (-c, -s))):
                old = new.get(power + shift, (Fraction(0), Fraction(0)))
                new[power + shift] = old[0] + a * re - b * im, old[1] + a * im + b * re
        product = new
    # prod of 2p factors over (2 i)^(2p) is real at frequency 0.
    return product[0][0]
