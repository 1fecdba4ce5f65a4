"""Chain drives: time of a link's step, of closures, maps and lives; a roller chain beside Exudyn's at the same contact stiffness."""

import time
from dataclasses import replace

import numpy as np
from timing import best

CORES = 2
RADII = (1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 7.4)  # mm, seven groups of the paper and its control group
DURATION, SHORT, STEP = 0.3, 0.1, 1e-6
FLOPS, SCALAR, VECTOR = 170, 28.0, 8.0  # of a link's step; ns of it that this kind of machine allows, one number or eight at a time
PITCH = 9.525e-3


def system(radius):
    """The paper's drive [mm], masses assumed, the outer flank where the paper has it."""
    from drivewright import load, registry
    from drivewright.mechanisms.silent_chain.chain_drive import chain_drive
    from drivewright.runner import build

    flank = float(2.6 + (1.2 - radius) * np.cos(np.pi / 6))
    kind = "arc" if radius > 0.25e3 * PITCH else "round-pin"
    changes = (
        f'joint.kind="{kind}"',
        f'joint.rolling_radius="{radius} mm"',
        f'plate.apothem="{flank!r} mm"',
        'plate.link_mass="2.5 g"',
        'plate.link_inertia="6.4e-8 kg m^2"',
        'driven.mass="0.6 kg"',
    )
    return chain_drive(build(load(registry.mechanism("silent-chain").presets()["default"], changes)))


def running():
    """Explicit steps of 82 links at 2000 rpm, and all groups of the paper."""
    from drivewright.cases import run
    from drivewright.chains.explicit.simulate import Settings, simulate
    from drivewright.chains.explicit.stability import largest_step

    drive, settings = system(1.2), Settings(STEP, settle=0.1, run_in=0.0)
    seconds = best(lambda: simulate(drive, DURATION, settings), 5)
    motion = simulate(drive, DURATION, settings)
    per = [1e9 * s * motion.step / DURATION / drive.chain.count for s in seconds]
    yield (
        f"82 links, 0.3 s at 2000 rpm in steps of {1e6 * motion.step:.3g} us, one core: {per[0]:.1f} ns per link and step",
        seconds,
        (
            f"{FLOPS} flops; this kind of machine allows {SCALAR:g} ns one link at a time, {VECTOR:g} ns with vectors: "
            f"{per[0] / VECTOR:.1f} times that; wanted under 14 ns; energy drift {motion.energy_drift:.1e}"
        ),
    )
    drives = [system(radius) for radius in RADII]

    def one(each):
        return simulate(each, DURATION, replace(settings, step=min(STEP, 0.5 * largest_step(each)))).energy_drift

    seconds, rows = best(lambda: run(one, drives, CORES), 2), run(one, drives, CORES).rows
    yield (
        "eight groups of the paper, 0.3 s each, two threads",
        seconds,
        (f"wanted under 10 s; {sum(row.ok for row in rows)} ran, largest energy drift {max(row.value or 0.0 for row in rows):.1e}"),
    )


def tensioned():
    """The plain roller chain and the tensioned one of the examples: what tensioner, rail and idler cost a link's step.

    Time of the steps alone, of a longer run less that of a shorter one from the same start: to find the path around all bodies takes a
    drive with tensioners 13 ms, once.
    """
    from pathlib import Path

    from drivewright import load
    from drivewright.chains.explicit.simulate import Settings, first_start, simulate
    from drivewright.mechanisms.silent_chain.chain_drive import chain_drive
    from drivewright.runner import build

    folder, per, settings = Path(__file__).parent.parent / "examples", {}, Settings(STEP, run_in=0.0, tolerance=1.0)
    drives = {name: chain_drive(build(load(folder / f"{name}.toml"))) for name in ("roller_chain", "tensioned_chain")}
    for name, drive in drives.items():
        begin = first_start(drive, settings)
        runs = {long: best(lambda long=long: simulate(drive, long, settings, begin=begin), 9) for long in (0.5 * SHORT, 2.5 * SHORT)}  # noqa: B023
        seconds = [after - before for before, after in zip(*runs.values(), strict=True)]
        step = simulate(drive, 1e-3, settings).step
        per[name] = 1e9 * seconds[0] * step / (2 * SHORT) / drive.chain.count
        words = f"{name}, {drive.chain.count} links, {2 * SHORT:g} s: {per[name]:.1f} ns per link and step"
        times = f", {per[name] / per['roller_chain']:.2f} times the plain one; wanted under 1.3" if name != "roller_chain" else ""
        yield words, seconds, f"run-in left out{times}"


def closures():
    """Rigid drives over a tooth, at rest with contacts, many designs."""
    from drivewright.chains.closure import Drive, close, phase_map
    from drivewright.chains.implicit.equilibrium import equilibrium
    from drivewright.chains.link import design_link
    from drivewright.chains.model import with_sprocket

    joint = design_link(PITCH, 1.2e-3, np.pi / 6, 0.0)
    means = {}
    for strands in ("straight", "equilibrium"):
        drive = Drive(joint, 35, 37, 82, strands)
        means[strands] = close(drive).mean
        yield (
            f"closure over a tooth, 48 positions, strands {strands}",
            best(lambda drive=drive: close(drive), 20),
            (f"mean {1e3 * means[strands]:.6f} mm, rest of the loop {close(drive).residual:.0e} m"),
        )
    drives = [
        Drive(design_link(PITCH, r, np.pi / 6, 0.0), 35, z, n)
        for r in np.linspace(0, 7.4e-3, 5)
        for z in (33, 35, 37, 39)
        for n in range(78, 88)
    ]
    seconds = best(lambda: phase_map(drives, 24, CORES), 3)
    failed = len(phase_map(drives, 24, CORES).failed)
    yield f"phase map of {len(drives)} designs, two threads: {len(drives) / seconds[0]:,.0f} per second", seconds, f"{failed} do not close"
    loaded = with_sprocket(system(1.2), 1, torque=0.0)  # without the torque that the damping of its turning takes up when it runs
    yield (
        "at rest with 150 N, teeth and joints elastic, 24 positions",
        best(lambda: equilibrium(loaded, 24), 5),
        (f"mean {1e3 * equilibrium(loaded, 24).mean:.6f} mm, {equilibrium(loaded, 24).residual:.0e} N unbalanced at most"),
    )


