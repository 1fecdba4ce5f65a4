"""A plate with its pins under forces: balance, mirror, homogeneity, modulus, clearance, seat, flanks."""

import numpy as np
import pytest

from drivewright.chains.solid.assumptions import over_fits, peaks, with_fit
from drivewright.chains.solid.history import solid_history
from drivewright.chains.solid.joint import Fit
from drivewright.chains.solid.pitch import forces_at
from drivewright.chains.stress.plate import plate_basis, plate_body, worst
from drivewright.errors import InputError
from drivewright.solids.stresses import skin_stress
from tests.support.solid_chain import COARSEST, FIT, PULL, STEEL, loads, middle_of_flank, no_gap, plate, pulled, solid, state_of, straight

pytestmark = [pytest.mark.analytical, pytest.mark.needs_fe]
LEANING = loads([[[-180.0, 40.0], [150.0, 25.0]]], [[0.0, 60.0]], [[0.0, middle_of_flank() + 4e-4]])
MIRRORED = loads([[[-150.0, 25.0], [180.0, 40.0]]], [[60.0, 0.0]], [[middle_of_flank() + 4e-4, 0.0]])
AXES = ((1, 0, 0), (0, 1, 0), (0, 0, 1))


def greatest(made, state, body="plate"):
    """Greatest von Mises stress [Pa] of a body beside flanks and pins' rolling contact."""
    region = "(?!flank|low).*" if body == "plate" else "high"
    return float(skin_stress(made.model.bodies[body], [state.displacement(body)], region).mises.max())


# -- forces


def test_seats_bear_half_of_what_the_pins_bear():
    """The model is half a plate; a force across the chain acts on the pin's whole volume."""
    state = state_of(solid(), LEANING)
    for number in (0, 1):
        assert state.force(number)[:2] == pytest.approx(LEANING.pins[0, number] / 2, rel=1e-5)
    assert state.links == pytest.approx([0.0, 0.0], abs=0.05 * PULL)  # hardly anything turns a pin in its seat


def test_forces_are_named_after_sides_and_flanks_after_the_nearest_height():
    found = forces_at(solid(), LEANING, 0)
    assert found == {"left x": -90.0, "left y": 20.0, "right x": 75.0, "right y": 12.5, "right flank 1": 30.0}
    lower = LEANING._replace(heights=LEANING.heights - 8e-4)
    assert "right flank 0" in forces_at(solid(), lower, 0)


def test_flanks_without_force_load_nothing():
    high = loads([[[-PULL, 0.0], [PULL, 0.0]]], [[0.0, 0.0]], [[1.0, -1.0]])
    assert forces_at(solid(), high, 0) == forces_at(solid(), straight(PULL), 0)


def work(body, vector, direction):
    return float(body.ng.InnerProduct(vector, body._interpolated(body.ng.CF(direction))))


@pytest.mark.parametrize(("side", "way"), [("left", -1.0), ("right", 1.0)])
def test_unit_loads_push_where_and_whither_they_say(side, way):
    made = solid()
    body, pin = made.model.bodies["plate"], made.model.bodies[side]
    one = made.model.loads[f"{side} x"].vector
    assert [work(pin, one, axis) for axis in AXES] == pytest.approx([1.0, 0.0, 0.0], abs=1e-9)
    across = made.model.loads[f"{side} y"].vector
    assert [work(pin, across, axis) for axis in AXES] == pytest.approx([0.0, 1.0, 0.0], abs=1e-9)
    (x0, y0), (x1, y1) = plate().flank(side)
    along = np.array([x1 - x0, y1 - y0]) / np.hypot(x1 - x0, y1 - y0)
    for number, height in enumerate(made.heights):
        press = made.model.loads[f"{side} flank {number}"].vector
        force = np.array([work(body, press, (1, 0, 0)), work(body, press, (0, 1, 0))])
        assert np.hypot(*force) == pytest.approx(1.0, rel=1e-9)
        assert force @ along == pytest.approx(0.0, abs=1e-9)
        assert way * force[0] < 0  # into the plate
        x = x0 + (height - y0) / (y1 - y0) * (x1 - x0)
        moment = work(body, press, (-body.ng.y, body.ng.x, 0))
        assert moment == pytest.approx(1e3 * (x * force[1] - height * force[0]), rel=1e-6)


def test_shares_along_a_pin_weigh_its_force():
    """The resultant of even shares lies half way up the pin."""
    pin = solid().model.bodies["right"]
    vector = solid().model.loads["right x"].vector
    assert work(pin, vector, (pin.ng.z, 0, 0)) == pytest.approx(1.5, rel=0.02)


# -- mirror and scale


def test_a_mirrored_load_gives_the_mirrored_stress():
    """But for the elements, which are not mirrored."""
    made = solid()
    one, other = state_of(made, LEANING), state_of(made, MIRRORED)
    assert greatest(made, one) == pytest.approx(greatest(made, other), rel=0.05)
    for here, there in (("left", "right"), ("right", "left")):
        assert greatest(made, one, here) == pytest.approx(greatest(made, other, there), rel=0.08)
    assert one.force(0) * [-1, 1, 1] == pytest.approx(other.force(1), abs=0.01 * PULL)


@pytest.mark.parametrize("size", [2.0, 7.0])
def test_without_gaps_stress_and_pressure_grow_with_the_load(size):
    made = solid()
    once, more = (state_of(made, loads(times * LEANING.pins), gaps=no_gap(made)) for times in (1.0, size))
    for number in (0, 1):
        assert more.pressure[number] == pytest.approx(size * once.pressure[number], rel=1e-6, abs=1e-6 * once.pressure[number].max())
    assert greatest(made, more) == pytest.approx(size * greatest(made, once), rel=1e-7)
    assert more.area(0) == pytest.approx(once.area(0), rel=1e-9)


