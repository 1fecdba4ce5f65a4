"""Compiled kernels: the one place that imports numba, and only when the first kernel is decorated.

`kernel`      compiles a function of numbers and arrays; cached on disk, runs without the interpreter lock.
`inner`, `outer`  the same for code that allocates nothing: no reference counts, which is what an inner loop over many arrays needs.
`generic`     declares a formula with one version per type of its first argument, a NamedTuple of parameters;
`implements`  states the version of one type.  The call works in plain Python and inside kernels alike, and a new type
              touches no kernel.  What a formula calls must be numpy, a kernel or a generic itself.
`plain`       the uncompiled twin of a kernel, for tests and for arguments that numba cannot compile.
`warmer`      marks a function that calls kernels once, so that `warm` can compile everything ahead of time.

numba's disk cache watches the file of the kernel alone and would answer with old numbers after an edit anywhere else.
Therefore each compiled kernel is filed under a hash of all sources it may depend on: its layer of this package and those below,
and the packages that bring the types of its arguments and their formulas.
"""

import atexit
import contextlib
import functools
import hashlib
import importlib
import shutil
import sys
import tempfile
import time
import types
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeVar, cast

from drivewright.errors import InputError

PACKAGE = __name__.partition(".")[0]
FunctionT = TypeVar("FunctionT", bound=Callable[..., Any])
_UNUSED_DAYS = 30
# Nothing below may import these, so that kernels below do not depend on them.
ABOVE = tuple(
    f"{PACKAGE}.{name}" for name in ("mechanisms", "oracles", "validation", "studies", "execution", "report", "view", "cli", "studio")
)
_generics = []
_overloaded = []  # the generics numba knows of
_warmers = []


def kernel(function: FunctionT) -> FunctionT:
    """Compile `function` with numba: cached on disk, without the interpreter lock, 1/0 = inf as in numpy, no fastmath.

    The original stays reachable as `.py_func`.
    """
    return _compiled(function, _nrt=True)  # said, for a callee inherits the caller's options otherwise


def inner(function: FunctionT) -> FunctionT:
    """A kernel for the innermost loops: it allocates nothing, and is inlined into its callers.

    Without reference counts a call with twenty arrays in its tuples costs nothing; with them it costs microseconds.
    """
    return _compiled(function, forceinline=True, _nrt=False)


def outer(function: FunctionT) -> FunctionT:
    """A kernel that allocates nothing, called from Python or with few arguments: as `inner`, but inlined only where that pays."""
    return _compiled(function, _nrt=False)


def _compiled(function: FunctionT, **options: Any) -> FunctionT:
    import numba

    compiled: Any = numba.njit(nogil=True, error_model="numpy", **options)(function)
    compiled._cache = _KernelCache(function)
    for dispatch in _generics:
        _overload_for_kernels(dispatch)
    return compiled


def generic(stub: FunctionT) -> FunctionT:
    """Declare a formula that depends on the type of its first argument; the stub gives name, arguments and docstring."""

    @functools.wraps(stub)
    def dispatch(first: Any, *rest: Any) -> Any:
        return formula_of(dispatch, type(first))(first, *rest)

    vars(dispatch)["formulas"] = {}
    _generics.append(dispatch)
    if _overloaded:
        _overload_for_kernels(dispatch)
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


def _overload_for_kernels(dispatch):
    """Let kernels call the generic: the version is chosen while compiling, from the type of the first argument."""
    if dispatch in _overloaded:
        return
    from numba.core.errors import TypingError
    from numba.extending import overload

    @overload(dispatch, strict=False, jit_options={"error_model": "numpy"})
    def choose(first, *rest):
        return formula_of(dispatch, getattr(first, "instance_class", first), TypingError)

    _overloaded.append(dispatch)


# ---------------------------------------------------------------------------------------------------------- disk cache


