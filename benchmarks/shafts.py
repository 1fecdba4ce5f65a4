"""Shafts on bearings: designs per second beside PyNite and ROSS and beside what this machine can do; a bearing, large shafts."""

import json
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import shaft_specs
from timing import best

sys.path.insert(0, str(Path(__file__).parent.parent / "tests" / "support"))  # the peers' models are those of the tests
MODULUS, POISSON, CORES = 206e9, 0.3, 2
UNIFORM = {"sections": [[0.34, 0.02, 0.0]], "supports": [0.0565, 0.1365], "stiffness": [3e7, 3e7], "stations": [0.0, 0.245]}
# Nine nodes: five ends of sections, three bearings, two stations, of which one at an end.
STEPPED = {
    "sections": [[0.08, 0.03, 0.0], [0.12, 0.042, 0.0], [0.1, 0.05, 0.0], [0.11, 0.035, 0.0]],
    "supports": [0.05, 0.18, 0.37],
    "stiffness": [5e7, 2e8, 8e6],
    "stations": [0.0, 0.25],
}
# Counted in the source, divisions as one: closed form with two stations; the stepped shaft above.
CLOSED_FLOPS, SWEPT_FLOPS = 300, 700


def designs(shaft, count):
    """Arguments of `flexibilities` for `count` shafts near this one, every number of its own."""
    rng = np.random.default_rng(1)
    lengths, diameters, _ = np.transpose(shaft["sections"])

    def near(values):
        return np.asarray(values) * rng.uniform(0.98, 1.02, (count, len(values)))

    return {
        "lengths": 1.05 * near(lengths),
        "diameters": near(diameters),
        "supports": near(shaft["supports"]),
        "radial_stiffness": near(shaft["stiffness"]),
        "stations": near(shaft["stations"]),
        "youngs_modulus": MODULUS,
        "poisson": POISSON,
    }


def batches():
    """Both routes of the batch, on one thread and on two; every input read once, every flexibility written once."""
    from drivewright.shafts import flexibilities

    memory, arithmetic = machine()
    yield "memory of this machine, two threads", None, f"{memory / 1e9:.1f} GB/s, a copy of 256 MB counted twice"
    yield "arithmetic of this machine, two threads", None, f"{arithmetic / 1e9:.0f} Gflop/s, multiply and add in the first cache"
    for name, shaft, count, flops, wanted in (
        ("closed form, two bearings, uniform", UNIFORM, 2_000_000, CLOSED_FLOPS, 6e7),
        ("stepped, 9 nodes, three bearings", STEPPED, 400_000, SWEPT_FLOPS, 5e5),
    ):
        many = designs(shaft, count)
        traffic = 8 * sum(np.shape(value)[1] for value in many.values() if np.ndim(value) == 2) + 32
        for workers in (1, CORES):
            seconds = best(lambda many=many, workers=workers: flexibilities(**many, workers=workers))
            rate = count / seconds[0]
            yield (
                f"{name}, {workers} thread{'s' * (workers > 1)}: {rate:,.0f} designs per second",
                seconds,
                (
                    f"wanted {wanted:.0e} on two; {flops} flops and {traffic} B a design: {100 * rate * flops / arithmetic:.0f} % of the "
                    f"arithmetic, {100 * rate * traffic / memory:.0f} % of the memory of both cores"
                ),
            )


def accuracy():
    """How far the two routes of the batch are apart, where both can go, and the sweep from itself with the shaft cut into slices."""
    from drivewright.shafts import flexibilities

    many = designs(UNIFORM, 10_000)
    closed = flexibilities(**many)
    third = {
        "supports": np.c_[many["supports"], many["lengths"] / 2],
        "radial_stiffness": np.c_[many["radial_stiffness"], np.zeros(10_000)],
    }
    yield "closed form against sweep, 10 000 designs", None, f"largest difference {_apart(flexibilities(**many | third), closed):.1e}"
    many = designs(STEPPED, 10_000)
    sliced = {"lengths": np.repeat(many["lengths"] / 5, 5, axis=1), "diameters": np.repeat(many["diameters"], 5, axis=1)}
    apart = _apart(flexibilities(**many | sliced), flexibilities(**many))
    yield "stepped shaft against the same in five times the sections", None, f"largest difference {apart:.1e}"


def _apart(a, b):
    """Largest difference of an entry, against the root of the two diagonals it stands between."""
    scale = np.sqrt(np.einsum("...ii->...i", b))
    return np.max(np.abs(a - b) / (scale[..., :, None] * scale[..., None, :]))


