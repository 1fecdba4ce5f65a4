"""The path of a chain and its balance: lengths against another program's hull and closed forms, forces against virtual work, refusals."""

from dataclasses import replace
from itertools import permutations

import numpy as np
import pytest
import shapely

from drivewright.chains.link import design_link
from drivewright.chains.model import Chain, ChainContact, ChainDrive, Guide, Slide, SpeedRamp, Sprocket, with_sprocket
from drivewright.chains.path import balanced, limit_speed, met, stations
from drivewright.chains.path.order import clearance
from drivewright.chains.path.route import route
from drivewright.chains.roller_sprocket import design_roller_sprocket
from drivewright.errors import DoesNotAssemble, InputError

pytestmark = pytest.mark.analytical

PITCH, MASS, K = 9.525e-3, 3.9e-3, 3e7
TOUCH = ChainContact(1e8, 50.0)


def wheel(teeth, centre, **more):
    design = design_roller_sprocket(teeth, PITCH, 6.35e-3, 0.5)
    return Sprocket(design.tooth, TOUCH, centre, tip_radius=design.tip_radius, inertia=1e-4, **more)


def drive(*further, links=96, guides=(), torque=0.0, distance=0.317, slide=None, speed=-60.0, teeth=(19, 38), **chain):
    first = replace(wheel(teeth[0], (0.0, 0.0)), drive=SpeedRamp(speed, speed), inertia=0.0)
    second = wheel(teeth[1], (distance, 0.0), torque=torque, slide=slide, mass=0.5)
    link = design_link(PITCH, 0.0, np.pi / 6, 0.0)
    return ChainDrive(Chain(link, links, MASS, 1e-7, K, **chain), (first, second, *further), guides)


def idler(teeth=15, centre=(0.13, 0.036), force=40.0, stiffness=2e3, outside=True, direction=-np.pi / 2, **more):
    slide = Slide(direction, force, stiffness, 100.0, **more)
    return wheel(teeth, centre, outside=outside, slide=slide, mass=0.2, name="idler")


def held(model):
    """The model with all of its slides at their given places."""
    return replace(
        model, sprockets=tuple(replace(s, slide=None) for s in model.sprockets), guides=tuple(replace(g, slide=None) for g in model.guides)
    )


# ------------------------------------------------------------------------------------------------------------------ the path


@pytest.mark.parametrize("seed", range(5))
def test_sprockets_inside_are_met_along_their_convex_hull(seed):
    rng = np.random.default_rng(seed)
    while True:
        places, teeth = rng.uniform(-0.4, 0.4, (5, 2)), rng.integers(11, 45, 5)
        discs = [shapely.Point(*at).buffer(z * PITCH / (2 * np.pi), 500) for at, z in zip(places, teeth, strict=True)]
        hull = shapely.unary_union(discs).convex_hull
        touched = {n for n, disc in enumerate(discs) if disc.distance(hull.exterior) < 1e-6}
        if all(a.distance(b) > 0.01 for k, a in enumerate(discs) for b in discs[:k]) and {0, 1} <= touched:
            break
    sprockets = tuple(wheel(int(z), tuple(at)) for at, z in zip(places, teeth, strict=True))
    model = drive()
    model = replace(model, sprockets=(replace(sprockets[0], drive=SpeedRamp(-60.0, -60.0), inertia=0.0), *sprockets[1:]))
    found = met(model, np.zeros(5))
    assert {station.body for station in found.stations} == touched
    radii = np.array([station.radius for station in found.stations])
    assert np.sum(found.lengths) + radii @ found.wraps == pytest.approx(hull.length, rel=1e-5)
    assert np.sum(found.wraps) == pytest.approx(2 * np.pi, abs=1e-12)
    for n in set(range(5)) - touched:
        assert clearance(model, np.zeros(5), n) > 0


