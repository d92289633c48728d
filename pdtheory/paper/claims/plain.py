"""The mathematics of a claim for a terminal: LaTeX in plain characters."""

from __future__ import annotations

import re
from typing import Final

#: Commands by what is printed for them; any other one is printed by its name.
_WORDS: Final = {
    "neq": "!=",
    "leq": "<=",
    "geq": ">=",
    "pm": "+-",
    "mp": "-+",
    "cdot": "*",
    "cdots": "...",
    "dots": "...",
    "to": "->",
    "mapsto": "->",
    "Leftrightarrow": "<=>",
    "sim": "~",
    "propto": "~",
    "notin": "not in",
    "bmod": "mod",
    "partial": "d",
    "nabla": "grad",
    "varepsilon": "epsilon",
    "|": "|",
}
#: Commands whose argument stands for itself.
_FONTS: Final = ("mathrm", "mathbb", "text")
#: Functions of an argument in braces.
_FUNCTIONS: Final = {"sqrt": "sqrt", "overline": "conj", "bar": "conj"}
#: Commands of two arguments.
_PAIRS: Final = {"frac": "{}/{}", "tfrac": "{}/{}", "binom": "binomial({}, {})"}

_TOKEN: Final = re.compile(r"\\([A-Za-z]+)|\\(.)|(.)", re.DOTALL)
#: What needs no parentheses in a quotient or an exponent.
_ATOM: Final = re.compile(r"-?\w+(_\{[^{}]*\})?|\w+\([^()]*\)")


def plain_text(text: str) -> str:
    """Return a text with its formulas, between dollar signs, in plain characters."""
    pieces = text.split("$")
    return "".join(_Formula(p).read() if i % 2 else p for i, p in enumerate(pieces))


class _Formula:
    """A formula that is read from left to right."""

    def __init__(self, source: str) -> None:
        self.tokens = [m.groups() for m in _TOKEN.finditer(source)]
        self.at = 0

    def read(self) -> str:
        """Return the plain text up to the end, or to the brace that closes the group."""
        text = ""
        while self.at < len(self.tokens):
            if self.tokens[self.at][2] == "}":
                break
            if self.tokens[self.at][2] in ("^", "_"):
                text += self._script()
                continue
            follows_name = self.at > 0 and bool(self.tokens[self.at - 1][0])
            is_command = self.tokens[self.at][2] is None
            piece = self._next()
            # A name must not run into what was set apart by its backslash.
            before, after = text[-1:], piece[:1]
            if (is_command and before.isalnum() and after.isalpha()) or (
                follows_name and before.isalpha() and (is_command or after.isalnum())
            ):
                text += " "
            text += piece
        return re.sub(" +", " ", text)

    def _script(self) -> str:
        mark = self.tokens[self.at][2]
        self.at += 1
        script = self._argument()
        if script == "circ":
            return " degrees"
        if mark == "^":
            return f"^{_as_factor(script)}"
        return f"_{script}" if len(script) == 1 else f"_{{{script}}}"

    def _next(self) -> str:
        word, symbol, character = self.tokens[self.at]
        self.at += 1
        if character == "{":
            inside = self.read()
            self.at += 1
            return inside
        if character is not None:
            return character
        if symbol is not None:
            return " " if symbol in ",; " else _WORDS.get(symbol, symbol)
        if word in _FONTS:
            return self._argument()
        if word in _FUNCTIONS:
            return f"{_FUNCTIONS[word]}({self._argument()})"
        if word in _PAIRS:
            pair = [self._argument(), self._argument()]
            return _PAIRS[word].format(*(pair if word == "binom" else map(_as_factor, pair)))
        return _WORDS.get(word, word)

    def _argument(self) -> str:
        while self.at < len(self.tokens) and self.tokens[self.at][2] == " ":
            self.at += 1
        return self._next().strip() if self.at < len(self.tokens) else ""


def _as_factor(text: str) -> str:
    return text if _ATOM.fullmatch(text) else f"({text})"
