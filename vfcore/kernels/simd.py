"""SIMD vectors for the kernels: the type, its operators, and loads and stores.

One file for three things that only make sense together: a numba type, its arithmetic and its memory access.

A ``Vec`` holds one number for each of ``count`` neighbours (nodes along x, or folds), and one instruction works on all
of them. ``load(array, at, count)`` reads ``count`` neighbours of a flat array and ``store`` writes them. +, −, ×, ÷, <,
> and the functions below act elementwise. A scalar in an expression with a Vec is broadcast, in the precision of the
Vec. So a law of flow.py, contact.py or membrane.py is written once and works for a float, for columns of one fold, or
for one column of several folds, in double or single precision.

Compiled, a Vec is an LLVM vector: it lives in registers, so speed does not depend on which loops the compiler can
vectorise. Interpreted (NUMBA_DISABLE_JIT=1), it is a numpy array.
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
CACHE_LINE = 64  # bytes


class Vec(types.Type):
    """``count`` floats of type ``dtype``."""

    def __init__(self, dtype, count):
        self.dtype, self.count = dtype, count
        super().__init__(name=f"vec({dtype} x {count})")


class Mask(types.Type):
    """``count`` booleans, the result of a comparison."""

    def __init__(self, count):
        self.count = count
        super().__init__(name=f"mask({count})")


@register_model(Vec)
class _VecModel(models.PrimitiveModel):
    def __init__(self, manager, vec):
        element = manager.lookup(vec.dtype).get_value_type()
        super().__init__(manager, vec, ir.VectorType(element, vec.count))


@register_model(Mask)
class _MaskModel(models.PrimitiveModel):
    def __init__(self, manager, mask):
        super().__init__(manager, mask, ir.VectorType(ir.IntType(1), mask.count))


NUMBER = (Vec, types.Float, types.Integer)
CONDITION = (Mask, types.Boolean)


def _widest(arguments):
    """The Vec type among the argument types, or double precision if there is none."""
    return next((kind for kind in arguments if isinstance(kind, Vec)), types.float64)


def _as(kind, context, builder, value, source):
    """``value`` of type ``source`` converted to ``kind``; a scalar is broadcast."""
    if not isinstance(kind, Vec):
        return context.cast(builder, value, source, kind)
    if isinstance(source, Vec):
        return value
    number = context.cast(builder, value, source, kind.dtype)
    vector = context.get_value_type(kind)
    first = builder.insert_element(ir.Constant(vector, ir.Undefined), number, INDEX(0))
    return builder.shuffle_vector(first, first, ir.Constant(ir.VectorType(INDEX, kind.count), [0] * kind.count))


def _compiles_to(function, emit, result=lambda kind: kind, condition=False):
    """Register the typing of ``function``; return a lowering that calls ``emit(builder, *values)``.

    With ``condition`` the first argument is a mask. ``result`` maps the Vec type to the type of the result.
    """
    first = 1 if condition else 0

    @infer_global(function)
    class _Types(AbstractTemplate):
        def generic(self, args, kws):
            fits = all(isinstance(kind, NUMBER) for kind in args[first:])
            if fits and not kws and all(isinstance(kind, CONDITION) for kind in args[:first]):
                return signature(result(_widest(args)), *args)

    def lower(context, builder, sig, args):
        kind = _widest(sig.args)
        numbers = [_as(kind, context, builder, v, t) for v, t in zip(args[first:], sig.args[first:], strict=True)]
        return emit(builder, *args[:first], *numbers)

    return lower


def _operator(symbol, emit, result=lambda kind: kind):
    lower = _compiles_to(symbol, emit, result)
    for left, right in ((a, b) for a in NUMBER for b in NUMBER if Vec in (a, b)):
        lower_builtin(symbol, left, right)(lower)


def _arithmetic(name):
    # Instructions that have a flag get no others from numba's fastmath pass, so these sums are not reordered.
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
# No += or other in-place operators: interpreted, they would change a numpy array that another name refers to.


def maximum(a, b):
    """The larger of the two; ``b`` if the comparison is unordered (NaN)."""
    return np.where(a > b, a, b)


def minimum(a, b):
    """The smaller of the two; ``b`` if the comparison is unordered (NaN)."""
    return np.where(a < b, a, b)


def select(mask, a, b):
    """``a`` where ``mask`` is true, else ``b``."""
    return np.where(mask, a, b)


def square_root(a):
    """√a."""
    return np.sqrt(a)


def multiply_add(a, b, c):
    """a b + c, fused where the processor can, even if the product a b is also used elsewhere."""
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
    conditions = CONDITION if condition else (None,)
    for first in conditions:
        for kinds in np.ndindex(*(len(NUMBER),) * arity):
            lower_builtin(function, *([first] if first else []), *(NUMBER[k] for k in kinds))(lower)


_function(maximum, lambda builder, a, b: builder.select(builder.fcmp_ordered(">", a, b), a, b), 2)
_function(minimum, lambda builder, a, b: builder.select(builder.fcmp_ordered("<", a, b), a, b), 2)
_function(select, lambda builder, mask, a, b: builder.select(mask, a, b), 2, condition=True)
_function(square_root, _intrinsic("sqrt"), 1)
_function(multiply_add, _intrinsic("fmuladd"), 3)


def aligned_zeros(size, dtype):
    """Zeros (size,) aligned to a cache line. A Vec that crosses two cache lines takes twice the time to load."""
    count = size * np.dtype(dtype).itemsize
    raw = np.zeros(count + CACHE_LINE, np.uint8)
    start = -raw.ctypes.data % CACHE_LINE
    return raw[start : start + count].view(dtype)


def paired(a, b, k):
    """Sums of neighbours that are ``k`` apart, of ``a`` and then of ``b``; ``k`` is a constant, 1, 2, 4, …

    Vectors count in groups of 2k: element i of the result is the sum of elements i and i + k of a group. With k = 4,
    2 and 1 in turn, eight vectors of eight become one, of their sums.
    """
    return np.concatenate([vec.reshape(-1, 2, k).sum(axis=1).reshape(-1) for vec in (a, b)])


def load(array, at, count):
    """``array[at : at + count]`` of a flat array; ``count`` is a constant."""
    return array[at : at + count].copy()


def store(array, at, vec):
    """``array[at : at + count] = vec``."""
    array[at : at + len(vec)] = vec


def width(vec):
    """Number of elements; a constant of the compiled code."""
    return len(vec)


def load_param(array, k, folds, count):
    """Parameter ``k``: one scalar if ``folds`` is 1, else ``count`` numbers, one per fold."""
    return array[k] if folds == 1 else array[k * count : k * count + count].copy()


def broadcast(number, array, count):
    """``count`` copies of one number, in the precision of ``array``."""
    return np.full(count, number, array.dtype)


def extract(vec, k):
    """Element ``k``."""
    return vec[k]


def all_of(mask):
    """True if every element of the mask is true."""
    return bool(np.all(mask))


def hsum(vec):
    """Horizontal sum by halving: elements k and k + count/2 are added first, then the same with half the count."""
    while len(vec) > 1:
        vec = vec[: len(vec) // 2] + vec[len(vec) // 2 :]
    return vec[0]


@infer_global(load)
class _LoadTypes(AbstractTemplate):
    prefer_literal = True

    def generic(self, args, kws):
        array, at, count = args
        if isinstance(count, types.IntegerLiteral):
            return signature(Vec(array.dtype, count.literal_value), array, types.intp, count)


@infer_global(store)
class _StoreTypes(AbstractTemplate):
    def generic(self, args, kws):
        array, at, vec = args
        return signature(types.none, array, types.intp, vec)


@infer_global(width)
class _WidthTypes(AbstractTemplate):
    def generic(self, args, kws):
        return signature(types.literal(args[0].count), *args)


@lower_builtin(width, Vec)
def _width(context, builder, sig, args):
    return context.get_constant(types.intp, sig.args[0].count)


@infer_global(load_param)
class _LoadParamTypes(AbstractTemplate):
    prefer_literal = True

    def generic(self, args, kws):
        array, k, folds, count = args
        if isinstance(folds, types.IntegerLiteral) and isinstance(count, types.IntegerLiteral):
            one = folds.literal_value == 1
            result = array.dtype if one else Vec(array.dtype, count.literal_value)
            return signature(result, array, types.intp, folds, count)


@infer_global(broadcast)
class _BroadcastTypes(AbstractTemplate):
    prefer_literal = True

    def generic(self, args, kws):
        number, array, count = args
        if isinstance(count, types.IntegerLiteral):
            return signature(Vec(array.dtype, count.literal_value), types.float64, array, count)


@infer_global(hsum)
class _HsumTypes(AbstractTemplate):
    def generic(self, args, kws):
        return signature(args[0].dtype, *args)


@lower_builtin(hsum, Vec)
def _hsum(context, builder, sig, args):
    value, count = args[0], sig.args[0].count
    while count > 1:
        count //= 2
        low, high = (
            ir.Constant(ir.VectorType(INDEX, count), list(range(start, start + count))) for start in (0, count)
        )
        value = builder.fadd(builder.shuffle_vector(value, value, low), builder.shuffle_vector(value, value, high))
    return builder.extract_element(value, INDEX(0))


@infer_global(paired)
class _PairedTypes(AbstractTemplate):
    prefer_literal = True

    def generic(self, args, kws):
        a, b, k = args
        if isinstance(a, Vec) and a == b and isinstance(k, types.IntegerLiteral):
            return signature(a, a, b, k)


@lower_builtin(paired, Vec, Vec, types.IntegerLiteral)
def _paired(context, builder, sig, args):
    count, k = sig.return_type.count, sig.args[2].literal_value
    starts = [group + i for group in range(0, 2 * count, 2 * k) for i in range(k)]
    mask = ir.VectorType(INDEX, count)
    low, high = (
        builder.shuffle_vector(args[0], args[1], ir.Constant(mask, [at + shift for at in starts])) for shift in (0, k)
    )
    return builder.fadd(low, high, flags=("contract",))


@infer_global(all_of)
class _AllOfTypes(AbstractTemplate):
    def generic(self, args, kws):
        return signature(types.boolean, *args)


@lower_builtin(all_of, Mask)
def _all_of(context, builder, sig, args):
    bits = ir.IntType(sig.args[0].count)
    return builder.icmp_unsigned("==", builder.bitcast(args[0], bits), bits(-1))


@infer_global(extract)
class _ExtractTypes(AbstractTemplate):
    def generic(self, args, kws):
        vec, k = args
        return signature(vec.dtype, vec, types.intp)


def _pointer(context, builder, array_type, array, at, count):
    """Pointer to element 0. Under NUMBA_BOUNDSCHECK the first and the last element must lie within the array."""
    view = make_array(array_type)(context, builder, array)
    if context.enable_boundscheck:
        (size,) = cgutils.unpack_tuple(builder, view.shape, 1)
        for offset in (0, count - 1):
            cgutils.do_boundscheck(context, builder, builder.add(at, at.type(offset)), size)
    vector = ir.VectorType(context.get_value_type(array_type.dtype), count)
    return builder.bitcast(builder.gep(view.data, [at]), vector.as_pointer())


@lower_builtin(load, types.Array, types.Integer, types.IntegerLiteral)
def _load(context, builder, sig, args):
    vec = sig.return_type
    pointer = _pointer(context, builder, sig.args[0], args[0], args[1], vec.count)
    return builder.load(pointer, align=vec.dtype.bitwidth // 8)


@lower_builtin(load_param, types.Array, types.Integer, types.IntegerLiteral, types.IntegerLiteral)
def _load_param(context, builder, sig, args):
    kind, count = sig.return_type, getattr(sig.return_type, "count", 1)
    at = builder.mul(args[1], args[1].type(count))
    pointer = _pointer(context, builder, sig.args[0], args[0], at, count)
    if count == 1:
        pointer = builder.bitcast(pointer, context.get_value_type(kind).as_pointer())
    return builder.load(pointer, align=getattr(kind, "dtype", kind).bitwidth // 8)


@lower_builtin(store, types.Array, types.Integer, Vec)
def _store(context, builder, sig, args):
    vec = sig.args[2]
    pointer = _pointer(context, builder, sig.args[0], args[0], args[1], vec.count)
    builder.store(args[2], pointer, align=vec.dtype.bitwidth // 8)
    return context.get_dummy_value()


@lower_builtin(broadcast, types.Float, types.Array, types.IntegerLiteral)
def _broadcast(context, builder, sig, args):
    return _as(sig.return_type, context, builder, args[0], sig.args[0])


@lower_builtin(extract, Vec, types.Integer)
def _extract(context, builder, sig, args):
    return builder.extract_element(args[0], args[1])
