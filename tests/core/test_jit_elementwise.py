"""Loops over the elements of many arrays: vector code, and the numbers of the loop as it stands."""

import os
import platform
import re
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from llvmlite import binding as llvm

from drivewright._jit import by_reference, elementwise, inner, plain
from drivewright._jit.compiling import with_independent_turns

pytestmark = pytest.mark.analytical

MANY = 20


@by_reference
class Rows(NamedTuple):
    a: np.ndarray
    b: np.ndarray
    c: np.ndarray
    d: np.ndarray
    e: np.ndarray
    f: np.ndarray
    g: np.ndarray
    h: np.ndarray
    i: np.ndarray
    j: np.ndarray
    k: np.ndarray
    l: np.ndarray  # noqa: E741
    m: np.ndarray
    n: np.ndarray
    o: np.ndarray
    p: np.ndarray
    q: np.ndarray
    r: np.ndarray
    s: np.ndarray
    t: np.ndarray


@inner
def product(a: float, b: float) -> float:
    """A callee of numbers."""
    return a * b


def turns(rows: Rows, first: int, last: int) -> None:
    """Ten rows from ten rows."""
    for n in range(np.uint64(first), np.uint64(last)):
        size = np.sqrt(product(rows.a[n], rows.b[n]) + rows.c[n])
        rows.k[n], rows.l[n], rows.m[n], rows.n[n] = size + rows.d[n], size * rows.e[n], size - rows.f[n], size * rows.g[n]
        rows.o[n], rows.p[n], rows.q[n] = rows.h[n] / size, max(rows.i[n] + size, rows.j[n]), rows.k[n] + 1.0
        rows.r[n], rows.s[n], rows.t[n] = size, 2.0 * rows.l[n], max(rows.m[n], rows.a[n])


def code_of(kernel):
    """LLVM's code of a kernel, compiled here and not from the disk."""
    kernel._cache = type("Nothing", (), {"load_overload": lambda *_: None, "save_overload": lambda *_: None, "release": lambda *_: None})()
    kernel.compile_for(rows_of(0), 1, 3)
    return next(iter(kernel.inspect_llvm().values()))


def has_vectors(kernel):
    """Whether its code computes with several numbers at once."""
    return re.search(r"<\d+ x double>", code_of(kernel)) is not None


def rows_of(seed, count=37):
    """Rows of numbers in (0, 1)."""
    return Rows(*np.random.default_rng(seed).uniform(0.1, 1.0, (MANY, count)))


BOTH = """
import test_jit_elementwise as here
marked = here.has_vectors(here.elementwise(here.turns))
vars(here.turns).pop("elementwise")
print(marked, here.has_vectors(here.inner(here.turns)))
"""


@pytest.mark.skipif(platform.machine() not in ("x86_64", "AMD64"), reason="compiled for a processor of x86-64")
def test_the_loop_becomes_vector_code_which_it_does_not_otherwise():
    """Compiled, not run, for a processor of which the vectors are known: for the one of this machine LLVM may choose otherwise."""
    processor = {"NUMBA_CPU_NAME": "x86-64-v3", "NUMBA_CPU_FEATURES": "", "PYTHONPATH": str(Path(__file__).parent)}
    done = subprocess.run([sys.executable, "-c", BOTH], env=os.environ | processor, capture_output=True, text=True, check=False)
    assert done.stdout.split() == ["True", "False"], done.stderr


@pytest.mark.parametrize(("first", "last"), [(0, 37), (3, 19), (5, 5), (36, 37)])
def test_its_numbers_are_those_of_the_loop_as_it_stands(first, last):
    compiled, expected = rows_of(1), rows_of(1)
    kernel = elementwise(turns)
    kernel(compiled, first, last)
    plain(turns)(expected, first, last)
    vars(turns).pop("elementwise")
    for one, two in zip(compiled, expected, strict=True):
        np.testing.assert_array_equal(one, two)


CODE = """
declare void @use(double*)
define void @f(double* %p) {
entry:
  br label %"head"
head:
  %n = phi i64 [0, %entry], [%m, %"head"]
  %x = load double, double* %p
  store double %x, double* %p
  call void @use(double* %p)
  %m = add i64 %n, 1
  %again = icmp slt i64 %m, 5
  br i1 %again, label %"head", label %out
out:
  ret void
}
define void @g() {
head:
  br label %out
out:
  ret void
}
!0 = !{!"something"}
"""


def test_reads_writes_calls_and_the_way_back_are_marked_and_nothing_else():
    llvm.initialize_native_target()
    code = with_independent_turns(CODE)
    llvm.parse_assembly(code).verify()
    assert [line.split()[0].strip() for line in code.splitlines() if "!llvm.access.group" in line] == ["%x", "store", "call"]
    back = [line for line in code.splitlines() if "!llvm.loop !" in line]
    assert len(back) == 1 and back[0].lstrip().startswith("br i1 %again")
    number = re.search(r"!llvm\.loop (!\d+)", back[0])[1]
    assert re.search(rf"^{number} = distinct !{{{number}, !\d+}}$", code, re.MULTILINE) and '!0 = !{!"something"}' in code
