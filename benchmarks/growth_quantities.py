"""What grows in `growth.py`: for each quantity its sizes, the call that is timed at a size, and the exponent that is expected.

A call does the same work per link, case, body ... at every size: the same number of steps, positions or rounds.
"""

import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from drivewright.chains.closure.model import Strands

EXAMPLES = Path(__file__).parent.parent / "examples"
PITCH, ROLLING = 9.525e-3, 1.2e-3  # of the chain [m]
ARM, SPAN = 0.05, 0.1  # rocker and coupler of the row of parallelograms [m]
MODULUS, POISSON = 206e9, 0.3


class Prepared(NamedTuple):
    """One size made ready: the size as it came out, what is timed, and what has to live as long as that."""

    size: int
    call: Callable[[], object]
    kept: object = None


class Quantity(NamedTuple):
    """What grows: its panel of the figure, name, what the sizes count, sizes, `prepare(size)`, the exponents expected, and why."""

    panel: str
    name: str
    counts: str
    sizes: Sequence[float]
    prepare: Callable[..., Prepared]
    expected: tuple[float, float]
    why: str


# -- chains --------------------------------------------------------------------------------------------------------------------


def running_chain(scale: int) -> Prepared:
    """42 links around 18 and 19 teeth times `scale`, at one speed of the chain: about ten thousand explicit steps."""
    from drivewright import load, registry
    from drivewright.chains.explicit.simulate import Settings, simulate
    from drivewright.chains.model import at_speed
    from drivewright.mechanisms.silent_chain.chain_drive import chain_drive
    from drivewright.runner import build

    changes = (
        f"teeth=[{18 * scale}, {19 * scale}]",
        f"links={42 * scale}",
        'joint.kind="round-pin"',
        f'joint.rolling_radius="{1e3 * ROLLING} mm"',
        'plate.link_mass="2.5 g"',
        'plate.link_inertia="6.4e-8 kg m^2"',
        'driven.mass="0.6 kg"',
    )
    model = chain_drive(build(load(registry.mechanism("silent-chain").presets()["default"], changes)))
    model, settings = at_speed(model, model.drive.speed / scale), Settings(1e-6, run_in=0.0)
    return Prepared(model.chain.count, lambda: simulate(model, 0.01, settings))


def closure(strands: "Strands") -> Callable[[int], Prepared]:
    """Closure of such a chain over a tooth, 48 positions."""

    def prepare(scale: int) -> Prepared:
        from drivewright.chains.closure import Drive, close
        from drivewright.chains.link import design_link

        drive = Drive(design_link(PITCH, ROLLING, np.pi / 6, 0.0), 18 * scale, 19 * scale, 42 * scale, strands)
        return Prepared(drive.links, lambda: close(drive))

    return prepare


# -- designs and cases ---------------------------------------------------------------------------------------------------------


def pusher_designs(count: int) -> Prepared:
    """Train and cam pair of a seedling pusher by the compiled batch."""
    from drivewright import load
    from drivewright.mechanisms.seedling_pusher import designs

    evaluate = designs.batch(load(EXAMPLES / "seedling_pusher.toml"), ("train.axis_ratio",), designs.NAMES)
    rows = np.linspace(0.98, 0.99, count)[:, None]
    assert evaluate is not None, "the batch covers the ratio of the axes"
    return Prepared(count, lambda: evaluate(rows))


def shaft_designs(count: int) -> Prepared:
    """Flexibilities of stepped shafts on three bearings by the compiled batch, one thread."""
    import shafts

    from drivewright.shafts import flexibilities

    many = shafts.designs(shafts.STEPPED, count)
    return Prepared(count, lambda: flexibilities(**many, workers=1))


def cases(analysis: str) -> Callable[[int], Prepared]:
    """A study of a chain on disk, from the spec to its table, computed in this process."""

    def prepare(count: int) -> Prepared:
        from drivewright import linspace, load, sweep

        spec = load(EXAMPLES / "hyvo_chain.toml", (f'study.analyses=["{analysis}"]',))

        def study() -> None:
            with tempfile.TemporaryDirectory() as folder:
                sweep(spec, {"joint.rolling_radius": linspace("1.0 mm", "1.6 mm", count)}, out=Path(folder) / "S", on="serial")

        return Prepared(count, study)

    return prepare


