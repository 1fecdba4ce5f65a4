"""numba's disk cache of the kernels, filed under a hash of all sources that a kernel may depend on.

numba watches the file of the kernel alone and would answer with old numbers after an edit anywhere else.  A kernel depends on its layer of
this package and those below, and on the packages that bring the types of its arguments and their formulas.
"""

import atexit
import contextlib
import functools
import hashlib
import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from drivewright._jit import compilation

PACKAGE = __name__.partition(".")[0]
UNUSED_DAYS = 30
# Nothing below may import these, so that kernels below do not depend on them.
ABOVE = tuple(
    f"{PACKAGE}.{name}" for name in ("mechanisms", "oracles", "validation", "studies", "execution", "report", "view", "cli", "studio")
)


class KernelCache:
    """numba's disk cache of one kernel, in one folder per set of sources that a signature depends on."""

    def __init__(self, function: Callable[..., Any], formulas_for: Callable[[type], Iterable[Callable[..., Any]]]) -> None:
        """`formulas_for` gives the formulas that are chosen by a class."""
        self.function, self.formulas_for = function, formulas_for
        self.name = f"{function.__module__.removeprefix(f'{PACKAGE}.')}.{function.__qualname__}"
        self.by_modules: dict[frozenset[str], Any] = {}

    @property
    def cache_path(self) -> str:
        """The folder of all kernels."""
        return str(cache_folder())

    def load_overload(self, signature: Any, target: Any) -> Any:
        """The compiled kernel for a signature, or None."""
        found = self._for(signature).load_overload(signature, target)
        compilation.tell(self.name, compilation.BEGUN if found is None else compilation.FOUND)
        return found

    def save_overload(self, signature: Any, result: Any) -> None:
        """Keep a compiled kernel."""
        compilation.tell(self.name, compilation.DONE)
        self._for(signature).save_overload(signature, result)

    def _for(self, signature):
        classes = set().union(*(_tuple_classes(each) for each in getattr(signature, "args", signature)))
        modules = frozenset({self.function.__module__}.union(*(self._modules_of(each) for each in classes)))
        if modules not in self.by_modules:
            self.by_modules[modules] = self._open(modules)
        return self.by_modules[modules]

    def _modules_of(self, kind):
        """The modules that state the class and its formulas; a class made inside a function counts as a script's."""
        formulas = {formula.__module__ for formula in self.formulas_for(kind)}
        return formulas | {"__main__" if "<locals>" in kind.__qualname__ else kind.__module__}

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
    remove_unused(folder)
    return folder


@functools.cache
def _folder_of(modules):
    """The folder for kernels that depend on these modules' packages, stamped as used today."""
    packages = {PACKAGE}.union(module.partition(".")[0] for module in modules)
    digest = hashlib.sha256(" ".join(sorted(modules)).encode())
    for package in sorted(packages):
        whole = package != PACKAGE or any(module.startswith(ABOVE) for module in modules)
        digest.update(hash_of(package, whole))
    folder = cache_folder() / digest.hexdigest()[:20]
    folder.mkdir(exist_ok=True)
    (folder / "last-used").touch()
    return folder


def remove_unused(root: Path) -> None:
    """Remove the folders that nobody has used for a month."""
    oldest = time.time() - UNUSED_DAYS * 86400
    for stamp in root.glob("*/last-used"):
        with contextlib.suppress(FileNotFoundError):  # another process may be tidying up too
            if stamp.stat().st_mtime < oldest:
                shutil.rmtree(stamp.parent, ignore_errors=True)


@functools.cache
def hash_of(package: str, whole: bool = True) -> bytes:
    """SHA-256 of the `sources` of a package."""
    digest = hashlib.sha256()
    for path in sources(package, whole):
        digest.update(path.as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.digest()


def sources(package: str, whole: bool = True) -> list[Path]:
    """The Python files of a package, or the one file of a module, in a fixed order; unless `whole`, without the layers ABOVE."""
    module = sys.modules[package]
    folders = getattr(module, "__path__", None)
    if folders is None:
        return [Path(module.__file__ or "")]
    files = ((Path(folder), file) for folder in folders for file in Path(folder).rglob("*.py"))
    above = {name.partition(".")[2] for name in ABOVE}
    return sorted(file for folder, file in files if whole or file.relative_to(folder).parts[0] not in above)
