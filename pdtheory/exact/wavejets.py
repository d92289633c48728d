"""The Wavejets face: a term of order k by its Fourier coefficients on the circle."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property, lru_cache
from math import comb, factorial
from typing import Any, Self

import sympy as sp

from pdtheory.conventions import frequencies
from pdtheory.errors import InputError
from pdtheory.exact.coefficients import check_order, exact, tidy
from pdtheory.exact.enclosing import nearest_double
from pdtheory.exact.faces import BinaryForm, Face
from pdtheory.exact.zeros import is_zero


@lru_cache(maxsize=64)
def krawtchouk(order: int) -> tuple[tuple[int, ...], ...]:
    """Return K[q][j], the coefficient of s^j in (1 + s)^(k-q) (1 - s)^q, for 0 <= q, j <= k."""
    row = [comb(order, j) for j in range(order + 1)]
    table = [tuple(row)]
    for _ in range(order):
        # (1 - s) / (1 + s) times the row before: an exact division of polynomials.
        quotient = [row[0]]
        for j in range(1, order + 1):
            quotient.append(row[j] - row[j - 1] - quotient[-1])
        row = quotient
        table.append(tuple(row))
    return tuple(table)


class WavejetsRow(Face):
    """The Wavejets row of order k: g = T_k v^k / k! = sum_n phi_n exp(i n theta) on the circle.

    Free symbols in the coefficients are taken to be real.

    Parameters
    ----------
    order
        The order k.
    phi
        phi_n by n for n >= 0 with n = k mod 2, exact and complex; missing ones are 0 and
        phi_{-n} is the conjugate.

    Examples
    --------
    >>> WavejetsRow(3, {3: 1}).form
    BinaryForm(12*x**3 - 36*x*y**2)
    """

    def __init__(self, order: int, phi: Mapping[int, Any]) -> None:
        self.order = check_order(order)
        parts = {n: _parts(exact(value)) for n, value in phi.items()}
        for n, (real, imaginary) in parts.items():
            if n not in frequencies(order):
                raise InputError(
                    f"A row of order {order} has no frequency {n}: n must be between 0 and {order} "
                    f"with the parity of {order}."
                )
            if n == 0 and not is_zero(imaginary):
                raise InputError(f"phi_{{{order},0}} = {real + sp.I * imaginary} must be real.")
        zero = (sp.Integer(0), sp.Integer(0))
        #: (real, imaginary) by frequency.
        self.parts: dict[int, tuple[Any, Any]] = {n: parts.get(n, zero) for n in frequencies(order)}

    @classmethod
    def from_maxima(cls, order: int, angles: Sequence[Any]) -> WavejetsRow:
        """Return a row whose maxima are given angles in degrees.

        Raises
        ------
        InputError
            If no row has these maxima; the message says why.
        """
        from pdtheory.exact.inverse import realize_maxima

        found = realize_maxima(order, angles)
        if found.row is None:
            listed = ", ".join(str(a) for a in found.angles)
            raise InputError(
                f"No row of order {order} has its maxima at {listed} degrees: {found.reason}."
            )
        return found.row

    @classmethod
    def of_form(cls, form: BinaryForm) -> WavejetsRow:
        """Return the row of a binary form."""
        k, table = form.order, krawtchouk(form.order)
        scale = sp.Rational(1, 2**k * factorial(k))
        row = cls(k, {})
        for n in frequencies(k):
            # x = (z + 1/z)/2 and y = (z - 1/z)/(2i): coefficient of z^n, split by the powers of -i.
            m = (k - n) // 2
            sums = [sp.Integer(0)] * 4
            for j, a in enumerate(form.coefficients):
                sums[j % 4] += a * table[j][m]
            row.parts[n] = (tidy(scale * (sums[0] - sums[2])), tidy(scale * (sums[3] - sums[1])))
        return row

    @property
    def row(self) -> WavejetsRow:
        """The row itself."""
        return self

    @cached_property
    def _form(self) -> BinaryForm:
        # r^k exp(i n theta) = (x + i y)^p (x - i y)^q with p = (k+n)/2, q = (k-n)/2.
        k, table = self.order, krawtchouk(self.order)
        coefficients = []
        for j in range(k + 1):
            total = sp.Integer(0)
            for n, (real, imaginary) in self.parts.items():
                # Re of 2 phi i^j K, or of phi i^j K for n = 0.
                part = (real, -imaginary, -real, imaginary)[j % 4]
                total += (2 if n else 1) * part * table[(k - n) // 2][j]
            coefficients.append(factorial(k) * total)
        return BinaryForm(coefficients)

    @property
    def form(self) -> BinaryForm:
        """The binary form k! sum_n phi_n r^k exp(i n theta)."""
        return self._form

    @classmethod
    def of(cls, face: Face) -> Self:
        """Return the row of any face."""
        row = face.row
        return cls(row.order, row.phi)

    def __getitem__(self, n: int) -> Any:
        """Return phi_n, also for negative n and for those that vanish by parity."""
        real, imaginary = self.parts.get(abs(n), (sp.Integer(0), sp.Integer(0)))
        return real + sp.I * imaginary * (-1 if n < 0 else 1)

    @property
    def phi(self) -> dict[int, Any]:
        """The coefficients phi_n, n >= 0, as SymPy expressions."""
        return {n: self[n] for n in self.parts}

    @property
    def support(self) -> list[int]:
        """The frequencies n > 0 with phi_n != 0, ascending."""
        return [n for n, (a, b) in self.parts.items() if n and not (is_zero(a) and is_zero(b))]

    def squared_modulus(self, n: int) -> Any:
        """Return |phi_n|^2."""
        real, imaginary = self.parts[n]
        return tidy(real**2 + imaginary**2)

    def to_complex(self) -> dict[int, complex]:
        """Return the coefficients as Python complex numbers."""
        return {
            n: complex(nearest_double(a), nearest_double(b)) for n, (a, b) in self.parts.items()
        }

    def __repr__(self) -> str:
        return f"WavejetsRow(order={self.order}, {self.phi})"

    def latex(self) -> str:
        """Return LaTeX source for the coefficients."""
        return r",\ ".join(
            rf"\phi_{{{self.order},{n}}} = {sp.latex(value)}" for n, value in self.phi.items()
        )


def _parts(value: Any) -> tuple[Any, Any]:
    """Split a coefficient into real and imaginary part, free symbols being real."""
    if value.is_Rational:
        return value, sp.Integer(0)
    real_symbols = {s: sp.Dummy(s.name, real=True) for s in value.free_symbols}
    parts = sp.expand(value.xreplace(real_symbols)).as_real_imag()
    back = {dummy: s for s, dummy in real_symbols.items()}
    real, imaginary = (tidy(p.xreplace(back)) for p in parts)
    return real, imaginary
