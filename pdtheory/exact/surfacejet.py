"""The jet of a surface: its height over the tangent plane with the frame it refers to."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
import sympy as sp

from pdtheory.conventions import wavejets_table
from pdtheory.errors import InputError
from pdtheory.exact.coefficients import tidy
from pdtheory.exact.enclosing import nearest_double
from pdtheory.exact.faces import BinaryForm
from pdtheory.exact.frames import Vector
from pdtheory.exact.tensor import SymmetricTensor
from pdtheory.exact.wavejets import WavejetsRow

if TYPE_CHECKING:
    from pdtheory.exact.eigenpairs import EigenPairs


@dataclass(frozen=True)
class SurfaceJet:
    """A surface near a point as z(s, t) = sum_k T_k (s, t)^k / k! over its tangent plane.

    Attributes
    ----------
    point : tuple of 3
        The point, exact.
    frame : tuple of 3 tuples of 3
        Rows t1, t2, n, orthonormal and right-handed, exact; s runs along t1, t along t2, z along n.
    forms : tuple of BinaryForm
        T_k v^k for k = 0 to K; those of orders 0 and 1 vanish.
    """

    point: Vector
    frame: tuple[Vector, Vector, Vector]
    forms: tuple[BinaryForm, ...]

    @property
    def degree(self) -> int:
        """The degree K of the jet."""
        return len(self.forms) - 1

    def form(self, order: int) -> BinaryForm:
        """Return the binary form T_k v^k."""
        if not 0 <= order <= self.degree:
            raise InputError(f"The order is {order}; this jet knows the orders 0 to {self.degree}.")
        return self.forms[order]

    def tensor(self, order: int) -> SymmetricTensor:
        """Return the differential tensor T_k of the height function."""
        return self.form(order).tensor

    def row(self, order: int) -> WavejetsRow:
        """Return the Wavejets row of order k."""
        return self.form(order).row

    def eigenpairs(self, order: int) -> EigenPairs:
        """Return the principal directions of order k with their eigenvalues."""
        return self.form(order).eigenpairs()

    @cached_property
    def wavejets(self) -> dict[tuple[int, int], Any]:
        """The exact coefficients phi_{k,n} by (k, n), in storage order."""
        return {(k, n): self.row(k)[n] for k, n in wavejets_table(self.degree)}

    def principal_curvatures(self) -> tuple[Any, Any]:
        """Return the two principal curvatures with respect to n, the larger first, exactly."""
        a, b, c = self.tensor(2).components
        middle, spread = (a + c) / 2, sp.sqrt(tidy(((a - c) / 2) ** 2 + b**2))
        return tidy(middle + spread), tidy(middle - spread)

    def numeric_phi(self) -> npt.NDArray[np.complex128]:
        """Return phi as a (C,) complex array in the storage order of `wavejets_table`."""
        rows = {k: self.row(k).to_complex() for k in range(self.degree + 1)}
        return np.array([rows[k][n] for k, n in wavejets_table(self.degree)])

    def numeric_frame(self) -> npt.NDArray[np.float64]:
        """Return the frame as a (3, 3) array with rows t1, t2, n."""
        return np.array([[nearest_double(c) for c in row] for row in self.frame])
