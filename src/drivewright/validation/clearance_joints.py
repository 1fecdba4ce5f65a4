"""Joints with play against other computations: what impact laws deliver, massless links, and the slider-crank with play at the wrist.

The other numbers come from an earlier, separate program of ours whose equations were written by hand for each mechanism.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np

from drivewright import cases, registry
from drivewright._typing import Floats
from drivewright.contact.impact import delivered_restitution, impact_law
from drivewright.mechanisms.linkage.build import LinkageModel, build
from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.multibody.analyses.impact_load import LOAD_WORDS, impact_load_of_run
from drivewright.multibody.analyses.lyapunov import lyapunov
from drivewright.multibody.analyses.simulation_model import ideal_record
from drivewright.multibody.assembly import assemble
from drivewright.multibody.measures import largest
from drivewright.multibody.model import GROUND, Body, Dry, Marker, MultibodyModel, Prismatic, Revolute
from drivewright.multibody.record import record
from drivewright.multibody.simulate import Settings, simulate
from drivewright.numerics.ensemble import mean_of_members
from drivewright.spec import document, from_document, load
from drivewright.validation.folding_linkage import CALIBRATION_SPEED, folding_spec, round_digits
from drivewright.validation.source import AGREES, EXPLAINED, OPEN, Explanation, Printed, Row, Source, about, rounded

DELIVERED_RESTITUTION = {  # e asked: delivered by each law in a free impact of two bodies
    "0.9": ("0.9132", "0.9090", "0.8939"),
    "0.7": ("0.7960", "0.7680", "0.6832"),
    "0.5": ("0.7252", "0.6630", "0.4704"),
    "0.1": ("0.6653", "0.5158", "0.0694"),
}
LAWS = ("lankarani-nikravesh", "hunt-crossley", "flores-2011")
CLOSED_FORM_LAWS = (*LAWS, "gonthier", "herbert-mcwhannell", "elastic")
LINKS = (  # inertia about, play [mm], damping [N m s/rad], K_d, root mean square over the ideal peak, K_d's verdict
    ("O4", "0.10", "3e-5", "1.26804", "0.57814", EXPLAINED),
    ("O4", "0.20", "1e-4", "1.65908", "0.58444", EXPLAINED),
    ("O4", "0.20", "2e-4", "0.99409", "0.57614", AGREES),
    ("centroid", "0.40", "1e-3", "1.21328", "0.58116", EXPLAINED),
)
SPEEDS = {10800: "3.4", 18000: "8.5", 28800: "15.8", 41400: "18.9"}  # K_d at 0.4 mm and 1e-4 N m s/rad
COARSE = 4000  # samples per turn of the other program
PLAYS_OF_STEPS = (5e-5, 1e-4, 2e-4, 3e-4, 4e-4, 5e-4)
BATCH = 100  # turns whose means count as independent
EXPONENTS = ((1e-5, -2.2), (5e-4, 6.6))  # (play [m], exponent per turn)
EARLIER: dict[str, Any] = {"kind": "other code", "where": "earlier program"}
FOLDER = "28 800 r/h, knife folder, massless links in A, B and O4, c_theta = 0.1 N m s/rad, 16 turns of which 5 are discarded"
TWO_ROUTES_NOTE = (
    "The multibody kernel and the closed form of the four-bar agree on 19.16 with the other program's samples, at every tolerance."
)
LAW = "hysteresis of Lankarani and Nikravesh, restitution 0.9, no friction"
SIGN_NOTE = "Estimates of 40 turns with an error of a fifth and more: the sign is compared."
LASTING_CONTACT_NOTE = (
    "The other program keeps the approach speed of the first touch for as long as the contact lasts; here a lasting contact is "
    "damped by its own energy. Which law a real pin follows is not known; at 0.5 mm both motions are chaotic."
)
SLIDER = "crank 50 mm, rod 120 mm, 0.21 kg, 2.5e-4 kg m^2, slider 0.14 kg, 5000 rpm, bearing 10 mm, play 0.5 mm, steel"


def rows() -> Iterator[Row]:
    """Impacts, massless links, slider-crank."""
    yield from _impacts()
    yield from _links()
    yield from _slider_crank()


# -- impacts -------------------------------------------------------------------------------------------------------------------


def simulated_restitution(
    law: str, restitution: float, speed: float = 0.2, mass: float = 0.3, clearance: float = 1e-4, stiffness: float = 6.6e10
) -> float:
    """Speed after a free impact over the one before: a mass on a slide, its pin in a bearing of the ground, in the multibody kernel."""
    contact = Dry(clearance, 0.01, stiffness, hysteresis=impact_law(law).factor(restitution))
    model = MultibodyModel(
        (Body("block", mass, 1e-4, velocity=(speed, 0.0)),),
        (Prismatic("slide", Marker("block"), Marker(GROUND)), Revolute("pin", Marker(GROUND), Marker("block"), contact)),
    )
    end = 2.5 * clearance / speed  # the block has left the wall again and not yet come to the other one
    last = simulate(assemble(model), end, Settings(rtol=1e-10), samples=np.array([end])).end[2]
    return -float(last[1]) / speed


def _impacts() -> Iterator[Row]:
    common: dict[str, Any] = {"unit": "-", "pinned": AGREES}
    for nominal, texts in DELIVERED_RESTITUTION.items():
        for law, text in zip(LAWS, texts, strict=True):
            yield Row(
                f"restitution delivered by {law}, e = {nominal}",
                rounded(text, "-"),
                simulated_restitution(law, float(nominal)),
                **EARLIER,
                **common,
            )
    for law in CLOSED_FORM_LAWS:
        closed = rounded(f"{delivered_restitution(impact_law(law).factor(0.6)):.7f}", "-")
        yield Row(
            f"restitution delivered by {law}, e = 0.6, closed form",
            closed,
            simulated_restitution(law, 0.6),
            kind="closed form",
            where="h (1 + e) = ln((1 + h)/(1 - h e))",
            **common,
        )


# -- massless links ------------------------------------------------------------------------------------------------------------


def _links() -> Iterator[Row]:
    outcomes = [row.value for row in cases.run(_link_loads, LINKS, workers=None).rows]
    common: dict[str, Any] = {"unit": "-", "inputs": FOLDER} | EARLIER
    for (inertia, play, damping, k_d, rms, pinned), (ours, level, sampled) in zip(LINKS, outcomes, strict=True):
        name = f"r = {play} mm, {damping} N m s/rad, inertia about {inertia}"
        coarse_sampling = Explanation(
            f"The other program sampled each turn at {COARSE} points and missed the tops of the peaks; sampled like that, ours gives "
            f"the same value.",
            sampled,
        )
        yield Row(
            f"K_d, {name}", rounded(k_d, "-"), ours, pinned=pinned, explanation=coarse_sampling if pinned == EXPLAINED else None, **common
        )
        yield Row(f"root mean square, {name}", rounded(rms, "-"), level, pinned=AGREES, **common)
    outcomes = cases.run(lambda speed: _loads(build(folding_spec(speed, "0.40", 1e-4)))["coefficient"], SPEEDS, workers=None).rows
    for (speed, text), row in zip(SPEEDS.items(), outcomes, strict=True):
        open_verdict = speed == 41400
        yield Row(
            f"K_d at {speed} r/h, r = 0.40 mm, 1e-4 N m s/rad",
            rounded(text, "-"),
            round_digits(row.value),
            pinned=OPEN if open_verdict else AGREES,
            note=TWO_ROUTES_NOTE if open_verdict else "",
            **common,
        )


def _link_loads(case: tuple[str, ...]) -> tuple[float, float, float]:
    """(K_d, root mean square, K_d on coarse samples)."""
    inertia, play, damping, *_ = case
    tables = document(folding_spec(CALIBRATION_SPEED, play, float(damping), relative_tolerance=1e-9))
    tables["bodies"]["knife"]["inertia_about"] = inertia
    model = build(from_document(tables, LinkageSpec))
    loads = _loads(model)
    return round_digits(loads["coefficient"], 5), round_digits(loads["rms"], 5), _coarse_peak_mean(model) / loads["ideal_peak"]


def _loads(model: LinkageModel) -> dict[str, float]:
    return dict(zip((*LOAD_WORDS, "ideal_peak"), impact_load_of_run(model, model.outputs[0]), strict=True))


def _coarse_peak_mean(model: LinkageModel) -> float:
    """Mean of the five largest maxima of the knife's angular acceleration, no more seen of it than `COARSE` samples per turn [rad/s^2]."""
    start = model.window_start
    turns = (model.run_length - start) / model.turn_length
    times = np.linspace(start, model.run_length, round(turns * COARSE) + 1)
    motion = record(simulate(model.assembly, model.run_length, model.settings, samples=times), model.markers)
    size = np.abs(motion.point("knife", "alpha"))
    tops = size[1:-1][(size[1:-1] > size[:-2]) & (size[1:-1] >= size[2:])]
    return float(np.mean(np.sort(tops)[-5:]))


