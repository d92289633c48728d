"""A smooth T-junction: order 3 points along the three branches."""

import matplotlib.pyplot as plt
import numpy as np

import synthetic_surfaces
from pdtheory import estimate_directions
from pdtheory.plots.polar import polar_figure

surface = synthetic_surfaces.get("smooth-t-junction")
cloud = surface.sample(20_000, seed=1)
field = estimate_directions(
    cloud, queries=np.zeros((1, 3)), radius=0.6, degree=6, orders=(2, 3, 4, 5), orient="normals"
)
polar_figure(field.at(0).polar_terms(), figure=plt.figure())
