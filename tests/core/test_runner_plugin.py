"""A package by somebody else, really installed: its drive and its motion law work like ours, without a change in the house."""

import json
import math
import os
import subprocess
import sys
from importlib.metadata import EntryPoint
from pathlib import Path

import pytest

from drivewright import plugins, registry
from drivewright.errors import InputError, UnknownName

pytestmark = pytest.mark.interface

PENDULUM, YOKE = (Path(__file__).parent / name for name in ("plugin", "scotch_yoke"))


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """Environment of a Python that has the packages as well."""
    target = tmp_path_factory.mktemp("site")
    for package in (PENDULUM, YOKE):
        _install(package, target)
    return {**os.environ, "PYTHONPATH": os.pathsep.join([str(target), os.environ.get("PYTHONPATH", "")]), "PYTHONDONTWRITEBYTECODE": "1"}


def _install(package, target):
    options = ["--quiet", "--no-deps", "--no-build-isolation", "--no-index", "--upgrade", "--target", str(target)]
    done = subprocess.run([sys.executable, "-m", "pip", "install", *options, str(package)], capture_output=True, text=True)
    if done.returncode:
        _install_by_hand(package, target)


def _install_by_hand(package, target):
    """What pip does, where hatchling or pip are not at hand: the sources and their metadata side by side."""
    import shutil
    import tomllib

    project = tomllib.loads((package / "pyproject.toml").read_text())["project"]
    name = project["name"].replace("-", "_")
    shutil.copytree(package / "src" / name, target / name, dirs_exist_ok=True)
    about = target / f"{name}-{project['version']}.dist-info"
    about.mkdir(exist_ok=True)
    (about / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: {project['version']}\n")
    lines = [
        f"[{group}]\n" + "".join(f"{name} = {place}\n" for name, place in points.items())
        for group, points in project["entry-points"].items()
    ]
    (about / "entry_points.txt").write_text("\n".join(lines))


def drivewright(installed, folder, *arguments):
    code = "from drivewright.cli import main; main()"
    return subprocess.run([sys.executable, "-c", code, *arguments], capture_output=True, text=True, env=installed, cwd=folder)


def test_a_drive_of_another_package_is_made_run_and_reported(installed, tmp_path):
    new = drivewright(installed, tmp_path, "new", "pendulum")
    assert new.returncode == 0 and 'length = "250 mm"' in (tmp_path / "pendulum.toml").read_text()
    run = drivewright(installed, tmp_path, "run", "pendulum.toml", "--json", "--set", "bob.length=1 m")
    assert run.returncode == 0, run.stderr
    record = json.loads(run.stdout)
    assert record["mechanism"] == "pendulum" and record["values"]["period"]["value"] == pytest.approx(
        2 * math.pi / math.sqrt(9.80665), rel=1e-14
    )
    assert record["values"]["rise"]["value"] == pytest.approx(1 - math.cos(math.radians(20)), rel=1e-12) and record["checks"][0]["ok"]
    assert {"result.json", "report.html", "spec.toml", "tables"} <= {path.name for path in (tmp_path / "out" / "pendulum").iterdir()}


def test_it_is_refused_strictly_and_by_key_like_ours(installed, tmp_path):
    drivewright(installed, tmp_path, "new", "pendulum")
    steep = drivewright(installed, tmp_path, "run", "pendulum.toml", "--no-figures", "--strict", "--set", "swing=170 deg")
    assert steep.returncode == 3 and "FAILS" in steep.stdout
    wrong = drivewright(installed, tmp_path, "run", "pendulum.toml", "--set", "bob.length=3 rpm")
    assert wrong.returncode == 2 and wrong.stderr == "drivewright: pendulum.toml: bob.length: wants a length, got '3 rpm' (angular speed)\n"


def test_a_drive_in_four_files_conforms_and_is_run_like_ours(installed, tmp_path):
    code = (
        "from drivewright.testing import cases; told = {str(case): case.check() for case in cases('scotch-yoke')}; "
        "import json; print(json.dumps(told))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=installed, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    reasons = {name.removeprefix("scotch-yoke-default-"): reason for name, reason in json.loads(done.stdout).items()}
    assert [name for name, reason in reasons.items() if not reason] == ["units", "record", "derivatives", "speed"]
    assert drivewright(installed, tmp_path, "new", "scotch-yoke").returncode == 0
    run = drivewright(installed, tmp_path, "run", "scotch-yoke.toml", "--json", "--set", "slot_tilt=60 deg")
    values = json.loads(run.stdout)["values"]
    assert values["max_speed"]["value"] == pytest.approx(2 * math.pi * 0.08, rel=1e-12)
    assert values["max_speed"]["label"] == "Peak slide speed"
    assert values["max_acceleration"]["value"] == pytest.approx(0.08 * (2 * math.pi) ** 2, rel=1e-12)
    assert len([path for path in (YOKE / "src").rglob("*") if path.is_file() and "__pycache__" not in path.parts]) == 4


def test_the_house_lists_it_and_finds_its_law(installed, tmp_path):
    code = (
        "import drivewright as dw; from drivewright import registry, motion; print(registry.kinds()); "
        "print(dw.motion.law('half-cosine').peaks().Am, 'half-cosine' in motion.names())"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=installed, cwd=tmp_path)
    kinds, law = done.stdout.splitlines()
    named = "cam geneva indexer linkage pendulum scotch-yoke seedling-pusher shaft silent-chain"
    assert kinds == str(named.split()) and law.endswith(" True")
    assert float(law.split()[0]) == pytest.approx(math.pi**2 / 2, rel=1e-12)


# -- the registry itself -------------------------------------------------------------------------------------------------------


@pytest.fixture
def points(monkeypatch):
    """Entry points of one test; the caches are emptied around it."""
    found = []
    monkeypatch.setattr(plugins, "entry_points", lambda group: [point for point in found if point.group == group])
    plugins.installed.cache_clear()
    plugins.load.cache_clear()
    yield found
    plugins.installed.cache_clear()
    plugins.load.cache_clear()


def test_an_unknown_kind_is_refused_with_the_nearest_known():
    known = "known: cam, geneva, indexer, linkage, seedling-pusher, shaft, silent-chain"
    with pytest.raises(UnknownName, match=f"no mechanism is called 'seedling_pusher' .did you mean 'seedling-pusher'.*; {known}"):
        registry.mechanism("seedling_pusher")


def test_two_packages_that_claim_one_name_are_told_apart_or_refused(points):
    points += [EntryPoint("gear", "a:make", "g"), EntryPoint("gear", "a:make", "g"), EntryPoint("rack", "b:make", "g")]
    assert {name: point.value for name, point in plugins.installed("g").items()} == {"gear": "a:make", "rack": "b:make"}
    plugins.installed.cache_clear()
    points.append(EntryPoint("rack", "c:make", "g"))
    with pytest.raises(InputError, match="g: 'rack' is claimed by b:make and by c:make; uninstall one of the packages"):
        plugins.installed("g")


def test_a_plug_in_that_does_not_load_is_named_with_its_package(points):
    class Distribution:
        name = "broken-drives"

    points.append(EntryPoint("broken", "no_such_module_at_all:mechanism", "drivewright.mechanisms"))
    vars(points[-1]).update(dist=Distribution())
    with pytest.raises(
        InputError, match="mechanism 'broken' of the package 'broken-drives' does not load: No module named 'no_such_module_at_all'"
    ):
        registry.mechanism("broken")


def test_a_bug_in_our_own_imports_stays_a_traceback(points):
    points.append(EntryPoint("ours", "no_such_module_at_all:mechanism", "drivewright.mechanisms"))
    with pytest.raises(ModuleNotFoundError):
        registry.mechanism("ours")