def test_the_order_in_which_sprockets_are_listed_does_not_matter():
    further = (wheel(21, (0.11, -0.08)), wheel(15, (0.13, 0.036), outside=True), wheel(17, (0.33, -0.1)))
    routes = []
    for order in permutations(range(3)):
        model = drive(*(further[k] for k in order))
        found = met(model, np.zeros(5))
        names = [station.body if station.body < 2 else 2 + order[station.body - 2] for station in found.stations]
        routes.append((names, found.links))
    assert all(each[0] == routes[0][0] == [0, 3, 1, 4, 2] for each in routes)
    assert np.ptp([links for _, links in routes]) < 1e-12


def test_an_idler_that_presses_a_strand_in_lengthens_it_as_the_inner_tangents_do():
    # equal sprockets of radius R, C apart, the idler of radius r midway, its centre a above the line of centres
    above = 0.05
    model = drive(wheel(15, (0.15, above), outside=True), teeth=(25, 25), distance=0.3)
    found = met(model, np.zeros(3))
    large, small = 25 * PITCH / (2 * np.pi), 15 * PITCH / (2 * np.pi)
    across = np.hypot(0.15, above)
    tangent = np.sqrt(across**2 - (large + small) ** 2)
    down = np.arcsin((large + small) / across) - np.arctan2(above, 0.15)  # of the strand below the line of centres
    assert found.lengths[:2] == pytest.approx([tangent, tangent], rel=1e-12)
    assert found.wraps[1] == pytest.approx(2 * down, rel=1e-12)
    wraps = 25 * (2 * np.pi + 2 * down) / (2 * np.pi) + 15 * 2 * down / (2 * np.pi)
    assert found.links == pytest.approx((2 * tangent + 0.3) / PITCH + wraps, rel=1e-12)


def test_a_rail_bends_a_strand_by_tangent_plates():
    model = drive(guides=(Guide((0.16, -0.345), 0.3, 1.3, 1.84, "outside", 4e-3, TOUCH),))
    found = met(model, np.zeros(3))
    place = found.place(2)
    assert place is not None and found.stations[place].turn == 1
    radius = 0.304
    turn = 2 * np.arctan(0.5 * PITCH / radius)  # of one plate to the next, both tangents
    without = met(replace(model, guides=()), np.zeros(2))
    longer = found.links - without.links
    assert found.wraps[place] / turn == pytest.approx(found.stations[place].per_turn * found.wraps[place] / (2 * np.pi), rel=1e-12)
    assert 0 < longer < 0.1


def test_a_rail_out_of_reach_is_not_met():
    model = drive(guides=(Guide((0.16, -0.36), 0.3, 1.3, 1.84, "outside", 4e-3, TOUCH),))
    assert met(model, np.zeros(3)).place(2) is None
    far = clearance(model, np.zeros(3), 2)
    near = met(replace(model, guides=(replace(model.guides[0], centre=(0.16, -0.36 + 1.05 * far)),)), np.zeros(3))
    assert 0 < far < 0.02 and near.place(2) is not None


# ------------------------------------------------------------------------------------------------------------------ the balance


def test_the_force_of_a_tensioner_is_twice_the_tension_times_the_sine_of_half_the_wrap():
    # symmetric: the idler midway between equal sprockets
    model = drive(idler(centre=(0.15, 0.045), force=50.0), teeth=(25, 25), distance=0.3, links=88)
    found = balanced(model)
    place = found.route.place(2)
    force = 50.0 - 2e3 * found.q[2]
    assert 2 * found.pulls[place] * np.sin(0.5 * found.route.wraps[place]) == pytest.approx(force, rel=1e-9)
    assert np.ptp(found.pulls) < 1e-9 * force


def test_the_chain_is_as_long_as_its_links_and_their_stretch():
    found = balanced(drive(idler(), torque=8.0))
    stretch = np.sum(found.route.lengths * (found.pulls + found.centrifugal)) / (K * PITCH**2)
    assert found.route.links == pytest.approx(96 + stretch, rel=1e-11)
    assert stretch > 0.01


def test_a_load_torque_is_the_difference_of_the_strands_times_the_radius():
    for torque in (8.0, -3.0):
        found = balanced(drive(idler(), torque=torque))
        tight, slack = found.pulls[found.route.place(1)], found.pulls[0]
        assert (tight - slack) * 38 * PITCH / (2 * np.pi) == pytest.approx(torque, rel=1e-9)


