"""On which side the normals are: by mesh winding, towards a viewpoint, or consistently."""

from __future__ import annotations

from typing import Any

import numpy as np

from pdtheory.pointset.cloud import FloatArray, IntArray
from pdtheory.pointset.kernels.signs import hand_on
from pdtheory.pointset.trees import kd_tree

#: Neighbours that every point is joined with.
NEIGHBOURS = 10
#: Points whose planes are found together: a fraction of a second of work.
_BATCH = 10_000
#: Weight of the edges between points whose normals are parallel, so that none is zero.
_FLOOR = 1e-6
#: Mean of the vertical components of the normals above which a part is seen from one side only; it
#: is 0 for closed surfaces, and a half for a half sphere.
_ONE_SIDED = 0.55


def winding_normals(points: FloatArray, faces: IntArray) -> FloatArray:
    """Return the sum of the area vectors of the faces around each point, shape (P, 3).

    Points without faces get zero vectors.
    """
    corners = points[faces]
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    result = np.zeros_like(points)
    for column in range(3):
        for axis in range(3):
            result[:, axis] += np.bincount(faces[:, column], area[:, axis], len(points))
    return result


def consistent_normals(points: FloatArray) -> FloatArray:
    """Return unit normals whose signs agree from neighbour to neighbour, shape (P, 3).

    The normals are those of the principal planes of the nearest neighbours. An edge of the
    neighbour graph costs 1 - |n_i . n_j|, so its minimum spanning tree goes where normals turn
    least, and signs are handed on along it (Hoppe et al., Surface reconstruction from unorganized
    points, 1992). In every connected part they start from the point farthest from the middle of the
    part, whose normal is turned away from that middle: outward on a closed surface. A part that is
    seen from above or below only, such as a terrain, has no outside; its normals point to +z.

    Parameters
    ----------
    points : (P, 3) float64
        Finite positions.
    """
    from scipy.sparse import csr_matrix
    from scipy.sparse.csgraph import breadth_first_order, minimum_spanning_tree

    count = len(points)
    nearest, normals = _planes(points, min(NEIGHBOURS + 1, count))
    rows = np.repeat(np.arange(count), nearest.shape[1])
    columns = nearest.ravel()
    cost = 1.0 - np.abs(np.einsum("ij,ij->i", normals[rows], normals[columns])) + _FLOOR
    keep = rows != columns
    graph = csr_matrix((cost[keep], (rows[keep], columns[keep])), shape=(count, count))
    tree = minimum_spanning_tree(graph).tocoo()
    label, starts, outward = _starts(points, normals, graph)
    # One more node joins the starting points of all parts, so that one traversal sees them all.
    tails = np.concatenate([tree.row, np.full(len(starts), count)])
    heads = np.concatenate([tree.col, starts])
    joined = csr_matrix((np.ones(len(tails)), (tails, heads)), shape=(count + 1, count + 1))
    order, parent = breadth_first_order(joined, count, directed=False)
    agree = np.ones(count, np.int8)
    children = order[parent[order] != count][1:]
    along = np.einsum("ij,ij->i", normals[children], normals[parent[children]])
    agree[children] = np.where(along < 0, -1, 1)
    agree[starts] = np.where(outward < 0, -1, 1)
    sign = np.ones(count + 1, np.int8)
    hand_on(order, parent, agree, sign)
    oriented = normals * sign[:count, None]
    upward = np.bincount(label, oriented[:, 2]) / np.bincount(label)
    return np.where(upward[label, None] < -_ONE_SIDED, -oriented, oriented)


def _planes(points: FloatArray, size: int) -> tuple[IntArray, FloatArray]:
    """Return the nearest points of each, (P, size), and the normals of their principal planes.

    In batches, between which an interrupt is seen.
    """
    tree = kd_tree(points)
    nearest = np.empty((len(points), size), np.int64)
    normals = np.empty_like(points)
    for start in range(0, len(points), _BATCH):
        batch = slice(start, start + _BATCH)
        _, found = tree.query(points[batch], k=size)
        nearest[batch] = np.reshape(found, (-1, size))
        local = points[nearest[batch]]
        local = local - local.mean(axis=1, keepdims=True)
        covariance = np.einsum("pki,pkj->pij", local, local)
        normals[batch] = np.linalg.eigh(covariance)[1][:, :, 0]
    return nearest, normals


def _starts(
    points: FloatArray, normals: FloatArray, graph: Any
) -> tuple[IntArray, IntArray, FloatArray]:
    """Return the connected part of each point, and of each part the outermost point.

    The third is how far the normal of that points away from the middle of the part.
    """
    from scipy.sparse.csgraph import connected_components

    parts, found = connected_components(graph, directed=False)
    label = found.astype(np.int64)
    size = np.bincount(label)
    middle = np.column_stack(
        [np.bincount(label, points[:, axis], parts) / size for axis in range(3)]
    )
    away = points - middle[label]
    by_distance = np.lexsort((-np.einsum("ij,ij->i", away, away), label))
    starts = by_distance[np.searchsorted(label[by_distance], np.arange(parts))]
    return label, starts, np.einsum("ij,ij->i", normals[starts], away[starts])
