"""Many cases in the lanes of vectors: what a kernel's numbers, arrays and records are when it computes eight cases at once.

The same kernels serve one case and eight.  A number of a case becomes `Lanes`, eight numbers in a vector register; an array or a table of
records has the lanes in its last axis, so that a number of all cases is one load.  Integers (which body hangs on which) are the same in
all lanes.  Arithmetic is that of single numbers, to the bit.  What one case decides by a branch, lanes decide by `numerics.lanes.where`;
a kernel full of branches is marked `per_lane` and runs lane by lane, on views of the same memory.
"""

import operator
from typing import Any

import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.core.datamodel import models, registry
from numba.core.extending import NativeValue, infer_getattr, lower_builtin, lower_cast, lower_getattr_generic, typeof_impl, unbox
from numba.core.imputils import lower_setattr_generic
from numba.core.typeconv.castgraph import Conversion
from numba.core.typing import templates
from numba.core.typing.templates import AbstractTemplate, AttributeTemplate, signature

from drivewright._jit.lane_arrays import WIDTH, LaneArray, LaneNumber
from drivewright._jit.references import Reference

DOUBLE, BIT, WORD = ir.DoubleType(), ir.IntType(1), ir.IntType(64)
infer_global: Any = templates.infer_global  # whose own annotations know one of its two uses
TupleType: Any = types.BaseTuple  # whose parts can be iterated over, which its annotations do not say
VECTOR, MASK = ir.VectorType(DOUBLE, WIDTH), ir.VectorType(BIT, WIDTH)


class LanesType(types.Type):
    """Eight numbers."""

    def __init__(self):
        super().__init__("lanes")

    def can_convert_from(self, typingctx: Any, other: Any) -> Any:
        """A single number is the same in all lanes."""
        return Conversion.safe if isinstance(other, types.Float | types.Integer) else None


class MaskType(types.Type):
    """Eight truths."""

    def __init__(self):
        super().__init__("lane_mask")

    def can_convert_from(self, typingctx: Any, other: Any) -> Any:
        """A single truth is the same in all lanes."""
        return Conversion.safe if isinstance(other, types.Boolean) else None


lanes, mask = LanesType(), MaskType()


class LaneArrayType(types.Type):
    """An array (or table of records, where `fields` says the places of their members in bytes) with lanes; `view`: of one lane alone."""

    def __init__(self, ndim, fields, size, view):
        self.ndim, self.fields, self.size, self.view = ndim, fields, size, view
        super().__init__(f"lane_array({ndim},{fields},{size},{view})")

    @property
    def item(self):
        """The type of its elements."""
        if self.fields:
            return LaneRecordType(self.fields, self.view)
        return types.float64 if self.view else lanes


class LaneRecordType(types.Type):
    """A record of such a table."""

    def __init__(self, fields, view):
        self.fields, self.view = fields, view
        self.places = {name: (place, is_integer) for name, place, is_integer in fields}
        super().__init__(f"lane_record({fields},{view})")

    def member(self, name):
        """The type of a member."""
        _, is_integer = self.places[name]
        return types.int64 if is_integer else types.float64 if self.view else lanes


class LaneViewType(types.Type):
    """One lane of a tuple that a kernel gets by reference."""

    def __init__(self, reference):
        self.reference, self.instance_class = reference, reference.instance_class
        super().__init__(f"lane_view({reference.name})")

    @property
    def types(self):
        """Those of the fields of the tuple."""
        return self.reference.types


def is_laned(kind: Any) -> bool:
    """Whether values of this type have lanes."""
    if isinstance(kind, Reference):
        return any(is_laned(each) for each in kind.types)
    return isinstance(kind, LanesType | MaskType) or (isinstance(kind, LaneArrayType | LaneRecordType) and not kind.view)


def lane_of(kind: Any) -> Any:
    """The type of one lane of values of this type."""
    if not is_laned(kind):
        return kind
    if isinstance(kind, LaneArrayType):
        return LaneArrayType(kind.ndim, kind.fields, kind.size, True)
    if isinstance(kind, LaneRecordType):
        return LaneRecordType(kind.fields, True)
    return LaneViewType(kind) if isinstance(kind, Reference) else types.float64 if kind == lanes else types.boolean


# ----------------------------------------------------------------------------------------------------------------- data models


@registry.register_default(LanesType)
class _LanesModel(models.PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, VECTOR)


@registry.register_default(MaskType)
class _MaskModel(models.PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, MASK)


