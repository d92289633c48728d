"""The edges and corners of a cube: order 2 sees the edges, order 3 the corners."""

import itertools
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import synthetic_surfaces
from pdtheory import estimate_directions
from pdtheory.viewer import view_field

cube = synthetic_surfaces.get("cube")
half = float(np.abs(cube.mesh(2).points).max())
ends = np.array(list(itertools.product((-half, half), repeat=3)))
middles = [
    (a + b) / 2 + t * (b - a)
    for a, b in itertools.combinations(ends, 2)
    if np.count_nonzero(a - b) == 1
    for t in (-0.2, 0.0, 0.2)
]
cloud = cube.sample(60_000, seed=1)
field = estimate_directions(
    cloud,
    queries=np.concatenate([ends, middles]),
    radius=0.5 * half,
    degree=6,
    orders=(2, 3),
    frame="principal",
)
figure, panels = plt.subplots(1, 2, figsize=(9, 3.9), layout="constrained")
with tempfile.TemporaryDirectory() as folder:
    for order, kind, axes in zip((2, 3), ("min", "max"), panels, strict=True):
        picture = Path(folder) / f"{order}.png"
        view_field(
            field, cube.mesh(2), orders=[order], kind=kind, least_strength=1.0,
            size=(560, 500), elevation=30, screenshot=picture,
        )  # fmt: skip
        axes.imshow(plt.imread(picture))
        axes.set_title(f"{kind}ima of order {order}")
        axes.set_axis_off()
