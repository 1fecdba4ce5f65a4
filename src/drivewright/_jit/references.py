"""How kernels get a NamedTuple of arrays: as one pointer to its members, not as hundreds of separate arguments.

numba hands over a tuple by its leaves: some forty arrays of seven words each in every call, and as many in every variable that holds the
tuple.  That is what compiling a kernel of a mechanism was spent on.  A class under `by_reference` is laid out once, where Python calls
a kernel; inside kernels it is a pointer, and a field is loaded where it is read.  The members do not change while a kernel runs (what the
arrays hold does), and LLVM is told so.
"""

import hashlib
from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.datamodel import models, registry
from numba.core.extending import NativeValue, infer_getattr, lower_getattr_generic, typeof_impl, unbox
from numba.core.imputils import impl_ret_borrowed
from numba.core.typing.templates import AttributeTemplate


class Reference(types.Type):
    """A pointer to the members of a NamedTuple of class `instance_class`; `types` are those of its fields."""

    def __init__(self, instance_class, members):
        self.instance_class, self.fields, self.types = instance_class, instance_class._fields, tuple(members)
        super().__init__(f"{instance_class.__module__}.{instance_class.__qualname__}&({', '.join(map(str, self.types))})")

    @property
    def mangling_args(self):
        """A short name in symbols, the same in every process."""
        return self.instance_class.__name__, (hashlib.sha256(self.name.encode()).hexdigest()[:16],)


def register(kind: type) -> None:
    """Let kernels take tuples of this class by reference."""
    typeof_impl.register(kind)(_type_of)


def _type_of(value: Any, context: Any) -> Reference:
    return Reference(type(value), [typeof_impl(member, context) for member in value])


@registry.register_default(Reference)
class _Pointer(models.PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, _layout(manager, kind).as_pointer())


def _layout(manager, kind):
    """The members in memory; references among them lie within."""
    return ir.LiteralStructType(
        [_layout(manager, each) if isinstance(each, Reference) else manager.lookup(each).get_data_type() for each in kind.types]
    )


@infer_getattr
class _Fields(AttributeTemplate):
    key = Reference

    def generic_resolve(self, reference, name):
        return reference.types[reference.fields.index(name)] if name in reference.fields else None


@lower_getattr_generic(Reference)
def _read(context, builder, reference, pointer, name):
    index = reference.fields.index(name)
    kind, place = reference.types[index], cgutils.gep_inbounds(builder, pointer, 0, index)
    if isinstance(kind, Reference):
        return place
    return impl_ret_borrowed(context, builder, kind, _constant(builder, context.data_model_manager[kind], place))


def _constant(builder, model, place):
    """Load what does not change while the kernel runs, part by part."""
    if not isinstance(model, (models.StructModel, models.UniTupleModel)):
        word = builder.load(place)
        word.set_metadata("invariant.load", builder.module.add_metadata([]))
        return model.from_data(builder, word)
    value = ir.Constant(model.get_value_type(), ir.Undefined)
    parts = model.inner_models() * (model.fe_type.count if isinstance(model, models.UniTupleModel) else 1)
    for i, part in enumerate(parts):
        value = builder.insert_value(value, _constant(builder, part, cgutils.gep_inbounds(builder, place, 0, i)), [i])
    return value


@unbox(Reference)
def _from_python(kind, tuple_object, c):
    place = cgutils.alloca_once(c.builder, _layout(c.context.data_model_manager, kind))
    failed, cleanups = cgutils.alloca_once_value(c.builder, cgutils.false_bit), []
    _lay_out(kind, tuple_object, place, c, failed, cleanups)

    def cleanup():
        for each in reversed(cleanups):
            each()

    return NativeValue(place, cleanup=cleanup if cleanups else None, is_error=c.builder.load(failed))


def _lay_out(kind, tuple_object, place, c, failed, cleanups):
    for i, each in enumerate(kind.types):
        member, there = c.pyapi.tuple_getitem(tuple_object, i), cgutils.gep_inbounds(c.builder, place, 0, i)
        if isinstance(each, Reference):
            _lay_out(each, member, there, c, failed, cleanups)
            continue
        if isinstance(each, types.Array):
            error = cgutils.is_not_null(c.builder, _adapt(c, member, there))
        else:
            native = c.unbox(each, member)
            error = native.is_error
            c.builder.store(c.context.data_model_manager[each].as_data(c.builder, native.value), there)
            if native.cleanup is not None:
                cleanups.append(native.cleanup)
        with c.builder.if_then(error, likely=False):
            c.builder.store(cgutils.true_bit, failed)


def _adapt(c, array, place):
    """Pointer, shape and strides of an array into `place`, without a count of references: the caller holds the tuple."""
    signature = ir.FunctionType(ir.IntType(32), [c.pyapi.pyobj, c.pyapi.voidptr])
    adapt = cgutils.get_or_insert_function(c.builder.module, signature, "numba_adapt_ndarray")
    return c.builder.call(adapt, (array, c.builder.bitcast(place, c.pyapi.voidptr)))
