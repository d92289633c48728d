"""
A surface with given directions
===============================

Which angles can be the maxima of a term of order k? The answer is a theorem, and it comes with a
term that has them, or with the reason why there is none.
"""

import matplotlib.pyplot as plt

from pdtheory.exact import realize_maxima
from pdtheory.plots.polar import PolarTerm, polar_figure

wanted = realize_maxima(5, [0, 60, 150, 210, 270])
print(wanted.is_realizable, "-", wanted.reason)
print(wanted.row)

# %%
# The row that was found, with its maxima where they were asked for:

polar_figure([PolarTerm.of_face(wanted.row)], figure=plt.figure())

# %%
# Two opposite maxima cannot be had with an odd order:

refused = realize_maxima(3, [0, 90, 180])
print(refused.is_realizable, "-", refused.reason)
