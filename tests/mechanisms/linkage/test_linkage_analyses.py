"""What a linkage's analyses say, on mechanisms whose answer is known."""

import numpy as np
import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright.mechanisms.linkage.build import build
from drivewright.multibody.analyses import turns
from drivewright.multibody.analyses.energy_audit import audit
from drivewright.multibody.analyses.joint_forces import joint_forces, observe_last_turn
from drivewright.multibody.analyses.poincare import zero_times
from drivewright.multibody.analyses.simulation_model import record_of, run_of
from drivewright.spec import from_document, read_document
from drivewright.units import SI

pytestmark = pytest.mark.property

PLAY = {"name": "wrist", "connects": ["rod.B", "slider.B"], "model": "dry", "clearance": "0.2 mm", "friction": 0.1}


def table_of(result, name):
    """Columns of a table by name."""
    return {column.name: column.data for column in result.tables[name].columns}


def slider_crank(joint=PLAY, **tables):
    """A slider-crank at 600 rpm with one joint of the caller's."""
    spec = {
        "mechanism": "linkage",
        "ground": {"points": {"O": ["0 mm", "0 mm"]}},
        "bodies": {
            "crank": {
                "mass": "0.3 kg",
                "inertia": "1e-4 kg m^2",
                "centroid": ["25 mm", "0 mm"],
                "points": {"O": ["0 mm", "0 mm"], "A": ["50 mm", "0 mm"]},
            },
            "rod": {
                "mass": "0.21 kg",
                "inertia": "2.5e-4 kg m^2",
                "centroid": ["60 mm", "0 mm"],
                "points": {"A": ["0 mm", "0 mm"], "B": ["120 mm", "0 mm"]},
            },
            "slider": {"mass": "0.14 kg", "points": {"B": ["0 mm", "0 mm"]}},
        },
        "joints": [
            {"name": "main", "connects": ["ground.O", "crank.O"]},
            {"name": "crank_pin", "connects": ["crank.A", "rod.A"]},
            joint,
            {"name": "guide", "kind": "prismatic", "connects": ["slider.B", "ground.O"], "axis": [1, 0]},
        ],
        "drive": {"joint": "main", "speed": "600 rpm"},
        "simulate": {"turns": 8, "discard": 2, "relative_tolerance": 1e-7},
        "outputs": [{"name": "slider", "body": "slider", "point": "B"}, {"name": "rod", "body": "rod"}],
    }
    return from_document(spec | tables)


@pytest.fixture(scope="module")
def dry():
    return dw.run(slider_crank(poincare={"output": "slider"}))


def test_an_ideal_slider_crank_has_the_textbook_peaks():
    result = dw.run(slider_crank({"name": "wrist", "connects": ["rod.B", "slider.B"]}))
    speed = 20 * np.pi
    assert result["slider.max_acceleration"] == pytest.approx(0.05 * speed**2 * (1 + 0.05 / 0.12), rel=1e-9)
    assert result["rod.swing"] == pytest.approx(2 * np.arcsin(0.05 / 0.12), rel=1e-6)


def test_nobody_computes_impact_loads_beside_the_ideal_where_no_joint_has_play(monkeypatch, dry):
    joint = {"name": "wrist", "connects": ["rod.B", "slider.B"]}
    monkeypatch.setattr(turns, "ideal_record", lambda model: pytest.fail("the same motion once more"))
    result = dw.run(slider_crank(joint), only=("motion", "energy"))
    assert result.outcome == "complete" and result["drive.max_torque"] > 0
    assert dry["slider.impact_load_coefficient"] > 1


def test_the_energy_audit_closes(dry):
    assert dry["energy.error"] < 1e-5
    assert dry["energy.drives"] + dry["energy.pins"] == pytest.approx(0.0, abs=0.05 * abs(dry["energy.drives"]) + 0.2)
    assert dry["energy.pins"] < 0.0 < dry["energy.drives"]


