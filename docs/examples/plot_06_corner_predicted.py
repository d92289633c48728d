"""
What a regression finds at a corner
===================================

At the corner of a cube no derivative exists, and yet the weighted fit has a limit as the samples
get dense. It is known exactly, and so are its directions.
"""

import matplotlib.pyplot as plt
import numpy as np

import synthetic_surfaces
from pdtheory import estimate_directions
from pdtheory.exact import Cone, predict
from pdtheory.plots.polar import PolarTerm, polar_figure

prediction = predict(Cone.corner(), degree=6, orders=(3, 6))
for order in prediction.orders:
    print("order", order, [str(p.angle_degrees(6)) for p in prediction.eigenpairs(order).maxima])

# %%
# The same from samples of a real corner. The prediction is made for weights that depend on the
# distance in the plane.

corner = synthetic_surfaces.get("corner")
site = corner.sites()[0]
apex = np.array([[float(c) for c in site.place]])
cloud = corner.sample(60_000, method="grid")
field = estimate_directions(
    cloud, queries=apex, radius=0.5, degree=6, orders=(3, 6),
    frame="given", weight_distance="planar",
    normals=np.tile([0.0, 0.0, 1.0], (len(cloud), 1)),
)  # fmt: skip
print(field.at(0))

# %%
# Exact above, sampled below.

polar_figure(
    [PolarTerm.of_face(prediction.row(order)) for order in (3, 6)],
    title="predicted",
    figure=plt.figure(),
)

# %%

field.at(0)
