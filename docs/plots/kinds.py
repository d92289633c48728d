"""Maxima, minima, an inflection, and a constant: all that a direction can be."""

import matplotlib.pyplot as plt

from pdtheory.exact import BinaryForm
from pdtheory.plots.polar import PolarTerm, polar_figure

forms = [
    BinaryForm([1, 0, -3, 0]),
    BinaryForm([0, 0, 0, 1]),
    BinaryForm([1, 0, 1]),
]
polar_figure([PolarTerm.of_face(form) for form in forms], figure=plt.figure())
