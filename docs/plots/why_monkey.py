"""A monkey saddle: order 2 has nothing to say, order 3 has three directions."""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt

import synthetic_surfaces
from pdtheory import estimate_directions
from pdtheory.viewer import view_field

surface = synthetic_surfaces.get("monkey")
mesh = surface.mesh(48)
cloud = surface.sample(4_000, method="blue", seed=1)
field = estimate_directions(cloud, radius=0.35, degree=4, orders=(2, 3), orient="normals")
figure, panels = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
with tempfile.TemporaryDirectory() as folder:
    for order, axes in zip((2, 3), panels, strict=True):
        picture = Path(folder) / f"{order}.png"
        view_field(
            field, mesh, orders=[order], strokes=220, size=(620, 520), azimuth=0, elevation=50,
            screenshot=picture,
        )  # fmt: skip
        axes.imshow(plt.imread(picture))
        axes.set_title(f"maxima of order {order}")
        axes.set_axis_off()
