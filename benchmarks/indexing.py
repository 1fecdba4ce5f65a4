"""Indexing drives: profile and contacts beside a polygon kernel, stiffness beside a general minimiser, designs per second."""

from pathlib import Path

import numpy as np
from timing import best

ROOT = Path(__file__).parent.parent
TURN = 2 * np.pi


def wheel():
    """The paper's prototype."""
    from drivewright.indexing import PinWheel, index_motion

    return PinWheel(12, 0.12, 0.008, 0.01, index_motion("modified-sine", 12, 1.0))


def profile():
    """Exact trimming, and the same by shapely: the centre curve as a polygon of as many points, widened by the pin."""
    from shapely import LineString

    from drivewright.indexing.plane import contacts_at, index_angles

    found = wheel()
    angles = index_angles(found)

    def ours():
        return wheel().profile

    def mapped():
        return contacts_at(wheel(), angles)

    exact = ours()
    yield "profile of twelve pins, trimmed on both sides", best(ours), f"area {1e6 * exact.area:.6f} mm², {len(exact.corners)} corners"
    yield "profile, and the contact map of 41 positions", best(mapped), "wanted under 0.12 s"
    for steps in (480, 5760):

        def theirs(steps=steps):
            points = found.pin_paths(np.linspace(0, TURN, steps, endpoint=False)).d0.T.ravel()
            line = LineString(np.stack([np.append(points, points[0]).real, np.append(points, points[0]).imag], axis=1))
            return max(line.buffer(found.pin_radius, quad_segs=max(steps // 30, 8)).interiors, key=lambda ring: ring.length)

        xy = np.array(theirs().coords)
        area = 0.5 * abs(np.sum(xy[:-1, 0] * xy[1:, 1] - xy[1:, 0] * xy[:-1, 1]))
        yield f"shapely, {12 * steps} points on the centre curve", best(theirs, 3), f"area off by {1e6 * abs(area - exact.area):.2g} mm²"


def stiffness():
    """41 positions at once; one of them by SciPy's trust-region minimiser on the same energy, gradient and Hessian."""
    from drivewright import load, registry

    spec = load(ROOT / "examples" / "pin_indexer.toml")
    for model in ("unilateral", "bonded"):
        changed = spec.replace(contact=spec.contact.replace(model=model))
        built = registry.mechanism("indexer").build(changed)
        built.drive.nodes  # noqa: B018 - the profile is timed above
        from drivewright.indexing.stiffness.loading import solve_loaded

        yield (
            f"stiffness at 41 positions, {model}, contacts included",
            best(lambda built=built: solve_loaded(built.loaded_wheel, built.angles, 1000.0)),
            "wanted under 0.2 s",
        )
    yield from _peer(spec, registry.mechanism("indexer").build(spec))


def _peer(spec, built):
    """SciPy's trust-region Newton method with the same energy, gradient and Hessian, from rest."""
    from scipy.optimize import minimize

    from drivewright.indexing import stiffness as core
    from drivewright.indexing.plane import find_contacts
    from drivewright.indexing.stiffness.assembly import assemble_drivetrain, load_vector, pad_contacts
    from drivewright.indexing.stiffness.equilibrium import _linear, _term
    from drivewright.indexing.stiffness.minimise import ConvexEnergy, gradient_and_hessian, total_energy

    theta, torque = np.array([np.pi / 2]), 1000.0
    near = [find_contacts(built.drive, theta[0], 2e-3)]

    def ours():
        return core.solve_torsional_stiffness(built.train, theta, near, spec.eccentricity, torque, cams=spec.cams)

    yield "one position of it", best(ours), f"{ours().secant[0]:.6f} N·m/rad in {ours().steps} steps"
    assembly = assemble_drivetrain(
        built.train, spec.cams, spec.eccentricity * np.exp(1j * theta), pad_contacts(near, [np.isfinite(near[0].gap)]), False
    )
    linear = assembly.basis.transpose(0, 2, 1) @ _linear(assembly) @ assembly.basis
    system = ConvexEnergy(
        linear,
        tuple(_term(group, group.law, assembly.basis) for group in assembly.groups if group.law is not None),
        load_vector(assembly, torque),
    )

    def theirs():
        return minimize(
            lambda y: total_energy(system, y[None])[0],
            np.zeros(linear.shape[1]),
            method="trust-exact",
            jac=lambda y: gradient_and_hessian(system, y[None])[0][0],
            hess=lambda y: gradient_and_hessian(system, y[None])[1][0],
            options={"gtol": 1e-6, "maxiter": 2000},
        )

    found = theirs()
    turn = (system.load[0] @ found.x) / torque
    yield (
        "SciPy, trust-exact, same energy and derivatives, from rest",
        best(theirs, 1),
        (f"{torque / turn:.6f} N·m/rad after {found.nit} steps; {'converged' if found.success else found.message}"),
    )


def designs():
    """Play, pressure angle and contacts of a thousand designs."""
    from drivewright.indexing.batch import evaluate_pin_wheels
    from drivewright.motion import law

    rng = np.random.default_rng(1)
    sizes = rng.uniform(0.005, 0.012, 1000), rng.uniform(0.006, 0.014, 1000), TURN * rng.uniform(0.4, 0.8, 1000)
    seconds = best(lambda: evaluate_pin_wheels(law("modified-sine"), 12, 0.12, *sizes), 1)
    yield (
        f"1000 designs, play, contacts and pressure angle: {1000 / seconds[0]:.0f} designs per second",
        seconds,
        ("wanted under 4 s; two threads; play every 0.9° of the whole turn"),
    )


def growth():
    """The whole default run without figures over the number of pins, on a pitch of 10 mm times 2 pi, and the exponent from row to row."""
    from drivewright import load, runner

    spec, before = load(ROOT / "examples" / "pin_indexer.toml"), None
    for pins in (12, 24, 50, 100, 200):
        changed = spec.replace(pins=pins, pin_circle_radius=f"{10 * pins} mm")
        seconds = best(lambda changed=changed: runner.run(changed), 2)
        exponent = f"time grows as pins^{np.log(seconds[0] / before[1]) / np.log(pins / before[0]):.2f}; " if before else ""
        yield f"run of {pins} pins", seconds, exponent + ("wanted under 20 s" if pins == 200 else "")
        before = pins, seconds[0]


SECTIONS = (
    ("Indexing cam: profile and contacts", profile),
    ("Indexing cam: torsional stiffness", stiffness),
    ("Indexing cam: many designs", designs),
    ("Indexing cam: many pins", growth),
)
