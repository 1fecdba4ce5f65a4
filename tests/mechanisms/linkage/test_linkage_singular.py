"""What a linkage that folds is told: its singular positions, the forces there, and the energy balance over them, on bars in line."""

import numpy as np
import pytest

import drivewright as dw
from drivewright.spec import from_document

pytestmark = pytest.mark.property

TURN, G = 2 * np.pi, 9.81


def bar(length, ends, angle, mass=1.0):
    return {
        "mass": f"{mass} kg",
        "inertia": "1e-3 kg m^2",
        "centroid": [f"{length / 2} mm", "0 mm"],
        "angle": f"{angle} deg",
        "points": {ends[0]: ["0 mm", "0 mm"], ends[1]: [f"{length} mm", "0 mm"]},
    }


def parallelogram(speed="60 rpm", start=60.0, turns=1.25, rocker=100.0, **tables):
    """Cranks of 0.1 m on a frame of 0.15 m, from 60 deg."""
    names = {"O2": ["ground.O2", "crank.O"], "A": ["crank.A", "coupler.A"], "B": ["coupler.B", "rocker.B"], "O4": ["ground.O4", "rocker.O"]}
    spec = {
        "mechanism": "linkage",
        "gravity": ["0 m/s^2", "-9.81 m/s^2"],
        "ground": {"points": {"O2": ["0 mm", "0 mm"], "O4": ["150 mm", "0 mm"]}},
        "bodies": {"crank": bar(100, "OA", start), "coupler": bar(150, "AB", 0), "rocker": bar(rocker, "OB", start, 2.0)},
        "joints": [{"name": name, "connects": connects} for name, connects in names.items()],
        "drive": {"joint": "O2", "speed": speed},
        "simulate": {"turns": turns},
    }
    return from_document(spec | tables)


def slider_crank(turns=1.25):
    """Crank and rod of 0.1 m: the slider passes the crank's axis."""
    spec = {
        "mechanism": "linkage",
        "ground": {"points": {"O": ["0 mm", "0 mm"]}},
        "bodies": {
            "crank": bar(100, "OA", 30),
            "rod": bar(100, "AB", -30),
            "slider": {"mass": "1 kg", "inertia": "1e-3 kg m^2", "points": {"B": ["0 mm", "0 mm"]}},
        },
        "joints": [
            {"name": "O", "connects": ["ground.O", "crank.O"]},
            {"name": "A", "connects": ["crank.A", "rod.A"]},
            {"name": "B", "connects": ["rod.B", "slider.B"]},
            {"name": "guide", "kind": "prismatic", "connects": ["slider.B", "ground.O"], "axis": [1, 0]},
        ],
        "drive": {"joint": "O", "speed": "60 rpm"},
        "simulate": {"turns": turns},
    }
    return from_document(spec)


def columns(result, table):
    return {column.name: column.data for column in result.tables[table].columns}


@pytest.mark.parametrize(
    ("spec", "times", "angles", "branch"),
    [
        (parallelogram(), [1 / 3, 5 / 6], [np.pi, 0.0], {"crank 1", "coupler 0", "rocker 1"}),
        (parallelogram("-60 rpm"), [1 / 6, 2 / 3, 7 / 6], [0.0, np.pi, 0.0], {"crank -1", "coupler 0", "rocker -1"}),
        (slider_crank(), [1 / 6, 2 / 3, 7 / 6], [np.pi / 2, 3 * np.pi / 2, np.pi / 2], {"crank 1", "rod -1", "slider 0"}),
    ],
    ids=["forth", "back", "slider"],
)
def test_the_table_of_singular_positions(spec, times, angles, branch):
    result = dw.run(spec, only="singular")
    found = columns(result, "singular_positions")
    assert result["singular.count"] == len(times)
    assert found["time"] == pytest.approx(times, abs=1e-7)
    assert found["drive_angle"] == pytest.approx(angles, abs=1e-6)
    assert np.max(found["smallest_singular_value"]) < 1e-9
    assert list(found["branches"]) == [2] * len(times)
    assert [set(taken.split(", ")) for taken in found["branch"]] == [branch] * len(times)
    assert list(found["rule"]) == ["continuous velocity"] * len(times)
    (finding,) = result.findings
    first = f"(the first at t = {times[0]:.6g} s, drive at {np.degrees(angles[0]):.4g}°)"
    assert f"passes {len(times)} singular positions {first}" in finding
    assert "up to 2 branches" in finding


def test_a_linkage_that_does_not_fold_has_no_table():
    result = dw.run(parallelogram(rocker=110.0), only="singular")
    assert result["singular.count"] == 0 and "singular_positions" not in result.tables and not result.findings


def test_a_single_singular_position_is_told_in_the_singular():
    (finding,) = dw.run(parallelogram(turns=0.5), only="singular").findings
    assert "passes a singular position (the first at" in finding


# -- forces --------------------------------------------------------------------------------------------------------------------------


def test_forces_that_grow_without_bound_have_no_largest_value():
    result = dw.run(parallelogram(), only="forces")
    assert not [name for name in result.values if name.endswith("max_force")]
    (finding,) = result.findings
    assert "the force in joints 'O2', 'A', 'B', 'O4' grows without bound towards the singular position at t = 0.833333 s" in finding


