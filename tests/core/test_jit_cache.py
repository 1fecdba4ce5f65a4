"""The disk cache over several processes: it hits, and it never answers with the numbers of an older source."""

import fcntl
import os
import shutil
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
# bytecode is told apart by whole seconds, and one file is written twice within one
START = """
import sys, platformdirs, pathlib
sys.dont_write_bytecode = True
platformdirs.user_cache_path = lambda *a, **k: pathlib.Path({cache!r})
"""
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
    assert not list((python.folder / "cache").rglob("*.kernel"))


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
        (tmp_path / name / "x.kernel").write_text("")
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
    for place, kept in ((folder, False), (tmp_path / "kernels", True)):
        monkeypatch.setattr(disk_cache, "cache_folder", lambda place=place: place)
        assert disk_cache.is_kept() == kept


def test_using_a_folder_stamps_it(tmp_path):
    folder = disk_cache._stamped(tmp_path / "one")
    assert folder == tmp_path / "one" and time.time() - (folder / "last-used").stat().st_mtime < 60


def test_a_folder_for_each_set_of_packages():
    few = disk_cache.hash_of_all(frozenset({"drivewright.errors"}))
    assert few == disk_cache.hash_of_all(frozenset({"drivewright.errors", "drivewright._jit"}))
    assert len({few, disk_cache.hash_of_all(frozenset({"drivewright.errors", "numpy"}))}) == 2
    # a kernel of an upper layer depends on all layers, one of a lower layer on those below
    assert len({few, disk_cache.hash_of_all(frozenset({"drivewright.mechanisms.cam"}))}) == 2


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


MANY_THINGS = """
from typing import NamedTuple
import numpy as np
from drivewright._jit import kernel, inner

class Pair(NamedTuple):
    a: np.ndarray
    b: float

@inner
def halves(x):
    return round(x) / 2, np.hypot(x, 1.0)

@kernel
def everything(matrix, z, n):
    if n < 0:
        raise ValueError("n must not be negative")
    solved = np.linalg.solve(matrix, np.ones(n)) + matrix @ (1.0 * np.arange(n)) + np.sort(np.sin(np.arange(n)))
    values = np.linalg.eigvalsh(matrix + matrix.T)
    total = 0.0
    for x in solved:
        a, b = halves(x)
        total += a + b + abs(z) + z.real
    return Pair(np.concatenate((solved, values, np.cumsum(values))), total), (np.floor(total), "word"), np.argsort(solved)
"""
SUM = """
from drivewright._jit import kernel

@kernel
def f(x):
    return round(x[0]) + x.sum() + x.mean()
"""
USE_THEM = """
import sys, pathlib, platformdirs
platformdirs.user_cache_path = lambda *a, **k: pathlib.Path("cache")
import numpy as np, many_things as m
matrix = np.array([[4.0, 1.0, 0.0], [1.0, 3.0, 1.0], [0.0, 1.0, 5.0]])
pair, rest, order = m.everything(matrix, 3 + 4j, 3)
print(type(pair).__name__, [float(x).hex() for x in pair.a], pair.b.hex(), rest, order)
try:
    m.everything(matrix, 3 + 4j, -1)
except ValueError as error:
    print(error)
print(sum(m.everything.stats.cache_hits.values()))
"""


def test_machine_code_from_the_disk_does_what_it_did(tmp_path):
    (tmp_path / "many_things.py").write_text(MANY_THINGS)
    runs = [
        subprocess.run(
            [sys.executable, "-c", USE_THEM], cwd=tmp_path, capture_output=True, text=True, timeout=300, check=True
        ).stdout.splitlines()
        for _ in range(2)
    ]
    assert runs[0][:-1] == runs[1][:-1] and [run[-1] for run in runs] == ["0", "1"]
    assert runs[0][1] == "n must not be negative"


def test_machine_code_from_the_disk_imports_neither_what_generates_code_nor_scipy(tmp_path):
    (tmp_path / "many_things.py").write_text(SUM)
    use = (
        USE_THEM.split("matrix =")[0]
        + "print(m.f(np.ones(3)), [name for name in ('numba.np.arraymath', 'scipy.linalg') if name in sys.modules])\n"
    )
    said = [
        subprocess.run([sys.executable, "-c", use], cwd=tmp_path, capture_output=True, text=True, timeout=300, check=True).stdout.strip()
        for _ in range(2)
    ]
    assert said == ["5.0 ['numba.np.arraymath', 'scipy.linalg']", "5.0 []"]


