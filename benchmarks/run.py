"""Side by side, in one run: our speed, a peer's, accuracy beside time.  Writes docs/benchmarks.md; asserts nothing."""

import os
import platform
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import chains
import indexing
import linkages
import numpy as np
import shafts
import solids
import studies
import studio
import viewers
from timing import best

ROOT = Path(__file__).parent.parent
sys.path.append(str(ROOT / "docs"))

from builders.markdown import table  # noqa: E402

EXAMPLES = ROOT / "examples"
EXAMPLE = EXAMPLES / "seedling_pusher.toml"
BYTECODE = Path(tempfile.gettempdir()) / "drivewright-bytecode"


def command(code, repeat=5, environment=None):
    """(shortest, median) wall seconds of a whole Python process; of its first run where it is to be repeated 0 times.

    Its modules lie there as bytecode, as they do wherever Python may write it.
    """
    environment = dict(environment or os.environ, PYTHONPYCACHEPREFIX=str(BYTECODE))
    environment.pop("PYTHONDONTWRITEBYTECODE", None)

    def once():
        subprocess.run([sys.executable, *code], capture_output=True, env=environment, check=True)

    if repeat:
        return best(once, repeat)
    began = time.perf_counter()
    once()
    return (time.perf_counter() - began,) * 2


def start_up():
    """Import and command line, as whole processes; the bare interpreter and the pace of the machine beside them."""
    bare = command(["-c", "pass"])
    yield "a sum of ten million numbers in a Python loop", best(lambda: total_of(10_000_000), 3), "pace of the machine on that day"
    yield "python -c pass (floor)", bare, ""
    yield "import drivewright", command(["-c", "import drivewright"]), "wanted under 0.3 s"
    yield "drivewright --help", command(["-m", "drivewright", "--help"]), "wanted under 0.15 s"


def total_of(count):
    """A loop that any Python does alike."""
    total = 0
    for number in range(count):
        total += number
    return total


COLD = {  # example: seconds wanted of a first run
    "disc_cam": 3,
    "rubber_roller_61804": 5,
    "pin_indexer": 5,
    "seedling_pusher": 6,
    "four_bar": 6,
    "hyvo_chain": 10,
    "slider_crank_clearance": 12,
}
WARM = {"four_bar": 0.8, "hyvo_chain": 1.5}  # seconds wanted of any other run without figures


def first_runs():
    """`drivewright run`, whole processes: with an empty cache of kernels, then with a full one, without figures and with them."""
    with tempfile.TemporaryDirectory() as folder:
        for name, wanted in COLD.items():
            environment = os.environ | {"XDG_CACHE_HOME": f"{folder}/{name}"}
            run = ["-m", "drivewright", "run", str(EXAMPLES / f"{name}.toml"), "--out", f"{folder}/out"]
            for title, more, repeat, remark in (
                ("first run, kernels compiled", ["--no-figures"], 0, f"wanted under {wanted} s"),
                ("run", ["--no-figures"], 3, f"wanted under {WARM[name]} s" if name in WARM else ""),
                ("run with figures and report", [], 3, "wanted under 2.5 s"),
            ):
                yield f"{name}: {title}", command(run + more, repeat, environment), remark


def designs():
    """Whole trains and cam pairs per second on one core, and the peer's cam follower for as many positions."""
    from drivewright import load
    from drivewright._jit import kernel
    from drivewright.mechanisms.seedling_pusher import designs as d

    spec = load(EXAMPLE)
    rows = np.tile(d.base_row(spec), (20_000, 1))
    rows[:, 1] = np.linspace(0.97, 0.99, len(rows))
    choices, out = d.choices_of(spec, with_mouth=False), np.empty((len(rows), len(d.NAMES)))
    half, law = d.half_angles(), d.law_table(spec.push.law)
    train, cams = d.evaluate_train, d.evaluate_cams

    @kernel
    def trains(rows, choices, c, s, out):
        for n in range(rows.shape[0]):
            train(rows[n], choices, c, s, out[n])

    @kernel
    def pairs(rows, choices, s, v, a, out):
        for n in range(rows.shape[0]):
            cams(rows[n], choices, 1.5, s, v, a, out[n])

    for name, call, wanted in (
        ("train designs", lambda: trains(rows, choices, *half, out), 20_000),
        ("cam-pair designs", lambda: pairs(rows, choices, *law, out), 15_000),
    ):
        seconds = best(call)
        yield (
            f"{name}: {len(rows) / seconds[0]:,.0f} per second and core",
            seconds,
            f"wanted {wanted:,}; {len(rows) / seconds[0] / wanted:.1f} times that",
        )


