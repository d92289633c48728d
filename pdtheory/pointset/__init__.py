"""Estimation of directions on point sets.

The names below are loaded on first use: reading a field needs no compiler.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pdtheory.pointset.cloud import PointCloud as PointCloud
    from pdtheory.pointset.directions import OrderDirections as OrderDirections
    from pdtheory.pointset.estimate import estimate_directions as estimate_directions
    from pdtheory.pointset.field import DirectionField as DirectionField
    from pdtheory.pointset.parts import load_parts as load_parts
    from pdtheory.pointset.parts import load_points as load_points
    from pdtheory.pointset.stream import estimate_to_disk as estimate_to_disk

_HOME = {
    "DirectionField": "field",
    "OrderDirections": "directions",
    "PointCloud": "cloud",
    "estimate_directions": "estimate",
    "estimate_to_disk": "stream",
    "load_parts": "parts",
    "load_points": "parts",
}
__all__ = sorted(_HOME)


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOME[name]}"), name)


def __dir__() -> list[str]:
    return list(__all__)