def test_every_joint_value_of_the_contract_is_there(dry):
    assert dry["joints.wrist.max_force"] > 0 and 0 < dry["joints.wrist.max_penetration"] < 1e-4
    assert dry["joints.wrist.impacts_per_turn"] == 0 and dry["joints.wrist.contact_share"] == 1.0  # friction has settled it
    assert dry["slider.peak_acceleration_ratio"] >= 1 and dry["slider.impact_load_coefficient"] > 0 and dry["slider.rms_ratio"] > 0.5


def test_the_poincare_point_is_the_state_at_the_end_of_a_whole_number_of_turns(dry):
    assert dry["poincare.position"] == pytest.approx(dry["bodies.slider.x"], abs=1e-12)
    assert dry["poincare.velocity"] == pytest.approx(dry["bodies.slider.vx"], abs=1e-9)
    assert len(dry.table("poincare")) == 7


def test_the_journal_stays_within_its_clearance_but_for_the_penetration(dry):
    pin = table_of(dry, "pin.wrist")
    away = np.hypot(pin["x"], pin["y"])
    assert np.all(away <= 0.2e-3 + dry["joints.wrist.max_penetration"] * (1 + 1e-9))
    np.testing.assert_allclose(away - 0.2e-3, pin["depth"], atol=1e-12)
    assert np.all(pin["force"][pin["depth"] < 0] == 0)


def test_a_flying_pin_touches_for_the_time_that_its_record_says():
    result = dw.run(
        slider_crank(
            PLAY | {"friction": 0.0, "clearance": "0.5 mm"},
            drive={"joint": "main", "speed": "5000 rpm"},
            simulate={"turns": 1, "relative_tolerance": 1e-7, "ensemble": 1},
        ),
        only="pins",
    )
    pin = table_of(result, "pin.wrist")
    t, touching = pin["time"], pin["depth"] > 0  # a change counts half way between the two samples that show it
    share = np.sum(np.diff(t) * (1.0 * touching[1:] + touching[:-1])) / 2 / (t[-1] - t[0])
    assert 0.05 < share < 0.95
    assert result["joints.wrist.contact_share"] == pytest.approx(share, abs=1e-9)


def test_a_run_that_meets_its_step_limit_returns_what_it_has():
    result = dw.run(slider_crank(simulate={"turns": 8, "max_steps": 700}))
    assert result.outcome == "partial"
    assert any("max_steps" in finding for finding in result.findings)
    assert 0 < result["window.end"] < 0.8


STOPPED = {"turns": 8, "max_steps": 700, "seed": 3}
RUN = ("impact", "motion", "pins", "forces", "energy", "spectrum", "end")


@pytest.fixture(scope="module")
def stopped():
    return slider_crank(simulate=STOPPED, springs=[{"connects": ["slider.B", "ground.O"], "stiffness": "1 N/mm"}])


@pytest.mark.parametrize("name", RUN)
def test_each_analysis_alone_says_that_its_run_stopped_and_when(stopped, name):
    result = dw.run(stopped, only=name)
    (stop,) = (finding for finding in result.findings if finding.startswith("the run ends at t = "))
    assert result.outcome == "partial" and f"Partial for that reason: {name}" in stop and " s of 0.8 s: the limit of 700 steps" in stop
    until = stop.partition(":")[0]
    assert [key for key, value in result.values.items() if until not in value.meaning] == []
    assert name in ("impact", "spectrum") or result.values or result.tables


def test_what_does_not_look_at_the_run_stays_complete(stopped):
    assert dw.run(stopped, only="rest").outcome == "complete"
    both = dw.run(stopped, only=("rest", "end"))
    assert not any("the run ends" in value.meaning for name, value in both.values.items() if name.startswith(("rest.", "modes.")))


