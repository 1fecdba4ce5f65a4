"""The indexing-cam paper beside our numbers: its formulas by hand for one instance, and what the explanations claim."""

import numpy as np
import pytest

from drivewright.validation import AGREES, EXPLAINED, NOT_COMPARED, OPEN, VERDICTS, indexer_paper, rounded

pytestmark = pytest.mark.analytical

ARCMIN = np.pi / 10800
ECCENTRICITY, SPACING, MODULE, TEETH = 10e-3, 0.11, 2.5e-3, 22
A, B1, C, B2 = 25e-3, 30e-3, 25e-3, 20e-3
SPAN = B1 + C + B2
X_B, Y_B = ECCENTRICITY * np.cos(np.pi / 8), ECCENTRICITY * np.sin(np.pi / 8)


@pytest.fixture(scope="module")
def rows():
    return {row.name: row for row in indexer_paper.source.rows()}


@pytest.fixture(scope="module")
def forces():
    """Forces of the pins on cam 1, and of the cams' bearings on the split shaft: cam 1, cam 2; the split gear's on the shaft [N]."""
    _, equilibrium, near = indexer_paper.equilibrium_instance()
    pins = -complex(np.sum(equilibrium.pin_forces[0][0] * near[0].normal))  # of cam 1 at the one position
    first, second = (complex(equilibrium.crank_forces[0, 0, cam]) for cam in range(2))
    return pins, first, second, complex(equilibrium.gear_forces[0, 0])


def near_print(row, value):
    """Whether a number by hand is the printed one: within its rounding."""
    return row.printed.low - 1e-9 <= value <= row.printed.high + 1e-9


def test_the_instance_is_the_one_that_the_rows_name():
    spec, equilibrium, _ = indexer_paper.equilibrium_instance()
    assert (spec.eccentricity, spec.shaft_spacing, spec.gear.module, spec.gear.teeth) == (ECCENTRICITY, SPACING, MODULE, TEETH)
    shafts = spec.shafts
    assert (shafts.overhang, shafts.front, shafts.pitch, shafts.rear) == pytest.approx((A, B1, C, B2), rel=1e-12)
    assert np.degrees(equilibrium.theta) == pytest.approx([22.5]) and spec.contact.model == "bonded"


def test_every_verdict_is_the_pinned_one(rows):
    assert [(row.name, row.verdict) for row in rows.values() if row.verdict != row.pinned] == []
    assert len(rows) == len(indexer_paper.source.rows()) == 35
    count = {verdict: sum(row.verdict == verdict for row in rows.values()) for verdict in VERDICTS}
    assert count == {AGREES: 10, EXPLAINED: 9, OPEN: 8, NOT_COMPARED: 8}


def test_equation_7(rows):
    assert rows["x_b at 22.5 deg"].ours == pytest.approx(X_B, rel=1e-12) and near_print(rows["x_b at 22.5 deg"], X_B)
    assert rows["y_b at 22.5 deg"].ours == pytest.approx(Y_B, rel=1e-12) and near_print(rows["y_b at 22.5 deg"], Y_B)


def test_equation_8_by_hand(rows, forces):
    pins = forces[0]
    fx, fy, l = pins.real, pins.imag, SPACING  # noqa: E741 - the paper's l
    printed = {
        "R_x1 of cam 1": -fx / 2,
        "R_x2 of cam 1": -fx / 2,
        "R_y1 of cam 1": -(1 / 2 + X_B / l) * fy - Y_B / l * fy,
        "R_y2 of cam 1": (X_B / l - 1 / 2) * fy + Y_B / l * fx,
    }
    for name, value in printed.items():
        assert (rows[name].where, rows[name].verdict) == ("eq. (8)", EXPLAINED)
        assert near_print(rows[name], value)
        assert rows[name].explanation.value == pytest.approx(value, rel=1e-6)


def test_our_reactions_balance_the_cam_and_the_printed_ones_do_not(rows, forces):
    """R_1 + R_2 + F = 0 holds of ours; of the printed the sum along y misses (y_b/l)(F_x - F_y)."""
    pins = forces[0]
    ours = complex(sum(rows[f"R_x{n} of cam 1"].ours for n in (1, 2)), sum(rows[f"R_y{n} of cam 1"].ours for n in (1, 2)))
    assert ours == pytest.approx(-pins, rel=1e-6)
    printed = sum(rows[f"R_y{n} of cam 1"].explanation.value for n in (1, 2))
    assert printed + pins.imag == pytest.approx(Y_B / SPACING * (pins.real - pins.imag), rel=1e-6)
    assert abs(printed + pins.imag) > 100


def test_the_couple_of_the_pins_is_what_turns_the_wheel(rows):
    """Without it ours along y would be off by the moment over the spacing, thousands of newtons: the print leaves out the load itself."""
    apart = rows["R_y1 of cam 1"].ours - rows["R_y2 of cam 1"].ours
    printed = rows["R_y1 of cam 1"].explanation.value - rows["R_y2 of cam 1"].explanation.value
    assert abs(apart) > 8000 > 1000 > abs(printed)


def test_equation_9_is_the_balance_of_the_split_shaft(rows, forces):
    first = forces[1]
    for name, value in (("F_x1", first.real), ("F_y1", first.imag)):
        row = rows[f"{name} of cam 1 on the split shaft, from the balance of that shaft"]
        assert (row.where, row.verdict) == ("eq. (9)", AGREES)
        assert near_print(row, value) and row.ours == pytest.approx(value, rel=1e-9)
    assert rows["R_x1 of cam 1"].ours == pytest.approx(-first.real, rel=1e-12)
    assert rows["R_y1 of cam 1"].ours == pytest.approx(-first.imag, rel=1e-12)