def _struct(kind, *members):
    @registry.register_default(kind)
    class Model(models.StructModel):
        def __init__(self, manager, each):
            named = [(name, member if isinstance(member, types.Type) else member(each)) for name, member in members]
            super().__init__(manager, each, named + ([("lane", types.intp)] if getattr(each, "view", True) else []))


_struct(LaneArrayType, ("data", types.voidptr), ("shape", lambda kind: types.UniTuple(types.intp, kind.ndim)))
_struct(LaneRecordType, ("data", types.voidptr))
_struct(LaneViewType, ("data", lambda kind: kind.reference))


@typeof_impl.register(LaneArray)
def _(value, context):
    return LaneArrayType(value.ndim, value.fields, value.item_bytes, False)


@typeof_impl.register(LaneNumber)
def _(value, context):
    return lanes


@unbox(LaneArrayType)
def _array_from_python(kind, value, c):
    array = types.Array(types.uint8, kind.ndim + 1, "C")
    raw = c.pyapi.object_getattr_string(value, "bytes")
    native = c.unbox(array, raw)
    c.pyapi.decref(raw)
    source, target = (
        c.context.make_array(array)(c.context, c.builder, native.value),
        cgutils.create_struct_proxy(kind)(c.context, c.builder),
    )
    target.data = source.data
    shape = cgutils.unpack_tuple(c.builder, source.shape, kind.ndim + 1)
    target.shape = cgutils.pack_array(c.builder, shape[: kind.ndim])
    return NativeValue(target._getvalue(), is_error=native.is_error, cleanup=native.cleanup)


@unbox(LanesType)
def _number_from_python(kind, value, c):
    array = types.Array(types.float64, 1, "C")
    raw = c.pyapi.object_getattr_string(value, "numbers")
    native = c.unbox(array, raw)
    c.pyapi.decref(raw)
    source = c.context.make_array(array)(c.context, c.builder, native.value)
    return NativeValue(_load(c.builder, source.data), is_error=native.is_error, cleanup=native.cleanup)


def _load(builder, place):
    return builder.load(builder.bitcast(place, VECTOR.as_pointer()), align=8)


# ----------------------------------------------------------------------------------------------------------------- arrays and records


def _is_index(kind: Any):
    return isinstance(kind, types.Integer) or (isinstance(kind, TupleType) and all(isinstance(each, types.Integer) for each in kind))


def _indexed(array, index):
    """Type of an element or of a part with fewer axes."""
    axes = array.ndim - (len(index) if isinstance(index, TupleType) else 1)
    return array.item if axes == 0 else LaneArrayType(axes, array.fields, array.size, array.view)


@infer_global(operator.getitem)
class _GetItem(AbstractTemplate):
    def generic(self, args, kws):
        array, index = args
        return signature(_indexed(array, index), array, index) if isinstance(array, LaneArrayType) and _is_index(index) else None


@infer_global(operator.setitem)
class _SetItem(AbstractTemplate):
    def generic(self, args, kws):
        array, index, _ = args
        if isinstance(array, LaneArrayType) and not array.fields and _is_index(index):
            return signature(types.none, array, index, array.item)
        return None


def _place(context, builder, kind, value, index_kind: Any, index):
    """(struct, address of the element or part, lengths of the axes that are left)."""
    array = cgutils.create_struct_proxy(kind)(context, builder, value=value)
    shape = cgutils.unpack_tuple(builder, array.shape, kind.ndim)
    kinds = list(index_kind) if isinstance(index_kind, TupleType) else [index_kind]
    parts = cgutils.unpack_tuple(builder, index, len(kinds)) if isinstance(index_kind, TupleType) else [index]
    flat = ir.Constant(WORD, 0)
    for axis in range(kind.ndim):
        step = context.cast(builder, parts[axis], kinds[axis], types.intp) if axis < len(parts) else ir.Constant(WORD, 0)
        flat = builder.add(builder.mul(flat, shape[axis]), step)
    return array, builder.gep(array.data, [builder.mul(flat, ir.Constant(WORD, kind.size))]), shape[len(parts) :]


def _at_lane(builder, place, lane):
    return builder.gep(builder.bitcast(place, DOUBLE.as_pointer()), [lane])


