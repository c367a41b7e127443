"""Numbers side by side; longer than other files: types, operators and memory of one new kind of number.

Lanes hold one number for each of a few neighbours (nodes along x, or postures), worked on by one instruction.
``load(array, at, count)`` reads ``count`` neighbours of a flat array, ``store`` writes them; + − × ÷, < and > and the
functions below act on each lane alone. A plain number among lanes stands for the same in every lane, in their
precision. So a law of flow.py, contact.py or membrane.py is written once and serves a float, the columns of one fold,
or one column of several folds, in double or single precision.

Compiled, lanes are vectors of LLVM: they live in registers, and no loop around them has to be of a kind that the
compiler knows how to vectorise. Interpreted (NUMBA_DISABLE_JIT=1) they are numpy arrays.
"""

import operator

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.typing import signature
from numba.core.typing.templates import AbstractTemplate, infer_global
from numba.extending import lower_builtin, models, register_model
from numba.np.arrayobj import make_array

INDEX = ir.IntType(32)


class Lanes(types.Type):
    """``count`` floats side by side."""

    def __init__(self, dtype, count):
        self.dtype, self.count = dtype, count
        super().__init__(name=f"lanes({dtype} x {count})")


class Mask(types.Type):
    """``count`` truth values side by side."""

    def __init__(self, count):
        self.count = count
        super().__init__(name=f"mask({count})")


@register_model(Lanes)
class _LanesModel(models.PrimitiveModel):
    def __init__(self, manager, lanes):
        element = manager.lookup(lanes.dtype).get_value_type()
        super().__init__(manager, lanes, ir.VectorType(element, lanes.count))


@register_model(Mask)
class _MaskModel(models.PrimitiveModel):
    def __init__(self, manager, mask):
        super().__init__(manager, mask, ir.VectorType(ir.IntType(1), mask.count))


NUMBER = (Lanes, types.Float, types.Integer)
CHOICE = (Mask, types.Boolean)


def _widest(arguments):
    """The lanes among types of arguments, or double precision."""
    return next((kind for kind in arguments if isinstance(kind, Lanes)), types.float64)


def _as(kind, context, builder, value, source):
    """``value`` of type ``source`` as ``kind``: one number is put in every lane."""
    if not isinstance(kind, Lanes):
        return context.cast(builder, value, source, kind)
    if isinstance(source, Lanes):
        return value
    number = context.cast(builder, value, source, kind.dtype)
    vector = context.get_value_type(kind)
    first = builder.insert_element(ir.Constant(vector, ir.Undefined), number, INDEX(0))
    return builder.shuffle_vector(first, first, ir.Constant(ir.VectorType(INDEX, kind.count), [0] * kind.count))


def _compiles_to(function, emit, result=lambda kind: kind, condition=False):
    """Compile ``function`` to ``emit(builder, *values)``; with ``condition`` the first argument is a mask."""
    first = 1 if condition else 0

    @infer_global(function)
    class _Types(AbstractTemplate):
        def generic(self, args, kws):
            fits = all(isinstance(kind, NUMBER) for kind in args[first:])
            if fits and not kws and all(isinstance(kind, CHOICE) for kind in args[:first]):
                return signature(result(_widest(args)), *args)

    def lower(context, builder, sig, args):
        kind = _widest(sig.args)
        numbers = [_as(kind, context, builder, v, t) for v, t in zip(args[first:], sig.args[first:], strict=True)]
        return emit(builder, *args[:first], *numbers)

    return lower


def _operator(symbol, emit, result=lambda kind: kind):
    lower = _compiles_to(symbol, emit, result)
    for left, right in ((a, b) for a in NUMBER for b in NUMBER if Lanes in (a, b)):
        lower_builtin(symbol, left, right)(lower)


def _arithmetic(name):
    return lambda builder, a, b: getattr(builder, name)(a, b, flags=("contract",))


def _mask(kind):
    return Mask(kind.count)


