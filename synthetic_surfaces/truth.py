"""The true directions of a surface: exact jets where it is smooth, predictions on cones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray
from synthetic_surfaces.description import Description

if TYPE_CHECKING:
    from pdtheory.exact import SurfaceJet
    from pdtheory.exact.prediction import ConePrediction

Measure = Literal["flat", "surface"]


@dataclass(frozen=True)
class Site:
    """A point of a surface at which its directions are known.

    Attributes
    ----------
    name : str
        What is there: ``apex``, ``edge``, ``corner``, ``origin``, ...
    description : Description
        The surface around it: a height, an implicit or a parametric form, or a cone.
    at : tuple of str
        The exact coordinates for that form: (x, y), (x, y, z) or (u, v); empty for a cone.
    place : (3,) float64 or None
        For a cone, where its apex lies in space.
    frame : (3, 3) float64 or None
        For a cone, the rows t1, t2, n of the frame that its rays refer to.
    """

    name: str
    description: Description
    at: tuple[str, ...] = ()
    place: FloatArray | None = None
    frame: FloatArray | None = None

    @property
    def smooth(self) -> bool:
        """Whether the surface has derivatives of all orders there."""
        return self.description.kind != "cone"

    def jet(
        self,
        degree: int,
        at: Sequence[Any] | None = None,
        tangent: Sequence[Any] | None = None,
    ) -> SurfaceJet:
        """Return the exact height function over the tangent plane.

        Parameters
        ----------
        degree
            Largest order.
        at
            Another point of the same form, exact: numbers or formulas.
        tangent
            A vector of space whose projection gives t1.

        Raises
        ------
        InputError
            If there is a cone, which has no derivatives, or the point is not on the surface.
        """
        import sympy as sp

        from pdtheory.exact import explicit_jet, implicit_jet, parametric_jet, parse_expression

        if not self.smooth:
            raise InputError(
                f"the surface has no derivatives at its {self.name}; ask for a prediction instead."
            )
        names = self.description.variables
        variables = sp.symbols(names)
        forms = [parse_expression(text, names) for text in self.description.expressions]
        place = [
            parse_expression(part, ()) if isinstance(part, str) else part
            for part in (self.at if at is None else at)
        ]
        if self.description.kind == "parametric":
            return parametric_jet(forms, variables, degree, place, tangent=tangent)
        build = explicit_jet if self.description.kind == "height" else implicit_jet
        return build(forms[0], variables, degree, place, tangent=tangent)

    def prediction(
        self, degree: int, orders: Sequence[int], *, radius: Any = 1, measure: Measure = "flat"
    ) -> ConePrediction:
        """Return what a dense fit of a degree finds at the apex of the cone.

        Parameters
        ----------
        degree
            Degree K of the fit.
        orders
            The orders.
        radius
            Radius R of the fit, exact.
        measure
            How the samples lie (:func:`pdtheory.exact.predict`).

        Raises
        ------
        InputError
            If the surface is smooth there.
        """
        from pdtheory.exact import parse_expression
        from pdtheory.exact.cones import Cone
        from pdtheory.exact.prediction import predict

        if self.smooth:
            raise InputError(f"the surface is smooth at its {self.name}; ask for its jet instead.")
        rays = [
            (parse_expression(angle, ()), parse_expression(slope, ()))
            for angle, slope in self.description.rays
        ]
        return predict(Cone(tuple(rays)), degree, orders, radius=radius, measure=measure)
