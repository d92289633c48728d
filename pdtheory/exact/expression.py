"""Text to SymPy expressions, through a whitelist of our own.

User text is read with :mod:`ast` and rebuilt node by node. It never reaches ``eval`` or SymPy's own
parsers, which run code. Size is bounded before anything is computed, so that no short text can ask
for an astronomically large number.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Sequence
from typing import Any, Final

import sympy as sp

from pdtheory.errors import ExpressionError

#: Longest text that is read, in characters.
MAX_LENGTH: Final = 10_000
#: Largest absolute value of an exponent.
MAX_EXPONENT: Final = 256
#: Largest size of a number that an operation may produce, in bits.
MAX_BITS: Final = 1 << 16
#: Largest size of a number under a root, in bits: SymPy looks for its factors, and what it cannot
#: factor makes a number field that is too large to compute in.
MAX_ROOT_BITS: Final = 1 << 10
#: Deepest nesting of operations; SymPy itself recurses several frames a level.
MAX_DEPTH: Final = 80

FUNCTIONS: Final[dict[str, Callable[[Any], Any]]] = {
    "sqrt": sp.sqrt,
    "cbrt": sp.cbrt,
    "exp": sp.exp,
    "log": sp.log,
    "sin": sp.sin,
    "cos": sp.cos,
    "tan": sp.tan,
    "asin": sp.asin,
    "acos": sp.acos,
    "atan": sp.atan,
    "sinh": sp.sinh,
    "cosh": sp.cosh,
    "tanh": sp.tanh,
    "asinh": sp.asinh,
    "acosh": sp.acosh,
    "atanh": sp.atanh,
}
#: The functions that are roots.
ROOTS: Final = ("sqrt", "cbrt")
CONSTANTS: Final[dict[str, Any]] = {"pi": sp.pi, "E": sp.E}

_NUMBER = re.compile(r"(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?")
_OPERATORS: Final = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Pow: "**"}


def parse_expression(
    text: str, variables: Sequence[str] = ("x", "y"), parameters: Sequence[str] = ()
) -> Any:
    """Read a formula into an exact SymPy expression.

    Decimals are read exactly: ``0.1`` is the rational 1/10.

    Parameters
    ----------
    text
        The formula: numbers, ``+ - * / **``, parentheses, the functions in `FUNCTIONS`, the
        constants ``pi`` and ``E``, and the declared names.
    variables
        Names of the variables; each becomes ``sympy.Symbol(name)``.
    parameters
        Names of further symbols that may occur, such as coefficients left free.

    Returns
    -------
    sympy.Expr
        The expression, with exact numbers.

    Raises
    ------
    ExpressionError
        If the text does not parse, uses anything else, or is larger than the bounds of this module.

    Examples
    --------
    >>> parse_expression("x**3 - 3*x*y**2")
    x**3 - 3*x*y**2
    >>> parse_expression("0.1*x + sqrt(2)*a", parameters=["a"])
    sqrt(2)*a + x/10
    """
    if len(text) > MAX_LENGTH:
        raise ExpressionError(
            f"The expression has {len(text)} characters; at most {MAX_LENGTH} are read."
        )
    stripped = text.strip()
    if not stripped:
        raise ExpressionError("The expression is empty; write a formula such as 'x**3 - 3*x*y**2'.")
    try:
        tree = ast.parse(stripped, mode="eval")
    except (SyntaxError, ValueError, MemoryError, RecursionError) as error:
        place = getattr(error, "offset", None)
        where = f" near character {place}" if place else ""
        hint = " (write a product as 2*x)" if re.search(r"\d[A-Za-z(]", stripped) else ""
        raise ExpressionError(
            f"The expression {_short(stripped)} has a syntax error{where}; "
            f"check the operators and parentheses{hint}."
        ) from error
    names = {name: sp.Symbol(name) for name in (*variables, *parameters)}
    return _Reader(stripped, names).read(tree.body, 0)


def _short(text: str) -> str:
    return repr(text if len(text) <= 60 else text[:57] + "...")


class _Reader:
    """Rebuild one syntax tree; every kind of node that is not named here is refused."""

    def __init__(self, text: str, names: dict[str, Any]) -> None:
        self.text = text
        self.names = names

    def read(self, node: ast.expr, depth: int) -> Any:
        if depth > MAX_DEPTH:
            raise ExpressionError(
                f"The expression {_short(self.text)} is nested more than {MAX_DEPTH} deep; "
                "split it or write the sum as a balanced one."
            )
        match node:
            case ast.Constant():
                return self._number(node)
            case ast.Name(id=name):
                return self._name(name)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return -self.read(operand, depth + 1)
            case ast.UnaryOp(op=ast.UAdd(), operand=operand):
                return self.read(operand, depth + 1)
            case ast.BinOp(op=ast.Add() | ast.Sub()):
                return self._sum(node, depth)
            case ast.BinOp(left=left, op=op, right=right) if type(op) in _OPERATORS:
                a, b = self.read(left, depth + 1), self.read(right, depth + 1)
                return self._operate(_OPERATORS[type(op)], a, b, node)
            case ast.Call(func=ast.Name(id=name), args=[argument], keywords=[]):
                if name not in FUNCTIONS:
                    raise self._refuse(f"the function {name!r}", "use " + ", ".join(FUNCTIONS))
                value = self.read(argument, depth + 1)
                if name in ROOTS:
                    self._check_root(value, node)
                return self._finite(FUNCTIONS[name](value), node)
            case ast.BinOp(op=ast.BitXor()):
                raise self._refuse("the operator '^'", "write a power as x**2")
        raise self._refuse(self._source(node), "use numbers, names, + - * / ** and functions")

    def _sum(self, node: ast.expr, depth: int) -> Any:
        # Long sums are left-deep in the tree; a loop keeps them clear of the depth limit.
        terms = []
        while isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Add, ast.Sub)):
            term = self.read(node.right, depth + 1)
            terms.append(-term if isinstance(node.op, ast.Sub) else term)
            node = node.left
        return sp.Add(self.read(node, depth + 1), *reversed(terms))

    def _operate(self, operator: str, a: Any, b: Any, node: ast.expr) -> Any:
        if operator == "*":
            self._check_bits(_bits(a) + _bits(b), node)
            return a * b
        if operator == "/":
            if b.is_zero:
                raise self._refuse(self._source(node), "a denominator must not be zero")
            self._check_bits(_bits(a) + _bits(b), node)
            return a / b
        if not b.is_Rational or abs(b) > MAX_EXPONENT:
            raise self._refuse(
                self._source(node),
                f"an exponent must be a rational number of size at most {MAX_EXPONENT}",
            )
        if a.is_zero and b < 0:
            raise self._refuse(self._source(node), "a denominator must not be zero")
        if not b.is_Integer:
            self._check_root(a, node)
        self._check_bits(_bits(a) * max(1, abs(int(b))), node)
        return self._finite(a**b, node)

    def _number(self, node: ast.Constant) -> Any:
        source = (ast.get_source_segment(self.text, node) or "").replace("_", "")
        if isinstance(node.value, bool) or not _NUMBER.fullmatch(source):
            raise self._refuse(repr(node.value), "write decimal numbers such as 2, 0.5 or 1e-3")
        mantissa, _, exponent = source.lower().partition("e")
        if exponent and abs(int(exponent)) > MAX_BITS // 4:
            raise self._refuse(source, f"a number may have at most {MAX_BITS} bits")
        self._check_bits(4 * len(mantissa), node)
        return sp.Rational(source)

    def _name(self, name: str) -> Any:
        if name in self.names:
            return self.names[name]
        if name in CONSTANTS:
            return CONSTANTS[name]
        known = ", ".join([*self.names, *CONSTANTS])
        raise self._refuse(f"the name {name!r}", f"the names here are {known}")

    def _check_bits(self, bits: int, node: ast.expr) -> None:
        if bits > MAX_BITS:
            raise self._refuse(self._source(node), f"a number may have at most {MAX_BITS} bits")

    def _check_root(self, value: Any, node: ast.expr) -> None:
        if _bits(value) > MAX_ROOT_BITS:
            raise self._refuse(
                self._source(node), f"a number under a root may have at most {MAX_ROOT_BITS} bits"
            )

    def _finite(self, value: Any, node: ast.expr) -> Any:
        if value.has(sp.zoo, sp.nan, sp.oo, -sp.oo):
            raise self._refuse(self._source(node), "it has no finite value")
        return value

    def _source(self, node: ast.expr) -> str:
        return _short(ast.get_source_segment(self.text, node) or self.text)

    def _refuse(self, what: str, remedy: str) -> ExpressionError:
        return ExpressionError(
            f"The expression {_short(self.text)} uses {what}, which is not allowed: {remedy}."
        )


def _bits(value: Any) -> int:
    """Return the size of the largest number inside an expression, in bits."""
    return max(
        (int(q.p).bit_length() + int(q.q).bit_length() for q in value.atoms(sp.Rational)),
        default=1,
    )
