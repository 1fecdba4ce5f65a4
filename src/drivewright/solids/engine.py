"""The door to Netgen and NGSolve (extra `fe`): loaded when first needed, with the real reason where they are not."""

import importlib
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from drivewright.errors import DrivewrightError, MissingExtra

QUADMATH = (
    "NGSolve's loader hides the real cause of a missing shared library: most often it is libquadmath; try: apt-get install libquadmath0"
)
EngineObject = Any  # shapes, meshes, forms and vectors of Netgen and NGSolve, which have no types of their own


def fe_module(name: str, purpose: str) -> Any:
    """A module of the extra `fe` by name, e.g. fe_module("netgen.occ", "STEP export"); MissingExtra says why it is not there."""
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        raise MissingExtra(purpose, "fe", error) from None
    except ImportError as error:  # installed, but a system library is not: "libopenblas.so.0: cannot open shared object file"
        raise MissingExtra(purpose, "fe", f"{error}. {QUADMATH}") from None


def engine_errors(purpose: str) -> tuple[type[Exception], ...]:
    """The errors that the CAD kernel and the mesher raise."""
    return RuntimeError, fe_module("netgen.meshing", purpose).NgException, fe_module("netgen.occ", purpose).OCCException


@contextmanager
def translated_errors(error_class: type[DrivewrightError], subject: str, advice: str, purpose: str) -> Iterator[None]:
    """Turns the poor messages of kernel and mesher into ours: "SUBJECT (their words); ADVICE"."""
    try:
        yield
    except engine_errors(purpose) as error:
        raise error_class(f"{subject} ({error}); {advice}") from error
