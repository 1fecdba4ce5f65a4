"""`drivewright doctor`: what is installed, what each extra adds, the kernel cache, a self-test."""

import math
import time
from importlib import import_module
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from drivewright import registry, units
from drivewright.cli import show
from drivewright.cli.records import print_json
from drivewright.runner import versions

EXTRAS = (
    ("fe", "ngsolve", "STEP and STL of solids, solid check by finite elements"),
    ("pdf", "typst", "PDF report"),
    ("optimise", "pymoo", "NSGA-II for several objectives"),
    ("studio", "nicegui", "the web studio"),
    ("frames", "xarray", "results and studies as frames of pandas and datasets of xarray"),
    ("cluster", "distributed", "studies on a Dask cluster, here or elsewhere"),
    ("peers", "exudyn", "independent engines for `verify` and the benchmarks"),
)


def report(warm: bool, as_json: bool = False) -> bool:
    """Print everything, as tables or as JSON; returns whether the self-test passed."""
    if as_json:
        if warm:
            _warm()
        found = record()
        print_json(found)
        return all(row["ok"] for row in found["self_test"])
    show.table("installed", (("what", "left"), ("version", "left")), versions().items())
    show.table("extras", (("extra", "left"), ("state", "left"), ("adds", "left")), _extras())
    show.table("mechanisms", (("kind", "left"), ("what", "left")), [(k, registry.mechanism(k).summary) for k in registry.kinds()])
    if warm:
        _warm()
    _cache()
    return _self_test()


def record() -> dict[str, Any]:
    """The same as plain data."""
    folder, files, size = _cache_size()
    extras = {name: {"installed": not state.startswith("missing"), "state": state, "adds": adds} for name, state, adds in _extras()}
    return {
        "installed": versions(),
        "extras": extras,
        "mechanisms": {kind: registry.mechanism(kind).summary for kind in registry.kinds()},
        "kernel_cache": {"folder": str(folder), "files": files, "bytes": size},
        "self_test": [{"what": what, "found": value, "expected": expected, "ok": ok} for what, value, expected, ok in _closed_forms()],
    }


def _extras() -> list[tuple[str, str, str]]:
    return [_extra(*row) for row in EXTRAS]


def _extra(name: str, module: str, adds: str) -> tuple[str, str, str]:
    try:
        import_module(module)
    except ImportError as error:
        hint = "make system (libquadmath0)" if name == "fe" else f"pip install 'drivewright[{name}]'"
        return name, f"missing ({str(error)[:60]}); {hint}", adds
    try:
        return name, version(module), adds
    except PackageNotFoundError:
        return name, "installed", adds


def _warm() -> None:
    from drivewright import _jit

    show.note("compiling every kernel ...")
    for name, seconds in _jit.warm():
        show.note(f"  {name}: {seconds:.1f} s")


def _cache() -> None:
    folder, files, size = _cache_size()
    show.table("kernel cache", (("folder", "left"), ("files", "right"), ("size", "right")), [(folder, files, f"{size / 1e6:.1f} MB")])


def _cache_size() -> tuple[Path, int, int]:
    """(folder, number of files, bytes) of the kernel cache."""
    from drivewright._jit.disk_cache import cache_folder

    folder = cache_folder()
    files = [path for path in folder.rglob("*") if path.is_file()]
    return folder, len(files), sum(path.stat().st_size for path in files)


def _closed_forms() -> list[tuple[str, float, float, bool]]:
    """(what, found, expected, whether they agree) of a few closed forms through the layers."""
    from drivewright import gears, motion
    from drivewright.numerics.roots import bracketed_roots

    rows = (
        ("9.525 mm in metres", units.to_si("9.525 mm", "length"), 9.525e-3),
        ("modified sine, peak acceleration", motion.law("modified-sine").peaks().Am, 5.527957),
        ("elliptic pair after half a turn", gears.EllipticGearPair(eccentricity=0.3).driven(math.pi), math.pi),
        ("root of x^2 - 2", bracketed_roots(lambda x: x * x - 2, [1.0, 2.0])[0], 2**0.5),
    )
    return [(what, float(value), expected, bool(abs(value - expected) < 1e-6)) for what, value, expected in rows]


def _self_test() -> bool:
    """The closed forms, a line each."""
    started = time.perf_counter()
    rows = _closed_forms()
    show.table(
        "self-test",
        (("what", "left"), ("found", "right"), ("expected", "right"), ("", "left")),
        [(what, f"{value:.7g}", f"{expected:.7g}", "ok" if ok else "WRONG") for what, value, expected, ok in rows],
    )
    passed = [ok for *_, ok in rows]
    show.note(f"self-test: {sum(passed)} of {len(passed)} in {time.perf_counter() - started:.1f} s")
    return all(passed)
