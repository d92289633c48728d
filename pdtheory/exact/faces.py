"""A term of order k and its three faces: symmetric tensor, binary form, Wavejets row.

All three describe the same homogeneous function f(v) = T_k v^k on the plane:

- the tensor by its k + 1 distinct components t_j, the entry with j indices equal to y;
- the binary form by its coefficients, f = sum_j C(k, j) t_j x^(k-j) y^j;
- the Wavejets row by f(cos a, sin a) / k! = sum_n phi_n exp(i n a), n = k mod 2, |n| <= k.

The conversions are linear and exact. Everything else is defined once, on `Face`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from itertools import pairwise
from math import comb
from typing import TYPE_CHECKING, Any, Self

import sympy as sp

from pdtheory.errors import InputError
from pdtheory.exact.coefficients import check_order, exact, exact_tuple, tidy
from pdtheory.exact.zeros import is_zero

if TYPE_CHECKING:
    from pdtheory.exact.eigenpairs import EigenPairs
    from pdtheory.exact.tensor import SymmetricTensor
    from pdtheory.exact.wavejets import WavejetsRow

X, Y = sp.symbols("x y")


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
        from pdtheory.exact.tensor import SymmetricTensor

        return SymmetricTensor(
            [a / comb(self.order, j) for j, a in enumerate(self.form.coefficients)]
        )

    @property
    def row(self) -> WavejetsRow:
        """The Wavejets row phi_{k,n}."""
        from pdtheory.exact.wavejets import WavejetsRow

        return WavejetsRow.of_form(self.form)

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
            If `times` is not between 0 and k, or v has not two coordinates.
        """
        from pdtheory.exact.tensor import SymmetricTensor

        if not 0 <= times <= self.order:
            raise InputError(f"A tensor of order {self.order} cannot be contracted {times} times.")
        x, y = exact_tuple(v, 2, "vector")
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
            The angle by a point of the unit circle instead. A rational one, such as
            ``Rational(3, 5)`` and ``Rational(4, 5)``, keeps everything rational.

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