@lower_builtin(operator.getitem, LaneArrayType, types.Any)
def _get_item(context, builder, sig, args):
    kind = sig.args[0]
    array, place, rest = _place(context, builder, kind, args[0], sig.args[1], args[1])
    if rest or kind.fields:
        part = cgutils.create_struct_proxy(sig.return_type)(context, builder)
        part.data = place
        if rest:
            part.shape = cgutils.pack_array(builder, rest)
        if kind.view:
            part.lane = array.lane
        return part._getvalue()
    return builder.load(_at_lane(builder, place, array.lane)) if kind.view else _load(builder, place)


@lower_builtin(operator.setitem, LaneArrayType, types.Any, types.Any)
def _set_item(context, builder, sig, args):
    kind = sig.args[0]
    array, place, _ = _place(context, builder, kind, args[0], sig.args[1], args[1])
    if kind.view:
        builder.store(args[2], _at_lane(builder, place, array.lane))
    else:
        builder.store(args[2], builder.bitcast(place, VECTOR.as_pointer()), align=8)


@infer_global(len)
class _Len(AbstractTemplate):
    def generic(self, args, kws):
        return signature(types.intp, *args) if isinstance(args[0], LaneArrayType) else None


@lower_builtin(len, LaneArrayType)
def _len(context, builder, sig, args):
    array = cgutils.create_struct_proxy(sig.args[0])(context, builder, value=args[0])
    return builder.extract_value(array.shape, 0)


@infer_getattr
class _ArrayFields(AttributeTemplate):
    key = LaneArrayType

    def generic_resolve(self, kind, name):
        return {"size": types.intp, "shape": types.UniTuple(types.intp, kind.ndim)}.get(name)


@lower_getattr_generic(LaneArrayType)
def _array_field(context, builder, kind, value, name):
    shape = cgutils.create_struct_proxy(kind)(context, builder, value=value).shape
    if name == "shape":
        return shape
    size = ir.Constant(WORD, 1)
    for length in cgutils.unpack_tuple(builder, shape, kind.ndim):
        size = builder.mul(size, length)
    return size


@infer_getattr
class _RecordFields(AttributeTemplate):
    key = LaneRecordType

    def generic_resolve(self, kind, name):
        return kind.member(name) if name in kind.places else None


def _member(context, builder, kind, value, name):
    """Address of a member, as a pointer to its type."""
    record = cgutils.create_struct_proxy(kind)(context, builder, value=value)
    place, is_integer = kind.places[name]
    address = builder.gep(record.data, [ir.Constant(WORD, place)])
    if is_integer:
        return builder.bitcast(address, WORD.as_pointer())
    return _at_lane(builder, address, record.lane) if kind.view else builder.bitcast(address, VECTOR.as_pointer())


@lower_getattr_generic(LaneRecordType)
def _get_member(context, builder, kind, value, name):
    return builder.load(_member(context, builder, kind, value, name), align=8)


@lower_setattr_generic(LaneRecordType)
def _set_member(context, builder, sig, args, name):
    builder.store(args[1], _member(context, builder, sig.args[0], args[0], name), align=8)


@infer_getattr
class _ViewFields(AttributeTemplate):
    key = LaneViewType

    def generic_resolve(self, kind, name):
        reference = kind.reference
        return lane_of(reference.types[reference.fields.index(name)]) if name in reference.fields else None


@lower_getattr_generic(LaneViewType)
def _read_view(context, builder, kind, value, name):
    view = cgutils.create_struct_proxy(kind)(context, builder, value=value)
    whole = kind.reference.types[kind.reference.fields.index(name)]
    return lane_value(
        context, builder, whole, context.get_getattr(kind.reference, name)(context, builder, kind.reference, view.data, name), view.lane
    )


def lane_value(context: Any, builder: Any, kind: Any, value: Any, lane: Any) -> Any:
    """One lane of a value."""
    if not is_laned(kind):
        return value
    if isinstance(kind, LanesType | MaskType):
        return builder.extract_element(value, lane)
    view = cgutils.create_struct_proxy(lane_of(kind))(context, builder)
    if isinstance(kind, Reference):
        view.data = value
    else:
        whole = cgutils.create_struct_proxy(kind)(context, builder, value=value)
        view.data = whole.data
        if isinstance(kind, LaneArrayType):
            view.shape = whole.shape
    view.lane = lane
    return view._getvalue()


# ----------------------------------------------------------------------------------------------------------------- arithmetic


def _splat(builder, value, kind):
    first = builder.insert_element(ir.Constant(kind, ir.Undefined), value, ir.Constant(ir.IntType(32), 0))
    return builder.shuffle_vector(first, ir.Constant(kind, ir.Undefined), ir.Constant(ir.VectorType(ir.IntType(32), WIDTH), [0] * WIDTH))


