"""
Outliers and the l1 norm
========================

One point in twenty lies anywhere in the bounding box, and the others are noisy. A least squares
fit is pulled away; the l1 norm notices less of it, and takes several times as long.
"""

import matplotlib.pyplot as plt
import numpy as np

import synthetic_surfaces
from pdtheory import estimate_directions

torus = synthetic_surfaces.get("torus")
clean = torus.sample(8_000, seed=2)
cloud = torus.sample(8_000, seed=2, noise=0.1, outliers=0.05)
moved = np.linalg.norm(clean.points - cloud.points, axis=1)
some = np.flatnonzero(moved < 0.02)[:400]  # no outliers themselves
options = {"radius": 0.4, "degree": 4, "orders": (2,), "queries": some, "normals": clean.normals}
truth = estimate_directions(clean, **options)[2].maxima
figure, axes = plt.subplots(figsize=(5, 3), layout="constrained")
for norm in ("l2", "l1"):
    found = estimate_directions(cloud, norm=norm, **options)[2].maxima
    errors = [
        np.degrees(np.arccos(np.clip(there @ here.T, -1, 1).max(axis=1))).max()
        for there, here in zip(truth.vectors, found.vectors, strict=True)
        if len(there) and len(here)
    ]
    axes.plot(np.sort(errors), np.linspace(0, 1, len(errors)), label=norm)
axes.set_xscale("log")
axes.set_xlabel("change of the direction by noise and outliers (degrees)")
axes.set_ylabel("share of points")
axes.legend(frameon=False)
