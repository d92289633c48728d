# SPDX-License-Identifier: GPL-3.0-or-later
"""Principal directions of arbitrary order on Blender objects: the extension."""

from .library import forget_replaced

# Before anything of the library is imported.
forget_replaced()

from . import (  # noqa: E402
    add_mesh,
    compute,
    exact_directions,
    exchange,
    inspect_point,
    jobs,
    panels,
    polar_plot,
    preferences,
    presets,
    properties,
    shading,
    translations,
)

#: In the order of registration; taken back in the opposite order.
_PARTS = (
    preferences,
    properties,
    presets,
    jobs,
    compute,
    shading,
    inspect_point,
    polar_plot,
    exchange,
    add_mesh,
    exact_directions,
    panels,
    translations,
)


def register() -> None:
    """Register all classes, properties, menus and handlers."""
    for part in _PARTS:
        part.register()


def unregister() -> None:
    """Take back everything that :func:`register` did."""
    for part in reversed(_PARTS):
        part.unregister()
