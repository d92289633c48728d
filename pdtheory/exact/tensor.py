"""The tensor face: a symmetric tensor of dimension 2 by its distinct components."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from math import comb
from typing import Any, Self

import numpy as np
import sympy as sp

from pdtheory.errors import InputError
from pdtheory.exact.coefficients import check_order, exact, tidy
from pdtheory.exact.faces import BinaryForm, Face
from pdtheory.exact.zeros import is_zero


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
