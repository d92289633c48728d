"""Corrected theorems: complex E-eigenpairs."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from typing import Any

import flint
import sympy as sp

from pdtheory.paper.claims.core import Orders, Section, Step
from pdtheory.paper.claims.kit import fact, identity, k, n
from pdtheory.paper.claims.resultants import random_form
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
        F = critical(order, random_form(order, generator))
        square = flint.fmpq_poly([1, 0, 1])
        _, remainder = divmod(F, square)
        counted[order] = (F.degree(), remainder != 0)
    yield fact(
        r"Random integer forms: $F$ has degree $k$ and is not divisible by $x^2 + y^2$: $k$ "
        r"complex E-eigenvectors up to sign.",
        all(found == (order, True) for order, found in counted.items()),
        degree_of_F=counted,
    )
