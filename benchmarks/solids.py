"""Solids in contact: two cylinders beside NGSolve's own contact by penalty, error beside time; load steps of a chain's plate and pins."""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from timing import best

sys.path.insert(0, str(Path(__file__).parent.parent))
EXAMPLES = Path(__file__).parent.parent / "examples"
RADIUS, FORCE, SHEET = 1.2, 33.3333, 1e-3  # mm, N on a sheet of 1 mm
PENALTY = 1e9  # MPa/mm, a hundredth of the indentation at the greatest pressure


def hertz_line():
    """(greatest pressure [MPa], half width [mm]) of two equal cylinders."""
    from drivewright.contact import hertz
    from tests.support.pressed_bodies import NU, E

    found = hertz.line_contact(FORCE, SHEET, RADIUS / 2 * 1e-3, hertz.effective_modulus(E, NU, E, NU))
    return 1e-6 * found.pressure, 1e3 * found.half_width


def meshes(size):
    """Two quarter discs with elements of a size [mm] where they touch."""
    from tests.support.pressed_bodies import quarter_disc

    return quarter_disc(RADIUS, 1, size, 0.04), quarter_disc(RADIUS, -1, size, 0.04)


def ours(size):
    """(seconds to condense, seconds of a load, greatest pressure by the ellipse [MPa])."""
    from drivewright.solids.contact import ContactModel, Functional, Pair
    from drivewright.solids.elastic import FreeBody, Plane
    from tests.support.pressed_bodies import NU, E

    upper_mesh, lower_mesh = meshes(size)
    began = time.perf_counter()
    upper = FreeBody(upper_mesh, E, NU, Plane(SHEET), dirichletx="sym")
    lower = FreeBody(lower_mesh, E, NU, Plane(SHEET), dirichletx="sym", dirichlety="flat")
    pair = Pair(("upper", "contact"), ("lower", "contact"), 1e-6)
    model = ContactModel({"upper": upper, "lower": lower}, [pair], [], {"push": Functional("upper", upper.mean("flat", (0, -1)))})
    condensed = time.perf_counter()
    state = model.solve({"push": FORCE / 2})
    ended = time.perf_counter()
    return condensed - began, ended - condensed, ellipse(model.pairings[0].places[:, 0], 1e-6 * state.pressure[0])


def ellipse(x, pressure):
    """Pressure at the middle of p^2 = p0^2 (1 - x^2/b^2) through the upper part."""
    kept = pressure > 0.3 * pressure.max()
    return float(np.sqrt(np.polyfit(x[kept] ** 2, pressure[kept] ** 2, 1)[1]))


def engine(size):
    """(seconds of a load, greatest pressure by the ellipse [MPa]) of NGSolve's ContactBoundary: Newton's method on the whole mesh."""
    import netgen.occ as occ
    import ngsolve as ng

    from tests.support.pressed_bodies import NU, E

    modulus, shear = 1e-6 * E, 1e-6 * E / 2 / (1 + NU)
    volume = modulus * NU / (1 + NU) / (1 - 2 * NU)

    def face(way):
        from tests.support.pressed_bodies import quarter_disc_face

        return quarter_disc_face(RADIUS, way, size, 0.04, f"contact{way}", f"flat{way}")

    mesh = ng.Mesh(occ.OCCGeometry(occ.Compound([face(1), face(-1)]), dim=2).GenerateMesh(maxh=RADIUS / 6, grading=0.3)).Curve(2)
    began = time.perf_counter()
    space = ng.VectorH1(mesh, order=2, dirichletx="sym", dirichlety="flat-1")
    u, v = space.TnT()

    def stress(w):
        e = ng.Sym(ng.Grad(w))
        return 2 * shear * e + volume * ng.Trace(e) * ng.Id(2)

    form = ng.BilinearForm(space, symmetric=True)
    form += ng.InnerProduct(stress(u), ng.Sym(ng.Grad(v))) * ng.dx
    touch = ng.ContactBoundary(mesh.Boundaries("contact1"), mesh.Boundaries("contact-1"))
    at = ng.CF((ng.x, ng.y))
    depth = (at + u - at.Other() - u.Other()) * touch.normal
    touch.AddIntegrator((ng.IfPos(depth, PENALTY * depth, 0) * ((v - v.Other()) * touch.normal)).Compile())
    load = ng.LinearForm(-FORCE / 2 / RADIUS * v[1] * ng.ds("flat1")).Assemble()
    field = ng.GridFunction(space)
    field.Set(ng.CF((0, -1.5e-4)), definedon=mesh.Materials("disc1"))
    rest, step = field.vec.CreateVector(), field.vec.CreateVector()
    with ng.TaskManager():
        for _ in range(3):
            touch.Update(field, form, intorder=10, maxdist=0.02)
            for _ in range(60):
                form.Apply(field.vec, rest)
                rest.data -= load.vec
                form.AssembleLinearization(field.vec)
                step.data = form.mat.Inverse(space.FreeDofs(), inverse="sparsecholesky") * rest
                field.vec.data -= step
                if abs(ng.InnerProduct(step, rest)) < 1e-18:
                    break
    seconds = time.perf_counter() - began
    rule = ng.IntegrationRule(points=[(q,) for q in np.linspace(0, 1, 7)], weights=[0.0] * 7)
    points = mesh.MapToAllElements(rule, mesh.Boundaries("contact1"))
    pressure = -np.asarray(ng.BoundaryFromVolumeCF(stress(field)[1, 1])(points)).ravel()
    return seconds, ellipse(np.asarray(ng.x(points)).ravel(), pressure)