def test_an_idler_outside_turns_the_other_way_against_its_own_torque():
    still = held(drive(idler()))
    found = balanced(with_sprocket(still, 2, torque=-0.4, centre=(0.13, 0.032)))
    after, before = found.pulls[1], found.pulls[0]
    assert (after - before) * 15 * PITCH / (2 * np.pi) == pytest.approx(0.4, rel=1e-9)


@pytest.mark.parametrize("sense", (-1, 1))
def test_friction_of_a_rail_is_that_of_a_rope(sense):
    rail = Guide((0.16, -0.335), 0.3, 1.3, 1.84, "outside", 4e-3, TOUCH, friction=0.3)
    found = balanced(drive(idler(), guides=(rail,), torque=8.0, speed=60.0 * sense))
    place = found.route.place(3)
    gain = found.pulls[place] / found.pulls[place - 1]
    assert gain == pytest.approx(np.exp(-sense * 0.3 * found.route.wraps[place]), rel=1e-12)
    assert abs(gain - 1) > 0.02


@pytest.mark.parametrize("kind", ("slide", "pivot", "blade"))
def test_pulls_are_those_of_virtual_work(kind):
    """The work of the spring over a small travel is the tension times what the path grows by."""
    if kind == "blade":
        slide = Slide(0.0, 30.0, 500.0, pivot=(0.03, 0.08), lever=-0.12)
        blade = Guide((0.15, 0.225), 0.2, -2.0, -1.2, "outside", 4e-3, TOUCH, mass=0.05, slide=slide, name="blade")
        model = drive(guides=(blade,))
    else:
        more = {"pivot": (0.05, 0.09), "lever": -np.hypot(0.08, 0.054)} if kind == "pivot" else {"direction": -1.4}
        model = drive(idler(**more))
    found = balanced(model)
    body = (*model.sprockets, *model.guides)[2]

    def grown(step):
        q = found.q.copy()
        q[2] += step
        return route(model, found.route.stations, q).links * PITCH

    growth = (grown(1e-6) - grown(-1e-6)) / 2e-6
    force = body.slide.force - body.slide.stiffness * found.q[2]
    # plates around a rail are tangents of its arc: longer than it by (p/(2 R))^2/3
    assert found.pulls[0] * growth == pytest.approx(force, rel=2e-7 if kind != "blade" else 5e-3)


def test_pulls_scale_with_the_forces():
    soft = balanced(replace(drive(idler(stiffness=0.0), torque=8.0), chain=replace(drive().chain, joint_stiffness=1e12)))
    hard = balanced(replace(drive(idler(stiffness=0.0, force=120.0), torque=24.0), chain=replace(drive().chain, joint_stiffness=1e12)))
    np.testing.assert_allclose(hard.pulls, 3 * soft.pulls, rtol=1e-4)
    np.testing.assert_allclose(hard.q, soft.q, atol=1e-6)


def test_a_sliding_driven_sprocket_balances_its_preload():
    found = balanced(drive(wheel(21, (0.11, -0.08)), links=102, slide=Slide(0.0, 150.0)))
    assert found.force_on(found.route.place(1)).real == pytest.approx(-150.0, rel=1e-9)


def test_a_fixed_chain_is_as_tense_as_it_is_stretched():
    taut = balanced(drive(slide=Slide(0.0, 1e-9), speed=-0.001))
    for longer in (2e-4, 4e-4):
        model = drive(distance=0.317 + float(taut.q[1]) + longer, speed=-0.001)
        found = balanced(model)
        cosine = np.cos(found.route.headings[0])
        strands = np.sum(found.route.lengths) / PITCH
        assert found.pulls[0] == pytest.approx(2 * cosine * longer * K / strands, rel=2e-3)
        assert found.slack == 0.0
    loose = balanced(drive(distance=0.317 + float(taut.q[1]) - 2e-4, torque=3.0))
    assert np.min(loose.pulls) == 0.0
    assert loose.slack == pytest.approx(2 * cosine * 2e-4, rel=0.3)


