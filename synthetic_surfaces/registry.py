"""All surfaces by name."""

from __future__ import annotations

from typing import Any, Final

from pdtheory.errors import InputError
from synthetic_surfaces.base import Surface
from synthetic_surfaces.cad import CadPart
from synthetic_surfaces.classics import Cylinder, Ellipsoid, Enneper, Plane, Sphere, Torus
from synthetic_surfaces.cones import Corner, Planes, Ridge, TJunction
from synthetic_surfaces.junctions import RidgeToJunction, SmoothTJunction
from synthetic_surfaces.quartics import Cyclide, Goursat
from synthetic_surfaces.solids import Cube, RoundedCube
from synthetic_surfaces.wavejets import (
    AnyWavejets,
    Monkey,
    Octopus,
    Order3Family,
    RandomPolynomial,
    Saddle,
)

SURFACES: Final[dict[str, type[Surface]]] = {
    kind.name: kind
    for kind in (
        Monkey,
        Octopus,
        Saddle,
        Order3Family,
        AnyWavejets,
        RandomPolynomial,
        Ridge,
        Corner,
        Planes,
        TJunction,
        SmoothTJunction,
        RidgeToJunction,
        Plane,
        Sphere,
        Ellipsoid,
        Cylinder,
        Torus,
        Enneper,
        Goursat,
        Cyclide,
        Cube,
        RoundedCube,
        CadPart,
    )
}


def names() -> tuple[str, ...]:
    """Return the names of all surfaces."""
    return tuple(SURFACES)


def get(name: str, **parameters: Any) -> Surface:
    """Return a surface by name.

    Parameters
    ----------
    name
        One of :func:`names`.
    **parameters
        Its parameters, as numbers or text; defaults for the others.

    Returns
    -------
    Surface
        The surface.

    Raises
    ------
    InputError
        If there is no such surface or parameter, or a value is out of range.

    Examples
    --------
    >>> import synthetic_surfaces
    >>> torus = synthetic_surfaces.get("torus", major=2, minor="1/2")
    >>> len(torus.sample(1000, seed=1))
    1000
    """
    if name not in SURFACES:
        raise InputError(f"there is no surface {name!r}; choose one of {', '.join(SURFACES)}.")
    return SURFACES[name](**parameters)