# -- slider-crank --------------------------------------------------------------------------------------------------------------


def slider_crank(play: float, normal: str = "lankarani-nikravesh") -> LinkageSpec:
    """The preset with another play [m] and law."""
    return load(
        registry.mechanism("linkage").presets()["slider_crank"],
        (f'joints.wrist.clearance="{1e3 * play} mm"', f'joints.wrist.normal="{normal}"'),
    )


def _slider_crank() -> Iterator[Row]:
    model = build(slider_crank(5e-4))
    common: dict[str, Any] = {"inputs": SLIDER, "pinned": AGREES}
    stiffness = next(joint.dry_contact.stiffness for joint in model.assembly.model.joints if joint.dry_contact)
    yield Row("slider-crank, stiffness K of the contact, 1e10 N/m^1.5", rounded("6.6102", "-"), stiffness / 1e10, "-", **EARLIER, **common)
    motion, speed = ideal_record(model), model.drive_speed or 0.0
    ideal, closed = largest(motion.t, motion.point("output", "ax")), 0.05 * speed**2 * (1 + 0.05 / 0.12)
    name = "slider-crank without play, largest acceleration of the slider"
    yield Row(name, rounded("19419.36 m/s^2", "m/s^2"), ideal, "m/s^2", **EARLIER, **common)
    yield Row(
        f"{name}, closed form",
        rounded(f"{closed:.6f} m/s^2", "m/s^2"),
        ideal,
        "m/s^2",
        kind="closed form",
        where="r w^2 (1 + r/L)",
        **common,
    )
    yield from _chaotic_rows({"unit": "-", "assumed": LAW} | EARLIER | common)


