"""A straight joint as solids: how pins share their force along their contact, the dent that a strip leaves out, clearance, meshes."""

import numpy as np
import pytest

from drivewright.chains.link import design_link
from drivewright.chains.plate import design_plate
from drivewright.chains.solid import tables
from drivewright.chains.solid.joint import (
    HATS,
    Fit,
    Stack,
    hat_widths,
    pin_body,
    rolling_pins,
    seat_gap,
    seat_pair,
    stack_of,
    strip_rows,
    turn_row,
)
from drivewright.chains.solid.meshes import pin_mesh, plate_mesh, usual_sizes
from drivewright.contact import hertz, hertz_beyond_strip
from drivewright.curves.outlines import outline_area
from drivewright.errors import InputError
from drivewright.solids.stresses import skin_stress
from tests.support.solid_chain import PULL, STEEL, plate, rolling, sizes

pytestmark = [pytest.mark.analytical, pytest.mark.needs_fe]
MM = 1e-3


# -- widths and compliance


def test_hats_stand_for_the_whole_length():
    widths = hat_widths(3e-3)
    assert len(widths) == HATS + 1
    assert widths.sum() == pytest.approx(3e-3, rel=1e-12)
    assert widths[0] == widths[-1] == pytest.approx(widths[1] / 2)


@pytest.mark.slow
def test_the_rolling_contact_has_the_compliance_that_the_strips_leave_out():
    """That of both pins over the length of a hat, with the half width of the mean line load."""
    found, end = rolling((1, 2)), 3e-3
    reduced = hertz.effective_radius(plate().link.radius, plate().link.radius)
    modulus = hertz.effective_modulus(*STEEL, *STEEL)
    half_width = 2 * np.sqrt(PULL / 2 / end * reduced / (np.pi * modulus))
    strip = 0.08 * plate().seat("right").radius
    both = 2 * hertz_beyond_strip(strip, half_width, *STEEL)
    assert [link.compliance for link in found.state.model.links[: HATS + 1]] == pytest.approx(both / hat_widths(end), rel=1e-9)


# -- lacing


def test_a_lacing_of_one_and_two_ends_and_a_wider_one_goes_on():
    assert stack_of(plate(), (1, 2)) == Stack((0.0, 1e-3), (1e-3, 3e-3), 3e-3, False)
    assert stack_of(plate(), (2, 3)) == stack_of(plate(), (4, 5)) == Stack((0.0, 1e-3), (1e-3, 2e-3), 2e-3, True)


# -- the joint


@pytest.mark.parametrize("lacing", [(1, 2), pytest.param((2, 3), marks=pytest.mark.slow)])
def test_forces_of_a_joint_are_in_balance(lacing):
    found = rolling(lacing)
    assert found.line_load @ hat_widths(found.height[-1]) == pytest.approx(PULL / 2, rel=1e-6)
    assert found.shares.sum() == pytest.approx(1.0)
    assert found.line_load.min() >= 0
    assert found.state.force(0) == pytest.approx([PULL / 2, 0, 0], abs=0.01 * PULL)  # the pin on the hole of the plate on the left
    assert found.state.force(1)[0] == pytest.approx(-PULL / 2, rel=1e-6)


@pytest.mark.slow
def test_the_line_load_is_greatest_in_the_middle_and_evener_in_an_endless_stack():
    """Pins that cross two outer plates bend and leave each other at their ends; a cell of an endless stack has no end."""
    ended, endless = rolling((1, 2)), rolling((2, 3))

    def unevenness(found):
        return found.line_load.max() / (PULL / 2 / found.height[-1])

    assert ended.line_load[0] > 1.2 * ended.line_load[-1]
    assert 1.0 < unevenness(endless) < 1.1 < unevenness(ended)


def test_the_rolling_table_is_hertz_along_the_pins():
    found = rolling((1, 2))
    table = tables.rolling_table(found, 1.2e-3, *STEEL)
    modulus = hertz.effective_modulus(*STEEL, *STEEL)
    assert table["pressure"].data == pytest.approx(np.sqrt(found.line_load * modulus / (np.pi * 0.6e-3)))
    assert table["line_load"].data == pytest.approx(found.line_load)
    assert table["height"].data == pytest.approx(np.linspace(0, 3e-3, 13))