@pytest.mark.slow
def test_without_gaps_stress_is_the_same_for_any_modulus():
    """And displacements are inverse to it."""
    steel, soft = (solid(modulus, COARSEST) for modulus in (STEEL.modulus, STEEL.modulus / 3))
    hard, gives = (state_of(made, straight(PULL), gaps=no_gap(made)) for made in (steel, soft))
    assert gives.pressure[0] == pytest.approx(hard.pressure[0], rel=1e-5, abs=1e-5 * hard.pressure[0].max())
    assert greatest(soft, gives) == pytest.approx(greatest(steel, hard), rel=1e-6)
    assert gives.travel("right x") == pytest.approx(3 * hard.travel("right x"), rel=1e-6)


def test_with_clearance_the_contact_widens():
    made, gaps = solid(), with_fit(solid(), Fit(10e-6, 0.0))
    areas, tops = zip(
        *(
            (state.area(0), max(part.max() for part in state.pressure))
            for state in (state_of(made, straight(f), gaps=gaps) for f in (50, 200))
        ),
        strict=True,
    )
    assert areas[1] > 1.2 * areas[0]
    assert tops[1] < 3 * tops[0]


# -- fits


def test_the_same_fit_has_the_gaps_that_the_model_was_made_with():
    for found, pairing in zip(with_fit(solid(), FIT), solid().model.pairings, strict=True):
        assert found == pytest.approx(pairing.gap, rel=1e-12, abs=1e-15)


def test_normals_of_a_seat_point_to_its_middle():
    for side, pairing in zip(("left", "right"), solid().model.pairings, strict=True):
        inward = 1e3 * np.array([*plate().seat(side).center]) - pairing.points[:, :2]
        across = inward / np.linalg.norm(inward, axis=1, keepdims=True)
        assert np.sum(across * pairing.outward[:, :2], axis=1) == pytest.approx(np.ones(len(across)), abs=0.01)


def test_clearance_adds_its_volume_to_the_gaps():
    tight, loose = (with_fit(solid(), Fit(clearance, 0.0)) for clearance in (0.0, 7e-6))
    for first, second, pairing in zip(tight, loose, solid().model.pairings, strict=True):
        assert second - first == pytest.approx(7e-3 * pairing.area, rel=1e-9)


def test_more_clearance_presses_more_on_less():
    made = solid()
    states = [state_of(made, straight(PULL), gaps=with_fit(made, Fit(c, 0.0))) for c in (0.0, 5e-6, 20e-6)]
    areas = [state.area(0) + state.area(1) for state in states]
    tops = [max(part.max() for part in state.pressure) for state in states]
    assert np.all(np.diff(areas) < 0)
    assert np.all(np.diff(tops) > 0)


def test_a_seat_of_a_few_degrees_is_pressed_there_alone():
    made, half = solid(), np.radians(50)
    state = state_of(made, straight(PULL), gaps=with_fit(made, Fit(0.0, 0.0, half)))
    for number, (side, way) in enumerate((("left", -1.0), ("right", 1.0))):
        seat = plate().seat(side)
        place = made.model.pairings[number].places[state.pressure[number] > 0]
        turn = np.angle(way * (place[:, 0] + 1j * place[:, 1] - 1e3 * complex(*seat.center)))
        assert np.abs(turn).max() < half
        assert np.abs(turn).max() > 0.5 * half
        assert state.force(number)[0] == pytest.approx(way * PULL / 2, rel=1e-6)


def test_what_is_borne_is_the_greatest_over_bodies_and_instants():
    tight, loose = over_fits(solid(), [FIT, Fit(4e-6, 50e-6)], straight(0.5 * PULL, 2 * PULL))
    found, wider = peaks(tight), peaks(loose)
    assert found.plate == pytest.approx(tight.greatest("plate").max())
    assert found.pin == pytest.approx(max(tight.greatest(side).max() for side in ("left", "right")))
    assert found.pressure == pytest.approx(max(part.max() for part in tight.states[1].pressure))
    assert wider.pressure > found.pressure


def test_a_fit_that_bears_beyond_the_condensed_seat_is_refused():
    narrow = solid()._replace(fit=Fit(0.0, 0.0, np.radians(40)))
    assert len(with_fit(narrow, Fit(5e-6, 0.0, np.radians(30)))) == 2
    for fit, words in ((Fit(0.0, 0.0), "needs all round"), (Fit(0.0, 0.0, np.radians(50)), "needs 50° to either side")):
        with pytest.raises(InputError, match=f"condensed with a bearing seat of 40° to either side.* {words}; condense it"):
            with_fit(narrow, fit)


# -- beside the plane plate


def test_the_crotch_bears_what_the_plane_plate_with_a_cosine_pressure_says():
    plane = worst(plate_basis(plate(), plate_body(plate(), *STEEL)), straight(PULL))
    (size, instant, point), found = pulled().worst("plate"), pulled()
    assert instant == 1
    assert size == pytest.approx(plane.stress, rel=0.06)
    assert found.skins["plate"].points[point, 1] == pytest.approx(plane.place[1], abs=0.2e-3)
    assert abs(found.skins["plate"].points[point, 0]) == pytest.approx(abs(plane.place[0]), abs=0.2e-3)


@pytest.mark.slow
def test_finer_elements_move_the_greatest_stress_by_little():
    fine = solid(fineness=1.0)
    moved = solid_history(fine, straight(PULL))
    assert moved.greatest("plate")[0] == pytest.approx(pulled().greatest("plate")[1], rel=0.05)
    assert moved.greatest("left")[0] == pytest.approx(moved.greatest("right")[0], rel=0.06)  # raw stress at the edge of the seat