def _chaotic_rows(common: dict[str, Any]) -> Iterator[Row]:
    """Rows that only means and signs can meet."""
    outcomes = [row.value for row in cases.run(_steps_and_impacts, PLAYS_OF_STEPS, workers=None).rows]
    steps = float(np.mean([each[0] for each in outcomes]))
    yield Row(
        "slider-crank, steps per turn at a relative tolerance of 1e-6, mean over plays of 0.05 to 0.5 mm",
        about("about 1100", 1100.0, 110.0),
        round_digits(steps),
        **common,
    )
    impacts: dict[str, Any] = common | {"pinned": OPEN, "note": LASTING_CONTACT_NOTE}
    mean, half = map(float, mean_of_members(outcomes[-1][1].reshape(-1, BATCH).mean(axis=1)))
    ends = {"low": mean - half, "high": mean + half}
    yield Row("slider-crank, impacts per turn", Printed("12 to 15", 12.0, 15.0), round_digits(mean, 2), **ends, **impacts)
    outcomes = [row.value for row in cases.run(_exponent, EXPONENTS, workers=None).rows]
    for (play, printed), value in zip(EXPONENTS, outcomes, strict=True):
        low, high = (0.0, np.inf) if printed > 0 else (-np.inf, 0.0)
        name = f"slider-crank, largest Lyapunov exponent per turn, play {1e3 * play:.2f} mm"
        yield Row(name, Printed(f"{printed:+}, its sign", low, high), round_digits(value, 1), note=SIGN_NOTE, **common)


def _steps_and_impacts(play: float) -> tuple[float, Floats]:
    """(steps per turn, impacts of each turn), over many turns where the motion is chaotic."""
    model = build(slider_crank(play))
    first, turns = 10, 32 * BATCH if play == PLAYS_OF_STEPS[-1] else 40
    done = simulate(model.assembly, (first + turns) * model.turn_length, Settings(1e-6), samples=np.empty(0))
    impacts, _ = np.histogram(done.impacts[:, 0] / model.turn_length, bins=np.arange(first, first + turns + 1))
    return done.steps / (first + turns), impacts.astype(float)


def _exponent(case: tuple[float, float]) -> float:
    tables = document(slider_crank(case[0]))
    tables["simulate"]["relative_tolerance"] = 1e-7
    return lyapunov(build(from_document(tables, LinkageSpec)), 40, 20).values["lyapunov_exponent.per_turn"].value


source = Source(
    "clearance-joints",
    "Joints with play: restitution of impact laws, massless links, and the slider-crank with play at the wrist (after "
    "Flores and others; masses recalled): an earlier, separate program of ours, and closed forms.",
    rows,
)
