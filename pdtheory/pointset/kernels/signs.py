"""Signs handed on from parent to child in a tree."""

from __future__ import annotations

from typing import Any

from pdtheory.pointset.kernels.jit import kernel


@kernel
def hand_on(order: Any, parent: Any, agree: Any, sign: Any) -> None:
    """Set the sign of each node to that of its parent, or the opposite.

    Parameters
    ----------
    order : (n,) int32
        Nodes, parents before children; the root, whose sign is set, comes first.
    parent : (P,) int32
        Parent of each node.
    agree : (P,) int8
        +1 or -1: sign of a node as a multiple of its parent's.
    sign : (P,) int8
        Receives the signs.
    """
    for i in range(1, len(order)):
        node = order[i]
        sign[node] = agree[node] * sign[parent[node]]
