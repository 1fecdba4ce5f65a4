"""The machine code of the kernels on the disk, filed under a hash of all sources that a kernel may depend on.

A kernel depends on its layer of this package and those below, and on the packages that bring the types of its arguments and their formulas.
(numba's own cache watches the file of the kernel alone and would answer with old numbers after an edit anywhere else.)  There is one file
for each kernel, signature and processor; it begins with its checksum, and one that is damaged is compiled again.

While a process compiles a kernel it holds a lock beside the file; others wait for the file instead of compiling the same.

A wheel may bring kernels along (`SHIPPED`), compiled for a processor that many can stand in for (`BASELINE`); those are taken where the
processor at hand can, and where Python, numba and the sources are the same.
"""

import atexit
import contextlib
import functools
import hashlib
import os
import pickle
import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

from drivewright import atomic
from drivewright._jit import compilation

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None

PACKAGE = __name__.partition(".")[0]
UNUSED_DAYS = 30
WAIT, PATIENCE = 0.02, 120.0  # seconds between two looks at what another process compiles, and until this one compiles it itself
# Nothing below may import these, so that kernels below do not depend on them.
ABOVE = tuple(
    f"{PACKAGE}.{name}" for name in ("mechanisms", "oracles", "validation", "studies", "execution", "report", "view", "cli", "studio")
)
PRIVATE = "drivewright-"  # how the name of a folder begins that goes with the process
SHIPPED = Path(__file__).parent / "shipped"
BASELINE = "x86-64-v3"  # processors since about 2013; LLVM's name for what these features make
FEATURES = ("avx", "avx2", "bmi", "bmi2", "f16c", "fma", "lzcnt", "movbe", "popcnt", "sse4.2", "xsave")


class KernelCache:
    """The files of one kernel, for numba's dispatcher."""

    def __init__(self, function: Callable[..., Any], formulas_for: Callable[[type], Iterable[Callable[..., Any]]]) -> None:
        """`formulas_for` gives the formulas that are chosen by a class."""
        self.function, self.formulas_for = function, formulas_for
        self._lock: int | None = None  # held while a kernel is compiled; it ends with the process, however that ends
        self.name = f"{function.__module__.removeprefix(f'{PACKAGE}.')}.{function.__qualname__}"

    @property
    def cache_path(self) -> str:
        """The folder of all kernels."""
        return str(cache_folder())

    def load_overload(self, signature: Any, target: Any) -> Any:
        """The compiled kernel for a signature, or None."""
        from numba.core.compiler import CompileResult
        from numba.core.runtime.nrt import rtsys

        files = list(self._files(signature, target.codegen()))
        code = next(filter(None, map(_read, files)), None)
        if code is not None:
            compilation.tell(self.name, compilation.FOUND)
        else:
            compilation.tell(self.name, compilation.BEGUN)
            code = self._from_another_process(files[0]) if files else None
            if code is None:
                return None
            compilation.tell(self.name, compilation.DONE)
        rtsys.initialize(target)  # all that machine code needs; what code is generated from takes half a second to register
        return CompileResult._rebuild(target, *pickle.loads(code))

    def _from_another_process(self, file):
        """What another process is compiling at this moment, once it is there; None where this one is to compile it, and holds the lock."""
        with contextlib.suppress(OSError):  # no locks on this disk: two may compile the same
            lock, began = os.open(file.with_suffix(".lock"), os.O_RDWR | os.O_CREAT, 0o600), time.monotonic()
            while time.monotonic() - began < PATIENCE and not _takes(lock):
                if not compilation.work_meanwhile():
                    time.sleep(WAIT)
            self._lock = lock
        return _read(file)

    def release(self) -> None:
        """Let others at the kernel that this process has compiled, or could not."""
        if self._lock is not None:
            os.close(self._lock)
            self._lock = None

    def save_overload(self, signature: Any, result: Any) -> None:
        """Keep a compiled kernel, where that can be."""
        compilation.tell(self.name, compilation.DONE)
        if result.library.has_dynamic_globals:  # addresses in this process
            return
        for file in self._files(signature, result.target_context.codegen()):
            with contextlib.suppress(OSError):  # a full disk costs time, not the result
                _write(file, result)
            return

    def _files(self, signature, codegen) -> Iterator[Path]:
        """Where the kernel may be: first the user's own file, which is the one to write; none for a class of a script, which is another
        class in every run."""
        classes = set().union(*(_tuple_classes(each) for each in getattr(signature, "args", signature)))
        modules = frozenset({self.function.__module__}.union(*(self._modules_of(each) for each in classes)))
        if "__main__" not in modules:
            digest = hash_of_all(modules)
            yield _stamped(cache_folder() / digest) / self._file(signature, classes, codegen.magic_tuple())
            if (SHIPPED / digest).is_dir() and _stands_in_for_baseline():
                yield SHIPPED / digest / self._file(signature, classes, (codegen.magic_tuple()[0], BASELINE, ""))

    def _modules_of(self, kind):
        """The modules that state the class and its formulas; a class made inside a function counts as a script's."""
        formulas = {formula.__module__ for formula in self.formulas_for(kind)}
        return formulas | {"__main__" if "<locals>" in kind.__qualname__ else kind.__module__}

    def _file(self, signature, classes, processor):
        """A name that says all that the machine code depends on beside the sources."""
        import llvmlite
        import numba
        from numba.core.serialize import dumps

        cells = tuple(cell.cell_contents for cell in self.function.__closure__ or ())
        names = sorted(f"{kind.__module__}.{kind.__qualname__}" for kind in classes)
        versions = sys.implementation.cache_tag, vars(numba)["__version__"], llvmlite.__version__
        key = hashlib.sha256(repr((str(signature), names, processor, versions)).encode())
        key.update(self.function.__code__.co_code + dumps(cells))
        return f"{self.name.replace('<locals>.', '')}-{key.hexdigest()[:24]}.kernel"


