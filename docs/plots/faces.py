"""One term of each order, in polar form."""

import matplotlib.pyplot as plt
import sympy

from pdtheory.exact import BinaryForm
from pdtheory.plots.polar import PolarTerm, polar_figure

forms = [
    BinaryForm([1, 0, -1]),
    BinaryForm([1, 0, -3, 0]),
    BinaryForm([1, 0, -6, 0, 1]),
    BinaryForm([1, 0, 0, 0, 0, sympy.Rational(1, 2)]),
]
polar_figure([PolarTerm.of_face(form) for form in forms], figure=plt.figure())
