"""The knife-folding four-bar with play of Yuan, Liu and Wang 2011: its Table 2 as a documented comparison, and what is wrong in it.

The motions run on the multibody kernel, through the mechanism `linkage`.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np

from drivewright import cases
from drivewright._typing import Floats
from drivewright.mechanisms.linkage.build import build
from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.multibody.analyses.impact_load import impact_load_of_run
from drivewright.oracles.linkage.four_bar_closed_form import ROCKER_TURN, FourBar, ideal_motion
from drivewright.spec import from_document
from drivewright.validation.source import (
    AGREES,
    CALIBRATED,
    EVALUATED,
    EXPLAINED,
    NOT_COMPARED,
    OPEN,
    PRINT_ONLY,
    Explanation,
    Printed,
    Row,
    Source,
    rounded,
)

TURN = 2 * np.pi
Point: TypeAlias = tuple[float, str, float]  # crank speed [turns/h], radial play [mm], damping of the links [N m s/rad]
PLAYS = ("0.01", "0.05", "0.10", "0.20", "0.40")  # radial [mm]
TABLE = {  # crank speed [turns/h]: (ideal acceleration [km/s^2], K_d at each play)
    10800: ("0.5708", "1.1097", "1.1778", "1.4685", "1.9632", "3.9987"),
    14400: ("1.0150", "1.1222", "1.1833", "1.4128", "1.7281", "3.2936"),
    18000: ("1.5860", "1.1097", "1.1778", "1.4685", "1.9632", "3.9987"),
    21600: ("2.2830", "1.1016", "1.1962", "1.4293", "1.8296", "4.3005"),
    25200: ("3.1080", "1.1042", "1.1943", "1.4579", "1.8980", "4.6879"),
    28800: ("4.0590", "1.1035", "1.2005", "1.5115", "1.9185", "4.4617"),
    32400: ("5.1380", "1.1158", "1.1925", "1.4005", "2.0202", "3.8186"),
    36000: ("6.3430", "1.0970", "1.2031", "1.4646", "2.0085", "3.6576"),
    37800: ("6.9930", "1.0948", "1.1949", "1.4786", "1.9648", "3.4649"),
    39600: ("7.6750", "1.1123", "1.1932", "1.4645", "2.0326", "3.5883"),
    41400: ("8.3880", "1.0986", "1.1969", "1.4223", "2.0017", "3.5718"),
}

FRAME, CRANK, COUPLER, ROCKER, ARM, BETA = 0.484, 0.066, 0.158, 0.424, 0.161, 1.536
TIP = ROCKER - ARM * np.exp(1j * BETA)  # BETA between the arms from B to O4 and from B to the knife's edge
CALIBRATION_SPEED = 28800  # the speed at which the damping is calibrated [turns/h]
CALIBRATED_DAMPING = {
    "0.01": 1.49e-7,
    "0.05": 5.55e-6,
    "0.10": 2.71e-5,
    "0.20": 8.89e-5,
    "0.40": 1.95e-4,
}  # damping of each link [N m s/rad]
STATED_DAMPING, CONSTANT_DAMPING = 0.1, CALIBRATED_DAMPING["0.20"]
EXPLICIT_DAMPING_LIMIT = 5e3  # damping over the square of the play [N s/m] above which the explicit integrator is the slower one

DATA = (
    "Table 1: crank 66 mm, coupler 158 mm, 1.113 kg, 2316 kg mm^2, centroid at 79 mm, rocker 424 mm, knife arm 161 mm, beta = 1.536 "
    "rad, 6.883 kg, 4.487e5 kg mm^2, centroid at 243 mm, frame 484 mm"
)
BETA_READING = "beta is the interior angle at B"
LINKS = (
    "r is radial; no play at O2 (r1 = 0), crank 1 kg; the knife rod's inertia is about its pivot, its centroid on the line O4-B; "
    "gravity square to the frame; links start at 0.2, 3.0 and 0.3 rad, at rest; 16 turns of which 5 are discarded; the output is the "
    "knife's angular acceleration; c_theta = 0.1 N m s/rad"
)
NO_READING = (
    "No reading of Table 1 gives the printed value. The peak at the knife's edge is 16.2 times less; of all orders of the lengths, radii, "
    "components and usual factors of units that were tried none with a physical meaning gives the digits. An acceleration of 8388 "
    "m/s^2, 855 times that "
    "of gravity, is also unlikely for such a machine."
)
NO_DAMPING = (
    "The damping that was used is not known: 0.1 N s/rad has the unit of no rotary damping, and read as 0.1 N m s/rad it locks the "
    "links. Neither that nor any other constant gives the table."
)
NOT_A_TARGET = (
    "Damping of the links chosen for each play so that K_d comes near the table at 28 800 r/h (1.5e-7, 5.6e-6, 2.7e-5, 8.9e-5 and 2.0e-4 "
    "N m s/rad), and proportional to the speed. This brings growth with the play from 0.05 mm on and the order of size, not the cells: a "
    "comparison, no evidence."
)
ONE_DAMPING = (
    f"One damping of the links for all plays, {CONSTANT_DAMPING:.2g} N m s/rad, that chosen for 0.20 mm: it cannot give the other columns."
)


def rows() -> Iterator[Row]:
    """Ideal mechanism, impact load coefficients, equation 2."""
    yield from _ideal()
    yield from _loads()
    yield from _text()
    yield from _equation_2()


def folding_spec(speed: float, play: str, damping: float, pins_as: Mapping[str, object] = {}, **simulate: object) -> LinkageSpec:
    """The spec at a crank speed [turns/h], a radial play [mm] in A, B and O4, and a damping of the massless links [N m s/rad].

    `pins_as` are other keys of these three pins, `simulate` those of the run.
    """
    link = {"kind": "revolute", "model": "massless-link", "clearance": f"{play} mm", "link_damping": f"{damping} N m s/rad", **pins_as}
    pins = (("A", "crank", "coupler", 0.2), ("B", "coupler", "knife", 3.0), ("O4", "knife", "ground", 0.3))
    pins = [
        {"name": name, "connects": [f"{first}.{name}", f"{second}.{name}"], "link_angle": f"{angle} rad"} | link
        for name, first, second, angle in pins
    ]
    return from_document(
        {
            "mechanism": "linkage",
            "gravity": ["0 m/s^2", "-9.81 m/s^2"],
            "ground": {"points": {"O2": ["0 m", "0 m"], "O4": [f"{FRAME} m", "0 m"]}},
            "bodies": {
                "crank": {"mass": "1 kg", "points": {"O2": ["0 m", "0 m"], "A": [f"{CRANK} m", "0 m"]}},
                "coupler": {
                    "mass": "1.113 kg",
                    "inertia": "2316e-6 kg m^2",
                    "centroid": ["0.079 m", "0 m"],
                    "angle": "-81 deg",
                    "points": {"A": ["0 m", "0 m"], "B": [f"{COUPLER} m", "0 m"]},
                },
                "knife": {
                    "mass": "6.883 kg",
                    "inertia": "0.4487 kg m^2",
                    "inertia_about": "O4",
                    "centroid": ["0.243 m", "0 m"],
                    "angle": "202 deg",
                    "points": {"O4": ["0 m", "0 m"], "B": [f"{ROCKER} m", "0 m"], "edge": [f"{TIP.real} m", f"{-TIP.imag} m"]},
                },
            },
            "joints": [{"name": "O2", "kind": "revolute", "connects": ["ground.O2", "crank.O2"]}, *pins],
            "rotational_springs": [{"body": body, "damping": "0.1 N m s/rad"} for body in ("coupler", "knife")],
            "drive": {"joint": "O2", "speed": f"{speed} rev/h"},
            "simulate": {"turns": 16, "discard": 5, "relative_tolerance": 1e-7} | simulate,
            "outputs": [{"name": "knife", "body": "knife"}, {"name": "edge", "body": "knife", "point": "edge"}],
        },
        LinkageSpec,
    )


def load_coefficients(points: Sequence[Point]) -> list[float]:
    """K_d of the knife for (speed, play, damping) each, in threads, to three digits."""
    outcomes = cases.run(_load_coefficient, points, workers=None)
    return [round_digits(row.value) for row in outcomes.rows]


def _load_coefficient(point: Point) -> float:
    speed, play, damping = point
    stiff = damping > EXPLICIT_DAMPING_LIMIT * (1e-3 * float(play)) ** 2
    model = build(folding_spec(*point, method="radau" if stiff else "dopri5"))
    return impact_load_of_run(model, model.outputs[0])[0]


def round_digits(value: float, count: int = 3) -> float:
    """To as many digits as another computer would repeat."""
    return float(f"{value:.{count}g}")


# -- ideal mechanism -----------------------------------------------------------------------------------------------------------


def ideal_four_bar() -> FourBar:
    """Lengths only, pins without play."""
    return FourBar(np.array([FRAME, CRANK, COUPLER, ROCKER]), np.ones(3), np.ones(2), np.zeros(3), np.zeros(4))


def edge_acceleration() -> float:
    """Largest acceleration of the knife's edge over the square of the crank's speed [m]."""
    _, v, a = ideal_motion(ideal_four_bar(), np.linspace(0, TURN, 36001))
    return float(np.max(abs(TIP) * np.hypot(a[ROCKER_TURN].real, v[ROCKER_TURN].real ** 2)))


def _ideal() -> Iterator[Row]:
    edge = edge_acceleration()
    common: dict[str, Any] = {"kind": "published table", "where": "Table 2", "inputs": DATA}
    for speed, (text, *_) in TABLE.items():
        yield Row(
            f"ideal acceleration at {speed} r/h",
            rounded(f"{text} km/s^2", "m/s^2"),
            edge * (TURN * speed / 3600) ** 2,
            "m/s^2",
            pinned=OPEN,
            assumed=BETA_READING,
            note=NO_READING,
            **common,
        )
    first, last = printed_acceleration(10800), printed_acceleration(41400)
    ratio = Printed("8.3880/0.5708", last.low / first.high, last.high / first.low)
    note = "Every acceleration grows with the square of a constant speed, so the ratio does not test the mechanism."
    only: dict[str, Any] = {"pinned": NOT_COMPARED, "basis": PRINT_ONLY, "note": note}
    yield Row("ideal acceleration, 41400 over 10800 r/h", ratio, (41400 / 10800) ** 2, "-", **only, **common)


def printed_acceleration(speed: int) -> Printed:
    """The ideal acceleration in Table 2 at a crank speed [turns/h]."""
    return rounded(f"{TABLE[speed][0]} km/s^2", "m/s^2")


# -- impact load coefficients --------------------------------------------------------------------------------------------------


def _loads() -> Iterator[Row]:
    """Every cell of Table 2 with the damping as stated and calibrated, and one speed with one damping for all."""
    cells = [(speed, play) for speed in TABLE for play in PLAYS]
    stated = [(speed, play, STATED_DAMPING) for speed, play in cells]
    constant = [(CALIBRATION_SPEED, play, CONSTANT_DAMPING) for play in PLAYS]
    calibrated = [(speed, play, CALIBRATED_DAMPING[play] * speed / CALIBRATION_SPEED) for speed, play in cells]
    ours = iter(load_coefficients(stated + constant + calibrated))
    by_hand: dict[str, Any] = {"basis": CALIBRATED, "pinned": NOT_COMPARED, "note": NOT_A_TARGET}
    unknown: dict[str, Any] = {"pinned": OPEN, "note": NO_DAMPING}
    for points, reading, remark in (
        (stated, "damping as stated", unknown),
        (constant, "one damping", by_hand | {"note": ONE_DAMPING}),
        (calibrated, "damping calibrated", by_hand),
    ):
        for speed, play, _ in points:
            yield load_row(speed, play, reading, next(ours), **remark)


def load_row(speed: int, play: str, reading: str, ours: float, **more: Any) -> Row:
    """The row of a cell of Table 2 under one reading."""
    cell, name = rounded(TABLE[speed][1 + PLAYS.index(play)], "-"), f"K_d at {speed} r/h, r = {play} mm"
    common: dict[str, Any] = {"unit": "-", "kind": "published table", "where": "Table 2", "inputs": DATA, "assumed": LINKS}
    return Row(f"{name}, {reading}", cell, ours, reading_of=name, **(common | more))


def _text() -> Iterator[Row]:
    """What the text makes of its own table."""
    common: dict[str, Any] = {"kind": "published table", "where": "section 3", "pinned": NOT_COMPARED, "basis": PRINT_ONLY}
    peak = rounded("7.0 km/s^2", "m/s^2")
    product = 1.4005 * printed_acceleration(32400).low
    yield Row("peak acceleration at 32400 r/h, r = 0.10 mm", peak, product, "m/s^2", note="K_d times the ideal peak of Table 2.", **common)
    near = "influence of the play below 10 000 r/h, K_d at 10800 r/h and 0.40 mm"
    small = Printed("very small: 1 within 10 %", 0.9, 1.1)
    yield Row(near, small, float(TABLE[10800][-1]), "-", note="The text is compared with its own table, at the nearest speed.", **common)
    allowed = rounded("28000 rev/h", "rad/s")
    note = "Nothing to compare it with: no criterion is printed."
    yield Row("crank speed allowed with r = 0.20 mm", allowed, None, "rad/s", note=note, **common)
    for play, low, high in (("0.01", 1.1, 1.1), ("0.10", 1.4, 1.5), ("0.20", 1.7, 2.1)):
        column = [float(row[1 + PLAYS.index(play)]) for row in TABLE.values()]
        text = f"about {low:.4f}" if low == high else f"{low:.4f} to {high:.4f}"
        name = f"largest K_d of the column r = {play} mm"
        yield Row(name, Printed(text, low, high), max(column), "-", note="The text is compared with its own table.", **common)


# -- equation 2 ----------------------------------------------------------------------------------------------------------------


def root_argument(crank: Floats, corrected: bool) -> tuple[Floats, Floats, Floats]:
    """(C, D, D^2 - C^2 + 1) of eq. (2) with ideal pins, as printed or corrected."""
    a, b = FRAME - CRANK * np.cos(crank), CRANK * np.sin(crank)
    if corrected:
        c = (a**2 + b**2 + ROCKER**2 - COUPLER**2) / (2 * a * ROCKER)
    else:
        c = (a**2 + b**2 - COUPLER**2 - ROCKER**2) / (2 * a * CRANK)
    return c, b / a, (b / a) ** 2 - c**2 + 1


def loop_closure_error(crank: Floats) -> Floats:
    """How far the loop stays open with the corrected eq. (2) and eq. (3) [m]."""
    c, d, root = root_argument(crank, True)
    sine = (-c * d + np.sqrt(root)) / (d**2 + 1)
    fourth = np.arctan2(sine, c + d * sine)
    third = np.arcsin(-(ROCKER * sine + CRANK * np.sin(crank)) / COUPLER)
    return np.abs(CRANK * np.exp(1j * crank) + COUPLER * np.exp(1j * third) + ROCKER * np.exp(1j * fourth) - FRAME)


def _equation_2() -> Iterator[Row]:
    crank = np.linspace(0, TURN, 36000, endpoint=False)
    common: dict[str, Any] = {"kind": "closed form", "where": "eq. (2)", "inputs": DATA}
    share = [float(np.mean(root_argument(crank, corrected)[2] < 0)) for corrected in (False, True)]
    misprint = Explanation("Misprint: C must be (A^2 + B^2 + l4^2 - l3^2)/(2 A l4), and the product C D carries a minus sign.", share[1])
    yield Row(
        "crank angles without a root, eq. (2) as printed",
        Printed("none, implied", 0.0, 0.0, origin=EVALUATED),
        share[0],
        "-",
        pinned=EXPLAINED,
        explanation=misprint,
        **common,
    )
    yield Row(
        "loop left open, eq. (2) corrected",
        Printed("0, implied", 0.0, 1e-14, origin=EVALUATED),
        float(loop_closure_error(crank).max()),
        "m",
        pinned=AGREES,
        **common,
    )


ERRATA = (
    "Eq. (2): C has -l3^2 - l4^2 over 2 A l2; it must be + l4^2 - l3^2 over 2 A l4, and C D is negative. As printed the root is that of a "
    "negative number at 31 % of the crank angles.",
    "Eqs. (2) and (3): the arcsine loses the branch; (3) is valid here only because the coupler stays between -83 and -31 deg.",
    "Eq. (5): the mixed term has the links' accelerations where their rates belong; the column vectors repeat a row.",
    "Eq. (9): the sums start at the frame, which has neither motion nor centroid; the damping of an angle has the unit N m s/rad, not "
    "N s/rad.",
    "Eq. (10): in the last term velocities are differentiated by coordinates; it must be by their rates.",
    "Eq. (11): products of two partial derivatives, by alpha and by theta_1, and mixed indices; called a partial differential system, it "
    "is one of ordinary differential equations.",
    "The text gives the coupler the mass m2 and the crank m3, then calls the coupler a rocker; Table 1 numbers the lengths in another way "
    "than the equations; the crank's mass is missing.",
    "Table 1: 0.4487 kg m^2 about the centroid would be a gyration radius of 255 mm; a body between O4 and the knife's edge with its "
    "centroid at 243 mm has at most 223 mm. Read as about the pivot it leaves 78 mm.",
    "Table 2: the rows of K_d for 10 800 and 18 000 r/h are the same digits.",
    "The text puts K_d for r = 0.10 mm between 1.4 and 1.5; the table has 1.5115. The peak of 7.0 km/s^2 at 32 400 r/h is in the table "
    "1.4005 times 5.138, which is 7.2.",
    "That play hardly matters below 10 000 r/h does not go with K_d = 1.96 for r = 0.20 mm at 10 800 r/h.",
    "Integrator, step, length of the run, start angles, whether r is radial, the load, and which acceleration is meant are not stated.",
)

source = Source(
    "folding-linkage",
    "Yuan Yingcai, Liu Yilun, Wang Yiming: Nonlinear dynamic response of offset press's fold mechanism with clearances. "
    "Journal of Central South University (Science and Technology) 42(4), 2011, 972 ff., article 1672-7207(2011)04-0972-05 (in Chinese; "
    "text and tables read, figures not).",
    rows,
    ERRATA,
)
