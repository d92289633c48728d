"""Surfaces whose differential quantities are known in closed form, sampled at random."""

from __future__ import annotations

import numpy as np

from pdtheory.conventions import frequencies


def disc(count, radius, seed, inner=True):
    """Uniform points in a disc, the first at the centre if `inner`."""
    rng = np.random.default_rng(seed)
    r = radius * np.sqrt(rng.random(count))
    t = 2 * np.pi * rng.random(count)
    xy = np.column_stack([r * np.cos(t), r * np.sin(t)])
    if inner:
        xy[0] = 0.0
    return xy


def polynomial(degree, seed, size=0.3):
    """Random coefficients {(a, b): c} of x^a y^b, without constant and linear terms."""
    rng = np.random.default_rng(seed)
    return {
        (d - b, b): size * rng.normal() / d**2 for d in range(2, degree + 1) for b in range(d + 1)
    }


def evaluate(coefficients, x, y):
    """Value of the polynomial."""
    return sum(c * x**a * y**b for (a, b), c in coefficients.items())


def wavejets(coefficients, degree):
    """phi_{k,n} by the Fourier integral of each homogeneous part, summed over 64 angles."""
    theta = 2 * np.pi * np.arange(64) / 64
    phi = {}
    for k in range(degree + 1):
        part = sum(
            c * np.cos(theta) ** a * np.sin(theta) ** b
            for (a, b), c in coefficients.items()
            if a + b == k
        )
        for n in frequencies(k):
            phi[k, n] = np.mean(part * np.exp(-1j * n * theta))
    return phi


def rotation(seed):
    """A random rotation matrix."""
    q, r = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    if np.linalg.det(q) < 0:
        q[:, 0] = -q[:, 0]
    return q


def torus(count, big, small, seed):
    """Points uniform by area on a torus about z, outward normals, and the two circle directions.

    The principal curvatures with respect to the outward normal are -1/small along the meridian and
    -cos(v) / (big + small cos(v)) along the parallel.
    """
    rng = np.random.default_rng(seed)
    v = np.empty(0)
    while len(v) < count:
        trial = 2 * np.pi * rng.random(count)
        keep = rng.random(count) < (big + small * np.cos(trial)) / (big + small)
        v = np.concatenate([v, trial[keep]])
    v = v[:count]
    u = 2 * np.pi * rng.random(count)
    points = np.column_stack(
        [
            (big + small * np.cos(v)) * np.cos(u),
            (big + small * np.cos(v)) * np.sin(u),
            small * np.sin(v),
        ]
    )
    normals = np.column_stack([np.cos(v) * np.cos(u), np.cos(v) * np.sin(u), np.sin(v)])
    meridian = np.column_stack([-np.sin(v) * np.cos(u), -np.sin(v) * np.sin(u), np.cos(v)])
    parallel = np.column_stack([-np.sin(u), np.cos(u), np.zeros(count)])
    curvatures = np.column_stack(
        [np.full(count, -1 / small), -np.cos(v) / (big + small * np.cos(v))]
    )
    return points, normals, meridian, parallel, curvatures
