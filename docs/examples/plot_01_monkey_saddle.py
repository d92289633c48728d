"""
One formula, exactly
====================

The monkey saddle :math:`z = x^3 - 3 x y^2` has no curvature at the origin: order 2 says nothing
there. Its term of order 3 has three maxima and three minima, 60 degrees apart, and they are found
as exact numbers.
"""

import matplotlib.pyplot as plt
import sympy

from pdtheory import differential_tensor, real_eigenpairs
from pdtheory.plots.polar import PolarTerm, polar_figure

x, y = sympy.symbols("x y")
monkey = x**3 - 3 * x * y**2
T2, T3 = (differential_tensor(monkey, (x, y), order) for order in (2, 3))
print("order 2:", real_eigenpairs(T2).status)
for pair in real_eigenpairs(T3):
    print(pair.angle_degrees(20), pair.vector, pair.eigenvalue, pair.kind.label)

# %%
# The curve is :math:`g_3(\theta) = T_3 v^3 / 3!` around the dashed circle of height 0. Thick rays
# end in maxima, thin ones in minima.

polar_figure([PolarTerm.of_face(T3)], title="monkey saddle", figure=plt.figure())