def peers():
    """The stepped shaft one by one: PyNite here, ROSS in a process of its own, its import left out."""
    from drivewright.shafts import EULER_BERNOULLI, flexibilities

    shaft = STEPPED | {"modulus": MODULUS, "poisson": POISSON, "timoshenko": False, "mass": 1.0}
    lengths, diameters, _ = np.transpose(STEPPED["sections"])

    def ours():
        return flexibilities(
            lengths, diameters, STEPPED["supports"], STEPPED["stiffness"], STEPPED["stations"], MODULUS, POISSON, EULER_BERNOULLI
        )[0]

    alone = best(ours, 200)
    yield f"ours, a batch of one: {1 / alone[0]:,.0f} designs per second", alone, "Euler-Bernoulli, as PyNite has it"
    try:
        import pynite_shaft

        theirs = best(lambda: pynite_shaft.flexibility(shaft), 10)
        yield (
            f"PyNite, one by one: {1 / theirs[0]:,.0f} designs per second",
            theirs,
            f"largest difference from ours {_apart(pynite_shaft.flexibility(shaft), ours()):.1e}",
        )
    except ImportError as error:
        yield "PyNite", None, f"not available: {error}"
    helper = Path(__file__).parent.parent / "tests" / "support" / "ross_shaft.py"
    told = subprocess.run([sys.executable, helper], input=json.dumps({"shafts": [shaft], "repeat": 20}), capture_output=True, text=True)
    if told.returncode:
        yield "ROSS", None, f"not available: {told.stderr.splitlines()[-1]}"
        return
    found = json.loads(next(line for line in told.stdout.splitlines() if line.startswith("[")))[0]
    yield (
        f"ROSS, one by one: {1 / found['seconds']:,.0f} designs per second",
        (found["seconds"],) * 2,
        f"largest difference from ours {_apart(np.array(found['flexibility']), ours()):.1e}; from its assembled matrix: its own "
        "static run takes every bearing for rigid",
    )


def rotors():
    """A rotor with two discs on 60 elements, damped and the same all round or not: Campbell diagram of 50 speeds, beside ROSS."""
    import rotors as cases

    from drivewright import shafts

    for name, stiffness in (("the same all round", cases.matrix(1e6)), ("two stiffnesses", cases.matrix(1e6, 0.8e6))):
        case = cases.two_discs(stiffness, cases.matrix(100.0))
        speeds = np.linspace(0.0, 1.2 * case["speed"], 50)
        equilibrium, rotor = cases.our_rotor(case)
        exact = shafts.campbell(shafts.reduced_rotor(equilibrium, [0.5], kept=60), speeds[-1:], 4).frequency[0]
        apart = np.max(np.abs(shafts.campbell(rotor, speeds[-1:], 4).frequency[0] / exact - 1))
        yield (
            f"Campbell diagram, 60 elements, 50 speeds, {name}",
            best(lambda rotor=rotor, speeds=speeds: shafts.campbell(rotor, speeds, 4), 5),
            f"wanted under 1 s; eight frequencies within {apart:.0e} of those with all modes",
        )
        yield f"reduced rotor from the shaft at rest, {name}", best(lambda e=equilibrium: shafts.reduced_rotor(e, [0.5]), 5), ""
    yield from _ross_campbell(case | {"places": rotor.z.tolist()}, shafts.campbell(rotor, speeds, 4).frequency[-1])


def _ross_campbell(case, ours):
    """The last of them in ROSS, in a process of its own, its import left out."""
    helper = Path(__file__).parent.parent / "tests" / "support" / "ross_rotor.py"
    asked = json.dumps({"rotors": [case | {"speed": 1.2 * case["speed"]}], "campbell": True})
    told = subprocess.run([sys.executable, helper], input=asked, capture_output=True, text=True)
    if told.returncode:
        yield "ROSS, Campbell diagram", None, f"not available: {told.stderr.splitlines()[-1]}"
        return
    found = json.loads([line for line in told.stdout.splitlines() if line.startswith("[{")][-1])[0]
    theirs = np.array(found["frequency"])
    apart = max(np.min(np.abs(theirs / each - 1)) for each in ours[:6])
    yield "ROSS, Campbell diagram of the same", (found["seconds"],) * 2, f"all 366 freedoms; six frequencies within {apart:.0e} of ours"


