"""Texts of expressions that may be far too long to be written."""

from __future__ import annotations

from typing import Any

import sympy as sp


def size_of(value: Any, most: int) -> int:
    """Return the number of nodes of an expression; any number above `most` if there are more."""
    stack, count = [value], 0
    while stack and count <= most:
        count += 1
        stack.extend(stack.pop().args)
    return count


def text_within(value: Any, length: int) -> str:
    """Return the text of an expression, empty if it is longer than `length` characters.

    A long expression is not written at all: SymPy sorts its terms, which takes seconds.
    """
    # Every leaf is a character or more, and a tree has fewer than twice as many nodes as leaves.
    if size_of(value, 2 * length) > 2 * length:
        return ""
    text = str(sp.sstr(value))
    return text if len(text) <= length else ""
