"""Corrected theorems: complex E-eigenpairs and the E-characteristic polynomial."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import Any

import flint
import sympy as sp

from pdtheory.paper.claims.core import UP_TO, Orders, Section, Step
from pdtheory.paper.claims.kit import fact, identity, k, n
from pdtheory.paper.claims.sturm import critical

section = Section("Corrected theorems: complex E-eigenpairs")

_Z, _W = sp.symbols("z w", nonzero=True)
_M = sp.Symbol("m", integer=True, nonnegative=True)


def _turn(f: Any) -> Any:
    """Return F = df/dtheta in the coordinates z = x + i y, w = x - i y: i (z f_z - w f_w)."""
    return sp.I * (_Z * sp.diff(f, _Z) - _W * sp.diff(f, _W))


def _term() -> Any:
    return _Z ** ((k + n) / 2) * _W ** ((k - n) / 2)


def _coordinates() -> Step:
    x, y, f_z, f_w = sp.symbols("x y f_z f_w")
    f_x, f_y = f_z + f_w, sp.I * f_z - sp.I * f_w
    return identity(
        r"In $z = x + i y$, $w = x - i y$ a form is $f = k! \sum_n \phi_n z^{(k+n)/2} "
        r"w^{(k-n)/2}$, and $F = x f_y - y f_x = i (z f_z - w f_w)$ by the chain rule.",
        x * f_y - y * f_x,
        sp.I * ((x + sp.I * y) * f_z - (x - sp.I * y) * f_w),
    )


@section.claim(
    "complex-eigenpairs",
    place="Correction of Definition 3.2 and Theorem 4.3",
    statement=r"The E-eigenvectors of a binary form that are not isotropic are $v = (\cos t, \sin "
    r"t)$, $t$ complex, with $P(u) = 0$, $u = e^{2 i t} \neq 0$, $\lambda = f(v)$; up to sign and "
    r"with multiplicity there are $n_{\max}$ of them, $k$ in general. Isotropic ones exist "
    r"exactly if $\phi_k = 0$.",
)
def complex_eigenpairs(
    orders: Orders, number: Callable[[Any], Any] = lambda n_max: n_max, isotropic: Any = 1
) -> Iterator[Step]:
    yield _coordinates()
    yield identity(
        r"Each term gives $i n$ times itself (symbolic $k$, $n$), so $F = k! \sum_n i n \phi_n "
        r"z^{(k+n)/2} w^{(k-n)/2}$.",
        sp.I * (_Z * sp.Derivative(_term(), _Z) - _W * sp.Derivative(_term(), _W)),
        sp.I * n * _term(),
        over=_term(),
    )
    u = sp.Symbol("u", positive=True)
    yield identity(
        r"$v \cdot v = z w = 1$ means $z = e$, $w = 1/e$, $e = x + i y \neq 0$: $v = (\cos t, "
        r"\sin t)$ with $e = e^{i t}$. There, with $u = e^2$, $u^{k/2} z^{(k+n)/2} w^{(k-n)/2} = "
        r"u^{(k+n)/2}$: $F = 0$ is $P(u) = 0$, $u \neq 0$, and by Theorem 4.3, an algebraic "
        r"identity, these are the E-eigenvectors with $\lambda = f(v)$.",
        lambda: u ** (k / 2) * sp.sqrt(u) ** ((k + n) / 2) * (1 / sp.sqrt(u)) ** ((k - n) / 2),
        u ** ((k + n) / 2),
    )
    N = sp.Symbol("N", integer=True, positive=True)
    yield identity(
        r"The exponents go from $(k - N)/2$ to $(k + N)/2$, $N = n_{\max}$: $N$ roots $u \neq 0$.",
        lambda: (k + N) / 2 - (k - N) / 2,
        number(N),
    )
    at_isotropic = {_Z: 0, _W: 2}
    values = {
        (o, m): (_Z ** ((o + m) // 2) * _W ** ((o - m) // 2)).subs(at_isotropic)
        for o in orders
        for m in range(-o, o + 1, 2)
    }
    yield fact(
        r"Isotropic: at $v = (1, i)$, $z = 0$ and $w = 2$, so every term vanishes but $n = -k$, "
        r"which gives $2^k$: $f = k!\, 2^k \overline{\phi_k}$ and $F = -i k f$. A vector is "
        r"parallel to $T v^{k-1}$ where $F = 0$: exactly if $\phi_k = 0$.",
        all(value == (2**o * isotropic if m == -o else 0) for (o, m), value in values.items()),
        orders=list(orders),
    )
    counted = {}
    generator = random.Random(17)
    for order in orders:
        F = critical(order, _generic(order, generator))
        square = flint.fmpq_poly([1, 0, 1])
        _, remainder = divmod(F, square)
        counted[order] = (F.degree(), remainder != 0)
    yield fact(
        r"Random integer forms: $F$ has degree $k$ and is not divisible by $x^2 + y^2$: $k$ "
        r"complex E-eigenvectors up to sign.",
        all(found == (order, True) for order, found in counted.items()),
        degree_of_F=counted,
    )


def _generic(order: int, generator: random.Random) -> Any:
    """Return f(1, t) with random integer coefficients, none of them zero."""
    digits = [j for j in range(-9, 10) if j]
    return flint.fmpq_poly([generator.choice(digits) for _ in range(order + 1)])


def _resultant(a: Any, b: Any) -> Any:
    """Return the resultant of two polynomials over the rationals."""
    scale = flint.fmpq(a.denom()) ** b.degree() * flint.fmpq(b.denom()) ** a.degree()
    return flint.fmpq(a.numer().resultant(b.numer())) / scale


def _on_isotropic(p: Any) -> Any:
    """Return |f(1, i)|^2."""
    powers = (1, 1, -1, -1)  # of i, apart from the factor i of the odd ones
    parts = [flint.fmpq(0), flint.fmpq(0)]
    for j, c in enumerate(p.coeffs()):
        parts[j % 2] += powers[j % 4] * c
    return parts[0] ** 2 + parts[1] ** 2


def psi_value(order: int, p: Any, value: Any) -> Any:
    """Return psi(value) from Qi's definition, up to a constant that depends on the order only.

    Even order: the resultant of the two components of T v^(k-1) - lambda (v.v)^((k-2)/2) v. Odd
    order: of T v^(k-1) - lambda x_0^(k-2) v on the conic v.v = x_0^2, with its parametrisation
    x = 1 - s^2, y = 2 s, x_0 = 1 + s^2.
    """
    s = flint.fmpq_poly([0, 1])
    square = flint.fmpq_poly([1, 0, 1])
    slope = p.derivative()
    t_x, t_y = (order * p - s * slope) / order, slope / order
    if order % 2 == 0:
        power = value * square ** ((order - 2) // 2)
        return _resultant(t_x - power, t_y - power * s)
    across, along = flint.fmpq_poly([1, 0, -1]), flint.fmpq_poly([0, 2])

    def on_conic(form: Any) -> Any:
        return sum(
            (c * across ** (order - 1 - j) * along**j for j, c in enumerate(form.coeffs())),
            flint.fmpq_poly(),
        )

    power = value * square ** (order - 2)
    return _resultant(on_conic(t_x) - power * across, on_conic(t_y) - power * along)


def _reduced(order: int, p: Any, value: Any) -> Any:
    """Return Res(F/k, f - lambda q^(k/2)), or Res(F/k, f^2 - lambda^2 q^k) for odd order."""
    F = critical(order, p) / order
    square = flint.fmpq_poly([1, 0, 1])
    if order % 2 == 0:
        return _resultant(F, p - value * square ** (order // 2))
    return _resultant(F, p * p - value * value * square**order)


@section.claim(
    "e-characteristic-polynomial",
    place="Correction of Definition 3.2",
    statement=r"If $\phi_k \neq 0$, $\psi$ has degree $k$ in $\lambda$ ($k$ even) or in "
    r"$\lambda^2$ ($k$ odd), its roots are the E-eigenvalues, and with $q = x^2 + y^2$: "
    r"$\mathrm{Res}(F/k, f - \lambda q^{k/2}) = \pm \psi\, |f(1, i)|^2$ for even $k$, "
    r"$\mathrm{Res}(F/k, f^2 - \lambda^2 q^k) = \pm \psi\, |f(1, i)|^4$ for odd $k$.",
    scope=UP_TO,
)
def e_characteristic_polynomial(
    orders: Orders,
    power: Callable[[int], int] = lambda order: 1 if order % 2 == 0 else 2,
    degree: Callable[[int], int] = lambda order: order,
) -> Iterator[Step]:
    generator = random.Random(19)
    constants: dict[int, set[Any]] = {}
    degrees: dict[int, int] = {}
    for order in orders:
        for _ in range(2):
            p = _generic(order, generator)
            isotropic = _on_isotropic(p)
            if isotropic == 0:
                continue
            # lambda = a_k would lower a degree; whole numbers above 9 avoid it.
            bound = 2 * (order - 1) if order % 2 == 0 else 4 * (order - 1)
            nodes = range(10, 10 + bound + 1)
            psi = [psi_value(order, p, value) for value in nodes]
            reduced = [_reduced(order, p, value) for value in nodes]
            constants.setdefault(order, set()).update(
                a * isotropic ** power(order) / b for a, b in zip(psi, reduced, strict=True)
            )
            degrees[order] = _degree(psi)
    yield fact(
        r"Both sides are polynomials in $\lambda$ of degree at most $2 (k - 1)$ ($4 (k - 1)$ for "
        r"odd $k$) and were computed at one more value than that, for two random integer forms of "
        r"each order: the ratio is one constant of the order, $\pm 1$ for even $k$, $\pm 2^{2 "
        r"(k-1)^2}$ for odd $k$, which comes from the parametrisation of the conic.",
        bool(constants)
        and all(
            len(found) == 1
            and abs(next(iter(found))) == (flint.fmpq(2) ** (2 * (o - 1) ** 2) if o % 2 else 1)
            for o, found in constants.items()
        ),
        orders=sorted(constants),
    )
    yield fact(
        r"Degree in $\lambda$, by divided differences of those values: $k$ for even, $2k$ for odd "
        r"orders.",
        all(
            found == (degree(order) if order % 2 == 0 else 2 * degree(order))
            for order, found in degrees.items()
        ),
        degrees=degrees,
    )
    scale = sp.Symbol("h", positive=True)
    yield identity(
        r"The resultant vanishes at $\lambda$ exactly if $F$ and $f - \lambda q^{k/2}$ have a "
        r"common zero. Where $q \neq 0$ it may be scaled to $q = 1$, an E-eigenvector with "
        r"$\lambda = f(v)$: scaling $v$ by $h$ multiplies every term by $h^k$ (symbolic $k$).",
        sp.expand_power_base(_term().subs({_Z: scale * _Z, _W: scale * _W}), force=True),
        scale**k * _term(),
        over=_term(),
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
        p = _generic(order - 2 * depth, generator) * square**depth if order >= 2 * depth else None
        if p is not None:
            vanishing[order] = all(psi_value(order, p, value) == 0 for value in (10, 11, 12))
        regular = _generic(order - 2, generator) * square
        others[order] = any(psi_value(order, regular, value) != 0 for value in (10, 11, 12))
    yield fact(
        r"$\psi = 0$ for random multiples of $(x^2 + y^2)^2$, at three values of $\lambda$, and "
        r"not for multiples of $x^2 + y^2$ alone (exact resultants).",
        all(vanishing.values()) and all(others.values()),
        irregular=sorted(vanishing),
        regular=sorted(others),
    )