for _symbol, _name in (
    (operator.add, "fadd"),
    (operator.sub, "fsub"),
    (operator.mul, "fmul"),
    (operator.truediv, "fdiv"),
):
    _operator(_symbol, _arithmetic(_name))
_operator(operator.lt, lambda builder, a, b: builder.fcmp_ordered("<", a, b), _mask)
_operator(operator.gt, lambda builder, a, b: builder.fcmp_ordered(">", a, b), _mask)
# No += and the like: among numpy arrays they would write into another name's numbers.


def maximum(a, b):
    """The larger; ``b`` where the two do not compare."""
    return np.where(a > b, a, b)


def minimum(a, b):
    """The smaller; ``b`` where the two do not compare."""
    return np.where(a < b, a, b)


def where(mask, a, b):
    """``a`` where ``mask`` is true, else ``b``."""
    return np.where(mask, a, b)


def square_root(a):
    """√a."""
    return np.sqrt(a)


def multiply_add(a, b, c):
    """a b + c, in one operation where the processor has it, even if a b is wanted elsewhere too."""
    return a * b + c


def _intrinsic(name):
    def emit(builder, *values):
        kind = values[0].type
        count = f"v{kind.count}" if isinstance(kind, ir.VectorType) else ""
        element = "f64" if ir.DoubleType() in (kind, getattr(kind, "element", None)) else "f32"
        function = ir.FunctionType(kind, [kind] * len(values))
        called = cgutils.get_or_insert_function(builder.module, function, f"llvm.{name}.{count}{element}")
        return builder.call(called, values)

    return emit


def _function(function, emit, arity, condition=False):
    lower = _compiles_to(function, emit, condition=condition)
    choices = CHOICE if condition else (None,)
    for choice in choices:
        for kinds in np.ndindex(*(len(NUMBER),) * arity):
            lower_builtin(function, *([choice] if choice else []), *(NUMBER[k] for k in kinds))(lower)


_function(maximum, lambda builder, a, b: builder.select(builder.fcmp_ordered(">", a, b), a, b), 2)
_function(minimum, lambda builder, a, b: builder.select(builder.fcmp_ordered("<", a, b), a, b), 2)
_function(where, lambda builder, mask, a, b: builder.select(mask, a, b), 2, condition=True)
_function(square_root, _intrinsic("sqrt"), 1)
_function(multiply_add, _intrinsic("fmuladd"), 3)


def load(array, at, count):
    """``array[at : at + count]`` of a flat array; ``count`` is a constant."""
    return array[at : at + count].copy()


def store(array, at, lanes):
    """``array[at : at + count] = lanes``."""
    array[at : at + len(lanes)] = lanes


def each(array, k, postures, count):
    """Constant ``k`` of each lane: one number for the columns of one fold, ``count`` numbers for as many folds."""
    return array[k] if postures == 1 else array[k * count : k * count + count].copy()


def spread(number, array, count):
    """One number in ``count`` lanes, in the precision of ``array``."""
    return np.full(count, number, array.dtype)


def lane(lanes, k):
    """The number in lane ``k``."""
    return lanes[k]


def all_of(mask):
    """Whether the mask is true in every lane."""
    return bool(np.all(mask))


