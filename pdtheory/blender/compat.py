"""What differs between Blender 4.2 and 5.2, in one place."""

from __future__ import annotations

from typing import Any

import bpy

#: Options of a property that holds a path, which may be given relative to the file as ``//name``.
RELATIVE_PATH = {"PATH_SUPPORTS_BLEND_RELATIVE"} if bpy.app.version >= (5, 0, 0) else set()


def interface_inputs(tree: Any) -> dict[str, Any]:
    """Return the input sockets of a node group by name."""
    return {
        item.name: item
        for item in tree.interface.items_tree
        if item.item_type == "SOCKET" and item.in_out == "INPUT"
    }


def _stored_inputs(modifier: Any) -> Any | None:
    """Return where Blender 5.2 keeps the inputs of a Geometry Nodes modifier (else None)."""
    properties = getattr(modifier, "properties", None)
    return getattr(properties, "inputs", None)


def input_owner(modifier: Any, identifier: str) -> tuple[Any, str]:
    """Return (data, property path) of a modifier input, as `UILayout.prop` takes them."""
    stored = _stored_inputs(modifier)
    if stored is None:
        return modifier, f'["{identifier}"]'
    return getattr(stored, identifier), "value"


def set_input(modifier: Any, name: str, value: Any) -> None:
    """Set one input of a Geometry Nodes modifier by its name; menus take the item's name.

    Raises
    ------
    KeyError
        If the node group has no such input, or a menu no such item.
    """
    socket = interface_inputs(modifier.node_group)[name]
    stored = _stored_inputs(modifier)
    if stored is not None:
        getattr(stored, socket.identifier).value = value
        return
    if socket.socket_type == "NodeSocketMenu":
        value = _menu_items(modifier.node_group, name)[value]
    # Blender 4 and 5.0 check the type of the property strictly.
    current = modifier.get(socket.identifier)
    if isinstance(current, float):
        value = float(value)
    modifier[socket.identifier] = value


def get_input(modifier: Any, name: str) -> Any:
    """Return one input of a Geometry Nodes modifier by its name; menus give the item's name."""
    socket = interface_inputs(modifier.node_group)[name]
    stored = _stored_inputs(modifier)
    if stored is not None:
        return getattr(stored, socket.identifier).value
    value = modifier[socket.identifier]
    if socket.socket_type == "NodeSocketMenu":
        numbers = _menu_items(modifier.node_group, name)
        return next(item for item, number in numbers.items() if number == value)
    return value


def _menu_items(tree: Any, name: str) -> dict[str, int]:
    """Return the number of each item of a menu input, from the switch the input feeds.

    Items are numbered as they were created, which is their position as long as none is removed.
    """
    for link in tree.links:
        if link.from_socket.name == name and link.to_node.bl_idname == "GeometryNodeMenuSwitch":
            return {item.name: i for i, item in enumerate(link.to_node.enum_items)}
    raise KeyError(name)


def name_menu_items(switch: Any, names: tuple[str, ...]) -> None:
    """Name the items of a menu switch; the two that come with it are renamed, never removed."""
    items = switch.enum_items
    for position, name in enumerate(names):
        if position < len(items):
            items[position].name = name
        else:
            items.new(name)


def enable_nodes(owner: Any) -> Any:
    """Return the node tree of a material or world, switched on where that is still asked for."""
    if bpy.app.version < (5, 0, 0):
        owner.use_nodes = True
    return owner.node_tree


def has_denoiser(scene: Any) -> bool:
    """Return True if this build of Blender carries OpenImageDenoise."""
    try:
        scene.cycles.denoiser = "OPENIMAGEDENOISE"
    except (AttributeError, TypeError):
        return False
    return True


def denoise_fast(scene: Any) -> None:
    """Choose the quick variant of the denoiser, where there is a choice."""
    scene.cycles.denoising_prefilter = "NONE"
    if hasattr(scene.cycles, "denoising_quality"):
        scene.cycles.denoising_quality = "FAST"
