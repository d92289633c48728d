"""A term of order k and its three faces: symmetric tensor, binary form, Wavejets row.

All three describe the same homogeneous function f(v) = T_k v^k on the plane:

- the tensor by its k + 1 distinct components t_j, the entry with j indices equal to y;
- the binary form by its coefficients, f = sum_j C(k, j) t_j x^(k-j) y^j;
- the Wavejets row by f(cos a, sin a) / k! = sum_n phi_n exp(i n a), n = k mod 2, |n| <= k.

The conversions are linear and exact. Everything else is defined once, on `Face`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from functools import cached_property, lru_cache
from itertools import pairwise
from math import comb, factorial
from typing import TYPE_CHECKING, Any, Final, Self

import numpy as np
import sympy as sp

from pdtheory.conventions import frequencies
from pdtheory.errors import InputError

if TYPE_CHECKING:
    from pdtheory.exact.eigenpairs import EigenPairs

#: Largest order of a form; a longer row would not be an answer that anyone could read.
MAX_ORDER: Final = 256

X, Y = sp.symbols("x y")


def check_order(order: int, least: int = 0) -> int:
    """Return the order if it is an integer within the bounds.

    Raises
    ------
    InputError
        If it is below `least` or above `MAX_ORDER`.
    """
    if int(order) != order or not least <= order <= MAX_ORDER:
        raise InputError(
            f"The order is {order}; it must be an integer from {least} to {MAX_ORDER}."
        )
    return int(order)


def exact(value: Any) -> Any:
    """Return a number or expression as exact SymPy; a float becomes the rational that it is.

    Raises
    ------
    InputError
        If the value is not finite or is no number.
    """
    if isinstance(value, (float, np.floating)):
        if not np.isfinite(value):
            raise InputError(f"The coefficient {value} is not finite.")
        return sp.Rational(*float(value).as_integer_ratio())
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, str):
        raise InputError(f"The coefficient {value!r} is text; read it with parse_expression first.")
    try:
        expression = sp.sympify(value)
    except (sp.SympifyError, TypeError) as error:
        raise InputError(f"The coefficient {value!r} is not a number or an expression.") from error
    if not isinstance(expression, sp.Expr):
        raise InputError(f"The coefficient {value!r} is not a number or an expression.")
    if expression.has(sp.oo, -sp.oo, sp.zoo, sp.nan):
        raise InputError(f"The coefficient {expression} is not finite.")
    if expression.has(sp.Float):
        expression = expression.replace(
            lambda e: e.is_Float, lambda e: sp.Rational(*_float_ratio(e))
        )
    return expression


def _float_ratio(value: Any) -> tuple[int, int]:
    sign, mantissa, exponent, _ = value._mpf_
    mantissa = -int(mantissa) if sign else int(mantissa)
    return (mantissa << exponent, 1) if exponent >= 0 else (mantissa, 1 << -exponent)


def tidy(value: Any) -> Any:
    """Return an exact expression expanded, so that equal coefficients look alike."""
    return value if value.is_Rational else sp.expand(value)


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


class Face(ABC):
    """A homogeneous function of order k on the plane, seen from one of its three faces.

    Attributes
    ----------
    order : int
        The order k.
    """

    order: int

    @property
    @abstractmethod
    def form(self) -> BinaryForm:
        """The binary form f = T_k v^k."""

    @property
    def tensor(self) -> SymmetricTensor:
        """The symmetric tensor T_k."""
        return SymmetricTensor(
            [a / comb(self.order, j) for j, a in enumerate(self.form.coefficients)]
        )

    @property
    def row(self) -> WavejetsRow:
        """The Wavejets row phi_{k,n}."""
        return WavejetsRow._of_form(self.form)

    @classmethod
    @abstractmethod
    def of(cls, face: Face) -> Self:
        """Return this face of any other."""

    def __call__(self, x: Any, y: Any) -> Any:
        """Return T_k v^k at v = (x, y), exactly."""
        x, y = exact(x), exact(y)
        value = sum(
            (a * x ** (self.order - j) * y**j for j, a in enumerate(self.form.coefficients)),
            sp.Integer(0),
        )
        return tidy(value)

    @property
    def is_zero(self) -> bool:
        """True if all coefficients vanish."""
        return all(is_zero(a) for a in self.form.coefficients)

    @property
    def free_symbols(self) -> set[Any]:
        """The parameters on which the coefficients depend."""
        return set().union(*(a.free_symbols for a in self.form.coefficients))

    def contract(self, v: Sequence[Any], times: int = 1) -> SymmetricTensor:
        """Return the tensor T v^j of order k - j (section 3 of the paper).

        Parameters
        ----------
        v
            The vector (x, y), exact or symbolic.
        times
            The number j of contractions, at most k.

        Raises
        ------
        InputError
            If `times` is not between 0 and k.
        """
        if not 0 <= times <= self.order:
            raise InputError(f"A tensor of order {self.order} cannot be contracted {times} times.")
        x, y = (exact(c) for c in v)
        t = list(self.tensor.components)
        for _ in range(times):
            t = [tidy(x * a + y * b) for a, b in pairwise(t)]
        return SymmetricTensor(t)

    def gradient(self) -> tuple[BinaryForm, BinaryForm]:
        """Return the two forms f_x and f_y, which are the components of k T_k v^(k-1)."""
        k, a = self.order, self.form.coefficients
        check_order(k, 1)
        return (
            BinaryForm([(k - j) * a[j] for j in range(k)]),
            BinaryForm([(j + 1) * a[j + 1] for j in range(k)]),
        )

    def angular_derivative(self) -> BinaryForm:
        """Return F = x f_y - y f_x, the derivative of f along the circle."""
        k, a = self.order, self.form.coefficients
        padded = (sp.Integer(0), *a, sp.Integer(0))
        return BinaryForm([(j + 1) * padded[j + 2] - (k - j + 1) * padded[j] for j in range(k + 1)])

    def turn_frame(self, angle: Any = None, *, cosine: Any = None, sine: Any = None) -> Self:
        """Return the function in a frame turned by an angle: phi_n becomes phi_n exp(i n angle).

        Parameters
        ----------
        angle
            Angle in radians, from the old t1 to the new one; exact or symbolic.
        cosine, sine
            The angle by a point of the unit circle instead, such as (3/5, 4/5): stays rational.

        Raises
        ------
        InputError
            If neither or both are given, or the point is not on the unit circle.
        """
        if (angle is None) == (cosine is None) or (cosine is None) != (sine is None):
            raise InputError("Give either the angle or both its cosine and its sine.")
        if angle is not None:
            cosine, sine = sp.cos(exact(angle)), sp.sin(exact(angle))
        else:
            cosine, sine = exact(cosine), exact(sine)
            if not is_zero(cosine**2 + sine**2 - 1):
                raise InputError(f"The point ({cosine}, {sine}) is not on the unit circle.")
        return self.of(self.form.substitute((cosine, -sine), (sine, cosine)))

    def __add__(self, other: Face) -> Self:
        if not isinstance(other, Face):
            return NotImplemented
        if self.order != other.order:
            raise InputError(f"Orders {self.order} and {other.order} cannot be added.")
        pairs = zip(self.form.coefficients, other.form.coefficients, strict=True)
        return self.of(BinaryForm([a + b for a, b in pairs]))

    def __neg__(self) -> Self:
        return self * -1

    def __sub__(self, other: Face) -> Self:
        return self + (-other)

    def __mul__(self, scalar: Any) -> Self:
        if isinstance(scalar, Face):
            return NotImplemented
        scalar = exact(scalar)
        return self.of(BinaryForm([scalar * a for a in self.form.coefficients]))

    __rmul__ = __mul__

    def __truediv__(self, scalar: Any) -> Self:
        return self * (1 / exact(scalar))

    def __eq__(self, other: object) -> bool:
        """Faces are equal if they are the same function, whatever side they show."""
        if not isinstance(other, Face):
            return NotImplemented
        if self.order != other.order:
            return False
        pairs = zip(self.form.coefficients, other.form.coefficients, strict=True)
        return all(is_zero(a - b) for a, b in pairs)

    def __hash__(self) -> int:
        return hash(self.order)

    def eigenpairs(self) -> EigenPairs:
        """Return the real E-eigenpairs; see :func:`pdtheory.exact.real_eigenpairs`."""
        from pdtheory.exact.eigenpairs import real_eigenpairs

        return real_eigenpairs(self)

    @property
    def expression(self) -> Any:
        """The polynomial f in the symbols x and y."""
        return sp.Add(
            *(a * X ** (self.order - j) * Y**j for j, a in enumerate(self.form.coefficients))
        )

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.latex()}$"

    @abstractmethod
    def latex(self) -> str:
        """Return LaTeX source for this face."""


def is_zero(value: Any) -> bool:
    """Decide whether an exact coefficient vanishes.

    Numbers clearly away from zero are told by evaluation; the rest by expansion and then by
    simplification.
    """
    if value.is_Rational:
        return bool(value == 0)
    if value.is_zero is not None:
        return bool(value.is_zero)
    if not value.free_symbols and abs(value.evalf(20, maxn=300)) > 1e-12:
        return False
    expanded = sp.expand(value)
    if expanded.is_zero is not None:
        return bool(expanded.is_zero)
    return bool(sp.simplify(expanded) == 0)


class BinaryForm(Face):
    """The binary form f = sum_j a_j x^(k-j) y^j = T_k v^k.

    Parameters
    ----------
    coefficients
        The k + 1 coefficients a_0 (of x^k) to a_k (of y^k).

    Examples
    --------
    >>> BinaryForm([1, 0, -3, 0])
    BinaryForm(x**3 - 3*x*y**2)
    >>> BinaryForm([1, 0, -3, 0]).row
    WavejetsRow(order=3, {1: 0, 3: 1/12})
    """

    def __init__(self, coefficients: Sequence[Any]) -> None:
        self.order = check_order(len(coefficients) - 1)
        self.coefficients: tuple[Any, ...] = tuple(tidy(exact(a)) for a in coefficients)

    @property
    def form(self) -> BinaryForm:
        """The form itself."""
        return self

    @classmethod
    def of(cls, face: Face) -> Self:
        """Return the form of any face."""
        return cls(face.form.coefficients)

    @classmethod
    def from_expression(cls, expression: Any, variables: Sequence[Any] = (X, Y)) -> Self:
        """Return the form of a homogeneous polynomial.

        Raises
        ------
        InputError
            If the expression is no polynomial in the variables or not homogeneous.
        """
        try:
            poly = sp.Poly(exact(expression), *variables)
        except sp.PolynomialError as error:
            raise InputError(
                f"{expression} is not a polynomial in {variables[0]} and {variables[1]}; "
                "take its Taylor term with differential_tensor."
            ) from error
        if poly.is_zero:
            raise InputError("The polynomial 0 has no order; give the coefficients instead.")
        if not poly.is_homogeneous:
            raise InputError(
                f"{expression} is not homogeneous; take one Taylor term with differential_tensor."
            )
        order = check_order(poly.total_degree())
        coefficients = [sp.Integer(0)] * (order + 1)
        for (_, j), a in poly.terms():
            coefficients[j] = a
        return cls(coefficients)

    def substitute(self, new_x: Sequence[Any], new_y: Sequence[Any]) -> BinaryForm:
        """Return f(a x + b y, c x + d y) for new_x = (a, b) and new_y = (c, d)."""
        k = self.order
        (a, b), (c, d) = (tuple(exact(e) for e in pair) for pair in (new_x, new_y))
        total = [sp.Integer(0)] * (k + 1)
        # Horner in y over powers of the new x keeps the number of products at O(k^2).
        power = [sp.Integer(1)]
        result = [self.coefficients[k]]
        for j in range(k - 1, -1, -1):
            power = _times_linear(power, a, b)
            result = _times_linear(result, c, d)
            result = [
                tidy(r + self.coefficients[j] * p) for r, p in zip(result, power, strict=True)
            ]
        total[: len(result)] = result
        return BinaryForm(total)

    def __repr__(self) -> str:
        return f"BinaryForm({self.expression})"

    def latex(self) -> str:
        """Return LaTeX source for the polynomial."""
        return f"T_{{{self.order}}}v^{{{self.order}}} = {sp.latex(self.expression)}"


def _times_linear(coefficients: list[Any], a: Any, b: Any) -> list[Any]:
    """Multiply a form by a x + b y."""
    padded = [*coefficients, sp.Integer(0)]
    return [tidy(a * padded[j] + (b * padded[j - 1] if j else 0)) for j in range(len(padded))]


class SymmetricTensor(Face):
    """A symmetric tensor of order k and dimension 2 by its k + 1 distinct components.

    Parameters
    ----------
    components
        t_0 to t_k; t_j is the entry with j of its k indices equal to y. For a differential tensor
        t_j is the derivative d^k f / dx^(k-j) dy^j.
    """

    def __init__(self, components: Sequence[Any]) -> None:
        self.order = check_order(len(components) - 1)
        self.components: tuple[Any, ...] = tuple(tidy(exact(t)) for t in components)

    @property
    def tensor(self) -> SymmetricTensor:
        """The tensor itself."""
        return self

    @cached_property
    def _form(self) -> BinaryForm:
        return BinaryForm([comb(self.order, j) * t for j, t in enumerate(self.components)])

    @property
    def form(self) -> BinaryForm:
        """The binary form T v^k."""
        return self._form

    @classmethod
    def of(cls, face: Face) -> Self:
        """Return the tensor of any face."""
        return cls(face.tensor.components)

    @classmethod
    def from_array(cls, array: Any) -> Self:
        """Return the tensor of a dense array of shape (2,) * k.

        Raises
        ------
        InputError
            If the shape is wrong or the array is not exactly symmetric; it names the entry.
        """
        dense = np.asarray(array)
        if dense.dtype != object and not np.issubdtype(dense.dtype, np.number):
            raise InputError(f"The array has dtype {dense.dtype}; it must hold numbers.")
        if any(size != 2 for size in dense.shape):
            raise InputError(f"The array has shape {dense.shape}; every axis must have length 2.")
        order = check_order(dense.ndim)
        if order > 16:
            raise InputError(f"A dense array of order {order} is too large; give its components.")
        components: dict[int, Any] = {}
        for index in np.ndindex(dense.shape):
            value, j = exact(dense[index]), sum(index)
            if not is_zero(components.setdefault(j, value) - value):
                raise InputError(
                    f"The array is not symmetric: entry {index} is {value}, but an entry with the "
                    f"same indices in another order is {components[j]}."
                )
        return cls([components[j] for j in range(order + 1)])

    def to_array(self) -> np.ndarray[Any, np.dtype[np.object_]]:
        """Return the dense array of shape (2,) * k with exact entries (orders up to 16)."""
        if self.order > 16:
            raise InputError(f"A dense array of order {self.order} is too large; use `components`.")
        dense = np.empty((2,) * self.order, dtype=object)
        for index in np.ndindex(dense.shape):
            dense[index] = self.components[sum(index)]
        return dense

    def __repr__(self) -> str:
        return f"SymmetricTensor(order={self.order}, {list(self.components)})"

    def latex(self) -> str:
        """Return LaTeX source for the components."""
        k = self.order
        entries = r",\ ".join(
            f"T_{{{'x' * (k - j)}{'y' * j}}} = {sp.latex(t)}" for j, t in enumerate(self.components)
        )
        return entries if k else sp.latex(self.components[0])


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
    def _of_form(cls, form: BinaryForm) -> WavejetsRow:
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
        return {n: complex(float(a), float(b)) for n, (a, b) in self.parts.items()}

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