def total(lanes):
    """The sum over the lanes, halves first: lane k and lane k + count/2, and so on."""
    while len(lanes) > 1:
        lanes = lanes[: len(lanes) // 2] + lanes[len(lanes) // 2 :]
    return lanes[0]


@infer_global(load)
class _LoadTypes(AbstractTemplate):
    prefer_literal = True

    def generic(self, args, kws):
        array, at, count = args
        if isinstance(count, types.IntegerLiteral):
            return signature(Lanes(array.dtype, count.literal_value), array, types.intp, count)


@infer_global(store)
class _StoreTypes(AbstractTemplate):
    def generic(self, args, kws):
        array, at, lanes = args
        return signature(types.none, array, types.intp, lanes)


@infer_global(each)
class _EachTypes(AbstractTemplate):
    prefer_literal = True

    def generic(self, args, kws):
        array, k, postures, count = args
        if isinstance(postures, types.IntegerLiteral) and isinstance(count, types.IntegerLiteral):
            one = postures.literal_value == 1
            result = array.dtype if one else Lanes(array.dtype, count.literal_value)
            return signature(result, array, types.intp, postures, count)


@infer_global(spread)
class _SpreadTypes(AbstractTemplate):
    prefer_literal = True

    def generic(self, args, kws):
        number, array, count = args
        if isinstance(count, types.IntegerLiteral):
            return signature(Lanes(array.dtype, count.literal_value), types.float64, array, count)


@infer_global(total)
class _TotalTypes(AbstractTemplate):
    def generic(self, args, kws):
        return signature(args[0].dtype, *args)


@lower_builtin(total, Lanes)
def _total(context, builder, sig, args):
    value, count = args[0], sig.args[0].count
    while count > 1:
        count //= 2
        low, high = (
            ir.Constant(ir.VectorType(INDEX, count), list(range(start, start + count))) for start in (0, count)
        )
        value = builder.fadd(builder.shuffle_vector(value, value, low), builder.shuffle_vector(value, value, high))
    return builder.extract_element(value, INDEX(0))


@infer_global(all_of)
class _AllOfTypes(AbstractTemplate):
    def generic(self, args, kws):
        return signature(types.boolean, *args)


@lower_builtin(all_of, Mask)
def _all_of(context, builder, sig, args):
    bits = ir.IntType(sig.args[0].count)
    return builder.icmp_unsigned("==", builder.bitcast(args[0], bits), bits(-1))


@infer_global(lane)
class _LaneTypes(AbstractTemplate):
    def generic(self, args, kws):
        lanes, k = args
        return signature(lanes.dtype, lanes, types.intp)


def _pointer(context, builder, array_type, array, at, count):
    """Where lane 0 is; under NUMBA_BOUNDSCHECK the first and the last lane must lie in the array."""
    view = make_array(array_type)(context, builder, array)
    if context.enable_boundscheck:
        (size,) = cgutils.unpack_tuple(builder, view.shape, 1)
        for offset in (0, count - 1):
            cgutils.do_boundscheck(context, builder, builder.add(at, at.type(offset)), size)
    vector = ir.VectorType(context.get_value_type(array_type.dtype), count)
    return builder.bitcast(builder.gep(view.data, [at]), vector.as_pointer())


@lower_builtin(load, types.Array, types.Integer, types.IntegerLiteral)
def _load(context, builder, sig, args):
    lanes = sig.return_type
    pointer = _pointer(context, builder, sig.args[0], args[0], args[1], lanes.count)
    return builder.load(pointer, align=lanes.dtype.bitwidth // 8)


@lower_builtin(each, types.Array, types.Integer, types.IntegerLiteral, types.IntegerLiteral)
def _each(context, builder, sig, args):
    kind, count = sig.return_type, getattr(sig.return_type, "count", 1)
    at = builder.mul(args[1], args[1].type(count))
    pointer = _pointer(context, builder, sig.args[0], args[0], at, count)
    if count == 1:
        pointer = builder.bitcast(pointer, context.get_value_type(kind).as_pointer())
    return builder.load(pointer, align=getattr(kind, "dtype", kind).bitwidth // 8)


@lower_builtin(store, types.Array, types.Integer, Lanes)
def _store(context, builder, sig, args):
    lanes = sig.args[2]
    pointer = _pointer(context, builder, sig.args[0], args[0], args[1], lanes.count)
    builder.store(args[2], pointer, align=lanes.dtype.bitwidth // 8)
    return context.get_dummy_value()


@lower_builtin(spread, types.Float, types.Array, types.IntegerLiteral)
def _spread(context, builder, sig, args):
    return _as(sig.return_type, context, builder, args[0], sig.args[0])


@lower_builtin(lane, Lanes, types.Integer)
def _lane(context, builder, sig, args):
    return builder.extract_element(args[0], args[1])