def bearing():
    """One five-degree-of-freedom equilibrium, in a batch of loads all round."""
    from drivewright.bearings import equilibria, law_of

    law = law_of(ball_bearing())
    turn = np.linspace(0.0, 2 * np.pi, 2000, endpoint=False)
    forces = np.array([500 * np.cos(turn), 500 * np.sin(turn), np.full_like(turn, 200.0), 0 * turn, 0 * turn]).T
    held = np.zeros(5, dtype=bool)
    shortest, median = (seconds / len(turn) for seconds in best(lambda: equilibria(law, forces, held)))
    steps = equilibria(law, forces, held)[1]
    yield (
        f"bearing of 12 balls, five freedoms: {1e6 * shortest:.1f} us",
        (shortest, median),
        (f"wanted under 20 us; {steps.mean():.1f} steps of Newton's method, {steps.min()} to {steps.max()}"),
    )


def coupled():
    """The paper's shaft on two such bearings, 500 N at its end wheel, from the description to rest."""
    from drivewright import shafts
    from drivewright.bearings import law_of

    law = law_of(ball_bearing())
    supports = (shafts.Support("A", 0.0565, law=law), shafts.Support("B", 0.1365, law=law))
    shaft = shafts.Shaft((shafts.Section(0.34, 0.02, 0.02),), MODULUS, POISSON, 7850.0, supports, (shafts.Station("m2", 0.245),))
    loads = shafts.ShaftLoads((shafts.ShaftLoad(0.245, (0.0, -500.0, 0.0)),))
    found = shafts.apply_loads(shaft, loads).equilibrium
    yield "shaft and two ball bearings, coupled", best(lambda: shafts.apply_loads(shaft, loads)), f"{found.steps} steps of Newton's method"


def large():
    """Shafts with many bearings, stations and segments: a run in this process, and of it the statics and the sensitivities."""
    with tempfile.TemporaryDirectory() as folder:
        for name, (text, wanted) in shaft_specs.SPECS.items():
            path = Path(folder, "spec.toml")
            path.write_text(text, encoding="utf-8")
            seconds, remark = _large_run(path)
            yield f"run of a shaft, {name}", seconds, f"wanted under {wanted:g} s; {remark}"


def _large_run(path):
    """((shortest, median) seconds of a run, what part of it are the statics and the sensitivities)."""
    from drivewright import load, runner
    from drivewright.mechanisms.shaft import build, mechanism

    spec = load(path)
    model, analyses = build(spec), {each.name: each for each in mechanism.analyses}
    done = runner.run_analyses(spec, model, runner.select_analyses(mechanism.analyses, "sensitivities"))
    statics, sensitivities = (best(lambda name=name: analyses[name].answer(model, done), 3)[0] for name in ("statics", "sensitivities"))
    count = len(done["sensitivities"].values)
    return best(lambda: runner.run(spec), 3), f"statics {1e3 * statics:.0f} ms, {count:,} sensitivities {1e3 * sensitivities:.0f} ms"


def ball_bearing():
    """20 x 32 x 7 mm, inner geometry fitted to its ratings."""
    from drivewright.bearings import BallBearing

    return BallBearing(balls=12, ball_diameter="3.572 mm", pitch_diameter="26 mm", youngs_modulus="206 GPa", poisson_ratio=0.3)


# -- the machine ---------------------------------------------------------------------------------------------------------------


def machine():
    """(bytes, flops) per second that two threads reach at best: copying memory, and multiply-add over a row that stays in the cache."""
    from drivewright._jit import inner

    @inner
    def multiply_add(rows, turns):
        for _ in range(turns):
            for i in range(rows.size):
                rows[i] = rows[i] * 0.999 + 0.5

    source, target = np.ones((CORES, 1 << 24)), np.zeros((CORES, 1 << 24))
    rows, turns = np.ones((CORES, 512)), 200_000
    with ThreadPoolExecutor(CORES) as pool:
        copied = best(lambda: list(pool.map(np.copyto, target, source)))[0]
        computed = best(lambda: list(pool.map(multiply_add, rows, [turns] * CORES)))[0]
    return 2 * source.nbytes / copied, 2 * rows.size * turns / computed


SECTIONS = (
    ("Shafts: many at once", batches),
    ("Shafts: accuracy", accuracy),
    ("Shafts: peers", peers),
    ("Shafts: rotors", rotors),
    ("Bearing", bearing),
    ("Shaft and bearings", coupled),
    ("Shafts: large ones", large),
)
