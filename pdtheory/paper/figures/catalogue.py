"""All figures by name; their modules are loaded when asked for."""

from __future__ import annotations

from importlib import import_module
from typing import Final

from pdtheory.errors import InputError
from pdtheory.paper.figures.outcome import Figure

#: Module and attribute of every figure, in the order of the paper.
_HOME: Final = {
    "teaser": ("scans", "TEASER"),
    "saddles": ("saddles", "FIGURE"),
    "order3": ("order3", "FIGURE"),
    "ridge2junction": ("ridge2junction", "FIGURE"),
    "five-planes": ("five_planes", "FIGURE"),
    "cube": ("cube", "FIGURE"),
    "armadillo": ("scans", "ARMADILLO"),
    "head": ("scans", "HEAD"),
    "rocker-arm": ("scans", "ROCKER_ARM"),
    "fandisk": ("scans", "FANDISK"),
    "cube-noise": ("cube_noise", "FIGURE"),
    "radius": ("radius", "FIGURE"),
    "t-junction": ("t_junction", "FIGURE"),
    "deltoid": ("diagrams", "DELTOID"),
    "astroid": ("diagrams", "ASTROID"),
    "convergence": ("convergence", "FIGURE"),
    "noise-gain": ("noise_gain", "FIGURE"),
    "error-bars": ("error_bars", "FIGURE"),
}

NAMES: Final = tuple(_HOME)


def get(name: str) -> Figure:
    """Return a figure by name.

    Parameters
    ----------
    name
        One of `NAMES`.

    Raises
    ------
    InputError
        If there is no such figure.
    """
    if name not in _HOME:
        raise InputError(f"there is no figure {name!r}; choose one of {', '.join(NAMES)}, or all.")
    module, attribute = _HOME[name]
    figure: Figure = getattr(import_module(f"pdtheory.paper.figures.{module}"), attribute)
    return figure
