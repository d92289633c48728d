"""
Hand a field on
===============

A field becomes a pandas table, strokes of trimesh, or a PyVista mesh; and a part of it is a field
again.
"""

import matplotlib.pyplot as plt

import synthetic_surfaces
from pdtheory import estimate_directions
from pdtheory.conventions import order_colour

cloud = synthetic_surfaces.get("ellipsoid").sample(5_000, seed=3)
field = estimate_directions(cloud, neighbours=100, degree=4, orders=(2, 3))
print(field)

table = field.to_dataframe()
print(table.groupby(["order", "kind"])[["strength", "angle_std"]].median())

# %%
# How the strengths are spread:

figure, axes = plt.subplots(figsize=(5, 2.6), layout="constrained")
for order, rows in table[table.kind == 1].groupby("order"):
    axes.hist(rows.strength, bins=60, color=order_colour(order), alpha=0.6, label=f"order {order}")
axes.set_xlabel("strength of the maxima")
axes.legend(frameon=False)

# %%
# Points are chosen by a slice, a mask or indices:

sharp = field.take(field.residual_rms < field.residual_rms.mean())
print(sharp, sharp[3].maxima.vectors)

# %%
# Strokes in the colours of the orders, ready for ``strokes.show()`` or ``strokes.export(...)``:

strokes = sharp.to_trimesh()
print(strokes)

# %%
# In a notebook a point shows its table and its plot:

field.at(10)