class _KernelCache:
    """numba's disk cache of one kernel, in one folder per set of sources that a signature depends on."""

    def __init__(self, function):
        self.function = function
        self.by_modules = {}

    @property
    def cache_path(self):
        return str(cache_folder())

    def load_overload(self, signature, target):
        return self._for(signature).load_overload(signature, target)

    def save_overload(self, signature, result):
        self._for(signature).save_overload(signature, result)

    def _for(self, signature):
        classes = set().union(*(_tuple_classes(each) for each in getattr(signature, "args", signature)))
        modules = frozenset({self.function.__module__}.union(*(_modules_of(each) for each in classes)))
        if modules not in self.by_modules:
            self.by_modules[modules] = self._open(modules)
        return self.by_modules[modules]

    def _open(self, modules):
        import numba
        from numba.core.caching import FunctionCache, NullCache

        if "__main__" in modules:  # a class of a script is another class in every run: its kernels would never be found again
            return NullCache()
        config: Any = vars(numba)["config"]  # filled from the environment when numba is imported
        other, config.CACHE_DIR = config.CACHE_DIR, str(_folder_of(modules))
        try:
            return FunctionCache(self.function)
        finally:
            config.CACHE_DIR = other  # kernels of other libraries stay where their users want them


def _tuple_classes(numba_type):
    """The NamedTuple classes in the type of one argument, nested ones included."""
    own = {numba_type.instance_class} if hasattr(numba_type, "instance_class") else set()
    return own.union(*(_tuple_classes(part) for part in getattr(numba_type, "types", ())))


def _modules_of(kind):
    """The modules that state the class and its formulas; a class made inside a function counts as a script's."""
    formulas = {dispatch.formulas[kind].__module__ for dispatch in _generics if kind in dispatch.formulas}
    return formulas | {"__main__" if "<locals>" in kind.__qualname__ else kind.__module__}


@functools.cache
def cache_folder() -> Path:
    """The folder of the compiled kernels: the user's cache folder, or a temporary one where that is not writable."""
    from platformdirs import user_cache_path

    folder = user_cache_path("drivewright", appauthor=False) / "kernels"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
    except OSError:
        # Fresh and private: what lies in a folder that others may write to must never be loaded as code.
        folder = Path(tempfile.mkdtemp(prefix="drivewright-"))
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
    _remove_unused(folder)
    return folder


@functools.cache
def _folder_of(modules):
    """The folder for kernels that depend on these modules' packages, stamped as used today."""
    packages = {PACKAGE}.union(module.partition(".")[0] for module in modules)
    digest = hashlib.sha256(" ".join(sorted(modules)).encode())
    for package in sorted(packages):
        whole = package != PACKAGE or any(module.startswith(ABOVE) for module in modules)
        digest.update(_hash_of(package, whole))
    folder = cache_folder() / digest.hexdigest()[:20]
    folder.mkdir(exist_ok=True)
    (folder / "last-used").touch()
    return folder


def _remove_unused(root):
    oldest = time.time() - _UNUSED_DAYS * 86400
    for stamp in root.glob("*/last-used"):
        with contextlib.suppress(FileNotFoundError):  # another process may be tidying up too
            if stamp.stat().st_mtime < oldest:
                shutil.rmtree(stamp.parent, ignore_errors=True)


@functools.cache
def _hash_of(package, whole=True):
    digest = hashlib.sha256()
    for path in _sources(package, whole):
        digest.update(path.as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.digest()


def _sources(package, whole=True):
    """The Python files of a package, or the one file of a module, in a fixed order; unless `whole`, without the layers ABOVE."""
    module = sys.modules[package]
    folders = getattr(module, "__path__", None)
    if folders is None:
        return [Path(module.__file__ or "")]
    files = ((Path(folder), file) for folder in folders for file in Path(folder).rglob("*.py"))
    above = {name.partition(".")[2] for name in ABOVE}
    return sorted(file for folder, file in files if whole or file.relative_to(folder).parts[0] not in above)


def _modules_with(text):
    """Names of this package's modules whose source contains `text` at the start of a line."""
    root = Path(__file__).parent
    for path in _sources(PACKAGE):
        if f"\n{text}" in path.read_text(encoding="utf-8"):
            yield ".".join((PACKAGE, *(part for part in path.relative_to(root).with_suffix("").parts if part != "__init__")))
