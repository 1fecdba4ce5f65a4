"""Two rows out of phase: their orders by the cosine of the phase, limits, sharing of the load, refusals."""

import numpy as np
import pytest

import drivewright as dw
from drivewright.chains.closure import mesh_order, phased
from drivewright.errors import SpecError
from drivewright.spec import from_document
from drivewright.spec.parsing import change_key

pytestmark = pytest.mark.interface

SPEC = {
    "mechanism": "silent-chain",
    "pitch": "9.525 mm",
    "links": 81,
    "teeth": [35, 37],
    "rows": 2,
    "row_phase": 0.5,
    "joint": {"rolling_radius": "1.2 mm"},
    "plate": {"apothem": "2.6 mm"},
    "drive": {"speed": "2000 rpm", "preload": "300 N", "load_torque": "5 N m"},
}


def spec(*changes):
    tables = {key: dict(value) if isinstance(value, dict) else value for key, value in SPEC.items()}
    for change in changes:
        change_key(tables, change)
    return from_document(tables)


def run(*changes, only=("closure",)):
    return dw.run(spec(*changes), only=only)


@pytest.mark.analytical
@pytest.mark.parametrize("phase", [0.5, 0.3, 0.12])
def test_each_order_is_that_of_one_row_by_the_cosine_of_the_phase(phase):
    result = run(f"row_phase={phase}")
    for order in (1, 2):
        both, one = result[f"phased.order_{order}"], result[f"phased.single_order_{order}"]
        assert both == pytest.approx(abs(np.cos(np.pi * order * phase)) * one, rel=2e-4, abs=1e-12)
    assert result["phased.transmission_error"] < result["transmission_error"]
    assert result["phased.centre_distance.fluctuation"] < result["centre_distance.fluctuation"]


@pytest.mark.analytical
def test_amplitude_of_a_harmonic():
    angle = np.linspace(0.2, 1.3, 401)
    turn = 2 * np.pi * (angle - angle[0]) / 1.1
    signal = 3.0 + 0.7 * np.cos(turn + 0.4) + 0.2 * np.sin(2 * turn)
    assert [mesh_order(angle, signal, order) for order in (1, 2, 3)] == pytest.approx([0.7, 0.2, 0.0], abs=1e-8)


@pytest.mark.property
def test_the_phase_to_either_side_is_the_same():
    ahead, behind = run("row_phase=0.3"), run("row_phase=0.7")
    for name in ("phased.transmission_error", "phased.centre_distance.fluctuation", "phased.force_difference"):
        assert ahead[name] == pytest.approx(behind[name], rel=1e-4)


@pytest.mark.property
def test_a_small_phase_is_nearly_one_row_and_shares_evenly():
    near = run("row_phase=1e-4")
    assert near["phased.transmission_error"] == pytest.approx(near["transmission_error"], rel=2e-3)
    assert near["phased.load_share"] == pytest.approx(0.5, abs=1e-3)
    assert not any(name.startswith("phased") for name in run("row_phase=0").values)


@pytest.mark.property
def test_force_that_rows_take_from_each_other():
    result, stiff = run(), run("contact.stiffness=2e5 N/mm")
    assert stiff["phased.force_difference"] == pytest.approx(2 * result["phased.force_difference"], rel=1e-9)
    model = dw.build(spec())
    gap, count = result.tables["phased_rows"]["distance_gap"].data, model.closure.free_plates
    both, arm = phased(model.closure, 0.5), 9.525e-3 / (2 * np.sin(np.pi / 37))
    ends = np.abs(gap + arm * both.angle_gap), np.abs(gap - arm * both.angle_gap)
    assert result["phased.force_difference"] == pytest.approx(1e8 / 3 / (count + 1) * 0.5 * np.max(ends), rel=1e-9)
    mean = 0.25 * (model.strands.tight + model.strands.slack)
    assert result["phased.load_share"] == pytest.approx(0.5 + 0.5 * result["phased.force_difference"] / mean)
    assert any("slack strand of one row" in finding for finding in run("drive.load_torque=13 N m", "contact.stiffness=1e6 N/mm").findings)
    assert "phased.load_share" not in run("drive=").values


def test_the_running_chain_is_refused_with_the_reason():
    result = run(only=("dynamics", "quasi_static"))
    assert (
        sum(
            "the dynamic model has one chain, and two rows out of phase are two chains on common shafts" in finding
            for finding in result.findings
        )
        == 2
    )


@pytest.mark.error
@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (("rows=",), "but rows = 1"),
        (("rows=3",), "but rows = 3"),
        (("pitch=", "joint=", "plate=", "chain=08B-2", "rows="), "share their pins"),
        (("row_phase=1",), "less than 1"),
    ],
)
def test_refusals_name_the_key(changes, words):
    with pytest.raises(SpecError) as refused:
        dw.build(spec(*changes))
    assert refused.value.key == "row_phase" and words in str(refused.value)
