"""Surfaces that are known exactly: described, meshed, sampled, with their true directions.

Examples
--------
>>> import synthetic_surfaces
>>> monkey = synthetic_surfaces.get("monkey")
>>> cloud = monkey.sample(2000, noise=0.1, seed=7)
>>> jet = monkey.sites()[0].jet(degree=3)
>>> [str(pair.eigenvalue) for pair in jet.eigenpairs(3)]
['6', '-6', '6', '-6', '6', '-6']
"""

from synthetic_surfaces.base import Surface
from synthetic_surfaces.description import Description
from synthetic_surfaces.parameters import Parameter
from synthetic_surfaces.registry import get, names
from synthetic_surfaces.truth import Site

__all__ = ["Description", "Parameter", "Site", "Surface", "get", "names"]