@lower_cast(types.Float, LanesType)
@lower_cast(types.Integer, LanesType)
def _same_in_all(context, builder, source, target, value):
    return _splat(builder, context.cast(builder, value, source, types.float64), VECTOR)


@lower_cast(types.Boolean, MaskType)
def _truth_in_all(context, builder, source, target, value):
    return _splat(builder, context.cast(builder, value, source, types.boolean), MASK)


def _operation(function, count, lower, given=lanes, result=lanes):
    """State a function of `count` arguments, of which at least one has lanes."""

    @infer_global(function)
    class Operation(AbstractTemplate):
        def generic(self, args, kws):
            fits = len(args) == count and given in args
            own = all(each == given or given.can_convert_from(self.context, each) is not None for each in args)
            return signature(result, *[given] * count) if fits and own else None

    lower_builtin(function, *[given] * count)(lambda context, builder, sig, args: lower(builder, *args))


def _intrinsic(name):
    def lower(builder, *args):
        function = ir.FunctionType(VECTOR, [VECTOR] * len(args))
        return builder.call(cgutils.get_or_insert_function(builder.module, function, f"llvm.{name}.v{WIDTH}f64"), args)

    return lower


def _chosen(comparison):
    return lambda builder, a, b: builder.select(builder.fcmp_ordered(comparison, b, a), b, a)


for _name, _operator in {"add": "fadd", "sub": "fsub", "mul": "fmul", "truediv": "fdiv"}.items():
    for _function in (getattr(operator, _name), getattr(operator, f"i{_name}")):
        _operation(_function, 2, lambda builder, a, b, name=_operator: getattr(builder, name)(a, b))
_operation(operator.neg, 1, lambda builder, a: builder.fneg(a))
_operation(operator.pos, 1, lambda builder, a: a)
_operation(abs, 1, _intrinsic("fabs"))
_operation(np.sqrt, 1, _intrinsic("sqrt"))
_operation(np.round, 1, _intrinsic("rint"))
_operation(np.floor, 1, _intrinsic("floor"))
_operation(max, 2, _chosen(">"))
_operation(min, 2, _chosen("<"))
for _name, _symbol in {"lt": "<", "le": "<=", "gt": ">", "ge": ">=", "eq": "=="}.items():
    _operation(getattr(operator, _name), 2, lambda builder, a, b, symbol=_symbol: builder.fcmp_ordered(symbol, a, b), result=mask)
_operation(operator.ne, 2, lambda builder, a, b: builder.fcmp_unordered("!=", a, b), result=mask)
_operation(operator.and_, 2, lambda builder, a, b: builder.and_(a, b), mask, mask)
_operation(operator.or_, 2, lambda builder, a, b: builder.or_(a, b), mask, mask)
_operation(operator.invert, 1, lambda builder, a: builder.not_(a), mask, mask)


def _of_library(function, count):
    """State a function of the mathematics library, which takes one lane after the other."""

    @infer_global(function)
    class Function(AbstractTemplate):
        def generic(self, args, kws):
            fits = len(args) == count and lanes in args
            return signature(lanes, *[lanes] * count) if fits else None

    @lower_builtin(function, *[lanes] * count)
    def _(context, builder, sig, args):
        scalar = signature(types.float64, *[types.float64] * count)
        context.typing_context.resolve_function_type(context.typing_context.resolve_value_type(function), scalar.args, {})
        call, result = context.get_function(function, scalar), ir.Constant(VECTOR, ir.Undefined)
        for lane in range(WIDTH):
            place = ir.Constant(ir.IntType(32), lane)
            result = builder.insert_element(result, call(builder, [builder.extract_element(each, place) for each in args]), place)
        return result


for _function, _count in {np.sin: 1, np.cos: 1, np.tanh: 1, np.exp: 1, np.hypot: 2, np.arctan2: 2}.items():
    _of_library(_function, _count)


@infer_global(operator.pow)
class _Power(AbstractTemplate):
    def generic(self, args, kws):
        square = args[0] == lanes and isinstance(args[1], types.IntegerLiteral) and args[1].literal_value == 2
        return signature(lanes, *args) if square else None


@lower_builtin(operator.pow, LanesType, types.IntegerLiteral)
def _square(context, builder, sig, args):
    return builder.fmul(args[0], args[0])


# ----------------------------------------------------------------------------------------------------------------- calls


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
