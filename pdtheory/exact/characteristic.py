"""The E-characteristic polynomial of a symmetric tensor of dimension 2, by Qi's definition.

For even k it is the resultant of the two forms T v^(k-1) - lambda (v.v)^((k-2)/2) v. For odd k it
is that of T v^(k-1) - lambda b^(k-2) v and v.v - b^2 in the three unknowns v and b; the conic is
parametrized by v = (s^2 - t^2, 2 s t), b = s^2 + t^2, which leaves two forms again. The
resultant is a determinant that is evaluated at integers and interpolated.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp
from sympy.polys.matrices import DomainMatrix

from pdtheory.errors import InputError
from pdtheory.exact.coefficients import check_order
from pdtheory.exact.faces import Face
from pdtheory.exact.fields import Field
from pdtheory.exact.zeros import is_zero

#: The unknown of the polynomial.
LAMBDA = sp.Symbol("lambda")

#: Largest order; the determinant has 4 k - 4 rows.
MAX_PSI_ORDER = 40
#: Most numbers beside a number field, such as pi and e, of which psi may be made.
MOST_NUMBERS = 3


@dataclass(frozen=True)
class CharacteristicPolynomial:
    """psi(lambda), up to a constant factor.

    Attributes
    ----------
    order : int
        The order k.
    polynomial : sympy.Poly
        In lambda; primitive with positive leading coefficient for rational tensors. Its degree is
        k for even k and 2 k for odd k, where it is even, unless the tensor has isotropic
        eigenvectors.
    """

    order: int
    polynomial: Any

    @property
    def is_irregular(self) -> bool:
        """True if psi vanishes identically: then every complex number is a root."""
        return bool(self.polynomial.is_zero)

    def factors(self) -> list[tuple[Any, int]]:
        """Return the irreducible factors over the coefficient field, with multiplicities."""
        return [] if self.is_irregular else list(self.polynomial.factor_list()[1])


def is_irregular(face: Face) -> bool:
    """Return whether a tensor of order k >= 2 is irregular: phi_k = phi_{k-2} = 0.

    By definition a tensor is irregular if T v^(k-1) = 0 for some v != 0 with v.v = 0. From order 3
    on psi vanishes identically then, and only then. Of order 2 the zero matrix alone is irregular,
    and its psi is lambda^2.
    """
    row = face.row
    k = check_order(row.order, 2)
    return all(is_zero(part) for n in (k, k - 2) for part in row.parts[n])


def characteristic_polynomial(face: Face) -> CharacteristicPolynomial:
    """Return the E-characteristic polynomial psi of a tensor of order k >= 2.

    Parameters
    ----------
    face
        A tensor, form or row; its coefficients may be constants of any kind, or symbols.

    Returns
    -------
    CharacteristicPolynomial
        Its roots are the E-eigenvalues with complex E-eigenvectors if the tensor is regular (Qi
        2007); for odd k with both signs. It vanishes identically iff k >= 3 and the tensor is
        irregular.

    Raises
    ------
    InputError
        If the order is below 2 or above `MAX_PSI_ORDER`, or more than `MOST_NUMBERS`
        transcendental numbers are among the coefficients.

    Examples
    --------
    >>> from pdtheory.exact import BinaryForm
    >>> psi = characteristic_polynomial(BinaryForm([1, 0, sp.Rational(3, 4), 0]))
    >>> [(p.as_expr(), m) for p, m in psi.factors()]
    [(lambda - 1, 1), (lambda + 1, 1), (4*lambda**2 + 1, 2)]
    """
    form = face.form
    k = check_order(form.order, 2)
    if k > MAX_PSI_ORDER:
        raise InputError(f"The order is {k}; psi is computed up to order {MAX_PSI_ORDER}.")
    field = Field(form.coefficients, "t")
    if len(field.numbers) > MOST_NUMBERS:
        raise InputError(
            f"The coefficients hold {len(field.numbers)} numbers beside a number field; psi is "
            f"computed with at most {MOST_NUMBERS} of them, because it is a polynomial in each."
        )
    domain, elements = field.domain, [field.element(c) for c in form.coefficients]
    first = [domain.convert(sp.QQ(k - j, k), sp.QQ) * elements[j] for j in range(k)]
    second = [domain.convert(sp.QQ(j + 1, k), sp.QQ) * elements[j + 1] for j in range(k)]
    zero, one = domain.zero, domain.one
    if k % 2 == 0:
        sphere = _power([one, zero, one], (k - 2) // 2)
        unknown = [_product(sphere, [one, zero]), _product(sphere, [zero, one])]
        parts = [first, second]
    else:
        x, y = [one, zero, -one], [zero, one + one, zero]
        sphere = _power([one, zero, one], k - 2)
        unknown = [_product(sphere, x), _product(sphere, y)]
        parts = [_compose(part, x, y) for part in (first, second)]
    # The degree of the determinant is at most 2 k - 2 in lambda (k even) or lambda^2 (k odd).
    points = range(2 * k - 1)
    values = []
    for point in points:
        rows = [
            [a - domain(point) * b for a, b in zip(part, u, strict=True)]
            for part, u in zip(parts, unknown, strict=True)
        ]
        values.append(_sylvester(rows[0], rows[1], domain))
    abscissae = [p if k % 2 == 0 else p * p for p in points]
    coefficients = _interpolate(abscissae, values, domain)
    if k % 2:
        coefficients = [c for a in coefficients for c in (a, zero)][:-1]
    return CharacteristicPolynomial(k, _normalized(coefficients, field))


def _normalized(coefficients: list[Any], field: Field) -> Any:
    domain = field.domain
    if field.numbers:
        # Relations between the numbers may make a coefficient vanish that does not look so.
        return sp.Poly([field.expression(c) for c in coefficients[::-1]], LAMBDA)
    poly = sp.Poly.from_list(coefficients[::-1], LAMBDA, domain=domain)
    if poly.is_zero or not domain.is_QQ:
        return poly
    poly = poly.clear_denoms(convert=True)[1].primitive()[1]
    return -poly if poly.LC() < 0 else poly


def _product(a: Sequence[Any], b: Sequence[Any]) -> list[Any]:
    result = [a[0] * 0] * (len(a) + len(b) - 1)
    for i, p in enumerate(a):
        for j, q in enumerate(b):
            result[i + j] = result[i + j] + p * q
    return result


def _power(a: Sequence[Any], exponent: int) -> list[Any]:
    result = [a[0] * 0 + 1]
    for _ in range(exponent):
        result = _product(result, a)
    return result


def _compose(form: Sequence[Any], x: Sequence[Any], y: Sequence[Any]) -> list[Any]:
    """Return the coefficients of sum_j a_j x^(d-j) y^j for forms x and y of equal degree."""
    degree = len(form) - 1
    size = degree * (len(x) - 1) + 1
    total = [form[0] * 0] * size
    for j, a in enumerate(form):
        term = _product(_power(x, degree - j), _power(y, j))
        total = [t + a * c for t, c in zip(total, term, strict=True)]
    return total


def _sylvester(a: Sequence[Any], b: Sequence[Any], domain: Any) -> Any:
    """Return the resultant of two forms of equal degree by the determinant of Sylvester."""
    degree = len(a) - 1
    zero = domain.zero
    rows = [
        [zero] * i + list(form) + [zero] * (degree - 1 - i)
        for form in (a, b)
        for i in range(degree)
    ]
    matrix = DomainMatrix(rows, (2 * degree, 2 * degree), domain)
    return (matrix.to_dense() if domain.is_QQ else matrix).det()


def sylvester_resultant(first: Face, second: Face) -> Any:
    """Return the resultant of two forms of equal order as a SymPy expression.

    Parameters
    ----------
    first, second
        Two forms of the same order, with rational, algebraic or symbolic coefficients.

    Raises
    ------
    InputError
        If the orders differ or are 0.
    """
    a, b = first.form, second.form
    if a.order != b.order or a.order < 1:
        raise InputError(f"A resultant needs two forms of one order, not {a.order} and {b.order}.")
    constants = [*a.coefficients, *b.coefficients]
    field = Field(constants, "t")
    elements, middle = [field.element(c) for c in constants], a.order + 1
    return field.expression(_sylvester(elements[:middle], elements[middle:], field.domain))


def _interpolate(abscissae: Sequence[int], values: Sequence[Any], domain: Any) -> list[Any]:
    """Return the coefficients, constant first, of the polynomial through the points (Newton)."""
    divided = list(values)
    for level in range(1, len(divided)):
        for i in range(len(divided) - 1, level - 1, -1):
            step = sp.QQ(1, abscissae[i] - abscissae[i - level])
            divided[i] = (divided[i] - divided[i - 1]) * domain.convert(step, sp.QQ)
    coefficients = [domain.zero]
    for c, at in zip(reversed(divided), reversed(abscissae), strict=True):
        shifted = [domain.zero, *coefficients]
        scaled = [domain(at) * e for e in coefficients] + [domain.zero]
        coefficients = [p - q for p, q in zip(shifted, scaled, strict=True)]
        coefficients[0] = coefficients[0] + c
    return coefficients