SQUARES = "from drivewright._jit import kernel\n\n@kernel\ndef square(x):\n    return x * x\n"
SHIPPING = """
import os, pathlib, platformdirs
platformdirs.user_cache_path = lambda *a, **k: pathlib.Path({cache!r})
from drivewright._jit import disk_cache
disk_cache.SHIPPED = pathlib.Path("shipped")
{more}
import squares
print(squares.square(3.0), sum(squares.square.stats.cache_hits.values()))
"""


@pytest.fixture
def squares(tmp_path):
    (tmp_path / "squares.py").write_text(SQUARES)

    def run(cache="cache", more="", **environment):
        code, env = SHIPPING.format(cache=cache, more=more), os.environ | environment
        return subprocess.run(
            [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, timeout=120, check=True, env=env
        ).stdout.strip()

    return run


def test_a_damaged_file_is_compiled_again_and_mended(tmp_path, squares):
    assert squares() == "9.0 0"
    (file,) = (tmp_path / "cache").rglob("*.kernel")
    whole = file.read_bytes()
    for damaged in (whole[:-1], whole[:100] + bytes([whole[100] ^ 1]) + whole[101:], b""):
        file.write_bytes(damaged)
        assert squares() == "9.0 0" and len(file.read_bytes()) == len(whole)
    assert squares() == "9.0 1"


def test_a_disk_that_takes_nothing_costs_time_and_not_the_result(squares):
    refuse = "from drivewright import atomic\ndef refuse(*a):\n    raise OSError(28, 'no space')\natomic.replacing = refuse"
    assert [squares(more=refuse) for _ in range(2)] == ["9.0 0"] * 2


WATCH = "from drivewright._jit import compilation\ncompilation._watchers.append(lambda kernel, what: print(what, flush=True))"


@pytest.fixture
def held(tmp_path, squares):
    """(the file that a kernel has been compiled to, the same place in an empty cache, its lock, which is held)."""
    assert squares("made") == "9.0 0"
    (made,) = (tmp_path / "made").rglob("*.kernel")
    file = tmp_path / "cache" / made.relative_to(tmp_path / "made")
    file.parent.mkdir(parents=True)
    with file.with_suffix(".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield made, file, lock


def test_what_another_process_compiles_is_waited_for(tmp_path, held):
    made, file, lock = held
    code = SHIPPING.format(cache="cache", more=WATCH)
    with subprocess.Popen([sys.executable, "-c", code], cwd=tmp_path, stdout=subprocess.PIPE, text=True) as other:
        assert other.stdout is not None and other.stdout.readline() == "begun\n"
        with pytest.raises(subprocess.TimeoutExpired):
            other.wait(0.5)
        shutil.copyfile(made, file)
        fcntl.flock(lock, fcntl.LOCK_UN)
        assert other.stdout.read() == "done\n9.0 1\n"


WORK = """
import squares
done = []
compilation._work.append(lambda: not done and not done.append(squares.square(3)))
"""


def test_meanwhile_another_one_is_compiled(tmp_path, held):
    """The same kernel for another signature: the lock that is waited for stays the one of the first."""
    made, file, lock = held
    code = SHIPPING.format(cache="cache", more=WATCH + WORK)
    with subprocess.Popen([sys.executable, "-c", code], cwd=tmp_path, stdout=subprocess.PIPE, text=True) as other:
        assert other.stdout is not None and [other.stdout.readline() for _ in range(3)] == ["begun\n", "begun\n", "done\n"]
        shutil.copyfile(made, file)
        fcntl.flock(lock, fcntl.LOCK_UN)
        assert other.stdout.read() == "done\n9.0 1\n"


THREADS = """
import threading
import squares
threads = [threading.Thread(target=lambda n=n: answers.append(squares.square(float(n)))) for n in range(8)]
answers = []
for each in threads: each.start()
for each in threads: each.join()
print(sorted(answers))
"""


def test_threads_of_one_process_do_not_let_go_of_each_others_lock(squares):
    """Letting go takes so long here that another thread comes to it meanwhile."""
    slowly = "import os, time\nclose = os.close\nos.close = lambda file: (time.sleep(0.05), close(file))"
    assert squares(more=slowly + THREADS) == f"{[float(n * n) for n in range(8)]}\n9.0 0"


def test_who_does_not_come_to_an_end_is_not_waited_for_for_ever(squares, held):
    assert squares(more="disk_cache.PATIENCE = 0.1") == "9.0 0"


def test_a_lock_that_a_dead_process_left_holds_nobody_up(squares, held):
    held[2].close()
    assert squares(more="disk_cache.PATIENCE = 1e9") == "9.0 0"
    assert squares() == "9.0 1"


def test_a_kernel_that_cannot_be_compiled_lets_others_at_it(tmp_path, squares):
    (tmp_path / "squares.py").write_text(SQUARES.replace("x * x", "x.nothing"))
    with pytest.raises(subprocess.CalledProcessError):
        squares()
    (lock,) = (tmp_path / "cache").rglob("*.lock")
    with lock.open() as file:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)


def test_the_lock_ends_with_the_compilation_not_with_the_process(tmp_path, squares):
    compiled = (
        "import squares, fcntl, pathlib\nsquares.square(3.0)\n"
        "(lock,) = pathlib.Path('cache').rglob('*.lock')\nfcntl.flock(lock.open(), fcntl.LOCK_EX | fcntl.LOCK_NB)"
    )
    assert squares(more=compiled) == "9.0 0"


def test_the_first_run_is_known_by_the_kernels_that_are_not_there(tmp_path, monkeypatch):
    monkeypatch.setattr(disk_cache, "cache_folder", lambda: tmp_path)
    monkeypatch.setattr(disk_cache, "SHIPPED", tmp_path / "shipped")
    assert disk_cache.is_first_run()
    digest = disk_cache.hash_of_all(frozenset({disk_cache.PACKAGE}))
    for root in (tmp_path, tmp_path / "shipped"):
        (root / digest).mkdir(parents=True)
        assert disk_cache.is_first_run()
        (root / digest / "a.kernel").touch()
        assert not disk_cache.is_first_run()
        (root / digest / "a.kernel").unlink()


def test_kernels_for_the_baseline_that_are_shipped_are_taken_where_they_run(tmp_path, squares):
    assert squares("made", NUMBA_CPU_NAME=disk_cache.BASELINE, NUMBA_CPU_FEATURES="") == "9.0 0"
    shutil.copytree(tmp_path / "made" / "kernels", tmp_path / "shipped")
    runs_here = "disk_cache._stands_in_for_baseline = lambda: {}"
    assert squares("mine", more=runs_here.format(True)) == "9.0 1"
    assert not list((tmp_path / "mine").rglob("*.kernel"))  # nothing was compiled
    assert squares("mine", more=runs_here.format(False)) == "9.0 0"
    (tmp_path / "squares.py").write_text(SQUARES.replace("x * x", "x * x * x"))
    assert squares("other", more=runs_here.format(True)) == "27.0 0"


@pytest.mark.parametrize("feature", disk_cache.FEATURES)
def test_a_processor_without_one_of_the_features_does_not_stand_in(monkeypatch, feature):
    from llvmlite import binding

    has = dict.fromkeys(disk_cache.FEATURES, True)
    monkeypatch.setattr(binding, "get_host_cpu_features", lambda: has)
    assert disk_cache._stands_in_for_baseline.__wrapped__()
    has[feature] = False
    assert not disk_cache._stands_in_for_baseline.__wrapped__()


def test_the_same_sources_elsewhere_have_the_same_hash(tmp_path, monkeypatch):
    digests = []
    for place in ("here", "there"):
        package = tmp_path / place / f"moved_{place}"
        (package / "deep").mkdir(parents=True)
        (package / "__init__.py").write_text("x = 1")
        (package / "deep" / "module.py").write_text("y = 2")
        monkeypatch.syspath_prepend(package.parent)
        __import__(package.name)
        digests.append(disk_cache.hash_of.__wrapped__(package.name))
    assert digests[0] == digests[1]
