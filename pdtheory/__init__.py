"""Principal directions of arbitrary order on surfaces: their exact theory and their computation.

The names below are loaded on first use, so that ``import pdtheory`` stays quick.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pdtheory.exact import BinaryForm as BinaryForm
    from pdtheory.exact import SymmetricTensor as SymmetricTensor
    from pdtheory.exact import WavejetsRow as WavejetsRow
    from pdtheory.exact import differential_tensor as differential_tensor
    from pdtheory.exact import real_eigenpairs as real_eigenpairs
    from pdtheory.io import read_cloud as read_cloud
    from pdtheory.io import write_field as write_field
    from pdtheory.pointset import DirectionField as DirectionField
    from pdtheory.pointset import PointCloud as PointCloud
    from pdtheory.pointset import estimate_directions as estimate_directions

__version__ = "0.1.0"

_HOME = {
    "BinaryForm": "pdtheory.exact",
    "SymmetricTensor": "pdtheory.exact",
    "WavejetsRow": "pdtheory.exact",
    "differential_tensor": "pdtheory.exact",
    "real_eigenpairs": "pdtheory.exact",
    "read_cloud": "pdtheory.io",
    "write_field": "pdtheory.io",
    "DirectionField": "pdtheory.pointset",
    "PointCloud": "pdtheory.pointset",
    "estimate_directions": "pdtheory.pointset",
}
__all__ = ["__version__", *sorted(_HOME)]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'pdtheory' has no attribute {name!r}")
    return getattr(import_module(_HOME[name]), name)


def __dir__() -> list[str]:
    return list(__all__)