def test_equation_10_by_hand(rows, forces):
    _, first, second, gear = forces
    row = rows["F_H on the split gear"]
    value = -2 * (first.imag * X_B - second.imag * X_B) / (MODULE * TEETH)
    assert near_print(row, value) and row.explanation.value == pytest.approx(value, rel=1e-6)
    right = value + 2 * (first.real - second.real) * Y_B / (MODULE * TEETH)  # and the forces along x
    assert row.ours == pytest.approx(right, rel=1e-6) == gear.imag


def test_equations_11_and_12_by_hand(rows, forces):
    _, first, second, gear = forces
    tooth = gear.imag
    printed = {
        "R_1qx": (first.real * (B2 + C) + second.real * B2) / SPAN,
        "R_1hx": -(second.real * (B1 + C) + first.real * B1) / SPAN,
        "R_1qy": (-first.imag * (B1 + C) - second.imag * B1 - tooth * (A + SPAN)) / SPAN,
        "R_1hy": (-second.imag * (B1 + C) + tooth * A - first.imag * B1) / SPAN,
    }
    for name, value in printed.items():
        row = rows[name]
        assert row.where == ("eq. (11)" if name.endswith("x") else "eq. (12)")
        assert near_print(row, value)
        assert row.explanation is None or row.explanation.value == pytest.approx(value, rel=1e-5, abs=0.05)


def test_our_support_loads_balance_the_shaft_by_force_and_moment(rows, forces):
    """About the front support: gear at -a, cams at b1 and b1 + c, rear support at L."""
    _, first, second, gear = forces
    front, rear = (complex(rows[f"R_1{end}x"].ours, rows[f"R_1{end}y"].ours) for end in "qh")
    size = abs(first) + abs(second)
    assert abs(front + rear + first + second + gear) < 1e-6 * size
    assert abs(rear * SPAN + first * B1 + second * (B1 + C) - gear * A) < 1e-6 * size * SPAN


def test_equation_3_over_a_loop_counts_the_hysteresis(rows):
    """cov/var of torque over angle by the printed means: k/(1 + 3 (h k/T)^2) of branches k, +-h, over +-T."""
    row = rows["stiffness of the loop by least squares of torque on angle"]
    k, h, top = 750 / ARCMIN, 0.1 * ARCMIN, 300.0
    torque = np.linspace(-top, top, 200001)
    torque, angle = np.concatenate([torque, torque]), np.concatenate([torque / k - h, torque / k + h])
    slope = (np.mean(angle * torque) - np.mean(angle) * np.mean(torque)) / (np.mean(angle**2) - np.mean(angle) ** 2)
    assert slope == pytest.approx(k / (1 + 3 * (h * k / top) ** 2), rel=1e-4)
    assert near_print(row, slope) and (row.where, row.verdict) == ("eq. (3)", EXPLAINED)
    assert row.explanation.value == pytest.approx(slope, rel=6e-3)  # of the finite samples of a made-up loop
    assert row.ours == pytest.approx(k, rel=1e-9)


def test_equation_4_takes_springs_in_series_out(rows):
    row = rows["stiffness without the bar and the support"]
    value = 1 / (1 / 750 - 1 / 3000 - 1 / 8000)
    assert (
        str(row.printed) == "1142.86 N m/arcmin, evaluated"
        and row.printed.origin == "evaluated"
        and value == pytest.approx(1142.857, abs=1e-3)
    )
    assert row.ours * ARCMIN == pytest.approx(value, rel=1e-9) and (row.where, row.verdict) == ("eq. (4)", AGREES)


def test_counts_of_the_test_rest_on_the_print_alone(rows):
    """41 positions have both ends; 40 leave one out.  Meshes of others have no number of ours."""
    assert rows["measuring points of the test"].ours == rows["measuring points of the simulation"].ours == 41
    assert rows["input angle between two models"].ours == pytest.approx(np.radians(4.5))
    assert [rows[f"{what} of the mesh"].ours for what in ("elements", "nodes")] == [None, None]


def test_what_the_paper_s_stiffness_would_need(rows):
    """The mean is five times ours, and no spacing or shaft that fits makes it up: the note says how far they go."""
    row = rows["mean torsional stiffness"]
    assert 747.39 / (row.ours * ARCMIN) == pytest.approx(5.26, abs=0.01)
    best = indexer_paper.indexer_result(*indexer_paper.LARGEST)["stiffness.mean"] * ARCMIN
    assert row.ours * ARCMIN < best < 0.5 * 747.39 and f"{best:.0f} N m/arcmin" in row.note


def test_errata_are_sentences():
    assert len(indexer_paper.ERRATA) == 11 and all(text.endswith(".") for text in indexer_paper.ERRATA)


def test_of_two_equal_maxima_the_nearer_one_counts(rows):
    """The stiffness is alike on both sides of 90 deg: 9 and 171 deg."""
    assert np.degrees(rows["angle of the highest stiffness"].ours) == pytest.approx(171.0)
    low, high = (np.radians(at) for at in (9.0, 171.0))
    for printed, found in ((20.0, low), (160.0, high)):
        near = indexer_paper._angle_of_max_stiffness(indexer_paper.indexer_result(), rounded(f"{printed} deg", "rad"))
        assert near == pytest.approx(found)
