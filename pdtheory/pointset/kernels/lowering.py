"""Entries of arrays, fields of records and loops over ranges in a few instructions.

For `a[i, j]` Numba writes some fifty instructions and for the start of a loop as many, most of them
to be removed again, and a good part of a first run goes into them. Kernels read and write numbers
in contiguous arrays at indices that are not negative, and no step of theirs is 0: that takes less.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir as llvm
from numba import types
from numba.core import cgutils, ir
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
        if expr.op in ("getattr", "getiter", "iternext"):
            kind = self.typeof(expr.value.name)
            if isinstance(kind, types.Record) and isinstance(resty, types.NestedArray):
                return self._field(kind, resty, expr)
            if isinstance(kind, types.RangeType) and kind.dtype.signed:
                return self._start(kind, resty, expr)
            if isinstance(kind, types.RangeIteratorType):
                return self._next(kind, resty, expr)
        return super().lower_expr(resty, expr)

    def _field(self, record: Any, kind: Any, expr: Any) -> Any:
        """Return an array that is part of a record."""
        model, value = self._empty(kind)
        data = self.context.get_data_type(kind.dtype)
        offset = record.offset(expr.attr)
        first = cgutils.get_record_member(self.builder, self.loadvar(expr.value.name), offset, data)
        return model.set(self.builder, value, first, "data")

    def _empty(self, kind: Any) -> tuple[Any, Any]:
        """Return the model of an array of known shape, and the array but for where it is."""
        model = self.context.data_model_manager[kind]
        whole = model.get_value_type()
        known = {
            "nitems": kind.nitems,
            "itemsize": kind.dtype.bitwidth // 8,
            "shape": kind.shape,
            "strides": kind.strides,
        }
        parts = []
        for name in ("meminfo", "parent", "nitems", "itemsize", "data", "shape", "strides"):
            part = whole.elements[model.get_field_position(name)]
            number = known.get(name)
            if isinstance(number, tuple):
                parts.append(llvm.Constant(part, [part.element(side) for side in number]))
            else:
                parts.append(llvm.Constant(part, number))
        return model, llvm.Constant(whole, parts)

    def _start(self, kind: Any, iterator: Any, expr: Any) -> Any:
        """Return what a loop over a range begins with."""
        build, value = self.builder, self.loadvar(expr.value.name)
        model = self.context.data_model_manager[kind]
        start, stop, step = (model.get(build, value, name) for name in ("start", "stop", "step"))
        zero, one = step.type(0), step.type(1)
        rest = build.select(
            build.icmp_signed(">", step, zero), build.sub(step, one), build.add(step, one)
        )
        count = build.sdiv(build.add(build.sub(stop, start), rest), step)
        count = build.select(build.icmp_signed(">", count, zero), count, zero)
        parts = {
            "iter": cgutils.alloca_once_value(build, start),
            "stop": stop,
            "step": step,
            "count": cgutils.alloca_once_value(build, count),
        }
        return self._struct(iterator, parts)

    def _next(self, kind: Any, pair: Any, expr: Any) -> Any:
        """Return the number of this round and whether there is one, and go on."""
        build, value = self.builder, self.loadvar(expr.value.name)
        model = self.context.data_model_manager[kind]
        at, left = model.get(build, value, "iter"), model.get(build, value, "count")
        number, count = build.load(at), build.load(left)
        build.store(build.add(number, model.get(build, value, "step")), at)
        build.store(build.sub(count, count.type(1)), left)
        there = build.icmp_signed(">", count, count.type(0))
        return self._struct(pair, {"first": number, "second": there})

    def _struct(self, kind: Any, parts: dict[str, Any]) -> Any:
        """Return a value of several parts."""
        model = self.context.data_model_manager[kind]
        value = llvm.Constant(model.get_value_type(), llvm.Undefined)
        for name, part in parts.items():
            value = model.set(self.builder, value, part, name)
        return value

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
