"""Entries of arrays in a few instructions.

For `a[i, j]` Numba writes some fifty instructions, most of which are removed again, and a good part
of a first run goes into them. Kernels read and write numbers in contiguous arrays at indices that
are not negative, for which five do.
"""

from __future__ import annotations

from typing import Any

from numba import types
from numba.core import ir
from numba.core.compiler_machinery import register_pass
from numba.core.lowering import Lower
from numba.core.typed_passes import NativeLowering


class PlainLower(Lower):
    """Writes the code of a kernel."""

    def lower_inst(self, inst: Any) -> Any:
        """Write a statement."""
        if isinstance(inst, ir.StaticSetItem) and self._is_plain(inst.target, inst.index_var):
            return self.lower_setitem(inst.target, inst.index_var, inst.value, None)
        return super().lower_inst(inst)

    def lower_expr(self, resty: Any, expr: Any) -> Any:
        """Return the value of an expression."""
        if expr.op == "static_getitem" and self._is_plain(expr.value, expr.index_var):
            return self.lower_getitem(resty, expr, expr.value, expr.index_var, None)
        return super().lower_expr(resty, expr)

    def lower_getitem(self, resty: Any, expr: Any, value: Any, index: Any, signature: Any) -> Any:
        """Return an entry."""
        if not self._is_plain(value, index):
            return super().lower_getitem(resty, expr, value, index, signature)
        number = self.typeof(value.name).dtype
        entry = self.context.unpack_value(self.builder, number, self._address(value, index))
        return self.context.cast(self.builder, entry, number, resty)

    def lower_setitem(self, target: Any, index: Any, value: Any, signature: Any) -> Any:
        """Write an entry."""
        if not self._is_plain(target, index):
            return super().lower_setitem(target, index, value, signature)
        number = self.typeof(target.name).dtype
        entry = self.loadvar(value.name)
        entry = self.context.cast(self.builder, entry, self.typeof(value.name), number)
        return self.context.pack_value(self.builder, number, entry, self._address(target, index))

    def _is_plain(self, array: Any, index: Any) -> bool:
        """Whether an entry of a contiguous array of numbers is meant."""
        if index is None:
            return False
        kind, at = self.typeof(array.name), _parts(self.typeof(index.name))
        return (
            isinstance(kind, types.Array)
            and kind.layout == "C"
            and kind.aligned
            and isinstance(kind.dtype, types.Number)
            and len(at) == kind.ndim
            and all(isinstance(part, types.Integer) for part in at)
        )

    def _address(self, array: Any, index: Any) -> Any:
        """Where an entry is."""
        build, value, array_kind = self.builder, self.loadvar(array.name), self.typeof(array.name)
        model = self.context.data_model_manager[array_kind]
        kind, at = self.typeof(index.name), self.loadvar(index.name)
        indices = [at]
        if isinstance(kind, types.BaseTuple):
            indices = [build.extract_value(at, axis) for axis in range(len(kind))]
        whole = None
        for axis, (part, own) in enumerate(zip(indices, _parts(kind), strict=True)):
            number = self.context.cast(build, part, own, types.intp)
            if whole is not None:
                if isinstance(array_kind, types.NestedArray):
                    side = self.context.get_constant(types.intp, array_kind.shape[axis])
                else:
                    side = build.extract_value(model.get(build, value, "shape"), axis)
                number = build.add(build.mul(whole, side), number)
            whole = number
        return build.gep(model.get(build, value, "data"), [whole])


def _parts(index: Any) -> tuple[Any, ...]:
    """The kinds of the indices."""
    return tuple(index.types) if isinstance(index, types.BaseTuple) else (index,)


@register_pass(mutates_CFG=True, analysis_only=False)
class PlainLowering(NativeLowering):
    """The pass that writes the code."""

    _name = "plain_lowering"

    @property
    def lowering_class(self) -> type[Lower]:
        """What writes it."""
        return PlainLower