def test_forces_of_a_load_along_the_bars_are_finite_and_those_of_the_closed_form():
    """Of the rocker: half of the coupler's weight along the bars and all forces of its circle, at the joint on the ground."""
    result = dw.run(parallelogram(gravity=["-9.81 m/s^2", "0 m/s^2"]), only="forces")
    (finding,) = result.findings
    assert "limits of those beside it" in finding and result["forces.residual"] < 1e-9
    found = columns(result, "forces")
    t = found["time"]
    assert 0.25 > t[0] >= 0.0 and np.max(np.diff(t)) > 2e-3  # the middles of folds are left out
    angle = np.pi / 3 + TURN * t
    # The bodies' sum: ground joints carry  sum m (a - g).
    total = -(TURN**2) * (0.05 * 3 + 0.1) * np.exp(1j * angle) + 4 * G
    ground = found["O2.force_x"] + found["O4.force_x"] + 1j * (found["O2.force_y"] + found["O4.force_y"])
    assert np.abs(ground) == pytest.approx(np.abs(total), rel=1e-7)


# -- energy ------------------------------------------------------------------------------------------------------------------------


def check(result, name):
    return next(each for each in result.checks if each.name == name)


@pytest.mark.parametrize("sense", [1, -1])
def test_work_and_stored_energy_of_a_parallelogram_in_closed_form(sense):
    """Both cranks and the coupler rise together, at constant speed: all work of the drive is lift."""
    result = dw.run(parallelogram(f"{sense * 60} rpm"), only="energy")
    found = columns(result, "energy")
    lift = G * (0.5 + 1.0 + 1.0) * 0.1 * (np.sin(np.pi / 3 + sense * TURN * found["time"]) - np.sin(np.pi / 3))
    for name in ("stored", "work_drives"):
        assert found[name] == pytest.approx(lift, rel=0, abs=1e-5)
    assert result["energy.drives"] == pytest.approx(lift[-1], abs=1e-5)
    assert [result[f"energy.{name}"] for name in ("springs", "applied", "pins")] == [0.0, 0.0, 0.0]
    assert result["energy.gap"] == np.max(np.abs(found["gap"]))
    t = np.linspace(0.0, 1.25, 20001)
    work = np.mean(np.abs(np.cos(np.pi / 3 + sense * TURN * t))) * 1.25 * TURN * G * 0.25
    assert check(result, "power_audit").value == pytest.approx(result["energy.gap"] / work, rel=1e-3)


def test_the_drive_of_a_slider_crank_without_weight_does_half_of_what_is_exchanged():
    """Its power is the change of the kinetic energy, and both count as exchanged."""
    result = dw.run(slider_crank(), only="energy")
    energy, power = (check(result, f"{name}_audit").value for name in ("energy", "power"))
    assert power == pytest.approx(2 * energy, rel=1e-3) and 0 < power < 1e-6
    assert result["energy.error"] == energy


def test_without_a_drive_there_is_no_power_audit():
    tables = {"drive": None, "simulate": {"duration": "0.3 s"}}
    result = dw.run(parallelogram(**tables), only="energy")
    assert [each.name for each in result.checks] == ["energy_audit"] and "drive.max_torque" not in result.values


def test_a_sharp_bend_does_not_open_the_energy_balance():
    """Rows lie as close as the bend is sharp, unevenly: the rocker turns back within a thousandth of a turn."""
    result = dw.run(parallelogram(rocker=100.01), only="energy")
    assert result["energy.error"] < 1e-4 and result["energy.gap"] == np.max(np.abs(columns(result, "energy")["gap"])) > 0


def test_a_run_that_stops_before_a_fold_passes_none_and_tells_its_stop_once():
    spec = parallelogram(
        turns=6.0, simulate={"turns": 6.0, "singular": "stop"}, outputs=[{"name": "rocker", "body": "rocker"}], limits={"least_turns": 0.5}
    )
    found = dw.run(spec, only=("motion", "forces", "singular"))
    assert found.outcome == "partial" and found["singular.count"] == 0 and "singular_positions" not in found.tables
    assert not any("grows without bound" in finding or "passes" in finding for finding in found.findings)
    assert not next(check for check in found.checks if check.name == "window").ok  # a third of a turn
    assert found.values["rocker.swing"].meaning.count("the run ends at") == 1
    assert found["rocker.swing"] == pytest.approx(2 * np.pi / 3, abs=0.2)


def test_a_start_in_line_by_rough_guesses_is_told_as_such():
    bodies = {"crank": bar(100, "OA", 0), "coupler": bar(150, "AB", 57), "rocker": bar(100, "OB", 106)}
    found = dw.run(parallelogram(bodies=bodies), only=("end", "singular"))
    assert found.outcome == "partial" and len(found.findings) == 1
    assert "starts in a singular position, drive 'O2' at 0.00°" in found.findings[0]
    assert "Start a few degrees away" in found.findings[0] and "'singular', 'end' fail alike" in found.findings[0]
