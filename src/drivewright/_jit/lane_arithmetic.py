"""Arithmetic of lanes: that of single numbers, to the bit; see `_jit.lanes`."""

import operator

import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.core.extending import lower_builtin, lower_cast
from numba.core.typing.templates import AbstractTemplate, signature

from drivewright._jit.lane_arrays import WIDTH
from drivewright._jit.lane_types import MASK, VECTOR, LanesType, MaskType, infer_global, lanes, mask


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
