"""Smooth junctions of ridges."""

from __future__ import annotations

import numpy as np

from pdtheory.pointset.cloud import FloatArray
from synthetic_surfaces.cones import SLOPE
from synthetic_surfaces.description import Description
from synthetic_surfaces.height import EXTENT, HeightSurface
from synthetic_surfaces.parameters import Parameter

#: A value with its two partial derivatives.
_Jet = tuple[FloatArray, FloatArray, FloatArray]


class RidgeToJunction(HeightSurface):
    """A ridge along x from which a branch along +y grows with `step`.

    z = height (A + step B (1 - A)) with the ridge A = exp(-(y/w)^2) and the branch
    B = exp(-(x/w)^2) (1 + tanh(y/w)) / 2. At the origin the gradient vanishes, g_2 is
    -height (1 - step/2) (y/w)^2 and g_3 is height step (y/w)^3 / 2: it grows with the branch.
    """

    name = "ridge-to-junction"
    summary = "ridge along x evolving to a smooth T-junction with a branch along +y"
    parameters = (
        Parameter("step", 1, "0 is the ridge, 1 the T-junction", 0, 1),
        Parameter("width", "1/4", "width of the ridges", 1e-6, 1e6),
        Parameter("height", "1/4", "height of the ridges", 1e-6, 1e6),
        EXTENT,
    )

    def describe(self) -> Description:
        step, width, height = (self.values[name] for name in ("step", "width", "height"))
        ridge = f"exp(-(y/({width}))**2)"
        branch = f"exp(-(x/({width}))**2)*(1 + tanh(y/({width})))/2"
        return Description("height", (f"({height})*({ridge} + ({step})*{branch}*(1 - {ridge}))",))

    def _parts(self, x: FloatArray, y: FloatArray) -> tuple[_Jet, _Jet]:
        width = self.number("width")
        ridge = np.exp(-((y / width) ** 2))
        across, rise = np.exp(-((x / width) ** 2)), (1 + np.tanh(y / width)) / 2
        climb = (1 - np.tanh(y / width) ** 2) / (2 * width)
        return (
            (ridge, np.zeros_like(ridge), -2 * y / width**2 * ridge),
            (across * rise, -2 * x / width**2 * across * rise, across * climb),
        )

    def height(self, x: FloatArray, y: FloatArray) -> FloatArray:
        (ridge, _, _), (branch, _, _) = self._parts(x, y)
        total = ridge + self.number("step") * branch * (1 - ridge)
        return np.asarray(self.number("height") * total)

    def gradient(self, x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        step, height = self.number("step"), self.number("height")
        (ridge, _, ridge_y), (branch, branch_x, branch_y) = self._parts(x, y)
        return (
            height * step * branch_x * (1 - ridge),
            height * (ridge_y + step * (branch_y * (1 - ridge) - branch * ridge_y)),
        )


class SmoothTJunction(HeightSurface):
    """The T of three gable roofs with every |t| replaced by sqrt(t^2 + m smoothing^2).

    The m = 1, 1, 3 and 2 make all roots rational at the origin, which keeps the exact jet short.
    """

    name = "smooth-t-junction"
    summary = "T-junction of three gable roofs, smoothed to an analytic surface"
    parameters = (
        SLOPE,
        Parameter("smoothing", "1/20", "length over which the creases are rounded", 1e-9, 1e6),
        EXTENT,
    )

    def describe(self) -> Description:
        slope, soft = self.values["slope"], f"({self.values['smoothing']})**2"
        a, b = f"sqrt(y**2 + {soft})", f"sqrt(x**2 + {soft})"
        larger = f"({b} - y + sqrt(({b} + y)**2 + 3*{soft}))/2"
        return Description(
            "height",
            (f"-({slope})*({a} + {larger} - sqrt(({a} - {larger})**2 + 2*{soft}))/2",),
        )

    def _jet(self, x: FloatArray, y: FloatArray) -> _Jet:
        """Return min(|y|, max(|x|, -y)), smoothed, with its derivatives."""
        zero, one = np.zeros_like(x), np.ones_like(x)
        across = self._size((y, zero, one))
        away = self._size((x, one, zero))
        apart = self._size(_plus(away, (y, zero, one)), 3)
        larger = _times(_plus(_plus(away, (-y, zero, -one)), apart), 0.5)
        gap = self._size(_plus(across, _times(larger, -1.0)), 2)
        return _times(_plus(_plus(across, larger), _times(gap, -1.0)), 0.5)

    def _size(self, jet: _Jet, more: int = 1) -> _Jet:
        value, dx, dy = jet
        size = np.sqrt(value**2 + more * self.number("smoothing") ** 2)
        return size, value / size * dx, value / size * dy

    def height(self, x: FloatArray, y: FloatArray) -> FloatArray:
        return np.asarray(-self.number("slope") * self._jet(x, y)[0])

    def gradient(self, x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        _, dx, dy = _times(self._jet(x, y), -self.number("slope"))
        return dx, dy


def _plus(a: _Jet, b: _Jet) -> _Jet:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def _times(a: _Jet, factor: float) -> _Jet:
    return factor * a[0], factor * a[1], factor * a[2]
