"""KD-trees, imported where one is needed: SciPy takes as long to import as all else together."""

from __future__ import annotations

from typing import Any

from pdtheory.pointset.cloud import FloatArray


def kd_tree(points: FloatArray) -> Any:
    """Return the :class:`scipy.spatial.cKDTree` of (P, 3) points."""
    from scipy.spatial import cKDTree

    return cKDTree(points)
