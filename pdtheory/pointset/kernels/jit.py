"""How the kernels are compiled and where their machine code is kept."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

import numba
import numpy as np
import numpy.typing as npt

from pdtheory.pointset.kernels.linking import Part, Pipeline, Whole, compile_as

Array = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]
F = TypeVar("F", bound=Callable[..., Any])

# Sums may be reordered and contracted, which lets them run in vector registers. NaN and infinity
# keep their meaning, because the kernels test for them.
_FAST = {"reassoc", "contract", "arcp", "nsz"}


@cache
def _source_stamp() -> tuple[float, int]:
    """Return a stamp that changes when any kernel source changes."""
    files = [path.stat() for path in Path(__file__).parent.glob("*.py")]
    return max(stat.st_mtime for stat in files), sum(stat.st_size for stat in files)


def _compile(function: F, **extra: Any) -> F:
    options: dict[str, Any] = {
        "nogil": True,
        "fastmath": _FAST,
        "error_model": "numpy",
        "pipeline_class": Pipeline,
        # Kernels make no arrays, so no references need to be counted.
        "_nrt": False,
        **extra,
    }
    try:
        compiled = numba.njit(**{"cache": True, **options})(function)
    except RuntimeError:
        return numba.njit(**options)(function)
    file: Any = getattr(compiled._cache, "_cache_file", None)
    if hasattr(file, "_source_stamp"):
        file._source_stamp = _source_stamp()
    return compiled


def kernel(function: F) -> F:
    """Compile a function that Python calls: no interpreter lock, cached on disk where possible.

    Numba keeps the machine code beside the source, or in the user's cache folder where the package
    cannot be written to; where neither can be, the code is compiled anew in each process. A kernel
    calls kernels of other modules, so its cache is tied to the sources of all of them.
    """
    # Nor does anybody call it from C.
    return compile_as(Whole, _compile(function, no_cfunc_wrapper=True))


def inner(function: F) -> F:
    """Compile a function that only kernels call, without the wrappers that Python would need."""
    part = _compile(function, no_cpython_wrapper=True, no_cfunc_wrapper=True, cache=False)
    return compile_as(Part, part)
