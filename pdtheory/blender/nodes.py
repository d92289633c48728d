"""A small vocabulary for building Geometry Nodes trees by code.

Sockets are addressed by their name among the enabled ones, since Blender 5.2 renamed identifiers.
"""

from __future__ import annotations

from typing import Any


class Builder:
    """Adds nodes to one tree; values may be output sockets or plain numbers."""

    def __init__(self, tree: Any) -> None:
        self.tree = tree

    def node(self, kind: str, **settings: Any) -> Any:
        """Add a node of `kind` and set its properties."""
        node = self.tree.nodes.new(kind)
        for name, value in settings.items():
            setattr(node, name, value)
        return node

    def feed(self, node: Any, name: str, value: Any, position: int = 0) -> None:
        """Link or set the `position`-th enabled input of that name."""
        matching = [s for s in node.inputs if s.enabled and s.name == name]
        self._connect(matching[position], value)

    def _connect(self, socket: Any, value: Any) -> None:
        if hasattr(value, "is_output"):
            self.tree.links.new(value, socket)
        else:
            socket.default_value = value

    def _result(self, node: Any) -> Any:
        return next(s for s in node.outputs if s.enabled)

    def _call(self, node: Any, *values: Any) -> Any:
        inputs = [s for s in node.inputs if s.enabled]
        for socket, value in zip(inputs, values, strict=False):
            self._connect(socket, value)
        return self._result(node)

    def attribute(self, name: str, data_type: str = "FLOAT") -> Any:
        """Read a named attribute."""
        return self._call(self.node("GeometryNodeInputNamedAttribute", data_type=data_type), name)

    def math(self, operation: str, *values: Any) -> Any:
        """Combine numbers; booleans count as 0 and 1."""
        return self._call(self.node("ShaderNodeMath", operation=operation), *values)

    def compare(self, operation: str, a: Any, b: Any, data_type: str = "FLOAT") -> Any:
        """Compare two numbers; floats count as equal within 0.001."""
        return self._call(
            self.node("FunctionNodeCompare", data_type=data_type, operation=operation), a, b
        )

    def both(self, a: Any, b: Any) -> Any:
        """Logical and."""
        return self._call(self.node("FunctionNodeBooleanMath", operation="AND"), a, b)

    def negate(self, a: Any) -> Any:
        """Logical not."""
        return self._call(self.node("FunctionNodeBooleanMath", operation="NOT"), a)

    def all_of(self, *values: Any) -> Any:
        """Logical and of several."""
        result = values[0]
        for value in values[1:]:
            result = self.both(result, value)
        return result

    def any_of(self, *values: Any) -> Any:
        """Logical or of several."""
        result = values[0]
        for value in values[1:]:
            result = self._call(self.node("FunctionNodeBooleanMath", operation="OR"), result, value)
        return result

    def switch(self, condition: Any, if_false: Any, if_true: Any, input_type: str) -> Any:
        """Choose between two values."""
        node = self.node("GeometryNodeSwitch", input_type=input_type)
        return self._call(node, condition, if_false, if_true)

    def mix(self, factor: Any, a: Any, b: Any) -> Any:
        """Interpolate: a at factor 0, b at factor 1."""
        return self.math("MULTIPLY_ADD", factor, self.math("SUBTRACT", b, a), a)

    def scale(self, vector: Any, factor: Any) -> Any:
        """Multiply a vector by a number."""
        return self._call(self.node("ShaderNodeVectorMath", operation="SCALE"), vector, factor)

    def combine(self, x: Any, y: Any, z: Any) -> Any:
        """Make a vector."""
        return self._call(self.node("ShaderNodeCombineXYZ"), x, y, z)

    def separate(self, vector: Any, axis: str) -> Any:
        """Take one component of a vector."""
        node = self.node("ShaderNodeSeparateXYZ")
        self.feed(node, "Vector", vector)
        return node.outputs[axis]

    def axes(self, primary: Any, secondary: Any) -> Any:
        """Make the rotation that takes z to `primary` and x close to `secondary`."""
        node = self.node("FunctionNodeAxesToRotation", primary_axis="Z", secondary_axis="X")
        return self._call(node, primary, secondary)

    def store(self, geometry: Any, name: str, value: Any, data_type: str) -> Any:
        """Store a named attribute on the points."""
        node = self.node("GeometryNodeStoreNamedAttribute", data_type=data_type, domain="POINT")
        self.feed(node, "Geometry", geometry)
        self.feed(node, "Name", name)
        self.feed(node, "Value", value)
        return self._result(node)

    def forget(self, geometry: Any, name: str) -> Any:
        """Remove a named attribute."""
        node = self.node("GeometryNodeRemoveAttribute")
        self.feed(node, "Geometry", geometry)
        self.feed(node, "Name", name)
        return self._result(node)

    def lift(self, geometry: Any, offset: Any, selection: Any = True) -> Any:
        """Move points."""
        node = self.node("GeometryNodeSetPosition")
        self.feed(node, "Geometry", geometry)
        self.feed(node, "Selection", selection)
        self.feed(node, "Offset", offset)
        return self._result(node)

    def cone(self, vertices: int, segments: Any, bottom: Any, top: Any, depth: float) -> Any:
        """Make a truncated cone from z = 0 to z = depth."""
        node = self.node("GeometryNodeMeshCone")
        self.feed(node, "Vertices", vertices)
        self.feed(node, "Side Segments", segments)
        self.feed(node, "Radius Top", top)
        self.feed(node, "Radius Bottom", bottom)
        self.feed(node, "Depth", depth)
        return self._result(node)

    def shift(
        self,
        geometry: Any,
        translation: tuple[float, float, float],
        rotation: tuple[float, float, float] = (0.0, 0.0, 0.0),
    ) -> Any:
        """Rotate (radians about x, then y, then z) and move a geometry."""
        node = self.node("GeometryNodeTransform")
        self.feed(node, "Geometry", geometry)
        self.feed(node, "Translation", translation)
        self.feed(node, "Rotation", rotation)
        return self._result(node)

    def smooth(self, mesh: Any) -> Any:
        """Shade a mesh smooth."""
        return self._call(self.node("GeometryNodeSetShadeSmooth"), mesh)

    def join(self, *geometries: Any) -> Any:
        """Join geometries."""
        node = self.node("GeometryNodeJoinGeometry")
        # The one input takes many links, the last linked comes first.
        for geometry in reversed(geometries):
            self.tree.links.new(geometry, node.inputs[0])
        return self._result(node)

    def arrange(self) -> None:
        """Lay the nodes out from left to right by their distance from the output."""
        column: dict[str, int] = {}
        nodes = list(self.tree.nodes)
        links = [(link.from_node.name, link.to_node.name) for link in self.tree.links]
        for node in nodes:
            column[node.name] = 0
        for _ in nodes:
            moved = False
            for source, target in links:
                if column[source] < column[target] + 1:
                    column[source] = column[target] + 1
                    moved = True
            if not moved:
                break
        height: dict[int, int] = {}
        for node in nodes:
            x = column[node.name]
            node.location = (-220.0 * x, -180.0 * height.get(x, 0))
            height[x] = height.get(x, 0) + 1
