"""
Edges and corners of a cube
===========================

Order 2 runs along the edges and has no direction of its own at the corners. Order 3 vanishes right
on an edge, where a cube is symmetric; beside it and at the corners it is strong.

The error bars are ignored here: next to a sharp edge no polynomial describes a cube, and the
residuals that they come from are not noise.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt

import synthetic_surfaces
from pdtheory import estimate_directions
from pdtheory.viewer import view_field

cube = synthetic_surfaces.get("cube")
mesh = cube.mesh(40)
field = estimate_directions(mesh, radius=0.35, degree=6, orders=(2, 3))
figure, panels = plt.subplots(1, 2, figsize=(9, 4), layout="constrained")
with tempfile.TemporaryDirectory() as folder:
    for order, axes in zip((2, 3), panels, strict=True):
        picture = Path(folder) / f"{order}.png"
        view_field(
            field, mesh, orders=[order], least_strength=0.02, largest_uncertainty=3.2,
            strokes=900, size=(560, 500), screenshot=picture,
        )  # fmt: skip
        axes.imshow(plt.imread(picture))
        axes.set_title(f"order {order}, strength above 0.02")
        axes.set_axis_off()