def parts(count: int) -> Prepared:
    """One case more, entered in a study on disk that has so many parts already."""
    from drivewright import linspace, load, sweep
    from drivewright.studies.parts import Part, part_name
    from drivewright.studies.study_folder import Folder

    spec = load(EXAMPLES / "hyvo_chain.toml", ('study.analyses=["meshing"]',))
    table = sweep(spec, {"joint.rolling_radius": linspace("1.0 mm", "1.6 mm", 2)}, on="serial").table.slice(0, 1)
    scratch = tempfile.TemporaryDirectory()
    folder, first = Folder(Path(scratch.name) / "S", spec, {"plan": "made up"}), iter(range(count, 10**9))
    names = [part_name(number, 1) for number in range(count)]
    for name in names:
        (Path(scratch.name) / "S" / "parts" / name).touch()
    folder._enter([Part(number, 1, name, 0, "") for number, name in enumerate(names)])  # noqa: SLF001 - as many as `add` would have made

    def another() -> None:
        folder.add(next(first), table, 1.0)

    return Prepared(count, another, scratch)


# -- linkages ------------------------------------------------------------------------------------------------------------------


def parallelograms(count: int) -> Prepared:
    """A row of parallel cranks, each coupled to the next, the first one driven: 200 positions."""
    from drivewright import multibody as mb

    on, rocker = mb.Marker, {"mass": 0.2, "inertia": 3e-5, "centroid": (ARM / 2, 0.0), "angle": np.pi / 3}
    bodies, joints = [mb.Body("rocker0", **rocker)], [mb.Revolute("ground0", on("ground"), on("rocker0"))]
    for k in range(1, count + 1):
        bodies += [mb.Body(f"coupler{k}", 0.3, 2e-4, (SPAN / 2, 0.0)), mb.Body(f"rocker{k}", **rocker)]
        joints += [
            mb.Revolute(f"ground{k}", on("ground", k * SPAN), on(f"rocker{k}")),
            mb.Revolute(f"tail{k}", on(f"rocker{k - 1}", ARM), on(f"coupler{k}")),
            mb.Revolute(f"head{k}", on(f"coupler{k}", SPAN), on(f"rocker{k}", ARM)),
        ]
    assembly = mb.assemble(mb.MultibodyModel(tuple(bodies), tuple(joints), drives=(mb.JointDrive("ground0", mb.line(0.0, 1.0)),)))
    times = np.linspace(0.0, np.pi / 3, 200)  # from 60 to 120 deg: no parallelogram folds
    return Prepared(len(bodies), lambda: mb.simulate(assembly, times[-1], samples=times))


def pendulum(count: int) -> Prepared:
    """A chain of pendulums under gravity: 100 steps of the classical Runge-Kutta method."""
    from drivewright import multibody as mb

    on, step = mb.Marker, 1e-4
    bodies = [mb.Body(f"link{k}", 0.1, 1e-4, (SPAN / 2, 0.0), angle=0.1 * np.sin(k)) for k in range(count)]
    joints = [mb.Revolute(f"pin{k}", on(f"link{k - 1}", SPAN) if k else on("ground"), on(f"link{k}")) for k in range(count)]
    assembly = mb.assemble(mb.MultibodyModel(tuple(bodies), tuple(joints), gravity=(0.0, -9.81)))
    return Prepared(count, lambda: mb.simulate(assembly, 100 * step, mb.Settings(method="rk4", max_step=step)))


# -- shafts, indexers, solids --------------------------------------------------------------------------------------------------


def loaded_shaft(bearings: int, segments: int) -> Callable[[], object]:
    """A stepped shaft on ball bearings 100 mm apart with 500 N behind each: from the description to rest."""
    import shafts as benchmark

    from drivewright import shafts
    from drivewright.bearings import law_of

    law, pitch = law_of(benchmark.ball_bearing()), 0.1
    supports = tuple(shafts.Support(f"B{k}", pitch * (k + 0.45), law=law) for k in range(bearings))
    diameters = [(0.02, 0.022, 0.025, 0.021)[k % 4] for k in range(segments)]
    sections = tuple(shafts.Section(pitch * bearings / segments, diameter, diameter) for diameter in diameters)
    loads = shafts.ShaftLoads(tuple(shafts.ShaftLoad(pitch * (k + 0.9), (0.0, -500.0, 0.0)) for k in range(bearings)))
    return lambda: shafts.apply_loads(shafts.Shaft(sections, MODULUS, POISSON, 7850.0, supports), loads)


def segments(count: int) -> Prepared:
    """Two bearings, more and more segments."""
    return Prepared(count, loaded_shaft(2, count))


def bearings(count: int) -> Prepared:
    """As many segments as bearings."""
    return Prepared(count, loaded_shaft(count, count))


def pins(count: int) -> Prepared:
    """Trimmed profile of a cam for a wheel of so many pins, 63 mm of the pin circle each."""
    from drivewright.indexing.motion import index_motion
    from drivewright.indexing.pin_wheel import PinWheel

    motion = index_motion("modified-sine", count, 1.0)
    return Prepared(count, lambda: PinWheel(count, 0.01 * count, 0.008, 0.01, motion).profile)