@pytest.mark.slow
def test_an_endless_stack_is_held_in_its_last_plane_and_another_is_not():
    """Poisson's contraction moves the outer face of a stack that ends."""

    def along_the_pin(lacing, name):
        found = rolling(lacing).state
        return np.abs(skin_stress(found.model.bodies[name], [found.displacement(name)], "high").displacement[0][:, 2]).max()

    for name in ("other plate", "own pin", "other pin"):
        assert along_the_pin((2, 3), name) < 1e-15
        assert along_the_pin((1, 2), name) > 1e-8


def test_a_hinge_has_no_rolling_pins():
    hinge = design_plate(design_link(9.525e-3, 0.0, np.radians(30), 2.6e-3))
    with pytest.raises(InputError, match="one round pin has no rolling pins"):
        rolling_pins(hinge, stack_of(plate(), (1, 2)), Fit(0.0, 0.0), STEEL, PULL, sizes())


# -- what holds and drives a pin


def unit_shift(body, axis):
    """Coefficients of a shift of 1 mm, or of a turn of 1 rad about z (axis 3) or y (axis 4) through the origin."""
    ng = body.ng
    fields = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (-ng.y, ng.x, 0), (ng.z, 0, -ng.x)]
    return body._interpolated(ng.CF(fields[axis]))


def work(body, vector, axis):
    return float(body.ng.InnerProduct(vector, unit_shift(body, axis)))


@pytest.mark.parametrize("way", [-1.0, 1.0])
def test_hats_of_a_strip_push_into_the_pin_where_they_stand(way):
    stack, sigma = stack_of(plate(), (1, 2)), 0.1e-3
    outline = plate().own_pins[1 if way > 0 else 0]
    pin = pin_body(outline, stack, STEEL, sizes(0.5), 0.0)
    rows = strip_rows(pin, complex(way * plate().link.pitch / 2), -way, sigma, stack.end)
    step = stack.end / HATS / MM
    expected = step * np.arange(HATS + 1.0)
    expected[[0, -1]] = step / 3, stack.end / MM - step / 3  # half hats
    assert [work(pin, row, 0) for row in rows] == pytest.approx(np.full(HATS + 1, way), rel=1e-9)
    assert [work(pin, row, 1) for row in rows] == pytest.approx(np.zeros(HATS + 1), abs=1e-9)
    assert [way * work(pin, row, 4) for row in rows] == pytest.approx(expected, abs=0.5 * step)
    assert way * sum(work(pin, row, 4) for row in rows) == pytest.approx(expected.sum(), rel=0.02)


def test_what_holds_a_pin_from_turning_is_a_couple():
    pin = pin_body(plate().own_pins[1], stack_of(plate(), (1, 2)), STEEL, sizes(0.5), 0.0)
    row = turn_row(pin)
    assert [work(pin, row, axis) for axis in (0, 1)] == pytest.approx([0.0, 0.0], abs=1e-6)
    assert work(pin, row, 3) == pytest.approx(1.0, rel=1e-5)


# -- clearance and edges


def gaps(fit, points, edges=(0.0, 1e-3), shift=0.0):
    return seat_gap(plate(), "right", fit, edges, shift)(np.array(points, float), np.zeros((len(points), 3)))


def on_seat(turn, height, side="right", shift=0.0):
    """A point [mm] of a seat at an angle from the direction outwards and a height [mm]."""
    seat, way = plate().seat(side), 1.0 if side == "right" else -1.0
    x, y = seat.center[0] + way * seat.radius * np.cos(turn), seat.center[1] + way * seat.radius * np.sin(turn)
    return ((x + shift) / MM, y / MM, height)


def test_clearance_is_a_gap_all_over_the_seat():
    points = [on_seat(turn, height) for turn in (-1.0, 0.0, 1.2) for height in (0.0, 0.5)]
    assert gaps(Fit(3e-6, 0.0), points) == pytest.approx(np.full(6, 3e-3))


