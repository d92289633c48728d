"""Corrected theorems: the E-characteristic polynomial."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import Any

import flint
import sympy as sp

from pdtheory.paper.claims.core import Orders, Section, Step
from pdtheory.paper.claims.kit import fact, i, identity, k, x, y
from pdtheory.paper.claims.resultants import (
    conic_pullback,
    line_resultant,
    on_isotropic,
    psi_value,
    quadratic_resultant,
    random_form,
    reduced_value,
)

section = Section("Corrected theorems: the E-characteristic polynomial")

_Z, _W = sp.symbols("z w", nonzero=True)
_M = sp.Symbol("m", integer=True, nonnegative=True)


@section.claim(
    "e-characteristic-polynomial",
    place="Correction of Definition 3.2",
    statement=r"If $\phi_k \neq 0$, $\psi$ has degree $k$ in $\lambda$ ($k$ even) or in "
    r"$\lambda^2$ ($k$ odd), its roots are the E-eigenvalues, and with $q = x^2 + y^2$: "
    r"$\mathrm{Res}(F/k, f - \lambda q^{k/2}) = \pm \psi\, |f(1, i)|^2$ for even $k$, "
    r"$\mathrm{Res}(F/k, f^2 - \lambda^2 q^k) = \pm \psi\, |f(1, i)|^4$ for odd $k$.",
)
def e_characteristic_polynomial(
    orders: Orders,
    power: Callable[[int], int] = lambda order: 2 if order % 2 == 0 else 4,
    degree: Callable[[int], int] = lambda order: order,
) -> Iterator[Step]:
    yield from _rules()
    yield from _factorization()
    yield identity(
        r"Even $k$: the change of the pair gives $(2 i)^k$, the two factors give $2 i$ for the "
        r"lines, $f(1, i) f(1, -i)$ for the mixed ones and $(-2 i)^{k-1} \psi$. The powers of 2 "
        r"cancel, so $\mathrm{Res}(p, q')$ is $\psi\, |f(1, i)|^2$ times a power of $i$, which "
        r"is $\pm 1$ as both sides are real. The degrees in the coefficients of $f$ agree.",
        lambda: 2 * (k - 1) + power(2),
        2 * k,
    )
    yield from _odd_orders(power(3))
    yield identity(
        r"At $(1, i)$, $F = x f_y - y f_x = -i (f_x + i f_y) = -i k f$: $\mathrm{Res}(F/k, q) = "
        r"\pm |f(1, i)|^2$, and the highest power of $\lambda$ in the resultant has the "
        r"coefficient $\pm \mathrm{Res}(F/k, q)^{k/2}$ ($k$ even: $\lambda^k$) or $\pm "
        r"\mathrm{Res}(F/k, q)^k$ ($k$ odd: $\lambda^{2 k}$), not 0 if $f(1, i) = k!\, 2^k "
        r"\overline{\phi_k} \neq 0$: the degrees. Here $F = -i k f$ for one term $x^i y^{k-i}$.",
        lambda: (k - i) * sp.I ** (k - i - 1) - sp.I * i * sp.I ** (k - i),
        -sp.I * k * sp.I ** (k - i),
        over=sp.I ** (k - i),
    )
    scale = sp.Symbol("h", positive=True)
    yield identity(
        r"The resultant vanishes at $\lambda$ exactly if $F$ and $f - \lambda q^{k/2}$ have a "
        r"common zero. There $q \neq 0$, as $F \neq 0$ at $(1, \pm i)$, and it may be scaled to "
        r"$q = 1$, an E-eigenvector with $\lambda = f(v)$: scaling $v$ by $h$ multiplies every "
        r"term by $h^k$ (symbolic $k$).",
        lambda: (scale * x) ** i * (scale * y) ** (k - i),
        scale**k * x**i * y ** (k - i),
        over=x**i * y ** (k - i),
    )
    yield from _random_forms(orders, power, degree)


def _rules() -> Iterator[Step]:
    """Yield the rules for resultants that the proof rests on."""
    a, b, c, d = sp.symbols("a b c d")
    e, g = sp.symbols("e g")
    yield identity(
        r"Resultants of binary forms are multiplicative in each argument, and $\mathrm{Res}(l, p)$ "
        r"of a line $l$ is $\pm p$ at its zero. The pair $(a p + b r, c p + d r)$ of two forms of "
        r"degree $m$ has the Sylvester matrix of $(p, r)$ times a matrix of four diagonal blocks: "
        r"its resultant is $(a d - b c)^m\, \mathrm{Res}(p, r)$. For lines:",
        line_resultant(
            (a * e + b * g, a * sp.Symbol("u") + b * sp.Symbol("v")),
            (c * e + d * g, c * sp.Symbol("u") + d * sp.Symbol("v")),
        ),
        (a * d - b * c) * line_resultant((e, sp.Symbol("u")), (g, sp.Symbol("v"))),
    )
    first, second = conic_pullback((a, b, 0)), conic_pullback((c, d, 0))
    yield identity(
        r"The conic $x^2 + y^2 = x_0^2$ is parametrised by $x = t^2 - s^2$, $y = 2 s t$, $x_0 = "
        r"s^2 + t^2$. For two lines $a x + b y$ and $c x + d y$ the resultant in $s, t$ is $-4 (a "
        r"d - b c)^2$; so for forms of degrees $m$ and $m'$ in $x, y$ it is $(-4)^{m m'}$ times "
        r"the square of theirs.",
        quadratic_resultant(first, second),
        -4 * line_resultant((a, b), (c, d)) ** 2,
    )
    first, second = conic_pullback((a, b, e)), conic_pullback((c, d, g))
    meet = (b * g - e * d, e * c - a * g, a * d - b * c)
    yield identity(
        r"For lines $a x + b y + e x_0$, $c x + d y + g x_0$ of the plane it is 4 times the value "
        r"of $x^2 + y^2 - x_0^2$ at the point where they meet, their resultant with the conic: for "
        r"two curves of degree $k - 1$ it is $\pm 4^{(k-1)^2}$ times Qi's resultant $\psi$.",
        quadratic_resultant(first, second),
        4 * (meet[0] ** 2 + meet[1] ** 2 - meet[2] ** 2),
    )


def _factorization() -> Iterator[Step]:
    """Yield the steps that hold for even and odd orders."""
    X, Y, value, rest = sp.symbols("x y lambda g")
    alpha, beta = sp.symbols("alpha beta")
    yield identity(
        r"With $\alpha = f_x/k - \lambda g x$ and $\beta = f_y/k - \lambda g y$, where $g = "
        r"q^{(k-2)/2}$ for even $k$ and $g = x_0^{k-2}$ for odd $k$, $\psi$ is $\mathrm{Res}("
        r"\alpha, \beta)$. Put $p = x \beta - y \alpha$ and $q' = x \alpha + y \beta$.",
        (X - sp.I * Y) * (alpha + sp.I * beta),
        (X * alpha + Y * beta) + sp.I * (X * beta - Y * alpha),
    )
    f = x**i * y ** (k - i)
    slopes = (sp.Derivative(f, x) / k, sp.Derivative(f, y) / k)
    yield identity(
        r"$p = F/k$: $\lambda$ cancels (one term of $f$, symbolic exponents).",
        x * (slopes[1] - value * rest * y) - y * (slopes[0] - value * rest * x),
        ((k - i) * x / y - i * y / x) * f / k,
        over=f,
    )
    yield identity(
        r"$q' = f - \lambda g q$, that is $f - \lambda q^{k/2}$, or $f - \lambda x_0^k$ on the "
        r"conic.",
        x * (slopes[0] - value * rest * x) + y * (slopes[1] - value * rest * y) - f,
        -value * rest * (x**2 + y**2),
    )
    yield identity(
        r"$q' + i p = (x - i y)(\alpha + i \beta)$ and $q' - i p = (x + i y)(\alpha - i \beta)$. "
        r"On the line $x + i y = 0$, at $(1, i)$, $\alpha + i \beta = (f_x + i f_y) / k = f(1, i)$ "
        r"by Euler, the term with $\lambda$ vanishing (one term of $f$):",
        lambda: (i * sp.I ** (k - i) + sp.I * (k - i) * sp.I ** (k - i - 1)) / k,
        sp.I ** (k - i),
        over=sp.I ** (k - i),
    )


def _odd_orders(isotropic: int) -> Iterator[Step]:
    """Yield the steps for odd orders, on the conic."""
    s, t, value, height = sp.symbols("s t lambda f")
    x, y, x_0 = t**2 - s**2, 2 * s * t, s**2 + t**2
    yield identity(
        r"Odd $k$, on the conic: $x + i y = (t + i s)^2$, whose double zero $(s, t) = (1, -i)$ is "
        r"the point $-2\, (1, i)$ with $x_0 = 0$.",
        x + sp.I * y,
        (t + sp.I * s) ** 2,
    )
    at_zero = {s: 1, t: -sp.I}
    yield fact(
        r"That point.",
        [sp.expand(c.subs(at_zero)) for c in (x, y, x_0)] == [-2, -2 * sp.I, 0],
        point=[sp.expand(c.subs(at_zero)) for c in (x, y, x_0)],
    )
    yield identity(
        r"So in $s, t$: $(2 i)^{2 k}\, \mathrm{Res}(p, q')$ is, up to a power of $i$, $2^4$ for "
        r"the lines, $2^{4 (k - 1)} |f(1, i)|^4$ for the mixed ones and $2^{2 (k - 1)} "
        r"\mathrm{Res}(\alpha, \beta)$; with $\mathrm{Res}(\alpha, \beta) = 4^{(k-1)^2} \psi$ "
        r"the power of 2 in $\mathrm{Res}(p, q')$ is $2 k^2$.",
        lambda: 4 + 4 * (k - 1) + 2 * (k - 1) + 2 * (k - 1) ** 2 - 2 * k,
        2 * k**2,
    )
    yield identity(
        r"$(s, t) \to (-t, s)$ changes the signs of $x$ and $y$ and not that of $x_0$. It turns "
        r"$p$ into $-p$ and $q'(\lambda)$ into $-q'(-\lambda)$, so $\mathrm{Res}(p, q'(\lambda)) "
        r"= \pm \mathrm{Res}(p, q'(-\lambda))$; their product is the resultant of $F/k$ and $f^2 "
        r"- \lambda^2 q^k$ in $s, t$, which is $4^{2 k^2}\, \mathrm{Res}(F/k, f^2 - \lambda^2 "
        r"q^k)^2$. The square root, a polynomial: $\pm 2^{2 k^2}\, \mathrm{Res}(F/k, f^2 - "
        r"\lambda^2 q^k)$, and $2^{2 k^2}$ cancels. The product:",
        (height - value * x_0**k) * (height + value * x_0**k),
        height**2 - value**2 * x_0 ** (2 * k),
    )
    yield identity(
        r"The degrees in the coefficients of $f$ agree, too.",
        lambda: 2 * (2 * (k - 1)) + isotropic,
        4 * k,
    )


def _random_forms(
    orders: Orders, power: Callable[[int], int], degree: Callable[[int], int]
) -> Iterator[Step]:
    """Yield the same equations for random forms, from determinants and without the rules."""
    generator = random.Random(19)
    constants: dict[int, set[Any]] = {}
    degrees: dict[int, int] = {}
    for order in orders:
        for _ in range(2):
            p = random_form(order, generator)
            isotropic = on_isotropic(p)
            if isotropic == 0:
                continue
            # lambda = a_k would lower a degree; whole numbers above 9 avoid it.
            bound = 2 * (order - 1) if order % 2 == 0 else 4 * (order - 1)
            nodes = range(10, 10 + bound + 1)
            psi = [psi_value(order, p, value) for value in nodes]
            reduced = [reduced_value(order, p, value) for value in nodes]
            constants.setdefault(order, set()).update(
                a * isotropic ** (power(order) // 2) / b for a, b in zip(psi, reduced, strict=True)
            )
            degrees[order] = _degree(psi)
    yield fact(
        r"The same without the rules: two random integer forms of each order, both sides at more "
        r"values of $\lambda$ than their degree. The ratio is one constant of the order, $\pm 1$ "
        r"for even $k$ and $\pm 4^{(k-1)^2}$, of the conic, for odd $k$.",
        bool(constants)
        and all(
            len(found) == 1
            and abs(next(iter(found))) == (flint.fmpq(4) ** ((o - 1) ** 2) if o % 2 else 1)
            for o, found in constants.items()
        ),
        orders=sorted(constants),
    )
    yield fact(
        r"Their degree in $\lambda$, by divided differences: $k$ for even, $2k$ for odd orders.",
        all(
            found == (degree(order) if order % 2 == 0 else 2 * degree(order))
            for order, found in degrees.items()
        ),
        degrees=degrees,
    )


def _degree(values: list[Any]) -> int:
    """Return the degree of the polynomial with these values at successive whole numbers."""
    degree = -1
    for order in range(len(values)):
        if any(value != 0 for value in values):
            degree = order
        values = [b - a for a, b in pairwise(values)]
    return degree


@section.claim(
    "irregular-tensors",
    place="Correction of Definition 3.2",
    statement=r"A symmetric tensor of dimension 2 and order $k \geq 3$ is irregular exactly if "
    r"$\phi_k = \phi_{k-2} = 0$, that is, if $(x^2 + y^2)^2$ divides $f$; then $\psi = 0$.",
)
def irregular_tensors(orders: Orders, depth: int = 2) -> Iterator[Step]:
    yield identity(
        r"$T v^{k-1} = 0$ at an isotropic vector means $f_z = f_w = 0$ at $z = 0$ (or at $w = 0$, "
        r"the conjugate). For the term with $n = -k + 2m$, $f_z = m z^{m-1} w^{k-m}$: not 0 at $z "
        r"= 0$ only for $m = 1$.",
        sp.Derivative(_Z**_M * _W ** (k - _M), _Z),
        _M * _Z ** (_M - 1) * _W ** (k - _M),
        over=_Z**_M * _W ** (k - _M),
    )
    yield identity(
        r"And $f_w = (k - m) z^m w^{k-m-1}$: not 0 only for $m = 0$. So both vanish exactly if "
        r"$\phi_{-k} = \phi_{-k+2} = 0$: $f$ has the factor $z^2$ and, being real, $w^2$: $(z "
        r"w)^2 = (x^2 + y^2)^2$.",
        sp.Derivative(_Z**_M * _W ** (k - _M), _W),
        (k - _M) * _Z**_M * _W ** (k - _M - 1),
        over=_Z**_M * _W ** (k - _M),
    )
    generator = random.Random(23)
    vanishing, others = {}, {}
    square = flint.fmpq_poly([1, 0, 1])
    for order in (o for o in orders if o >= 4):
        if order >= 2 * depth:
            p = random_form(order - 2 * depth, generator) * square**depth
            vanishing[order] = all(psi_value(order, p, value) == 0 for value in (10, 11, 12))
        regular = random_form(order - 2, generator) * square
        others[order] = any(psi_value(order, regular, value) != 0 for value in (10, 11, 12))
    yield fact(
        r"$\psi = 0$ for random multiples of $(x^2 + y^2)^2$, at three values of $\lambda$, and "
        r"not for multiples of $x^2 + y^2$ alone (exact resultants).",
        all(vanishing.values()) and all(others.values()),
        irregular=sorted(vanishing),
        regular=sorted(others),
    )
