"""The same point of a torus with growing noise: the error bars grow with it."""

import matplotlib.pyplot as plt
import numpy as np

import synthetic_surfaces
from pdtheory import estimate_directions
from pdtheory.plots.polar import polar_figure

torus = synthetic_surfaces.get("torus")
terms = []
for noise in (0.0, 0.05, 0.2):
    cloud = torus.sample(20_000, noise=noise, seed=8)
    field = estimate_directions(
        cloud, queries=np.array([[1.2, 0.0, 0.35]]), radius=0.3, degree=6, orders=(3,)
    )
    terms += field.at(0).polar_terms()
figure = polar_figure(terms, figure=plt.figure())
for axes, name in zip(figure.axes, ("no noise", "0.05 %", "0.2 %"), strict=True):
    axes.text(0.5, 0.0, name, transform=axes.transAxes, ha="center", fontsize=8)
