"""Elements and members of what has lanes, or of one of its lanes; see `_jit.lanes`."""

import operator
from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.extending import infer_getattr, lower_builtin, lower_getattr_generic
from numba.core.imputils import lower_setattr_generic
from numba.core.typing.templates import AbstractTemplate, AttributeTemplate, signature

from drivewright._jit.lane_types import (
    DOUBLE,
    VECTOR,
    WORD,
    LaneArrayType,
    LaneRecordType,
    LanesType,
    LaneViewType,
    MaskType,
    TupleType,
    infer_global,
    is_laned,
    lane_of,
    load_lanes,
)
from drivewright._jit.references import Reference


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
    return builder.load(_at_lane(builder, place, array.lane)) if kind.view else load_lanes(builder, place)


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