@pytest.mark.parametrize("samples", [8, 60, 61, 1000])
def test_the_spectrum_exists_at_any_sampling(samples):
    spec = slider_crank({"name": "wrist", "connects": ["rod.B", "slider.B"]}, simulate={"turns": 2, "samples_per_turn": samples})
    result = dw.run(spec, only="spectrum")
    found = table_of(result, "spectrum.rod")
    assert result.outcome == "complete" and not [f for f in result.findings if "spectrum" in f]
    # sin(rod) = -k sin(crank), k = r/l, so that rod'' = k (1 - k^2) sin(crank) / (1 - k^2 sin^2(crank))^(3/2): harmonics of a closed form
    crank, k = np.linspace(0, 2 * np.pi, 4096, endpoint=False), 0.05 / 0.12
    exact = (20 * np.pi) ** 2 * k * (1 - k**2) * np.sin(crank) / (1 - (k * np.sin(crank)) ** 2) ** 1.5
    harmonics = 2 * np.abs(np.fft.rfft(exact))[:8] / crank.size
    assert harmonics[1] > 1500
    np.testing.assert_allclose(found["amplitude"][:8], harmonics, rtol=1e-6, atol=1e-6 * harmonics[1])


def bar(length, angle, ends):
    return {
        "mass": "1 kg",
        "inertia": f"{length * length / 12e6!r} kg m^2",
        "centroid": [f"{length / 2} mm", "0 mm"],
        "angle": angle,
        "points": {ends[0]: ["0 mm", "0 mm"], ends[1]: [f"{length} mm", "0 mm"]},
    }


@pytest.fixture(scope="module")
def swing():
    """Two rockers on a short coupler, swinging in gravity: either is now and then in a limit position, where the coordinates change."""
    pins = {"O2": ["ground.O2", "left.O"], "A": ["left.A", "coupler.A"], "B": ["coupler.B", "right.B"], "O4": ["ground.O4", "right.O"]}
    bodies = {
        "left": bar(100, "-60 deg", "OA") | {"angular_velocity": "200 rpm"},
        "coupler": bar(60, "0 deg", "AB"),
        "right": bar(100, "-120 deg", "OB"),
    }
    return build(
        from_document(
            {
                "mechanism": "linkage",
                "gravity": ["0 m/s^2", "-9.81 m/s^2"],
                "bodies": bodies,
                "ground": {"points": {"O2": ["0 mm", "0 mm"], "O4": ["150 mm", "0 mm"]}},
                "joints": [{"name": name, "connects": connects} for name, connects in pins.items()],
                "simulate": {"duration": "2 s"},
                "outputs": [{"name": "left", "body": "left"}],
            }
        )
    )


def test_a_record_of_many_stretches_is_one_signal_and_its_audit_closes(swing):
    seen = record_of(swing)
    assert len(run_of(swing).stretches) > 4 and np.all(np.diff(seen.t) > 0) and len(seen.t) % 2 == 1
    assert audit(seen).error < 1e-6


def test_forces_are_told_over_the_whole_run_whatever_its_stretches(swing):
    seen = observe_last_turn(swing)
    assert seen.t[0] == 0.0 and seen.t[-1] == 2.0 and np.all(np.diff(seen.t) >= 0)
    result = joint_forces(swing)
    left = next(column.data for column in result.tables[0].columns if column.name == "O2.force")
    assert len(left) == len(seen.t) and result.values["forces.residual"].value < 1e-9


def test_another_drive_angle_at_the_start_moves_the_section_to_its_zero():
    spec = slider_crank(poincare={"output": "slider"})
    model = build(from_document(_turned(spec, "90 deg")))
    times = zero_times(model, 0.8)
    np.testing.assert_allclose(times, 0.075 + 0.1 * np.arange(8), atol=1e-12)
    np.testing.assert_allclose(np.cos(model.crank_angle(times)), 1.0)


def _turned(spec, angle):
    from drivewright.spec import document

    tables = document(spec)
    tables["bodies"]["crank"]["angle"] = angle
    tables["bodies"]["rod"]["angle"] = "-25 deg"
    return tables


