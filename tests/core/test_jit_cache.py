"""The disk cache over several processes: it hits, and it never answers with the numbers of an older source."""

import os
import subprocess
import sys
import time

import pytest

from drivewright import _jit
from drivewright._jit import disk_cache

pytestmark = pytest.mark.interface

LAWS = '''
from typing import NamedTuple
from drivewright._jit import generic, implements, kernel

@generic
def force(law, gap):
    """Force."""

class Linear(NamedTuple):
    k: float

@implements(force, Linear)
def _(law, gap):
    return -law.k * gap

@kernel
def work(law, n):
    total = 0.0
    for i in range(n):
        total += force(law, -1.0)
    return total
'''
THEIRS = """
from typing import NamedTuple
from drivewright._jit import implements
from kernels_of_ours import force
from their_plugin.helper import factor

class Theirs(NamedTuple):
    k: float

@implements(force, Theirs)
def _(law, gap):
    return -factor(law.k) * gap
"""
HELPER = """
from drivewright._jit import kernel

@kernel
def factor(k):
    return {factor} * k
"""
START = "import platformdirs, pathlib; platformdirs.user_cache_path = lambda *a, **k: pathlib.Path({cache!r})\n"
REPORT = "print({call}, sum(work.stats.cache_hits.values()), sum(work.stats.cache_misses.values()))"


@pytest.fixture
def python(tmp_path):
    (tmp_path / "kernels_of_ours.py").write_text(LAWS)
    (tmp_path / "their_plugin").mkdir()
    (tmp_path / "their_plugin" / "__init__.py").write_text(THEIRS)
    (tmp_path / "their_plugin" / "helper.py").write_text(HELPER.format(factor=2.0))

    def run(code):
        """Last line printed by a new process."""
        start = START.format(cache=str(tmp_path / "cache"))
        done = subprocess.run([sys.executable, "-c", start + code], cwd=tmp_path, capture_output=True, text=True, timeout=60)
        assert done.returncode == 0, done.stderr
        return done.stdout.strip().splitlines()[-1] if done.stdout else ""

    run.folder = tmp_path
    return run


OURS = "from kernels_of_ours import *\n" + REPORT.format(call="work(Linear(3.0), 2)")
PLUGIN = "from kernels_of_ours import *\nfrom their_plugin import Theirs\n" + REPORT.format(call="work(Theirs(3.0), 2)")


def test_the_second_process_compiles_nothing_even_for_a_law_from_outside(python):
    assert python(PLUGIN) == "12.0 0 1"
    assert python(PLUGIN) == "12.0 1 0"
    assert python(OURS) == "6.0 0 1"  # a cache that holds other packages' types is no obstacle where they are not imported


def test_an_edit_in_another_file_gives_the_new_number(python):
    assert python(PLUGIN) == "12.0 0 1"
    (python.folder / "their_plugin" / "helper.py").write_text(HELPER.format(factor=5.0))
    assert python(PLUGIN) == "30.0 0 1"


def test_an_edit_of_a_formula_for_the_class_of_another_module_gives_the_new_number(python):
    call = "from kernels_of_ours import *\nfrom classes import Bare\nimport formulas\n" + REPORT.format(call="work(Bare(3.0), 2)")
    (python.folder / "classes.py").write_text("from typing import NamedTuple\n\nclass Bare(NamedTuple):\n    k: float\n")
    formula = "from drivewright._jit import implements\nfrom kernels_of_ours import force\nfrom classes import Bare\n\n"
    for factor in (2.0, 5.0):
        law = f"@implements(force, Bare)\ndef _(law, gap):\n    return -{factor} * law.k * gap\n"
        (python.folder / "formulas.py").write_text(formula + law)
        assert python(call) == f"{6.0 * factor} 0 1"


def test_a_law_of_a_script_is_compiled_and_not_filed(python):
    script = (
        "from typing import NamedTuple\nfrom kernels_of_ours import *\nclass Own(NamedTuple):\n    k: float\n"
        "@implements(force, Own)\ndef _(law, gap):\n    return law.k\n" + REPORT.format(call="work(Own(3.0), 2)")
    )
    assert python(script) == "6.0 0 1"
    assert not list((python.folder / "cache").rglob("*.nbc"))


def test_importing_the_package_and_the_laws_does_not_import_numba(python):
    assert python("import sys, drivewright, drivewright._jit, drivewright.contact.normal\nprint('numba' in sys.modules)") == "False"


def test_every_source_counts_and_nothing_else(tmp_path, monkeypatch):
    package = tmp_path / "some_package"
    package.mkdir()
    (package / "__init__.py").write_text("")
    monkeypatch.syspath_prepend(tmp_path)
    __import__("some_package")

    def digest():
        return disk_cache.hash_of.__wrapped__("some_package")

    digests = [digest(), digest()]
    (package / "notes.txt").write_text("words")
    digests.append(digest())
    assert len(set(digests)) == 1
    (package / "deep").mkdir()
    (package / "deep" / "module.py").write_text("x = 1")
    digests.append(digest())
    (package / "deep" / "module.py").write_text("x = 2")
    digests.append(digest())
    (package / "deep" / "module.py").rename(package / "deep" / "other.py")
    digests.append(digest())
    assert len(set(digests)) == 4


def test_folders_unused_for_a_month_are_removed(tmp_path):
    for name, days in (("fresh", 1), ("kept", 29), ("old", 31)):
        (tmp_path / name).mkdir()
        (tmp_path / name / "kernel.nbc").write_text("")
        stamp = tmp_path / name / "last-used"
        stamp.touch()
        os.utime(stamp, (time.time() - days * 86400,) * 2)
    disk_cache.remove_unused(tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["fresh", "kept"]


def test_where_the_users_folder_is_not_writable_a_private_one_is_taken(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("not a folder")
    monkeypatch.setattr("platformdirs.user_cache_path", lambda *args, **kwargs: tmp_path / "file")
    folder = disk_cache.cache_folder.__wrapped__()
    assert folder.is_dir() and tmp_path not in folder.parents
    assert os.name == "nt" or folder.stat().st_mode & 0o077 == 0


def test_using_a_folder_stamps_it(tmp_path, monkeypatch):
    monkeypatch.setattr(disk_cache, "cache_folder", lambda: tmp_path)
    folder = disk_cache._folder_of.__wrapped__(frozenset({"drivewright.errors"}))
    assert time.time() - (folder / "last-used").stat().st_mtime < 60
    assert folder != disk_cache._folder_of.__wrapped__(frozenset({"drivewright.errors", "drivewright._jit"}))


def test_warm_runs_each_warmer_and_reports_it(monkeypatch):
    calls = []
    monkeypatch.setattr(_jit, "_warmers", [])
    monkeypatch.setattr(_jit, "_modules_with", lambda text: ["drivewright.errors"])

    @_jit.warmer
    def compiles_something():
        calls.append(1)

    ((name, seconds),) = _jit.warm()
    assert calls == [1] and name.endswith(".compiles_something") and seconds >= 0


def test_modules_that_warm_are_found_by_their_source():
    assert list(_jit._modules_with('"""Every error a user can')) == []
    assert "drivewright._jit" in list(_jit._modules_with("def warmer("))
