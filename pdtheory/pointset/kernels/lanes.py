"""Code for several doubles at a time, written straight to LLVM.

Numba turns a plain loop into one over vectors half as wide as those of the machine, and finishes it
point by point. The few kernels that take most of the time are therefore written here instead: each
is a Python function that receives a `Lanes` and its arguments, and emits the code. That also spares
Numba their analysis, which is most of the time of a first compilation.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import reduce
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.registry import cpu_target
from numba.extending import intrinsic


def _target_features() -> str:
    """What the processor that Numba compiles for can do: perhaps less than that of this machine."""
    _, _, features = cpu_target.target_context.codegen().magic_tuple()
    return str(features)


#: Doubles in a vector.
LANES = 8 if "+avx512f" in _target_features().split(",") else 4

_REAL = ir.DoubleType()
_VECTOR = ir.VectorType(_REAL, LANES)
_INT = ir.IntType(64)
_INDEX = ir.IntType(32)
_FIRST = ir.Constant(_INDEX, 0)
_ALIKE = ir.Constant(ir.VectorType(_INDEX, LANES), [0] * LANES)
# A product and a sum may be fused; nothing else is taken liberties with.
_FLAGS = ("contract",)


class Rows:
    """A C-contiguous array of doubles or 64-bit integers with one or two axes."""

    def __init__(self, lanes: Lanes, data: Any, stride: Any) -> None:
        self._lanes = lanes
        self._data = data
        self._stride = stride

    @classmethod
    def of(cls, lanes: Lanes, kind: Any, value: Any) -> Rows:
        """Return the rows of an array of Numba."""
        array = lanes.context.make_array(kind)(lanes.context, lanes.builder, value)
        return cls(lanes, array.data, cgutils.unpack_tuple(lanes.builder, array.shape)[-1])

    def unless(self, condition: Any, other: Rows) -> Rows:
        """Return these, or the others if a condition holds."""
        build = self._lanes.builder
        data = build.select(condition, other._data, self._data)
        return Rows(self._lanes, data, build.select(condition, other._stride, self._stride))

    def at(self, row: Any, column: Any = None) -> Any:
        """Address of an entry."""
        lanes = self._lanes
        if column is not None:
            row = lanes.plus(lanes.builder.mul(lanes.integer(row), self._stride), column)
        return lanes.builder.gep(self._data, [lanes.integer(row)])


class Lanes:
    """Writes instructions behind those written so far."""

    def __init__(self, context: Any, builder: Any) -> None:
        self.context = context
        self.builder = builder

    def integer(self, value: Any) -> Any:
        """A constant, or the value itself if it is none."""
        return ir.Constant(_INT, value) if isinstance(value, int) else value

    def plus(self, *values: Any) -> Any:
        """Sum of integers."""
        total = self.integer(values[0])
        for value in values[1:]:
            total = self.builder.add(total, self.integer(value))
        return total

    def minus(self, a: Any, b: Any) -> Any:
        """Difference of integers."""
        return self.builder.sub(self.integer(a), self.integer(b))

    def mul(self, a: Any, b: Any) -> Any:
        """Product of integers."""
        return self.builder.mul(self.integer(a), self.integer(b))

    def div(self, a: Any, b: Any) -> Any:
        """Quotient of integers, cut towards zero."""
        return self.builder.sdiv(self.integer(a), self.integer(b))

    def least(self, a: Any, b: Any) -> Any:
        """The smaller of two integers."""
        a, b = self.integer(a), self.integer(b)
        return self.builder.select(self.builder.icmp_signed("<", a, b), a, b)

    def greatest(self, a: Any, b: Any) -> Any:
        """The larger of two integers."""
        a, b = self.integer(a), self.integer(b)
        return self.builder.select(self.builder.icmp_signed(">", a, b), a, b)

    def real(self, value: float) -> Any:
        """A constant."""
        return ir.Constant(_REAL, value)

    def constant(self, value: float) -> Any:
        """A constant in all lanes."""
        return ir.Constant(_VECTOR, [value] * LANES)

    def sequence(self, first: int) -> Any:
        """The whole numbers from `first` on as constants."""
        return ir.Constant(_VECTOR, [float(first + lane) for lane in range(LANES)])

    def spread(self, value: Any) -> Any:
        """One number in all lanes."""
        empty = ir.Constant(_VECTOR, ir.Undefined)
        one = self.builder.insert_element(empty, value, _FIRST)
        return self.builder.shuffle_vector(one, empty, _ALIKE)

    def get(self, address: Any) -> Any:
        """The number at an address."""
        return self.builder.load(address)

    def put(self, value: Any, address: Any) -> None:
        """Write one number."""
        self.builder.store(value, address)

    def load(self, address: Any) -> Any:
        """A vector from an address on."""
        return self.builder.load(self.builder.bitcast(address, _VECTOR.as_pointer()), align=8)

    def store(self, value: Any, address: Any) -> None:
        """Write a vector from an address on."""
        self.builder.store(value, self.builder.bitcast(address, _VECTOR.as_pointer()), align=8)

    def times(self, a: Any, b: Any) -> Any:
        """Product."""
        return self.builder.fmul(a, b, flags=_FLAGS)

    def add(self, a: Any, b: Any) -> Any:
        """Sum."""
        return self.builder.fadd(a, b, flags=_FLAGS)

    def subtract(self, a: Any, b: Any) -> Any:
        """Difference."""
        return self.builder.fsub(a, b, flags=_FLAGS)

    def divide(self, a: Any, b: Any) -> Any:
        """Quotient."""
        return self.builder.fdiv(a, b, flags=_FLAGS)

    def root(self, value: Any) -> Any:
        """Square root of a number, or of those in all lanes."""
        name = "llvm.sqrt.f64" if value.type == _REAL else f"llvm.sqrt.v{LANES}f64"
        kind = ir.FunctionType(value.type, [value.type])
        sqrt = cgutils.get_or_insert_function(self.builder.module, kind, name)
        return self.builder.call(sqrt, [value])

    def size(self, value: Any) -> Any:
        """Absolute values."""
        zero = self.constant(0.0)
        negative = self.builder.fcmp_ordered("<", value, zero)
        return self.builder.select(negative, self.subtract(zero, value), value)

    def larger(self, a: Any, b: Any) -> Any:
        """The larger of two numbers, or those in all lanes."""
        return self.builder.select(self.builder.fcmp_ordered(">", a, b), a, b)

    def smaller(self, a: Any, b: Any) -> Any:
        """The smaller of two numbers, or those in all lanes."""
        return self.builder.select(self.builder.fcmp_ordered("<", a, b), a, b)

    def largest(self, vector: Any) -> Any:
        """The largest number in a vector."""
        return reduce(self.larger, [self.lane(vector, number) for number in range(LANES)])

    def next(self, vector: Any, behind: Any) -> Any:
        """The lanes of a vector from the second on, then the first of another."""
        order = ir.Constant(ir.VectorType(_INDEX, LANES), list(range(1, LANES + 1)))
        return self.builder.shuffle_vector(vector, behind, order)

    def sums(self, vectors: Sequence[Any]) -> Any:
        """One vector with the sums over the lanes of each of up to LANES vectors, then zeros."""
        vectors = [*vectors, *[self.constant(0.0)] * (LANES - len(vectors))]
        index = ir.VectorType(_INDEX, LANES)
        even = ir.Constant(index, list(range(0, 2 * LANES, 2)))
        odd = ir.Constant(index, list(range(1, 2 * LANES, 2)))
        while len(vectors) > 1:
            vectors = [
                self.add(
                    self.builder.shuffle_vector(u, v, even), self.builder.shuffle_vector(u, v, odd)
                )
                for u, v in zip(vectors[::2], vectors[1::2], strict=True)
            ]
        return vectors[0]

    def store_sums(self, places: Sequence[Any], out: Rows) -> None:
        """Write the sums over the lanes of what is in `places`, then zeros up to a whole vector."""
        for first in range(0, len(places), LANES):
            group = [self.get(place) for place in places[first : first + LANES]]
            self.store(self.sums(group), out.at(first))

    def any(self, mask: Any) -> Any:
        """Whether a truth value holds in some lane."""
        bits = self.builder.bitcast(mask, ir.IntType(LANES))
        return self.builder.icmp_unsigned("!=", bits, ir.Constant(ir.IntType(LANES), 0))

    def below(self, count: Any) -> Any:
        """Truth values that hold in the first `count` lanes."""
        kind = ir.VectorType(_INT, LANES)
        one = self.builder.insert_element(ir.Constant(kind, ir.Undefined), count, _FIRST)
        spread = self.builder.shuffle_vector(one, ir.Constant(kind, ir.Undefined), _ALIKE)
        return self.builder.icmp_signed("<", ir.Constant(kind, list(range(LANES))), spread)

    def number(self, mask: Any) -> Any:
        """In how many lanes a truth value holds."""
        bits = self.builder.zext(self.builder.bitcast(mask, ir.IntType(LANES)), _INT)
        return self.builder.ctpop(bits)

    def pack(self, vectors: Sequence[Any], mask: Any, addresses: Sequence[Any]) -> None:
        """Write the lanes where a truth value holds, without gaps.

        What follows them, up to a whole vector, may be overwritten.
        """
        if LANES == 8:
            # The form that stores to memory is microcode on some processors, this one is not.
            kind = ir.FunctionType(_VECTOR, [_VECTOR, _VECTOR, mask.type])
            name = f"llvm.x86.avx512.mask.compress.v{LANES}f64"
            compress = cgutils.get_or_insert_function(self.builder.module, kind, name)
            for vector, address in zip(vectors, addresses, strict=True):
                self.store(self.builder.call(compress, [vector, vector, mask]), address)
            return
        # Where the machine has no such instruction: each lane goes where the next one is due.
        place = self.integer(0)
        for number in range(LANES):
            for vector, address in zip(vectors, addresses, strict=True):
                self.put(self.lane(vector, number), self.builder.gep(address, [place]))
            place = self.plus(place, self.builder.zext(self.lane(mask, number), _INT))

    def lane(self, vector: Any, number: int) -> Any:
        """One lane of a vector."""
        return self.builder.extract_element(vector, ir.Constant(_INDEX, number))

    def variable(self, value: Any) -> Any:
        """A place for a value that changes in a loop, to be used with `get` and `put`."""
        return cgutils.alloca_once_value(self.builder, value)

    @contextmanager
    def count(self, start: Any, stop: Any, step: int = 1) -> Iterator[Any]:
        """Loop over ``range(start, stop, step)``."""
        with cgutils.for_range_slice(
            self.builder, self.integer(start), self.integer(stop), self.integer(step), _INT
        ) as (index, _):
            yield index


def emit(write: Callable[..., Any]) -> Any:
    """Turn a function that writes code into one that kernels can call.

    `write` receives a `Lanes`, then a `Rows` for every array and an LLVM value for every number.
    The kernel gets back nothing, or the number (double) that `write` returns.
    """
    names = list(inspect.signature(write).parameters)[1:]
    result = types.void if write.__annotations__.get("return") == "None" else types.float64

    def typer(context: Any, *kinds: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, values: Any) -> Any:
            lanes = Lanes(context, builder)
            arguments = [
                Rows.of(lanes, kind, value) if isinstance(kind, types.Array) else value
                for kind, value in zip(signature.args, values, strict=True)
            ]
            returned = write(lanes, *arguments)
            return context.get_dummy_value() if returned is None else returned

        kinds = tuple(kind if isinstance(kind, types.Array) else _number(kind) for kind in kinds)
        return result(*kinds), generate

    # Numba wants to see the names of the arguments.
    typer.__signature__ = inspect.Signature(  # type: ignore[attr-defined]
        [inspect.Parameter(n, inspect.Parameter.POSITIONAL_OR_KEYWORD) for n in ("context", *names)]
    )
    typer.__name__ = write.__name__
    typer.__doc__ = write.__doc__
    return intrinsic(typer)


def _number(kind: Any) -> Any:
    return types.int64 if isinstance(kind, (types.Integer, types.Boolean)) else types.float64