def lives():
    """Critical planes of many points under a plate's history of 200 instants, plane stress."""
    from drivewright import fatigue

    card = fatigue.uniform_material_law(980e6, 206e9)
    rng, points, instants = np.random.default_rng(1), 200, 200
    turn = np.linspace(0, 2 * np.pi, instants, endpoint=False)
    stress = np.zeros((points, instants, 3, 3))
    for k, wave in enumerate((1 + np.sin(turn), np.sin(2 * turn), np.cos(turn))):
        i, j = ((0, 0), (1, 1), (0, 1))[k]
        stress[..., i, j] = stress[..., j, i] = rng.uniform(50e6, 250e6, (points, 1)) * wave
    strain = fatigue.elastic_strain(stress, card)
    remarks = {"max-shear": "", "max-damage": "wanted 2,000"}
    for plane in remarks:
        seconds = best(lambda plane=plane: fatigue.life_map(strain, stress, card, plane), 2)
        yield (
            f"life of {points} points, {instants} instants, plane {plane}: {points / seconds[0]:,.0f} points per second",
            seconds,
            remarks[plane],
        )


# -- a roller chain beside Exudyn's ----------------------------------------------------------------------------------------------

ROLLER, SEAT, SEAT_ANGLE, FLANK = 3.175e-3, 3.9e-3, 1.9, 9e-3
STIFFNESS, DAMPING, FORCE, SPEED = 1e8, 300.0, 150.0, -60.0
TIME, SAMPLES = 1e-3, 10  # [s]
SHARE = 0.4  # of the largest stable step


def roller_drive():
    """24 links around 9 and 10 teeth."""
    from drivewright.chains import model as m
    from drivewright.chains.link import Link
    from drivewright.chains.roller_tooth import RollerTooth

    teeth = [RollerTooth(z, 0.5 * PITCH / np.sin(np.pi / z), SEAT, SEAT_ANGLE, FLANK, ROLLER) for z in (9, 10)]
    chain = m.Chain(Link(PITCH, 0.0, np.pi / 6, 0.0), 24, 2.5e-3, 6.4e-8, 10 * STIFFNESS, 2e-6)
    contact = m.ChainContact(STIFFNESS, DAMPING)
    first = m.Sprocket(teeth[0], contact, angle=0.0, tip_radius=teeth[0].pitch_radius + 2e-3, drive=m.SpeedRamp(SPEED, SPEED))
    second = m.Sprocket(
        teeth[1],
        contact,
        (0.0692, 0.0),
        tip_radius=teeth[1].pitch_radius + 2e-3,
        mass=0.2,
        inertia=2e-5,
        slide=m.Slide(0.0, FORCE, damping=100.0),
    )
    return m.ChainDrive(chain, (first, second))


def beside():
    """The first millisecond of both, from the same start, with the same joints and contacts: the chain of `verify`."""
    from drivewright.chains.explicit.assembly import start
    from drivewright.chains.explicit.simulate import Settings, simulate, tooth_time
    from drivewright.chains.explicit.stability import largest_step

    model = roller_drive()
    begin, step = start(model), SHARE * largest_step(model)
    per_tooth = round(tooth_time(model) / TIME * SAMPLES)
    duration = tooth_time(model) * SAMPLES / per_tooth

    def ours():
        return simulate(model, duration, Settings(step, run_in=0.0, samples_per_tooth=per_tooth), begin=begin)

    def remark(step, time, distance):
        return f"steps of {step:.1e} s; centre distance {1e3 * distance:.6f} mm at {1e3 * time:.4f} ms"

    seconds, motion = best(ours, 5), ours()
    yield (
        f"ours, 24 links, rollers, 1 ms: {1e9 * seconds[0] * motion.step / (model.chain.count * duration):.0f} ns per link and step",
        seconds,
        remark(motion.step, motion.t[-1], motion.centre_distance[-1]),
    )
    try:
        from drivewright.oracles.silent_chain import exudyn_model
    except ImportError as error:
        yield "Exudyn", None, f"not available: {error}"
        return
    for solver, name, longer in (("VelocityVerlet", "Verlet", 1), ("RK44", "Runge and Kutta, order 4", 2)):
        began = time.perf_counter()
        run = exudyn_model.run(model, begin, duration, longer * step, SAMPLES, solver)
        took = time.perf_counter() - began
        distance = abs(run.centre(model, 1) - run.centre(model, 0))[-1]
        each = 1e9 * took * longer * step / (model.chain.count * duration)
        yield (
            f"Exudyn, the same joints and contacts, {name}: {each:,.0f} ns per link and step",
            (took, took),
            f"{remark(longer * step, run.time[-1], distance)}; forces of the teeth by a function in Python",
        )


SECTIONS = (
    ("Chains: running", running),
    ("Chains: tensioners and guides", tensioned),
    ("Chains: closure and equilibrium", closures),
    ("Chains: lives", lives),
    ("Chains: rollers beside Exudyn", beside),
)
