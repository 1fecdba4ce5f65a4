"""Types of numbers, arrays, records and tuples in lanes, and how they lie in memory; see `_jit.lanes`."""

from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.datamodel import models, registry
from numba.core.extending import NativeValue, typeof_impl, unbox
from numba.core.typeconv.castgraph import Conversion
from numba.core.typing import templates

from drivewright._jit.lane_arrays import WIDTH, LaneArray, LaneNumber
from drivewright._jit.references import Reference

infer_global: Any = templates.infer_global  # whose own annotations know one of its two uses
TupleType: Any = types.BaseTuple  # whose parts can be iterated over, which its annotations do not say
DOUBLE, BIT, WORD = ir.DoubleType(), ir.IntType(1), ir.IntType(64)
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
    return NativeValue(load_lanes(c.builder, source.data), is_error=native.is_error, cleanup=native.cleanup)


def load_lanes(builder: Any, place: Any) -> Any:
    """The numbers at an address, which need not be aligned to more than one of them."""
    return builder.load(builder.bitcast(place, VECTOR.as_pointer()), align=8)
