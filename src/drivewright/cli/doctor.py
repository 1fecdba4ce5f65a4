"""`drivewright doctor`: what is installed, what each extra adds, the kernel cache, a self-test."""

import time
from importlib import import_module
from importlib.metadata import PackageNotFoundError, version

from drivewright import registry, units
from drivewright.cli import show
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


def report(warm: bool) -> bool:
    """Print everything; returns whether the self-test passed."""
    show.table("installed", (("what", "left"), ("version", "left")), versions().items())
    show.table("extras", (("extra", "left"), ("state", "left"), ("adds", "left")), [_extra(*row) for row in EXTRAS])
    show.table("mechanisms", (("kind", "left"), ("what", "left")), [(k, registry.mechanism(k).summary) for k in registry.kinds()])
    if warm:
        _warm()
    _cache()
    return _self_test()


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
    from drivewright._jit.disk_cache import cache_folder

    folder = cache_folder()
    files = [path for path in folder.rglob("*") if path.is_file()]
    size = sum(path.stat().st_size for path in files)
    show.table("kernel cache", (("folder", "left"), ("files", "right"), ("size", "right")), [(folder, len(files), f"{size / 1e6:.1f} MB")])


def _self_test() -> bool:
    """A few closed forms through the layers; a line each."""
    from drivewright import gears, motion
    from drivewright.numerics.roots import bracketed_roots

    started = time.perf_counter()
    peaks = motion.law("modified-sine").peaks()
    driven = gears.EllipticGearPair(eccentricity=0.3).driven(3.141592653589793)
    rows = (
        ("9.525 mm in metres", units.to_si("9.525 mm", "length"), 9.525e-3),
        ("modified sine, peak acceleration", peaks.Am, 5.527957),
        ("elliptic pair after half a turn", driven, 3.141592653589793),
        ("root of x^2 - 2", bracketed_roots(lambda x: x * x - 2, [1.0, 2.0])[0], 2**0.5),
    )
    passed = [abs(value - expected) < 1e-6 for _, value, expected in rows]
    show.table(
        "self-test",
        (("what", "left"), ("found", "right"), ("expected", "right"), ("", "left")),
        [
            (what, f"{value:.7g}", f"{expected:.7g}", "ok" if ok else "WRONG")
            for (what, value, expected), ok in zip(rows, passed, strict=True)
        ],
    )
    show.note(f"self-test: {sum(passed)} of {len(passed)} in {time.perf_counter() - started:.1f} s")
    return all(passed)
