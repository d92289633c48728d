"""The input of the sampled side: points, with normals and triangles where they are known."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from pdtheory.errors import InputError

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]


@dataclass(frozen=True)
class PointCloud:
    """Points in space, in the units of their source.

    Attributes
    ----------
    points : (P, 3) float64
        Positions.
    normals : (P, 3) float64 or None
        Unit normals that fix the side of the surface from which heights are counted.
    faces : (F, 3) int64 or None
        Triangles as indices of points, if the source was a mesh.
    name : str
        Where the points come from, for messages.

    Raises
    ------
    InputError
        If a shape is wrong or a face names a point that does not exist.
    """

    points: FloatArray
    normals: FloatArray | None = None
    faces: IntArray | None = None
    name: str = "points"

    def __post_init__(self) -> None:
        count = len(self.points)
        if self.points.ndim != 2 or self.points.shape[1] != 3:
            raise InputError(f"{self.name}: points have shape {self.points.shape}; give (P, 3).")
        if self.normals is not None and self.normals.shape != self.points.shape:
            raise InputError(
                f"{self.name}: {self.normals.shape[0]} normals for {count} points; "
                "give one normal for each point."
            )
        if self.faces is not None:
            if self.faces.ndim != 2 or self.faces.shape[1] != 3:
                raise InputError(f"{self.name}: faces have shape {self.faces.shape}; give (F, 3).")
            if self.faces.size and not 0 <= int(self.faces.min()) <= int(self.faces.max()) < count:
                raise InputError(
                    f"{self.name}: a face names a point outside 0..{count - 1}; repair the mesh."
                )

    def __len__(self) -> int:
        return len(self.points)

    @property
    def diagonal(self) -> float:
        """Length of the diagonal of the bounding box of the finite points (0 for none)."""
        finite = self.points[np.isfinite(self.points).all(axis=1)]
        if not len(finite):
            return 0.0
        return float(np.linalg.norm(finite.max(axis=0) - finite.min(axis=0)))
