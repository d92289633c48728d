"""Corrected theorems: how many maxima, exactly (deltoid, astroid, hypocycloids)."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any

import sympy as sp

from pdtheory.paper.claims.core import Orders, Section, Step
from pdtheory.paper.claims.kit import angular, fact, identity, t
from pdtheory.paper.claims.sturm import count_maxima, form_of_row, random_row

section = Section("Corrected theorems: how many maxima")


Criterion = Callable[[Any, Any, Any, Any], Any]


def d3(p1: Any, p3: Any, q1: Any, q3: Any) -> Any:
    """Return D3 of the row (phi_31, phi_33) = (p1, p3) with the conjugates (q1, q3)."""
    a, c = p1 * q1, p3 * q3
    return a**2 + 162 * a * c - 2187 * c**2 + 12 * (p1**3 * q3 + q1**3 * p3)


def d4(p2: Any, p4: Any, q2: Any, q4: Any) -> Any:
    """Return D4 of the row (phi_42, phi_44) = (p2, p4) with the conjugates (q2, q4)."""
    return (p2 * q2 - 16 * p4 * q4) ** 3 - 27 * (p2**2 * q4 - q2**2 * p4) ** 2


def _of_complex(criterion: Criterion, low: Any, high: Any) -> Any:
    return sp.expand(criterion(low, high, sp.conjugate(low), sp.conjugate(high)))


def _discriminant(order: int, row: dict[int, Any]) -> Any:
    """Return the discriminant of F(1, s) for a symbolic row."""
    a, b = sp.symbols("X Y", real=True)
    z = a + sp.I * b
    square = a**2 + b**2
    f = sum(
        2 * sp.re(sp.expand(phi * z**m)) * square ** ((order - m) // 2) for m, phi in row.items()
    )
    F = angular(sp.expand(f), a, b)
    return sp.expand(sp.discriminant(sp.expand(F.subs(a, 1)), b))


def _sampled(order: int, criterion: Criterion, most: int) -> Step:
    """Compare the criterion with Sturm counts on random rows, both cases represented."""
    generator = random.Random(order)
    low, high = order - 2, order
    counts: dict[int, int] = {}
    agree = True
    for _ in range(60):
        row = random_row(order, generator)
        values = [sp.Rational(row[m][0]) + sp.I * sp.Rational(row[m][1]) for m in (low, high)]
        inside = bool(_of_complex(criterion, *values) < 0)
        found = count_maxima(order, form_of_row(order, row))
        agree = agree and (found == most) is inside
        if found is not None:
            counts[found] = counts.get(found, 0) + 1
    return fact(
        "The criterion against Sturm counts on 60 random rational rows, both cases among them.",
        agree and len(counts) == 2,
        maxima=dict(sorted(counts.items())),
    )


@section.claim(
    "order3-discriminant",
    place="Criterion for Section 7, 'Synthetic data', Figure 3",
    statement=r"Order 3, $D_3 = |\phi_1|^4 + 162 |\phi_1|^2 |\phi_3|^2 - 2187 |\phi_3|^4 + 24\, "
    r"\mathrm{Re}(\phi_1^3 \overline{\phi_3})$: three maxima exactly if $D_3 < 0$, else one. With "
    r"$\phi_3 = 1$ the boundary is the deltoid $\phi_1 = -3 (2 e^{i s} + e^{-2 i s})$, cusps at "
    r"radius 9, inner radius 3.",
    scope="order 3",
)
def order3_discriminant(
    orders: Orders,
    criterion: Criterion = d3,
    boundary: Callable[[Any], Any] = lambda e: -3 * (2 * e + e**-2),
) -> Iterator[Step]:
    a, b, c, d = sp.symbols("a b c d", real=True)
    disc = _discriminant(3, {1: a + sp.I * b, 3: c + sp.I * d})
    wanted = _of_complex(criterion, a + sp.I * b, c + sp.I * d)
    ratio = sp.cancel(disc / wanted)
    yield fact(
        r"The discriminant of the real cubic $F(1, s)$ is a negative constant times $D_3$, for "
        r"symbolic $\phi_1 = a + i b$, $\phi_3 = c + i d$: three different real roots, all "
        r"extrema, exactly if $D_3 < 0$; a double or triple root leaves one change of sign.",
        ratio.is_number and ratio < 0,
        D3=wanted,
        factor=ratio,
    )
    yield _sampled(3, criterion, 3)
    z = sp.Symbol("z")
    curve, mirrored = boundary(z), boundary(1 / z)
    yield identity(
        r"The deltoid satisfies $D_3 = 0$ with $\phi_3 = 1$, identically in $z = e^{i s}$ "
        r"(conjugation is $z \to 1/z$).",
        criterion(curve, sp.Integer(1), mirrored, sp.Integer(1)),
    )
    A, B = sp.symbols("A B")
    eliminated = sp.factor(
        sp.resultant(sp.expand((A - boundary(z)) * z**2), sp.expand((B - boundary(1 / z)) * z), z)
    )
    implicit = sp.expand((A * B) ** 2 + 162 * A * B - 2187 + 12 * (A**3 + B**3))
    quotient = sp.cancel(eliminated / implicit)
    yield fact(
        r"Conversely, eliminating $e^{i s}$ between $\phi_1$ and its conjugate leaves $D_3 = 0$ "
        r"and nothing else (a resultant, $A = \phi_1$, $B = \overline{\phi_1}$).",
        quotient.is_number and quotient != 0,
        resultant=eliminated,
        factor=quotient,
    )
    yield identity(
        r"$|\phi_1|^2 = 45 + 36 \cos 3 s$: between $3^2$ and the cusps at $9^2$.",
        curve * mirrored,
        45 + 18 * (z**3 + z**-3),
    )


@section.claim(
    "order4-discriminant",
    place="Criterion for Section 5, 'Number of principal directions'",
    statement=r"Order 4, $D_4 = (|\phi_2|^2 - 16 |\phi_4|^2)^3 + 108\, (\mathrm{Im}\, \phi_2^2 "
    r"\overline{\phi_4})^2$: four maxima exactly if $D_4 < 0$, else two (if $g_4$ is not "
    r"constant). With $\phi_4 = 1$ the boundary is the astroid $\phi_2 = -4 (\cos^3 s + i \sin^3 "
    r"s)$.",
    scope="order 4",
)
def order4_discriminant(
    orders: Orders, criterion: Criterion = d4, radius: int = 4
) -> Iterator[Step]:
    a, b, c, d = sp.symbols("a b c d", real=True)
    disc = _discriminant(4, {2: a + sp.I * b, 4: c + sp.I * d})
    wanted = _of_complex(criterion, a + sp.I * b, c + sp.I * d)
    ratio = sp.cancel(disc / wanted)
    yield fact(
        r"The discriminant of the real quartic $F(1, s)$ is a negative constant times $D_4$. $F$ "
        r"has two or four real lines (at least $2 n_{\min} / 2 = 2$, Sturm-Hurwitz; $\phi_0$ "
        r"drops out), so the discriminant is positive exactly for four.",
        ratio.is_number and ratio < 0,
        D4=wanted,
        factor=ratio,
    )
    yield _sampled(4, criterion, 4)
    z = sp.Symbol("z")
    cosine, sine = (z + 1 / z) / 2, (z - 1 / z) / (2 * sp.I)
    astroid, mirrored = (-radius * (cosine**3 + sign * sine**3) for sign in (sp.I, -sp.I))
    yield identity(
        r"The astroid satisfies $D_4 = 0$ with $\phi_4 = 1$, identically in $z = e^{i s}$.",
        criterion(astroid, sp.Integer(1), mirrored, sp.Integer(1)),
    )
    p, q, r = sp.symbols("p q r", positive=True)
    yield identity(
        r"Conversely $D_4 = (\alpha^2 + \beta^2 - 16)^3 + 432\, \alpha^2 \beta^2$ for $\phi_2 = "
        r"\alpha + i \beta$. With $\alpha^2 = p^3$, $\beta^2 = q^3$, $16 = r^3$ it is $A^3 + 27 "
        r"(p q r)^3$, $A = p^3 + q^3 - r^3$, which has the real factor $A + 3 p q r = (p + q - "
        r"r)\,(\dots)$ with a positive second factor: it is 0 only on the astroid $p + q = r$.",
        (p**3 + q**3 - r**3) + 3 * p * q * r,
        (p + q - r) * (((p - q) ** 2 + (p + r) ** 2 + (q + r) ** 2) / 2),
    )


@section.claim(
    "two-frequency-hypocycloid",
    place="Criterion for Section 5, 'Number of principal directions'",
    statement=r"Two frequencies $p < q$ of one parity, $\phi_q = 1$, $\phi_p = a$: the number of "
    r"maxima changes only on the hypocycloid $a(t) = -\frac{q}{2 p^2} [(q + p) e^{i (q - p) t} + "
    r"(q - p) e^{-i (q + p) t}]$; $|a| < q/p$ gives $q$ maxima, $|a| > (q/p)^2$ gives $p$.",
)
def two_frequency_hypocycloid(
    orders: Orders,
    curve: Callable[[Any, Any, Any], Any] = lambda p, q, t: (
        -q
        / (2 * p**2)
        * ((q + p) * sp.exp(sp.I * (q - p) * t) + (q - p) * sp.exp(-sp.I * (q + p) * t))
    ),
    radii: Callable[[Fraction], tuple[Fraction, Fraction]] = lambda ratio: (ratio, ratio**2),
) -> Iterator[Step]:
    p, q = sp.symbols("p q", positive=True)
    a = curve(p, q, t)
    term = a * sp.exp(sp.I * p * t)
    first = sp.I * q * sp.exp(sp.I * q * t) + sp.I * p * term
    second = -(q**2) * sp.exp(sp.I * q * t) - p**2 * term

    def real_part(value: Any) -> Any:
        return value + sp.conjugate(value)

    yield identity(
        r"On the curve the direction $t$ has $g' = 0$ (symbolic $p$, $q$).", real_part(first)
    )
    yield identity(
        r"And $g'' = 0$: a double root. Since $g' = g'' = 0$ are two real linear equations for "
        r"$a$, with the determinant $p^3$, the curve has all double roots.",
        real_part(second),
    )
    yield identity(
        r"$|a(t)|^2 = \frac{q^4}{p^4} \cos^2 q t + \frac{q^2}{p^2} \sin^2 q t$, between $(q/p)^2$ "
        r"and $(q/p)^4$; so the disc $|a| < q/p$ and the outside of $|a| = (q/p)^2$ are connected "
        r"and do not meet the curve, and the number of maxima is constant in each: $q$ as at $a = "
        r"0$, $p$ as for $a \to \infty$, where $g / |a|$ tends to a cosine with $p$ simple maxima.",
        a * sp.conjugate(a),
        q**4 / p**4 * sp.cos(q * t) ** 2 + q**2 / p**2 * sp.sin(q * t) ** 2,
    )
    results: dict[tuple[int, int], list[int | None]] = {}
    one = (Fraction(1), Fraction(0))
    points = [(Fraction(3, 5), Fraction(4, 5)), (Fraction(-12, 13), Fraction(5, 13))]
    for high in orders:
        for low in range(2 - high % 2, high, 2):
            inner, outer = radii(Fraction(high, low))
            results[low, high] = [
                count_maxima(
                    high,
                    form_of_row(high, {high: one, low: (c * size, s * size)}),
                )
                for size in (inner * Fraction(999, 1000), outer * Fraction(1001, 1000))
                for c, s in points
            ]
    yield fact(
        r"Sturm counts just inside $q/p$ and just outside $(q/p)^2$, for all $p < q$ in the "
        r"orders.",
        all(found == [q_, q_, p_, p_] for (p_, q_), found in results.items()),
        pairs=sorted(results),
    )