def peer():
    """pylinkage's cam follower stepped through as many positions as one of our cam-pair designs has, per position."""
    try:
        from pylinkage.actuators import Crank
        from pylinkage.cam import CycloidalMotionLaw, FunctionProfile
        from pylinkage.components import Ground
        from pylinkage.dyads import TranslatingCamFollower
        from pylinkage.simulation import Linkage
    except ImportError as error:
        yield "pylinkage", None, f"not available: {error}"
        return
    positions = 4 * 91
    centre = Ground(0.0, 0.0, name="centre")
    crank = Crank(anchor=centre, radius=0.1, angular_velocity=2 * np.pi / positions)
    profile = FunctionProfile(motion_law=CycloidalMotionLaw(), base_radius=1.0, total_lift=0.4)
    guide = Ground(0.0, 0.0, name="guide")
    linkage = Linkage([centre, guide, crank, TranslatingCamFollower(crank, profile, guide, np.pi / 2)])
    seconds = best(lambda: list(linkage.step(iterations=positions)))
    rate = f"{positions / seconds[0]:,.0f} positions per second"
    yield f"pylinkage: cam follower, {positions} positions ({rate})", seconds, "position only: no pressure angle, no curvature"


def ours_per_position():
    """The same number of positions by our general path (exact derivatives) and by the batch."""
    from drivewright import load
    from drivewright.mechanisms.seedling_pusher import designs as d
    from drivewright.mechanisms.seedling_pusher.build import build

    spec = load(EXAMPLE)
    model = build(spec)
    t = np.linspace(0, 2 * np.pi, 4 * 91)
    general = best(lambda: [model.pair.pitch(cam, t) for cam in model.pair.cams])
    yield f"ours, general path, both cams with three derivatives ({len(t) / general[0]:,.0f} positions per second)", general, ""
    evaluate = d.batch(spec, ("train.axis_ratio",), d.NAMES)
    x = np.linspace(0.98, 0.99, 2000)[:, None]
    seconds = best(lambda: evaluate(x))
    yield (
        f"ours, batch, train and both cams ({2000 * len(t) / seconds[0]:,.0f} cam positions per second)",
        seconds,
        "pressure angle, curvature and track included",
    )


def optimiser():
    """The reverse design of the example."""
    from drivewright import load, optimise

    spec = load(EXAMPLE)
    optimise(spec)
    started = time.perf_counter()
    found = optimise(spec)
    seconds = time.perf_counter() - started
    angle = np.degrees(found.best["cam.max_pressure_angle"])
    yield (
        f"optimise: {found.evaluations:,} designs ({33_000 * seconds / found.evaluations:.2f} s for 33 000)",
        (seconds, seconds),
        f"wanted under 5 s for 33 000; {'feasible' if found.feasible else 'not feasible'}, {angle:.2f}°",
    )


def cam_search():
    """The search for a disc cam, by the batch and design by design."""
    from drivewright import load, registry
    from drivewright.spec import document, from_document

    table = {
        "population": 32,
        "generations": 40,
        "unknowns": [
            {"key": "follower.prime_radius", "lower": "25 mm", "upper": "60 mm"},
            {"key": "follower.offset", "lower": "-10 mm", "upper": "15 mm"},
            {"key": "follower.roller_radius", "lower": "4 mm", "upper": "12 mm"},
        ],
        "objectives": [{"value": "max_pressure_angle"}],
        "requirements": [
            {"value": "check.curvature_margin"},
            {"value": "check.pressure_angle"},
            {"value": "min_convex_radius", "at_most": "30 mm"},
        ],
    }
    spec = load(registry.mechanism("cam").folder / "presets" / "default.toml")
    yield from search("cam", from_document(document(spec) | {"optimise": table}))


def linkage_search():
    """The search for a four-bar, by the batch and design by design; one turn stands for the run of six."""
    from drivewright import load
    from drivewright.spec import document, from_document

    table = {
        "population": 32,
        "generations": 10,
        "unknowns": [
            {"key": "bodies.crank.points.A.0", "lower": "30 mm", "upper": "50 mm"},
            {"key": "bodies.coupler.points.B.0", "lower": "85 mm", "upper": "115 mm"},
            {"key": "bodies.rocker.points.B.0", "lower": "75 mm", "upper": "105 mm"},
        ],
        "objectives": [{"value": "drive.max_torque"}],
        "requirements": [
            {"value": "rocker.swing", "at_least": "50 deg"},
            {"value": "coupler_point.max_acceleration", "at_most": "80 m/s^2"},
        ],
    }
    yield from search("four-bar", from_document(document(load(EXAMPLES / "four_bar.toml")) | {"optimise": table}))


def indexer_search():
    """The search for a stiff pin wheel, by the batch and design by design."""
    from drivewright import load
    from drivewright.spec import document, from_document

    table = {
        "population": 32,
        "generations": 16,
        "unknowns": [
            {"key": "pin_radius", "lower": "7 mm", "upper": "9 mm"},
            {"key": "eccentricity", "lower": "9 mm", "upper": "11 mm"},
            {"key": "shafts.diameters.2", "lower": "25 mm", "upper": "35 mm"},
        ],
        "objectives": [{"value": "stiffness.minimum", "goal": "maximise"}],
        "requirements": [{"value": "contacts.minimum", "at_least": 2.0}],
    }
    yield from search(
        "indexer with its stiffness", from_document(document(load(EXAMPLE.with_name("pin_indexer.toml"))) | {"optimise": table})
    )