def test_contracting_motion_has_a_negative_exponent_and_repeats_itself():
    heavy = PLAY | {"clearance": "0.05 mm", "restitution": 0.3, "friction": 0.2}
    result = dw.run(
        slider_crank(
            heavy,
            lyapunov={"turns": 40, "discard": 20},
            poincare={"output": "slider"},
            simulate={"turns": 30, "discard": 15, "relative_tolerance": 1e-8},
        ),
        only=("lyapunov", "poincare"),
    )
    assert result["lyapunov_exponent.per_turn"] < 0
    position = table_of(result, "poincare")["position"]
    assert result["poincare.period"] == 2  # the pin hits one wall in one turn, the other in the next
    assert max(np.ptp(position[::2]), np.ptp(position[1::2])) < 1e-7


@pytest.mark.parametrize(
    ("over", "start", "stop"),
    [
        ("joints.wrist.clearance", "0.1 mm", "0.2 mm"),
        ("drive.speed", "500 rpm", "700 rpm"),
        ("joints.wrist.restitution", 0.5, 0.9),
        ("joints.wrist.friction", 0.0, 0.2),
    ],
)
def test_a_bifurcation_diagram_over(over, start, stop):
    asked = {"over": over, "start": start, "stop": stop, "steps": 2, "turns": 4, "discard": 2, "output": "slider"}
    table = table_of(dw.run(slider_crank(bifurcation=asked), only="bifurcation"), "bifurcation")
    assert len(table["position"]) == 6 and len(set(table["parameter"])) == 2  # visits at the turns 2, 3 and 4
    last = dw.run(
        slider_crank(poincare={"output": "slider"}, simulate={"turns": 4, "relative_tolerance": 1e-7}).replace(
            {over: SI(table["parameter"][-1])}
        ),
        only="poincare",
    )
    assert table["position"][-1] == pytest.approx(last["poincare.position"], abs=1e-9)


def test_the_load_table_holds_the_same_numbers_as_single_runs():
    spec = slider_crank(
        {
            "name": "wrist",
            "connects": ["rod.B", "slider.B"],
            "model": "massless-link",
            "clearance": "0.1 mm",
            "link_damping": "1e-4 N m s/rad",
        },
        table={"speeds": ["500 rpm", "600 rpm"], "clearances": ["0.1 mm"], "output": "rod"},
        simulate={"turns": 8, "discard": 2, "relative_tolerance": 1e-8},
    )
    table = table_of(dw.run(spec, only="load_table"), "load_table")
    assert table["speed"].tolist() == pytest.approx([500 * np.pi / 30, 600 * np.pi / 30])
    assert table["coefficient"][1] == pytest.approx(dw.run(spec, only="impact")["rod.impact_load_coefficient"], rel=1e-4)


def test_the_spectrum_of_the_ideal_motion_has_the_series_of_the_slider_crank():
    table = table_of(dw.run(slider_crank(), only="spectrum"), "spectrum.rod")
    ratio, speed = 0.05 / 0.12, 20 * np.pi
    # sin(angle) = ratio sin(wt): the rod's angular acceleration has odd orders only, the first near ratio w^2 (1 + ratio^2/8).
    assert table["ideal_amplitude"][1] == pytest.approx(ratio * speed**2 * (1 + ratio**2 / 8 + 3 * ratio**4 / 64), rel=2e-3)
    assert table["ideal_amplitude"][2] < 1e-6 * table["ideal_amplitude"][1]


def test_examples_read_back_to_themselves():
    for name in ("knife_folder", "slider_crank_clearance", "four_bar", "jansen_leg"):
        spec = from_document(read_document(EXAMPLES / f"{name}.toml"))
        assert from_document(_again(spec)).digest() == spec.digest()


def _again(spec):
    import tomllib

    return tomllib.loads(spec.to_toml())