def _takes(lock):
    """Whether this process holds the lock now; another one may.  Where a system has no such locks, two may compile the same."""
    if fcntl is None:
        return True
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True


def _write(file, result):
    from numba.core.serialize import dumps

    library, function, environment, signature, *rest = result._reduce()
    rest[2] = ""  # an annotated listing, which is not used
    code = dumps((library, function, environment, signature, *rest))
    with atomic.replacing(file) as temporary:
        temporary.write_bytes(hashlib.sha256(code).digest() + code)


def _read(file):
    """The code in a file; None where there is none, or where it is damaged."""
    try:
        content = file.read_bytes()
    except OSError:
        return None
    return content[32:] if hashlib.sha256(content[32:]).digest() == content[:32] else None


@functools.cache
def _stands_in_for_baseline():
    from llvmlite import binding

    has = binding.get_host_cpu_features()
    return all(has.get(feature, False) for feature in FEATURES)


def _tuple_classes(numba_type):
    """The NamedTuple classes in the type of one argument, nested ones included."""
    own = {numba_type.instance_class} if hasattr(numba_type, "instance_class") else set()
    return own.union(*(_tuple_classes(part) for part in getattr(numba_type, "types", ())))


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
        folder = Path(tempfile.mkdtemp(prefix=PRIVATE))
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
    remove_unused(folder)
    return folder


def is_kept() -> bool:
    """Whether what is compiled outlives this process: not where the user's cache folder cannot be written to."""
    return not cache_folder().name.startswith(PRIVATE)


def is_first_run() -> bool:
    """Whether none of the kernels below the mechanisms is here, neither shipped nor compiled by an earlier run."""
    digest = hash_of_all(frozenset({PACKAGE}))
    return not any(any((root / digest).glob("*.kernel")) for root in (cache_folder(), SHIPPED))


@functools.cache
def _stamped(folder):
    """The folder, stamped as used today."""
    folder.mkdir(exist_ok=True)
    (folder / "last-used").touch()
    return folder


@functools.cache
def hash_of_all(modules: frozenset[str]) -> str:
    """The name of the folder for kernels that depend on the packages of these modules: the same whichever modules of a package they are,
    for which formulas a class has depends on what a process has imported."""
    digest = hashlib.sha256()
    for package in sorted({PACKAGE}.union(module.partition(".")[0] for module in modules)):
        whole = package != PACKAGE or any(module.startswith(ABOVE) for module in modules)
        digest.update(package.encode() + hash_of(package, whole))
    return digest.hexdigest()[:20]


def remove_unused(root: Path) -> None:
    """Remove the folders that nobody has used for a month."""
    oldest = time.time() - UNUSED_DAYS * 86400
    for stamp in root.glob("*/last-used"):
        with contextlib.suppress(FileNotFoundError):  # another process may be tidying up too
            if stamp.stat().st_mtime < oldest:
                shutil.rmtree(stamp.parent, ignore_errors=True)


@functools.cache
def hash_of(package: str, whole: bool = True) -> bytes:
    """SHA-256 of the `sources` of a package, wherever that is installed."""
    digest = hashlib.sha256()
    for name, path in sources(package, whole):
        digest.update(name.encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.digest()


def sources(package: str, whole: bool = True) -> list[tuple[str, Path]]:
    """(name within the package, path) of the Python files of a package, or the one file of a module, in a fixed order; unless `whole`,
    without the layers ABOVE."""
    module = sys.modules[package]
    folders = getattr(module, "__path__", None)
    if folders is None:
        return [("", Path(module.__file__ or ""))]
    files = ((path.relative_to(folder), path) for folder in folders for path in Path(folder).rglob("*.py"))
    above = {name.partition(".")[2] for name in ABOVE}
    return sorted((name.as_posix(), path) for name, path in files if whole or name.parts[0] not in above)