def search(name, spec):
    """Time of a design in the search of a spec, and of one alone by the batch and by a run."""
    from drivewright import optimise
    from drivewright.studies.search.evaluator import Evaluator, Runs
    from drivewright.studies.search.problem import prepare
    from drivewright.studies.store import Memory

    found = optimise(spec)
    seconds = best(lambda: optimise(spec), 3)
    each = tuple(part / found.evaluations for part in seconds)
    yield f"{name}, a design of optimise ({found.evaluations:,}, with the run of the best one)", each, "wanted under 5 ms"
    problem = prepare(spec)
    points = np.random.default_rng(1).uniform(*problem.bounds.T, (64, len(problem.keys)))
    one_by_one = Runs(problem, 1, None)
    for route, compute in (("by the batch", Evaluator(problem, Memory())._compute), ("run by run", one_by_one)):
        seconds = best(lambda compute=compute: list(compute(0, points, [], 0)), 3)
        yield f"{name}, a design alone, {route}", tuple(part / len(points) for part in seconds), ""
    one_by_one.close()


def report():
    """The example's run and report, warm."""
    from drivewright import load, runner
    from drivewright.report.folder import write_run_folder

    def everything():
        write_run_folder(runner.run(load(EXAMPLE)), Path(folder) / "run")

    with tempfile.TemporaryDirectory() as folder:
        yield "run of the example", best(lambda: runner.run(load(EXAMPLE)), 3), ""
        yield "run and report of the example, in one process", best(everything, 3), "wanted under 5 s"


def integrator():
    """Dormand-Prince against SciPy at the same tolerance: Arenstorf-like nonlinear oscillator, work and precision."""
    from benchmarks_systems import VanDerPol, rate_of
    from scipy.integrate import solve_ivp

    from drivewright.numerics.ode import integrate

    exact = solve_ivp(rate_of(3.0), (0, 20), [2.0, 0.0], method="DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
    for tolerance in (1e-6, 1e-9):
        ours = integrate(VanDerPol(3.0), 0.0, 20.0, [2.0, 0.0], tolerance, tolerance).y_end
        seconds = best(lambda tolerance=tolerance: integrate(VanDerPol(3.0), 0.0, 20.0, [2.0, 0.0], tolerance, tolerance))
        yield f"DOPRI5, ours, tolerance {tolerance:.0e}", seconds, f"error {np.abs(ours - exact).max():.1e}"
        theirs = solve_ivp(rate_of(3.0), (0, 20), [2.0, 0.0], method="RK45", rtol=tolerance, atol=tolerance).y[:, -1]
        other = best(
            lambda tolerance=tolerance: solve_ivp(rate_of(3.0), (0, 20), [2.0, 0.0], method="RK45", rtol=tolerance, atol=tolerance)
        )
        yield (
            f"RK45, SciPy, tolerance {tolerance:.0e}",
            other,
            f"error {np.abs(theirs - exact).max():.1e}; ours is {other[0] / seconds[0]:.0f} times faster",
        )


SECTIONS = (
    ("Start", start_up),
    ("First and other runs", first_runs),
    ("Designs per second", designs),
    ("Peer: a cam follower", peer),
    ("Ours for as many positions", ours_per_position),
    ("Reverse design", optimiser),
    ("Search for a disc cam", cam_search),
    ("Search for a four-bar", linkage_search),
    ("Search for an indexer", indexer_search),
    ("Report", report),
    ("Integrator", integrator),
    ("Slider-crank with play: work and precision", linkages.work_precision),
    ("Folder: table of impact load coefficients", linkages.table),
    ("Slider-crank with play: bifurcation diagram", linkages.bifurcation),
    ("Friction in ideal joints", linkages.friction),
    *shafts.SECTIONS,
    *indexing.SECTIONS,
    *chains.SECTIONS,
    *solids.SECTIONS,
    *studies.SECTIONS,
    *studio.SECTIONS,
    *viewers.SECTIONS,
)


def main():
    lines = [
        "# Benchmarks",
        "",
        f"Python {platform.python_version()}, {os.cpu_count()} cores, {platform.machine()}. One run, everything side by side; the shortest "
        "of the repeats and the median. Compile time is not included, but for first runs. Nothing here is asserted by a test.",
        "",
    ]
    chosen = sys.argv[1:]  # beginnings of titles: these alone, printed and not written
    for title, section in SECTIONS:
        if chosen and not title.startswith(tuple(chosen)):
            continue
        rows = []
        for name, seconds, remark in section():
            times = ["", ""] if seconds is None else [f"{s:.3g} s" if s >= 1 else f"{1e3 * s:.3g} ms" for s in seconds]
            rows.append([name, *times, remark])
            print(f"{title}: {' | '.join(rows[-1])}", flush=True)
        lines += [f"## {title}", *table(("what", "shortest", "median", "remark"), rows)]
    if not chosen:
        (ROOT / "docs" / "benchmarks.md").write_text("\n".join(lines), encoding="utf-8")


if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parent))
    main()
