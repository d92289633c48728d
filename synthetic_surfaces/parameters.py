"""Parameters of surfaces: exact values with ranges, from numbers or from text."""

from __future__ import annotations

import re
import reprlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Literal

from pdtheory.errors import InputError

#: Wavejets coefficients by (order k, frequency n), as exact real and imaginary parts.
Table = dict[tuple[int, int], tuple[Fraction, Fraction]]

#: Longest text of a value, and largest power of ten in it: beyond doubles, yet quick to work out.
MAX_LENGTH, MAX_EXPONENT = 10_000, 400

_EXPONENT = re.compile(r"[eE]([+-]?[\d_]+)")
_TABLE_ENTRY = re.compile(r"\s*(\d+)\s*,\s*(\d+)\s*:\s*([^;]+)")
_COMPLEX = re.compile(r"(?P<re>[+-]?[\d./e]+(?![\d./e]*[ij]))?\s*(?:(?P<im>[+-]?\s*[\d./e]*)[ij])?")


@dataclass(frozen=True)
class Parameter:
    """One parameter of a surface.

    Attributes
    ----------
    name : str
        Its name.
    default
        Its value where none is given.
    doc : str
        What it does.
    low, high : float
        The closed range of its values (of each value of a list).
    kind : {"real", "integer", "list", "table"}
        One number, one whole number, several numbers, or Wavejets coefficients.
    """

    name: str
    default: Any
    doc: str
    low: float = float("-inf")
    high: float = float("inf")
    kind: Literal["real", "integer", "list", "table"] = "real"

    @property
    def summary(self) -> str:
        """One line for people: name, default, range and meaning."""
        ends = "" if self.kind == "table" else f", {self.low:g} to {self.high:g}"
        return f"{self.name} ({self.default}{ends}): {self.doc}"

    def read(self, value: Any) -> Any:
        """Return `value` exactly: a Fraction, an int, a tuple of Fractions, or a Table.

        Parameters
        ----------
        value
            A number, or text: ``0.25``, ``1/3``; ``0,60,130`` for a list;
            ``3,3:1/2; 3,1:0.1+2i`` for a table.

        Raises
        ------
        InputError
            If it cannot be read or lies outside the range.
        """
        if isinstance(value, str) and len(value) > MAX_LENGTH:
            raise InputError(
                f"{self.name} has {len(value)} characters; at most {MAX_LENGTH} are read."
            )
        if self.kind == "table":
            return self._table(value)
        if self.kind == "list":
            parts = value.split(",") if isinstance(value, str) else value
            if not isinstance(parts, Iterable):
                parts = [parts]
            return tuple(self._number(part) for part in parts)
        number = self._number(value)
        if self.kind == "integer":
            if number.denominator != 1:
                raise InputError(f"{self.name} = {value}; give a whole number.")
            return int(number)
        return number

    def _number(self, value: Any) -> Fraction:
        number = _exact(value)
        if number is None:
            raise InputError(
                f"{self.name} = {reprlib.repr(value)} cannot be read as a number; {self._hint()}."
            )
        if not self.low <= number <= self.high:
            raise InputError(f"{self.name} = {value} is out of range; {self._hint()}.")
        return number

    def _hint(self) -> str:
        return f"give one between {self.low:g} and {self.high:g}, such as {self.default}"

    def _table(self, value: Any) -> Table:
        if isinstance(value, str):
            entries: dict[Any, Any] = {}
            for part in filter(str.strip, value.split(";")):
                match = _TABLE_ENTRY.fullmatch(part)
                if match is None:
                    raise InputError(
                        f"{self.name}: cannot read {reprlib.repr(part.strip())}; write k,n:value "
                        "entries separated by semicolons, such as 3,3:1/2; 3,1:0.1+2i."
                    )
                entries[int(match[1]), int(match[2])] = match[3]
            value = entries
        if not isinstance(value, Mapping) or not value:
            raise InputError(f"{self.name} is empty; give at least one coefficient, as 3,3:1/2.")
        table: Table = {}
        for (order, frequency), entry in value.items():
            if not 0 <= frequency <= order <= self.high or (order - frequency) % 2:
                raise InputError(
                    f"{self.name}: there is no coefficient of order {order} and frequency "
                    f"{frequency}; n has the parity of k and 0 <= n <= k <= {self.high:g}."
                )
            parts = _exact_complex(entry)
            if parts is None:
                raise InputError(
                    f"{self.name}: {reprlib.repr(entry)} cannot be read as a number; "
                    "write it as 1/2 or 0.1+2i."
                )
            if frequency == 0 and parts[1] != 0:
                raise InputError(f"{self.name}: the coefficient {order},0 must be real.")
            table[order, frequency] = parts
        return table


#: The parameters of a surface.
Parameters = tuple[Parameter, ...]


def _exact(value: Any) -> Fraction | None:
    """Return a number or its text as a fraction; decimals mean what they say."""
    try:
        if isinstance(value, float):
            return Fraction(repr(float(value)))
        if isinstance(value, str):
            exponent = _EXPONENT.search(value)
            if exponent is not None and abs(int(exponent[1])) > MAX_EXPONENT:
                return None
            return Fraction(value.strip())
        return Fraction(value)
    except (ValueError, TypeError, ZeroDivisionError, OverflowError):
        return None


def _exact_complex(value: Any) -> tuple[Fraction, Fraction] | None:
    if isinstance(value, tuple) and len(value) == 2:
        real, imaginary = _exact(value[0]), _exact(value[1])
    elif isinstance(value, complex):
        real, imaginary = _exact(value.real), _exact(value.imag)
    elif isinstance(value, str):
        match = _COMPLEX.fullmatch(value.strip())
        if match is None or (match["re"] is None and match["im"] is None):
            return None
        imaginary_text = None if match["im"] is None else match["im"].replace(" ", "")
        if imaginary_text in ("", "+", "-"):
            imaginary_text += "1"
        real = _exact(match["re"] or 0)
        imaginary = _exact(imaginary_text or 0)
    else:
        real, imaginary = _exact(value), Fraction(0)
    return None if real is None or imaginary is None else (real, imaginary)