def test_a_rounded_edge_falls_away_as_its_circle_and_the_middle_plane_has_none():
    heights = np.array([0.0, 0.94, 0.95, 0.97, 1.0])
    depth = np.clip(heights - 0.95, 0.0, 0.05)
    found = gaps(Fit(0.0, 50e-6), [on_seat(0.2, height) for height in heights])
    assert found == pytest.approx(0.05 - np.sqrt(0.05**2 - depth**2), abs=1e-12)
    assert gaps(Fit(0.0, 50e-6), [on_seat(0.2, 1.0)], edges=(1e-3, 3e-3)) == pytest.approx([0.05])


@pytest.mark.parametrize(("side", "shift"), [("left", 0.0), ("right", 0.0), ("left", 9.525e-3)])
def test_a_seat_bears_within_its_angle_about_the_direction_outwards(side, shift):
    more = seat_gap(plate(), side, Fit(0.0, 0.0, np.radians(45)), (0.0, 1e-3), shift)
    turns = np.radians([-80, -46, -44, 0, 44, 46, 80])
    found = more(np.array([on_seat(turn, 0.5, side, shift) for turn in turns]), np.zeros((7, 3)))
    assert list(found > 0.5) == [True, True, False, False, False, True, True]


def test_what_may_close_lies_within_reach():
    """The clearance and half the edges' radius, and two hundredths of a millimetre for what the bodies give."""
    pair = seat_pair(plate(), "plate", "right", "right", Fit(5e-6, 50e-6), (0.0, 1e-3), 0.0)
    assert pair.reach == pytest.approx(50e-6)
    assert pair.first == ("plate", "seat right.*")
    assert pair.second == ("right", "skin")


# -- meshes


def measured(mesh, region=None):
    import ngsolve as ng

    return ng.Integrate(ng.CF(1) * (ng.dx if region is None else ng.ds(region)), mesh)


def test_the_mesh_of_a_plate_has_its_volume_and_its_named_faces():
    mesh = plate_mesh(plate(), 0.0, 1e-3, sizes(0.5), shift=2e-3)
    section = 1e6 * (abs(outline_area(plate().outline)) - sum(abs(outline_area(hole)) for hole in plate().holes))
    seat = plate().seat("left")
    assert measured(mesh) == pytest.approx(section, rel=2e-3)
    assert measured(mesh, "low") == pytest.approx(section, rel=2e-3)
    assert measured(mesh, "seat left.*") == pytest.approx(1e3 * seat.radius * abs(seat.sweep), rel=2e-3)
    assert {"seat left", "seat right", "flank left", "flank right", "low", "high"} <= set(mesh.GetBoundaries())


@pytest.mark.parametrize("half", [-1.0, 1.0])
def test_half_a_plate_is_cut_in_its_middle(half):
    whole, mesh = plate_mesh(plate(), 0.0, 1e-3, sizes(0.5)), plate_mesh(plate(), 0.0, 1e-3, sizes(0.5), half)
    import ngsolve as ng

    assert measured(mesh) == pytest.approx(measured(whole) / 2, rel=1e-3)
    assert np.sign(ng.Integrate(ng.x, mesh)) == half
    assert ng.Integrate(ng.x * ng.ds("cut"), mesh) == pytest.approx(0.0, abs=1e-9)


def test_the_mesh_of_a_pin_is_cut_where_plates_end():
    outline, stack = plate().own_pins[0], stack_of(plate(), (1, 2))
    mesh = pin_mesh(outline, stack.end, (stack.own[1], stack.other[1]), sizes(0.5))
    heights = np.array(mesh.ngmesh.Coordinates())[:, 2]
    assert measured(mesh) == pytest.approx(1e6 * abs(outline_area(outline)) * 3, rel=3e-3)
    assert np.isclose(heights, 1.0).sum() > 8
    assert {"skin", "low", "high", "inside"} <= set(mesh.GetBoundaries())


def test_twice_the_fineness_halves_all_elements():
    coarse, fine = usual_sizes(plate(), 0.7), usual_sizes(plate(), 1.4)
    assert np.array(coarse) == pytest.approx(2 * np.array(fine))
