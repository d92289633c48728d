"""
Your own surface, at a point
============================

A surface given by an equation is expanded over its tangent plane at a rational point, without
rounding, and every order of the expansion has its E-eigenvectors.
"""

import matplotlib.pyplot as plt
import sympy

from pdtheory.exact import implicit_jet, parse_expression
from pdtheory.plots.polar import PolarTerm, polar_figure

variables = sympy.symbols("x y z")
ellipsoid = parse_expression("x**2 + y**2/4 + z**2/9 - 1", variables=("x", "y", "z"))
point = sympy.Rational(1, 3), sympy.Rational(4, 3), 2
jet = implicit_jet(ellipsoid, variables, 4, point)
print("principal curvatures:", *jet.principal_curvatures())
for order in (2, 3, 4):
    for pair in jet.eigenpairs(order):
        angle, value = pair.angle_degrees(12), pair.eigenvalue_float(12)
        print(f"order {order}  {pair.kind.label}  {angle} degrees  lambda {value}")

# %%
# The same as curves. ``of_face`` takes any tensor, binary form or Wavejets row.

polar_figure(
    [PolarTerm.of_face(jet.row(order)) for order in (2, 3, 4)],
    title="ellipsoid",
    figure=plt.figure(),
)