def cylinders():
    """Two cylinders by both, at two sizes of elements."""
    top, half_width = hertz_line()
    for share in (0.2, 0.05):
        size = share * half_width
        condense, load, found = (np.array(each) for each in zip(*(ours(size) for _ in range(5)), strict=True))
        words = f"elements of {share:g} of the half width"
        yield f"ours, condensing: {words}", (condense.min(), float(np.median(condense))), ""
        yield (
            f"ours, one load: {words}",
            (load.min(), float(np.median(load))),
            f"greatest pressure off by {100 * (found[0] / top - 1):+.2f} %",
        )
        seconds, theirs = (np.array(each) for each in zip(*(engine(size) for _ in range(5)), strict=True))
        yield (
            f"NGSolve, ContactBoundary, one load: {words}",
            (seconds.min(), float(np.median(seconds))),
            f"penalty of {PENALTY:g} MPa/mm; off by {100 * (theirs[0] / top - 1):+.2f} %",
        )


def plate_and_pins():
    """The Hy-Vo chain's plate with its pins: condensed, then 24 load steps, then lives."""
    from drivewright import load, registry
    from drivewright.chains.solid.history import skin_life, solid_history
    from drivewright.chains.solid.joint import Fit, Material, rolling_pins, stack_of
    from drivewright.chains.solid.meshes import usual_sizes
    from drivewright.chains.solid.pitch import plate_and_pins as condensed
    from drivewright.chains.stress.plate import Loads
    from drivewright.mechanisms.silent_chain.stress import card_of
    from drivewright.runner import build

    model = build(load(registry.mechanism("silent-chain").presets()["default"]))
    plate, material, fit = model.plate, Material(206e9, 0.3), Fit(5e-6, 5e-5)
    stack, sizes = stack_of(plate, (1, 2)), usual_sizes(plate, 1.0)
    began = time.perf_counter()
    rolling = rolling_pins(plate, stack, fit, material, 100.0, sizes)
    joint = time.perf_counter() - began
    began = time.perf_counter()
    solid = condensed(plate, stack, fit, material, rolling.shares, (-3.7e-3,), sizes)
    whole = time.perf_counter() - began
    turn = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    size = 150.0 + 80.0 * np.sin(turn)
    pins = np.stack([np.stack([-size, 10 * np.cos(turn)], axis=1), np.stack([size, -10 * np.cos(turn)], axis=1)], axis=1)
    loads = Loads(pins, np.zeros((24, 2)), np.full((24, 2), -3.7e-3))
    steps = best(lambda: solid_history(solid, loads), 3)
    history = solid_history(solid, loads)
    unknowns = [body.unknowns for body in solid.model.bodies.values()]
    yield "straight joint: two halves of plates, two pins, condensed and solved", (joint, joint), ""
    yield (
        "plate and two pins condensed",
        (whole, whole),
        f"{unknowns} unknowns, {sum(len(each.gap) for each in solid.model.pairings)} places",
    )
    yield "24 load steps", steps, "wanted with condensing, 24 steps and lives under 3 min on two cores"
    lives = best(lambda: skin_life(history.skins["plate"], history.searched["plate"], card_of(model)), 3)
    yield "life on the plate's skin", lives, ""


def whole_runs():
    """Both analyses of solids as a user starts them, with the memory that they take."""
    for example, analysis, wanted in (
        ("hyvo_chain", "solid_stress", "3 min and 4 GB"),
        ("pin_indexer", "assembly", "4 min at 9 positions"),
    ):
        with tempfile.TemporaryDirectory() as folder:
            given = [str(EXAMPLES / f"{example}.toml"), "--only", analysis, "--out", folder, "--no-figures"]
            began = time.perf_counter()
            process = subprocess.Popen(
                [sys.executable, "-m", "drivewright", "run", *given], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
            )
            _, status, usage = os.wait4(process.pid, 0)
            seconds = time.perf_counter() - began
        name = f"drivewright run {example}.toml --only {analysis}"
        yield (
            name,
            (seconds, seconds),
            f"peak memory {usage.ru_maxrss / 1e6:.2f} GB{'' if status == 0 else '; failed'}; wanted under {wanted}",
        )


SECTIONS = (
    ("Solids in contact: two cylinders", cylinders),
    ("Solids in contact: plate and pins of a chain", plate_and_pins),
    ("Solids in contact: whole runs", whole_runs),
)
