"""Compiled kernels: the one place that imports numba, and only when the first kernel is decorated.

`kernel`      compiles a function of numbers and arrays; cached on disk, runs without the interpreter lock.
`inner`       the same for code that allocates nothing: no reference counts, which is what an inner loop over many arrays needs.
`elementwise` the same for loops over the elements of arrays whose turns do not depend on each other: they become vector code.
`by_reference`  marks a NamedTuple of arrays that kernels get as one pointer.
`generic`     declares a formula with one version per type of its first argument, a NamedTuple of parameters;
`implements`  states the version of one type.  The call works in plain Python and inside kernels alike, and a new type
              touches no kernel.  What a formula calls must be numpy, a kernel or a generic itself.
`plain`       the uncompiled twin of a kernel, for tests and for arguments that numba cannot compile.
`per_lane`    marks an inner kernel full of branches, which runs lane by lane where many cases are computed at once;
`branch_free` one that has a form of its own there.
`warmer`      marks a function that calls kernels once, so that `warm` can compile everything ahead of time.

How a kernel is compiled: `_jit.compiling`; where it is kept: `_jit.disk_cache`; how tuples of arrays reach it: `_jit.references`; how it
computes many cases at once: `_jit.lanes`, with `lane_types`, `lane_storage` and `lane_arithmetic`, from the arrays of `lane_arrays`;
what a first run says meanwhile: `_jit.compilation`.
"""

import functools
import importlib
import sys
import time
import types
from collections.abc import Callable, Iterator
from typing import Any, TypeVar, cast

from drivewright._jit.disk_cache import PACKAGE, KernelCache, sources
from drivewright.errors import InputError

FunctionT = TypeVar("FunctionT", bound=Callable[..., Any])
KindT = TypeVar("KindT", bound=type)
_generics = []
_untold = []  # what is registered with numba when it is imported: generics, and classes that kernels get by reference
_warmers = []


def kernel(function: FunctionT) -> FunctionT:
    """Compile `function` with numba: cached on disk, without the interpreter lock, 1/0 = inf as in numpy, no fastmath.

    The original stays reachable as `.py_func`.
    """
    return _compiled(function, _nrt=True)  # said, for a callee inherits the caller's options otherwise


def inner(function: FunctionT) -> FunctionT:
    """A kernel that allocates nothing: without reference counts a call with twenty arrays in its tuples costs nothing; with them
    it costs microseconds."""
    return _compiled(function, _nrt=False)


def elementwise(function: FunctionT) -> FunctionT:
    """An inner kernel over the elements of arrays: no turn of its loops writes what another one reads or writes.

    What it calls has numbers for arguments, no arrays.  LLVM is told so, and makes vector code of its loops; else it had to compare the
    places of all arrays in every call, and with more than a dozen of them it leaves the loop as it is.
    """
    vars(function)["elementwise"] = True
    return inner(function)


def per_lane(function: FunctionT) -> FunctionT:
    """An inner kernel full of branches: where its arguments are many cases in lanes (see `_jit.lanes`), it is called lane by lane."""
    vars(function)["in_lanes"] = True
    return inner(function)


def branch_free(function: FunctionT) -> FunctionT:
    """An inner kernel that has a form of its own in `_jit.lanes`."""
    vars(function)["in_lanes"] = f"{function.__name__}_in_lanes"
    return inner(function)


def _compiled(function: FunctionT, **options: Any) -> FunctionT:
    import numba

    if vars(numba)["config"].DISABLE_JIT:
        return function
    from drivewright._jit import compiling

    compiled: Any = compiling.Kernel(function, targetoptions=compiling.OPTIONS | options)
    compiled._cache = KernelCache(function, _formulas_for)
    _tell_numba()
    return compiled


def by_reference(kind: KindT) -> KindT:
    """Decorator of a NamedTuple class: kernels get its tuples as one pointer, and read a field where they name it.

    For tuples of arrays; they are neither made nor indexed inside kernels.
    """
    _tell_numba_of(kind)
    return kind


def _tell_numba_of(what):
    """At once where kernels are compiled already, else with the first of them."""
    _untold.append(what)
    if f"{__name__}.compiling" in sys.modules:
        _tell_numba()


