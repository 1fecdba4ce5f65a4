"""Many cases in the lanes of vectors: what a kernel's numbers, arrays and records are when it computes eight cases at once.

The same kernels serve one case and eight.  A number of a case becomes `Lanes`, eight numbers in a vector register; an array or a table of
records has the lanes in its last axis, so that a number of all cases is one load.  Integers (which body hangs on which) are the same in
all lanes.  Arithmetic is that of single numbers, to the bit.  What one case decides by a branch, lanes decide by `numerics.lanes.where`;
a kernel full of branches is marked `per_lane` and runs lane by lane, on views of the same memory.
"""

from typing import Any

from llvmlite import ir
from numba.core import types
from numba.core.extending import lower_builtin
from numba.core.typing.templates import AbstractTemplate, signature

import drivewright._jit.lane_arithmetic  # noqa: F401  # tells numba of it
from drivewright._jit.lane_arrays import WIDTH
from drivewright._jit.lane_storage import lane_value
from drivewright._jit.lane_types import MASK, VECTOR, MaskType, TupleType, infer_global, is_laned, lane_of, lanes, mask

__all__ = ["is_laned", "lane_by_lane"]


def where(condition: Any, one: Any, other: Any) -> Any:
    """Typed for lanes below."""


def any_lane(condition: Any) -> Any:
    """Likewise."""


def all_lanes(condition: Any) -> Any:
    """Likewise."""


def view(value: Any, lane: Any) -> Any:
    """One lane of a value."""


def with_lane(value: Any, lane: Any, number: Any) -> Any:
    """A value of lanes with another number in one of them."""


@infer_global(where)
class _Where(AbstractTemplate):
    def generic(self, args, kws):
        kind = mask if all(isinstance(each, types.Boolean | MaskType) for each in args[1:]) else lanes
        return signature(kind, mask, kind, kind)


@lower_builtin(where, mask, lanes, lanes)
@lower_builtin(where, mask, mask, mask)
def _select(context, builder, sig, args):
    return builder.select(*args)


def _reduction(function, operation):
    @infer_global(function)
    class Reduction(AbstractTemplate):
        def generic(self, args, kws):
            return signature(types.boolean, mask)

    @lower_builtin(function, mask)
    def _(context, builder, sig, args):
        bits = ir.IntType(WIDTH)
        word = builder.bitcast(args[0], bits)
        return operation(builder, word, ir.Constant(bits, 0), ir.Constant(bits, 2**WIDTH - 1))


_reduction(any_lane, lambda builder, word, none, every: builder.icmp_unsigned("!=", word, none))
_reduction(all_lanes, lambda builder, word, none, every: builder.icmp_unsigned("==", word, every))


@infer_global(view)
class _View(AbstractTemplate):
    def generic(self, args, kws):
        return signature(lane_of(args[0]), args[0], types.intp)


@lower_builtin(view, types.Any, types.intp)
def _view(context, builder, sig, args):
    return lane_value(context, builder, sig.args[0], *args)


@infer_global(with_lane)
class _WithLane(AbstractTemplate):
    def generic(self, args, kws):
        return signature(args[0], args[0], types.intp, lane_of(args[0]))


@lower_builtin(with_lane, lanes, types.intp, types.float64)
@lower_builtin(with_lane, mask, types.intp, types.boolean)
def _with_lane(context, builder, sig, args):
    value, lane, number = args
    return builder.insert_element(value, number, lane)


def where_in_lanes(condition: Any, one: Any, other: Any) -> Any:
    """What `numerics.lanes.where` is there."""
    return where(condition, one, other)


def any_lane_in_lanes(condition: Any) -> Any:
    """What `numerics.lanes.any_lane` is there."""
    return any_lane(condition)


def opposite_in_lanes(condition: Any) -> Any:
    """What `numerics.lanes.opposite` is there."""
    return ~condition


def all_lanes_in_lanes(condition: Any) -> Any:
    """What `numerics.lanes.all_lanes` is there."""
    return all_lanes(condition)


def lane_by_lane(callee: Any, name: str, args: Any) -> Any:
    """A Python function that calls a kernel for each lane, for arguments of these types; what the kernel gives comes back as lanes."""
    single = tuple(lane_of(each) for each in args)
    callee.get_call_template(single, {})
    result: Any = callee.overloads[single].signature.return_type
    parts = list(result) if isinstance(result, TupleType) else [] if isinstance(result, types.NoneType) else [result]
    kinds = ["empty_mask()" if isinstance(each, types.Boolean) else "empty_lanes()" for each in parts]
    given = [f"a{n}" for n in range(len(args))]
    call = f"kernel({', '.join(f'view({each}, lane)' for each in given)})"
    lines = [f"def {name}_lane_by_lane({', '.join(given)}):"]
    lines += [f"    r{n} = {kind}" for n, kind in enumerate(kinds)]
    lines += [f"    for lane in range({WIDTH}):", f"        found = {call}" if parts else f"        {call}"]
    for n in range(len(parts)):
        lines.append(f"        r{n} = with_lane(r{n}, lane, found{f'[{n}]' if isinstance(result, TupleType) else ''})")
    if parts:
        lines.append(f"    return {', '.join(f'r{n}' for n in range(len(parts)))}")
    scope: dict[str, Any] = {"kernel": callee, "view": view, "with_lane": with_lane, "empty_lanes": empty_lanes, "empty_mask": empty_mask}
    exec("\n".join(lines), scope)
    return scope[f"{name}_lane_by_lane"]


def empty_lanes() -> Any:
    """Lanes to be written."""


def empty_mask() -> Any:
    """Truths to be written."""


def _empty(function, kind, model):
    @infer_global(function)
    class Empty(AbstractTemplate):
        def generic(self, args, kws):
            return signature(kind)

    lower_builtin(function)(lambda context, builder, sig, args: ir.Constant(model, None))


_empty(empty_lanes, lanes, VECTOR)
_empty(empty_mask, mask, MASK)
