"""The options of an estimation, which are the same wherever the results go."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from typing import Any, Literal, TypedDict, TypeVar

import numpy.typing as npt

from pdtheory.pointset.pool import Progress

Orient = Literal["auto", "normals", "winding", "propagate", "none"]
F = TypeVar("F", bound=Callable[..., Any])


class Options(TypedDict, total=False):
    """Keywords of :func:`pdtheory.pointset.estimate_directions`, which explains them.

    Their defaults stand in :func:`pdtheory.pointset.prepare.prepare`.
    """

    radius: float | Sequence[float] | Literal["auto"] | None
    neighbours: int | None
    radius_relative: float | None
    degree: int | Literal["auto"]
    orders: Sequence[int]
    norm: Literal["l2", "l1"]
    normals: npt.ArrayLike | None
    queries: npt.ArrayLike | None
    orient: Orient | npt.ArrayLike
    frame: Literal["tangent", "principal", "given"]
    weight_distance: Literal["3d", "planar"]
    uncertainty: bool
    non_finite: Literal["refuse", "drop"]
    threads: int | None
    progress: Progress | None


def shows_options_of(source: Callable[..., Any]) -> Callable[[F], F]:
    """Let help and completion show the keywords of `source` in place of ``**options``."""

    def decorate(function: F) -> F:
        own = inspect.signature(function)
        known = [p for p in own.parameters.values() if p.kind is not p.VAR_KEYWORD]
        names = {p.name for p in known}
        more = inspect.signature(source).parameters.values()
        known += [p for p in more if p.kind is p.KEYWORD_ONLY and p.name not in names]
        function.__signature__ = own.replace(parameters=known)  # type: ignore[attr-defined]
        return function

    return decorate