def _tell_numba():
    from drivewright._jit import compiling, references

    while _untold:
        what = _untold.pop(0)
        if isinstance(what, type):
            references.register(what)
        else:
            compiling.choose_by_type(what, functools.partial(_formula_in_kernel, what))


def _formula_in_kernel(dispatch, first):
    """The formula for the numba type of a first argument."""
    from numba.core.errors import TypingError

    return formula_of(dispatch, getattr(first, "instance_class", first), TypingError)


def _formulas_for(kind):
    return [formulas_of(dispatch)[kind] for dispatch in _generics if kind in formulas_of(dispatch)]


def generic(stub: FunctionT) -> FunctionT:
    """Declare a formula that depends on the type of its first argument; the stub gives name, arguments and docstring."""

    @functools.wraps(stub)
    def dispatch(first: Any, *rest: Any) -> Any:
        return formula_of(dispatch, type(first))(first, *rest)

    vars(dispatch)["formulas"] = {}
    _generics.append(dispatch)
    _tell_numba_of(dispatch)
    return cast(FunctionT, dispatch)


def implements(dispatch: Callable[..., Any], kind: type) -> Callable[[FunctionT], FunctionT]:
    """Decorator: the version of the generic formula `dispatch` for a first argument of type `kind`, a NamedTuple class."""

    formulas = formulas_of(dispatch)

    def register(formula: FunctionT) -> FunctionT:
        if kind in formulas:
            raise InputError(f"{dispatch.__name__}: {kind.__name__} already has a formula; give the new one a type of its own.")
        formulas[kind] = formula
        return formula

    return register


def formulas_of(dispatch: Callable[..., Any]) -> dict[type, Callable[..., Any]]:
    """The formulas of a generic by the type of their first argument; others may add to it through `implements` alone."""
    return vars(dispatch)["formulas"]


def formula_of(dispatch: Callable[..., Any], kind: Any, error: type[Exception] = InputError) -> Callable[..., Any]:
    """The version of a generic formula for the type `kind`; raises `error`, naming the known ones, where there is none."""
    formulas = formulas_of(dispatch)
    if kind not in formulas:
        known = ", ".join(sorted(each.__name__ for each in formulas)) or "none yet"
        raise error(
            f"{dispatch.__name__}: no formula for a {getattr(kind, '__name__', kind)}; it has one for: {known}. "
            f"Import the module that states it, or write one under @implements({dispatch.__name__}, ...)."
        )
    return formulas[kind]


@functools.cache
def plain(compiled: Callable[..., Any]) -> Callable[..., Any]:
    """The kernel in plain Python, together with the kernels and generics that it calls by name; a generic with all its formulas."""
    if hasattr(compiled, "formulas"):
        return lambda first, *rest: plain(formula_of(compiled, type(first)))(first, *rest)
    function: Any = getattr(compiled, "py_func", compiled)  # under NUMBA_DISABLE_JIT=1 kernels are plain already
    names = {name: function.__globals__.get(name) for name in function.__code__.co_names}
    callees = {name: plain(value) for name, value in names.items() if hasattr(value, "py_func") or hasattr(value, "formulas")}
    scope = function.__globals__ | callees
    return types.FunctionType(function.__code__, scope, function.__name__, function.__defaults__, function.__closure__)


def warmer(function: FunctionT) -> FunctionT:
    """Mark a function without arguments that calls kernels with typical argument types."""
    _warmers.append(function)
    return function


def warm() -> Iterator[tuple[str, float]]:
    """Compile every kernel that has a warmer; yields (name, seconds) one by one, so that progress can be shown."""
    for module in _modules_with("@warmer"):
        importlib.import_module(module)
    for function in _warmers:
        start = time.perf_counter()
        function()
        yield f"{function.__module__}.{function.__name__}", time.perf_counter() - start


def _modules_with(text):
    """Names of this package's modules whose source contains `text` at the start of a line."""
    for name, path in sources(PACKAGE):
        if f"\n{text}" in path.read_text(encoding="utf-8"):
            yield ".".join((PACKAGE, *(part for part in name.removesuffix(".py").split("/") if part != "__init__")))
