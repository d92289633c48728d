"""
One maximum or three
====================

A term of order 3 has one maximum or three. With :math:`\\phi_{3,3} = 1` the answer depends on
:math:`\\phi_{3,1}` alone, and changes on a deltoid. Every dot is counted exactly.
"""

import matplotlib.pyplot as plt
import numpy as np
import sympy

from pdtheory.exact import WavejetsRow, count_maxima
from pdtheory.exact.strata import deltoid

steps = [sympy.Rational(3 * i, 4) for i in range(-13, 14)]
counts = np.array(
    [[count_maxima(WavejetsRow(3, {1: re + sympy.I * im, 3: 1})) for re in steps] for im in steps]
)
figure, axes = plt.subplots(figsize=(4.2, 4.2), layout="constrained")
grid = np.array([float(step) for step in steps])
re, im = np.meshgrid(grid, grid)
for count, colour in ((1, "0.75"), (3, "tab:green")):
    axes.scatter(re[counts == count], im[counts == count], s=9, color=colour, label=f"{count} max")
turn = sympy.Symbol("t", real=True)
curve = sympy.lambdify(turn, deltoid(turn), "numpy")(np.linspace(0, 2 * np.pi, 400))
axes.plot(curve.real, curve.imag, color="black", linewidth=1)
axes.set_aspect("equal")
axes.set_xlabel("real part of $\\phi_{3,1}$")
axes.set_ylabel("imaginary part")
axes.legend(loc="upper left", frameon=False)
