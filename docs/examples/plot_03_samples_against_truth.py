"""
Samples against the truth
=========================

A torus is sampled without noise, and the directions that the regression finds are compared with
the exact ones at a point where these are known.
"""

import matplotlib.pyplot as plt
import numpy as np

import synthetic_surfaces
from pdtheory import estimate_directions
from pdtheory.plots.polar import polar_figure

torus = synthetic_surfaces.get("torus", major=1, minor="2/5")
site = torus.sites()[0]
jet = site.jet(degree=4)
point = np.array([[float(c) for c in jet.point]])

cloud = torus.sample(20_000, seed=1)
field = estimate_directions(cloud, queries=point, radius=0.2, degree=8, orders=(2, 3, 4))
print(field.at(0))

# %%
# Every exact direction, as a vector in space, and the nearest estimate of its kind:

frame = np.array([[float(c) for c in row] for row in jet.frame])
for order in field.orders:
    rows = field[order]
    pairs = jet.eigenpairs(order)
    if pairs.status != "ok":
        print(f"order {order} is {pairs.status}: every direction is an E-eigenvector")
    for pair in pairs:
        exact = np.array([float(c) for c in pair.vector]) @ frame[:2]
        same = rows.vector[rows.kind == pair.kind]
        error = np.degrees(2 * np.arcsin(np.linalg.norm(same - exact, axis=1).min() / 2))
        print(f"order {order}  {pair.kind.label}  off by {error:.1e} degrees")

# %%
# The estimate in polar form. What it says of order 3 is noise of the fit: see the strength.

polar_figure(field.at(0).polar_terms(), figure=plt.figure())
