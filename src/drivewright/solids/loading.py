"""The door to Netgen and NGSolve (extra `fe`): loaded when first needed, with the real reason where they are not."""

import importlib

from drivewright.errors import MissingExtra

QUADMATH = (
    "NGSolve's loader hides the real cause of a missing shared library: most often it is libquadmath; try: apt-get install libquadmath0"
)


def load(module, what):
    """A module of the extra `fe` by name, e.g. load("netgen.occ", "STEP export"); MissingExtra says why it is not there."""
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        raise MissingExtra(what, "fe", error) from None
    except ImportError as error:  # installed, but a system library is not: "libopenblas.so.0: cannot open shared object file"
        raise MissingExtra(what, "fe", f"{error}. {QUADMATH}") from None


def failures(what):
    """The errors that the kernel and the mesher raise."""
    return RuntimeError, load("netgen.meshing", what).NgException, load("netgen.occ", what).OCCException