def elements(size: float) -> Prepared:
    """A steel block of 60 x 30 x 20 mm in curved tetrahedra of second order of at most `size` [mm]: factorised, one unit load."""
    from drivewright.solids.elastic import FreeBody
    from drivewright.solids.engine import fe_module
    from drivewright.solids.meshing import solid_mesh

    occ = fe_module("netgen.occ", "this benchmark")
    block = occ.Box(occ.Pnt(0, 0, 0), occ.Pnt(60, 30, 20))
    block.faces.Max(occ.X).name = "end"
    mesh = solid_mesh(block, size, 0.3)

    def solved() -> FreeBody:
        body = FreeBody(mesh, MODULUS, POISSON)
        body.response([body.mean("end", (1.0, 0.0, 0.0))])
        return body

    return Prepared(solved().unknowns, solved)


SCALES = (1, 2, 4, 8, 16, 32, 47)  # a spec takes 2000 links
QUANTITIES = (
    Quantity(
        "Chains",
        "running, 10 000 steps",
        "links",
        SCALES,
        running_chain,
        (0.8, 1.05),
        "a link has two neighbours: one pass over the links; short chains pay for the rest of a step",
    ),
    Quantity("Chains", "closure, bent strands", "links", SCALES, closure("equilibrium"), (0.8, 1.1), "each strand is summed link by link"),
    Quantity(
        "Chains",
        "closure, straight strands",
        "links",
        SCALES,
        closure("straight"),
        (-0.1, 0.1),
        "four seats and two straight lines, however many links",
    ),
    Quantity(
        "Designs in a batch",
        "seedling pusher",
        "designs",
        (30, 100, 300, 1000, 3000, 10_000),
        pusher_designs,
        (0.95, 1.05),
        "design by design",
    ),
    Quantity(
        "Designs in a batch",
        "shaft, 3 bearings",
        "designs",
        (3000, 10_000, 30_000, 100_000, 300_000),
        shaft_designs,
        (0.95, 1.05),
        "design by design",
    ),
    Quantity(
        "Studies on disk",
        "run by run (closure)",
        "cases",
        (20, 60, 200, 600, 2000),
        cases("closure"),
        (0.8, 1.05),
        "case by case; opening the folder and the first run are the same for all",
    ),
    Quantity(
        "Studies on disk",
        "compiled (meshing)",
        "cases",
        (10_000, 30_000, 100_000, 300_000, 1_000_000),
        cases("meshing"),
        (0.7, 1.05),
        "case by case and column by column; opening the folder is the same for all",
    ),
    Quantity(
        "Studies on disk",
        "one part more",
        "parts",
        (100, 300, 1000, 3000, 10_000, 30_000),
        parts,
        (-0.1, 0.1),
        "the ledger is a tree, and nothing looks through the folder but a start",
    ),
    Quantity(
        "Linkages",
        "kinematics, 200 positions",
        "bodies",
        (2, 4, 8, 16, 32, 64),
        parallelograms,
        (2.0, 3.0),
        "dense: partial velocities of n bodies by n coordinates, n^2, and a factorisation of all loops at once, n^3",
    ),
    Quantity(
        "Linkages",
        "dynamics, 100 steps",
        "bodies",
        (4, 8, 16, 32, 64, 128),
        pendulum,
        (2.0, 3.0),
        "dense: a mass matrix in minimal coordinates, n^2 products for each of n bodies, and its factorisation, n^3",
    ),
    Quantity(
        "Shafts",
        "segments, 2 bearings",
        "segments",
        (10, 20, 40, 80, 160, 320),
        segments,
        (0.9, 1.1),
        "a beam is a band; here each step of Newton's method factorises a dense matrix with 6 unknowns a segment, n^3",
    ),
    Quantity(
        "Shafts",
        "bearings and segments",
        "bearings",
        (2, 4, 8, 16, 32, 64),
        bearings,
        (2.0, 3.0),
        "dense Newton's method: n^2 entries for each of n bearings, and a factorisation, n^3",
    ),
    Quantity(
        "Indexers",
        "profile of the cam",
        "pins",
        (4, 8, 16, 32, 64, 128),
        pins,
        (0.8, 1.3),
        "as many pieces of the envelope as pins; candidates for crossings are found by their boxes",
    ),
    Quantity(
        "Solids",
        "factor, solve once",
        "unknowns",
        (10, 6.5, 5, 4, 3.2, 2.6),
        elements,
        (1.3, 2.0),
        "elements n, sparse Cholesky factorisation in space n^2, of which small bodies see the beginning",
    ),
)
