"""
Noise, degree and error bars
============================

A high degree follows the surface more closely and lets more noise through. The error bars say
how much: here the median of those of order 2 and 3 against the degree, on a noisy torus.
"""

import matplotlib.pyplot as plt
import numpy as np

import synthetic_surfaces
from pdtheory import estimate_directions
from pdtheory.conventions import order_colour

cloud = synthetic_surfaces.get("torus").sample(20_000, noise=0.1, seed=4)
some = np.arange(0, len(cloud), 50)
degrees = range(3, 11)
figure, axes = plt.subplots(figsize=(5, 3.2), layout="constrained")
medians = {2: [], 3: []}
for degree in degrees:
    field = estimate_directions(cloud, queries=some, neighbours=300, degree=degree)
    for order, values in medians.items():
        values.append(np.degrees(np.median(field[order].angle_std)))
for order, values in medians.items():
    axes.semilogy(degrees, values, "o-", color=order_colour(order), label=f"order {order}")
axes.set_xlabel("degree K of the regression")
axes.set_ylabel("median standard deviation (degrees)")
axes.legend(frameon=False)

# %%
# Choose the lowest degree that describes the surface, not the highest that can be afforded.