def test_a_fixed_chain_loses_its_pull_where_the_centrifugal_force_is_its_tension():
    taut = balanced(drive(slide=Slide(0.0, 1e-9)))
    model = drive(distance=0.317 + float(taut.q[1]) + 3e-4)
    still = balanced(model, 0.0)
    limit = limit_speed(model) * 19 * PITCH / (2 * np.pi)
    assert MASS / PITCH * limit**2 == pytest.approx(still.pulls[0], rel=1e-6)
    assert limit_speed(drive(idler(stiffness=0.0, force=400.0))) == np.inf  # a force that does not yield


# ------------------------------------------------------------------------------------------------------------------ refusals


@pytest.mark.error
@pytest.mark.parametrize(
    ("model", "words"),
    [
        (lambda: drive(idler(travel=(-0.015, 0.015)), links=104), r"104 links are .* links \(.* mm\) too long: .*'idler' moves by 15 mm"),
        (
            lambda: drive(idler(travel=(-0.015, 0.015)), links=92),
            r"92 links are .* too short: .* Take \d*[02468] more links, give it more travel",
        ),
        (lambda: drive(wheel(15, (0.13, 0.0), name="lost")), "does not reach sprocket 'lost': the nearest strand passes .* mm away"),
        (lambda: drive(wheel(15, (0.13, 0.09), outside=True)), "does not reach sprocket 3"),
        (lambda: drive(idler(force=-40.0, stiffness=0.0)), "leaves the chain slack"),
        (
            lambda: drive(idler(centre=(0.13, 0.2), travel=(-0.02, 0.02))),
            r"'idler' does not touch the chain: it lies outside .* side = 'inside'",
        ),
        (
            lambda: drive(idler(centre=(0.13, 0.045), outside=False, travel=(-0.02, 0.02))),
            r"'idler' does not tighten the chain: it lies inside the loop, and its direction leads it away.* side = 'outside'",
        ),
    ],
)
def test_chains_that_do_not_fit(model, words):
    with pytest.raises(DoesNotAssemble, match=words):
        balanced(model())


@pytest.mark.error
def test_bodies_that_are_too_near_are_named():
    with pytest.raises(InputError, match="the driving sprocket and the driven sprocket overlap: .* 80 mm apart, .* touch at 86.41 mm"):
        balanced(drive(distance=0.08))
    with pytest.raises(
        InputError, match=r"no strand fits between sprocket 'idler' and the driven sprocket: their centres are 39.81 mm apart"
    ):
        balanced(drive(idler(centre=(0.3, 0.036))))


@pytest.mark.error
def test_teeth_outside_meet_rollers_only():
    from drivewright.chains.tooth import Tooth

    with pytest.raises(InputError, match="sprocket 3: outside of the loop it meshes with roller chains only"):
        drive(replace(wheel(15, (0.13, 0.036), outside=True), tooth=Tooth(15, 0.02, -0.01)))


@pytest.mark.property
def test_the_other_sense_of_a_lever_turns_the_other_way():
    pivot = (0.02, 0.07)
    centre = complex(0.13, 0.04)
    slides = [Slide(0.0, 1.0, pivot=pivot, lever=lever) for lever in (0.1, -0.1)]
    assert slides[0].shift(centre, 0.01) == pytest.approx(slides[1].shift(centre, -0.01), abs=1e-15)
    for slide in slides:
        step = (slide.shift(centre, 1e-6) - slide.shift(centre, -1e-6)) / 2e-6
        assert step == pytest.approx(slide.way(centre, 0.0), rel=1e-9)
        assert abs(centre + slide.shift(centre, 0.03) - complex(*pivot)) == pytest.approx(abs(centre - complex(*pivot)), rel=1e-12)


def test_stations_take_their_radius_from_seats_and_rails():
    model = drive(guides=(Guide((0.16, -0.345), 0.3, 1.3, 1.84, "outside", 4e-3, TOUCH),))
    found = stations(model)
    assert [s.turn for s in found] == [-1, -1, 1]
    assert 0.5 * PITCH / np.tan(np.pi / 19) < found[0].radius < 0.5 * PITCH / np.sin(np.pi / 19)
    assert found[2].radius == pytest.approx(0.304, rel=1e-12)
