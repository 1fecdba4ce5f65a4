"""The chain drive's own formulas: closed forms and similarity for what it finds and hands on to geometry, closure and dynamics."""

import tomllib
from types import SimpleNamespace

import numpy as np
import pytest

import drivewright as dw
from drivewright import registry
from drivewright.chains import interference
from drivewright.chains.closure import Drive, departure, phase_map
from drivewright.chains.explicit.ensemble import Ensemble
from drivewright.chains.explicit.measure import BODY, PLATE, ROW
from drivewright.chains.explicit.motion import LOSSES, Motion
from drivewright.chains.explicit.signals import Signal
from drivewright.chains.explicit.simulate import Settings, tooth_time
from drivewright.chains.link import design_link, seat_height, seat_support
from drivewright.chains.stress.plate import Loads
from drivewright.chains.stress.revolution import fewer_instants, open_seats
from drivewright.mechanisms.silent_chain import dynamics, many, stress
from drivewright.mechanisms.silent_chain.chain_drive import bare_drive, chain_drive
from drivewright.mechanisms.silent_chain.geometry import geometry
from drivewright.mechanisms.silent_chain.scene import link_shapes
from drivewright.numerics.ensemble import Estimate
from drivewright.result import Value
from drivewright.spec import from_document
from drivewright.spec.parsing import change_key

pytestmark = pytest.mark.analytical

MM = 1e-3
SIGNAL = Signal("centre_distance", "m", "centre distance", lambda run: run.centre_distance, "Dynamic centre distance")
P = 9.525 * MM
SPEC = """
mechanism = "silent-chain"
pitch = "9.525 mm"
links = 66
teeth = [23, 31]
[joint]
kind = "round-pin"
rolling_radius = "1.2 mm"
contact_length = "7 mm"
offset = "match-drive"
[plate]
flank_angle = "30 deg"
apothem = "2.6 mm"
thickness = "0.5 mm"
lacing = [2, 3]
[cutter]
half_angle = "27 deg"
bore = "18 mm"
[drive]
speed = "150 rad/s"
preload = "160 N"
load_torque = "2 N m"
"""
HINGE = ('joint.kind="revolute"', "joint.rolling_radius=", 'joint.offset="0 mm"')
ROLLER = (*HINGE, "plate.apothem=", 'roller.diameter="6.35 mm"')


def spec(*changes):
    tables = tomllib.loads(SPEC)
    for change in changes:
        change_key(tables, change)
    return from_document(tables)


def build(*changes):
    return dw.build(spec(*changes))


def run(only, *changes):
    return dw.run(spec(*changes), only=only)


def pitch_radius(teeth):
    return P / 2 / np.sin(np.pi / teeth)


# ------------------------------------------------------------------------------------------------------------------- wear, pins, wheels


def test_a_worn_chain_closes_as_a_new_one_of_its_longer_pitch():
    worn = run("closure", "closure.elongation=0.01")
    new = run("closure", f'pitch="{1.01 * P!r} m"')
    assert worn["centre_distance.mean"] > run("closure")["centre_distance.mean"] + MM
    for name, value in new.values.items():
        assert worn[name] == pytest.approx(value.value, rel=1e-9), name
    assert any("elongated by 1 %" in finding for finding in worn.findings)


def test_both_sides_of_the_closure_are_told_apart():
    found = run("closure")
    for side, teeth in (("drive", 23), ("driven", 31)):
        leaving = departure(design_link(P, 1.2 * MM, np.pi / 6, 2.6 * MM), teeth)
        told = [found[f"{name}.{side}"] for name in ("chordal_rise", "seating_angle", "strand_slip")]
        assert told == pytest.approx([leaving.rise, leaving.seating, leaving.slip], rel=1e-12)
    assert found["wrap.drive"] + found["wrap.driven"] == pytest.approx(2 * np.pi, rel=1e-12)
    lean = np.arcsin((pitch_radius(31) - pitch_radius(23)) / found["centre_distance.mean"])  # of a belt
    assert found["wrap.driven"] - found["wrap.drive"] == pytest.approx(4 * lean, rel=0.02)
    table = found.tables["centre_distance"]
    for side in ("drive", "driven"):
        teeth = {"drive": 23, "driven": 31}[side]
        assert np.mean(table[f"seated_{side}"].data) == pytest.approx(found[f"wrap.{side}"] * teeth / (2 * np.pi), abs=1.0)
    heights = sum(0.5 * P / np.tan(np.pi / z) for z in (23, 31))  # of the polygons, and near those of the pins
    assert found.check("sprockets.apart").value == pytest.approx(found["centre_distance.mean"] - heights, rel=0.02)
    straight = run("closure", 'closure.strands="straight"')
    assert straight["chordal_rise.drive"] == pytest.approx(departure(design_link(P, 1.2 * MM, 0.5, 0.0), 23, "straight").rise, rel=1e-12)


def test_a_fixed_centre_distance_may_not_stretch_the_chain():
    taut = run("closure")["centre_distance.mean"]
    for share, fits in ((0.99, True), (1.0005, True), (1.002, False)):
        assert run("closure", f'driven.centre_distance="{share * taut!r} m"').check("centre_distance.taut").ok is fits


def test_pins_of_each_kind_of_joint():
    assert build().pins.pin(build().link).pieces[0].radius == pytest.approx(1.2 * MM)
    assert build(*HINGE).pins.radius == pytest.approx(P / 8)
    assert build(*HINGE, 'joint.pin_diameter="3 mm"').pins.radius == pytest.approx(1.5 * MM)


def test_teeth_stand_where_they_are_told_to():
    said = ('cutter.tip_depth="1.5 mm"', 'cutter.root_depth="6.2 mm"', 'cutter.chamfer="0.1 mm"', 'cutter.tip_rounding="0.3 mm"')
    model = build(*said)
    for wheel, side in zip(model.sprockets, model.sides, strict=True):
        height = seat_height(model.link, side.teeth)
        assert height - wheel.tip_radius == pytest.approx(1.5 * MM)
        assert height - wheel.root_radius == pytest.approx(6.2 * MM)
        assert (wheel.tip_chamfer, wheel.tip_rounding) == pytest.approx((0.1 * MM, 0.3 * MM))
        assert wheel.tooth == side.tooth
        assert side.positioning_diameter == pytest.approx(side.seated_pitch / np.sin(np.pi / side.teeth), rel=1e-12)
    assert model.chain_width == pytest.approx(2.5 * MM)
    small, large = (build(*ROLLER, f"roller.tooth_space={share}").sprockets[0] for share in (0.0, 1.0))
    assert large.seat_radius > small.seat_radius
    assert build(*ROLLER, "roller.tooth_space=0.3").sprockets[0].seat_radius == pytest.approx(
        0.7 * small.seat_radius + 0.3 * large.seat_radius, rel=1e-9
    )


def test_any_matching_cutter_leaves_the_teeth_on_which_the_plates_sit():
    """Base pitch of the teeth: p cos a; their support: that of the seated plates' flanks, with no offset, to the published method's
    own error."""
    for half_angle in (20, 27, 31):
        model = build(f'cutter.half_angle="{half_angle} deg"')
        for side in model.sides:
            assert 2 * np.pi * side.tooth.base_radius / side.teeth == pytest.approx(P * np.cos(np.pi / 6), rel=1e-12)
            assert side.tooth.support == pytest.approx(seat_support(model.link, side.teeth), abs=1e-9)


def test_the_published_measures_of_each_side():
    found, model = run("meshing"), build()
    table = found.tables["equivalent_pitch"]
    seat = np.argmin(np.abs(table["turn"].data - 2 * np.pi / 23))
    assert table["turn"].data[[0, seat, -1]] == pytest.approx([0, 2 * np.pi / 23, 2.5 * np.pi / 23], rel=1e-12)
    assert table["pitch"].data[0] == pytest.approx(P, rel=1e-12)
    assert table["pitch"].data[seat] == pytest.approx(found["seated_pitch.drive"], rel=1e-12)
    assert table["ideal"].data[seat] == pytest.approx(found["ideal_pitch.drive"], rel=1e-12)
    for side, teeth in (("drive", 23), ("driven", 31)):
        base = P * np.cos(np.pi / 6) * teeth / (2 * np.pi)
        assert found[f"base_radius.{side}"] == pytest.approx(base, rel=1e-12)
        assert np.hypot(found[f"curvature_radius.{side}"], base) == pytest.approx(found[f"contact_radius.{side}"], rel=1e-12)
        assert found[f"pitch_deviation.{side}"] == pytest.approx(found[f"seated_pitch.{side}"] - found[f"ideal_pitch.{side}"], abs=1e-15)
    rack = run("meshing", 'meshing.ideal="rack"', 'joint.offset="0.3 mm"')
    for side in ("drive", "driven"):
        assert rack[f"pitch_deviation.{side}"] == pytest.approx(rack[f"seated_pitch.{side}"] - rack[f"ideal_pitch.{side}"], abs=1e-15)
    assert found["seated_apothem.driven"] == pytest.approx(model.sides[1].seated_apothem, rel=1e-15)
    assert found["seated_apothem.driven"] != pytest.approx(found["standard_apothem"], rel=1e-4)


def test_findings_tell_what_is_off():
    def words(*changes):
        return " ".join(run(("meshing", "layout"), *changes).findings)

    assert "base pitch" not in words() and "odd number" not in words() and "has more teeth" not in words()
    assert "base pitch" in words('cutter.pitch="9.6 mm"')
    assert "odd number of links" in words("links=67") and "odd number" not in words("links=67", "plate.lacing=[2, 2]")
    other = ('meshing.apothem_reference="pin"', 'plate.flank_angle="25 deg"', 'joint.offset="0.4 mm"')
    assert f"{400 * np.sin(np.radians(25)):.4g} µm off the flanks" in words(*other)
    assert not run("meshing", 'joint.offset="-1.5 mm"').check("offset").ok
    said = run("meshing", *other, "plate.apothem=", 'plate.standard_apothem="3.7 mm"')  # the flank's place does not depend on the reading
    assert said["standard_apothem"] == pytest.approx(3.7 * MM - 0.4 * MM * np.sin(np.radians(25)), rel=1e-12)


# ---------------------------------------------------------------------------------------------------------------------------- geometry


def test_teeth_are_as_thick_as_the_seated_plates_leave_room_for():
    found, model = run("geometry"), build()
    assert found.ok
    for number, (side, teeth) in enumerate((("drive", 23), ("driven", 31))):
        x, y = model.plate.contact(model.sides[number].tooth, "right")
        height = seat_height(model.link, teeth) + y
        room = 2 * np.hypot(x, height) * (2 * np.pi / teeth - np.arctan2(x, height))  # of the next tooth, which the flank touches
        assert found[f"tooth_thickness.{side}"] == pytest.approx(room, rel=1e-9)
        assert found[f"least_gap.{side}"] == pytest.approx(0, abs=5e-7)
        wheel = model.sprockets[number]
        gap, overlap = found.values[f"least_gap.{side}"], found.check(f"overlap.{side}")
        assert overlap.value == -gap.value and overlap.bounds == (-gap.high, -gap.low)
        assert gap.low < 0 < gap.high and gap.high - gap.low == pytest.approx(1e-4 * model.spec.pitch)  # seated plates touch
        assert overlap.geometry and not overlap.undecided
        assert found.check(f"contact.above_form.{side}").value == pytest.approx(np.hypot(x, height) - wheel.form_radius, abs=1e-12)
        assert found.check(f"contact.below_tip.{side}").value == pytest.approx(
            wheel.tip_radius - wheel.tip_chamfer - np.hypot(x, height), abs=1e-12
        )
        ends = sorted(point[1] for point in (model.plate.flank("right").start, model.plate.flank("right").end))
        assert found.check(f"contact.on_flank.{side}").value == pytest.approx(min(y - ends[0], ends[1] - y), abs=1e-12)
        told = [found[f"{name}_radius.{side}"] for name in ("tip", "root", "form")]
        assert told == pytest.approx([wheel.tip_radius, wheel.root_radius, wheel.form_radius])
        assert found.check(f"undercut.{side}").ok


def test_plates_and_joints_measure_up():
    found, model = run("geometry"), build()
    assert found.check("joint.turn").limit == pytest.approx(2 * np.pi / 23)
    assert found["plate.turn.forward"] >= 2 * np.pi / 23 and found["plate.turn.backward"] >= 0
    pins = 2 * np.pi * (1.2 * MM) ** 2 * model.chain_width
    sheet = found["plate.area"] * 0.5 * MM * 2.5  # two and three plates in turn
    assert found["plate.mass_per_pitch"] == pytest.approx(7850 * (sheet + pins), rel=1e-4)
    pin = run("geometry", 'cutter.measuring_pin="6 mm"')
    assert pin["measuring_pin.drive"] == pytest.approx(6 * MM)
    assert pin["over_pins.drive"] == pytest.approx(build().sprockets[0].over_pins(6 * MM), rel=1e-12)
    assert pin["over_pins.drive"] != pytest.approx(found["over_pins.drive"], rel=1e-6)


def test_a_plate_comes_to_its_seat_about_the_contact_of_its_pins():
    found, model = run("geometry"), build()
    for side, design in zip(("drive", "driven"), model.sides, strict=True):
        half, reach, turn = np.pi / design.teeth, 1.2 * MM, 1e-7
        pivot = -0.5 * model.link.hole_pitch + reach * np.exp(1j * half)
        touch, normal = complex(*model.plate.contact(design.tooth, "right")), np.exp(-1j * np.pi / 6)
        moved = (pivot + (touch - pivot) * np.exp(-1j * turn) - touch) / turn * np.conj(normal)  # along the flank's normal, and up it
        assert found[f"seating.approach.{side}"] == pytest.approx(moved.real, rel=1e-6)
        assert found[f"seating.sliding.{side}"] == pytest.approx(moved.imag, rel=1e-6)


def test_few_teeth_are_undercut():
    found = run("geometry", "teeth=[15, 31]", 'cutter.half_angle="20 deg"')
    assert not found.check("undercut.drive").ok and found.check("undercut.driven").ok


def test_the_least_gap_is_that_of_the_worst_position(monkeypatch):
    position = {}  # how often each sprocket was asked

    def gap(plate, sprocket, poses, angle, spacing, tolerance):
        teeth = sprocket.tooth.teeth
        position[teeth] = position.get(teeth, -1) + 1
        return 1e-6 * ((position[teeth] - 2) ** 2 + (teeth == 31))

    monkeypatch.setattr(interference, "min_chain_gap", gap)
    found = geometry(build(), {}).values
    assert position == {23: 5, 31: 5}
    assert (found["least_gap.drive"].value, found["least_gap.driven"].value) == pytest.approx((0.0, 1e-6))


def test_thick_teeth_are_found_to_overlap_the_plates():
    model = build()
    for number, side in enumerate(("drive", "driven")):
        sides = [
            each._replace(tooth=each.tooth._replace(support=each.tooth.support - 20e-6 * (k == number)))
            for k, each in enumerate(model.sides)
        ]
        thick = type(model)(model.spec, model.link, model.offset, model.standard_apothem, model.cutter, tuple(sides))
        found = {check.name: check for check in geometry(thick, {}).checks}
        assert found[f"overlap.{side}"].value == pytest.approx(20e-6, abs=5e-7)
        assert not found[f"overlap.{side}"].ok
        assert found[f"overlap.{('driven', 'drive')[number]}"].ok


# ------------------------------------------------------------------------------------------------------------------- forces on the pins


def test_a_pin_bends_across_its_pack():
    """Five plates of thickness t, two of the pin's own link, summed up in small steps; against them the others, or the other pin."""
    force, t, r = 200.0, 0.5 * MM, 1.2 * MM
    for changes, radius in ((HINGE, P / 8), ((), r)):
        found = run("contact", *changes, 'contact.force="200 N"')
        edges = np.arange(0, 5.0001, 0.001)
        own = (np.floor(edges[:-1]) % 2 == 1) * force / 2
        other = (np.floor(edges[:-1]) % 2 == 0) * force / 3 if changes else np.full(len(edges) - 1, force / 5)
        q = (own - other) / t
        v = np.concatenate([[0], np.cumsum(q) * 0.001 * t])
        m = np.concatenate([[0], np.cumsum(0.5 * (v[1:] + v[:-1])) * 0.001 * t])
        assert found["pin.bending_stress"] == pytest.approx(4 * np.abs(m).max() / (np.pi * radius**3), rel=1e-5)
        assert found["pin.shear_stress"] == pytest.approx(4 / 3 * np.abs(v).max() / (np.pi * radius**2), rel=1e-5)
        assert found["pin.von_mises"] >= max(found["pin.bending_stress"], np.sqrt(3) * found["pin.shear_stress"]) * (1 - 1e-12)
        assert found.check("pin.yield").value == pytest.approx(835e6 / found["pin.von_mises"], rel=1e-12)
        assert found["pin.von_mises"] > 1.001 * found["pin.bending_stress"]  # thin plates: shear decides


def test_pressure_of_a_hinge_and_limits_of_a_rolling_joint():
    hinge = run("contact", *HINGE, 'contact.force="200 N"', 'joint.pin_diameter="3 mm"')
    assert hinge["pin.bearing_pressure"] == pytest.approx(200 / (3 * MM * 1 * MM), rel=1e-12)  # in two plates of 0.5 mm
    rolling = run("contact", 'contact.force="200 N"')
    modulus = 206e9 / (2 * (1 - 0.3**2))
    pressure = np.sqrt(200 * modulus / (np.pi * 7 * MM * 0.6 * MM))  # 1/R = 2/r
    assert rolling["pin.contact_pressure"] == pytest.approx(pressure, rel=1e-12)
    assert rolling["pin.shear_depth"] == pytest.approx(0.786 * rolling["pin.half_width"], rel=1e-3)
    assert rolling["pin.shakedown_limit"] == pytest.approx(4 * 835e6 / np.sqrt(3), rel=1e-12)
    assert rolling["pin.first_yield"] == pytest.approx(1.79 * 835e6, rel=3e-3)
    assert rolling.check("pin.shakedown").value == pytest.approx(rolling["pin.shakedown_limit"] / pressure, rel=1e-12)


def test_forces_of_the_strands_by_hand():
    found, mass = run("contact", 'plate.link_mass="2 g"'), 2e-3
    speed, pull = 150 * 23 * P / (2 * np.pi), 2 * 2 * np.pi / (31 * P)
    told = [found[name] for name in ("chain.speed", "strand.centrifugal_force", "strand.tight_force", "strand.slack_force", "pin.force")]
    layout = run("layout")
    along = 80 * layout["layout.centre_distance"] / layout["layout.strand_length"]  # both strands balance the preload, aslant
    forces = [speed, mass / P * speed**2, along + pull / 2, along - pull / 2, along + pull / 2 + mass / P * speed**2]
    assert told == pytest.approx(forces, rel=1e-12)


def test_layout_by_pitch_circles():
    found = run("layout", 'plate.link_mass="2 g"')
    r1, r2, c, strand = pitch_radius(23), pitch_radius(31), found["layout.centre_distance"], found["layout.strand_length"]
    assert strand == pytest.approx(np.sqrt(c**2 - (r2 - r1) ** 2), rel=1e-12)
    lean = np.arcsin((r2 - r1) / c)
    arcs = P * (23 * (0.5 - lean / np.pi) + 31 * (0.5 + lean / np.pi))  # whole pitches around whole turns
    assert found["layout.chain_length"] == pytest.approx(66 * P, rel=1e-12)
    assert 2 * strand + arcs == pytest.approx(66 * P, rel=1e-12)
    assert (found["layout.pitch_diameter.drive"], found["layout.pitch_diameter.driven"]) == pytest.approx((2 * r1, 2 * r2))
    assert found["layout.mesh_frequency"] == pytest.approx(150 * 23 / (2 * np.pi))
    assert found["layout.meeting_velocity"] == pytest.approx(150 * P)
    speed, tight = 150 * 23 * P / (2 * np.pi), 80 * c / strand + 2 * np.pi / (31 * P)
    wave = np.sqrt(tight * P / 2e-3 + speed**2)  # the waves of a string, tension with the centrifugal force
    for mode in (1, 2):
        both_ways = strand / (wave - speed) + strand / (wave + speed)
        assert found[f"layout.strand_frequency.{mode}"] == pytest.approx(mode / both_ways, rel=1e-9)
    roller = run("layout", *ROLLER, "teeth=[22, 30]")
    for side, teeth in (("drive", 22), ("driven", 30)):
        assert roller[f"over_pins.{side}"] == pytest.approx(2 * pitch_radius(teeth) + 6.35 * MM, rel=1e-12)


# --------------------------------------------------------------------------------------------------------------------- beside each other


def test_comparisons_take_the_design_as_it_is():
    found = run("trade_off", 'closure.strands="straight"', 'contact.force="300 N"', 'compare.rolling_radii=["2 mm"]').tables["trade_off"]
    own = run("closure", 'closure.strands="straight"', 'joint.rolling_radius="2 mm"')
    hinge = run("closure", 'closure.strands="straight"', *HINGE)
    assert found["transmission_error"].data[0] == pytest.approx(own["transmission_error"], rel=1e-3)
    assert found["fluctuation"].data[0] == pytest.approx(own["centre_distance.fluctuation"], rel=1e-3)
    assert found["running_deviation"].data[0] == pytest.approx(own["centre_distance.mean"] - hinge["centre_distance.mean"], rel=1e-4)
    chosen = run("trade_off").tables["trade_off"]["rolling_radius"].data
    assert np.any(np.isclose(chosen, 1.2 * MM)) and np.all(np.diff(chosen) > 0) and chosen[0] > 0
    other = run("meshing", 'joint.rolling_radius="2 mm"', 'joint.offset="minimax"')
    both = run("trade_off", 'joint.offset="minimax"', 'compare.rolling_radii=["2 mm"]').tables["trade_off"]
    for side in ("drive", "driven"):
        assert both[f"pitch_deviation_{side}"].data[0] == pytest.approx(other[f"pitch_deviation.{side}"], rel=1e-9)


def test_a_phase_map_looks_four_links_to_either_side():
    answer = run("phase_map")
    table = answer.tables["phase_map"]
    assert sorted(set(table["links"].data)) == list(range(62, 71))
    assert sorted(set(table["rolling_radius"].data)) == pytest.approx([0, 1.2 * MM, 0.78 * P])
    rows = phase_map(
        [
            Drive(design_link(P, r, 0.5, 0.0), 23, 31, int(n))
            for r, n in zip(table["rolling_radius"].data, table["links"].data, strict=True)
        ],
        24,
    ).rows
    assert table["transmission_error"].data == pytest.approx([row.value.transmission_ripple for row in rows], rel=1e-12)
    best = np.argmin(table["fluctuation"].data)
    assert answer["phase_map.least_fluctuation"] == table["fluctuation"].data[best]
    assert f"{table['links'].data[best]:.0f} links" in answer.values["phase_map.least_fluctuation"].meaning
    assert not any("do not close" in finding for finding in answer.findings)
    short = run("phase_map", "compare.links=[30, 66]", 'compare.rolling_radii=["1.2 mm"]')
    assert any("1 of 2 chains do not close" in finding for finding in short.findings)
    assert short["phase_map.least_fluctuation"] == short.tables["phase_map"]["fluctuation"].data[1]


# ------------------------------------------------------------------------------------------------------------------- as a moving system


def test_links_weigh_what_their_steel_weighs():
    light, heavy = build().link_mass, build('material.density="15700 kg/m^3"').link_mass
    assert heavy.mass / light.mass == pytest.approx(2, rel=1e-12) and heavy.inertia / light.inertia == pytest.approx(2, rel=1e-12)
    assert light.mass == pytest.approx(run("geometry")["plate.mass_per_pitch"], rel=1e-12)
    said = build('plate.link_mass="5 g"').link_mass
    assert said.mass == pytest.approx(5e-3) and said.inertia / 5e-3 == pytest.approx(light.inertia / light.mass, rel=1e-12)
    assert build('plate.link_inertia="7e-8 kg m^2"').link_mass.inertia == pytest.approx(7e-8)
    rough = build(*ROLLER).link_mass
    bars = 7850 * 0.5 * 9 * MM * P**2  # half of the width over four plates of 0.5 mm and the bush is full of a pitch squared
    assert rough.mass == pytest.approx(bars, rel=1e-12)
    assert rough.inertia == pytest.approx(bars * ((1.86 * P) ** 2 + (0.95 * P) ** 2) / 12, rel=1e-12)


def test_the_chain_and_its_contacts_as_they_are_told():
    model = build('contact.stiffness="6e4 N/mm"', 'contact.joint_damping="3 us"', "closure.elongation=0.002")
    system, drawn = chain_drive(model), model.link_mass
    chain, touch = system.chain, system.sprockets[0].contact
    assert (touch.stiffness, touch.damping) == pytest.approx((6e7, 180.0))
    assert (chain.joint_stiffness, chain.joint_damping) == pytest.approx((2e7, 3e-6))
    assert chain_drive(build('contact.damping="50 N s/m"')).sprockets[1].contact.damping == 50.0
    force = run("contact", 'contact.stiffness="6e4 N/mm"')["pin.force"]  # rocking on two joints: stiffness T A, dampers 2 c
    critical = np.sqrt(force * (P + 2.4 * MM) * drawn.inertia)
    assert chain.articulation_damping == pytest.approx(0.003 * critical, rel=1e-9)
    for ratio in (0.0, 0.1):
        damping = chain_drive(
            build(f"contact.articulation_damping_ratio={ratio}", 'contact.stiffness="6e4 N/mm"')
        ).chain.articulation_damping
        assert damping == pytest.approx(ratio * critical, rel=1e-9)
    hinge = build('joint.kind="revolute"', 'plate.link_mass="2 g"', 'plate.link_inertia="5e-8 kg m^2"')
    force = run("contact", 'joint.kind="revolute"', 'plate.link_mass="2 g"')["pin.force"]
    assert chain_drive(hinge).chain.articulation_damping == pytest.approx(0.02 * np.sqrt(force * P * 5e-8), rel=1e-9)
    assert (chain.count, chain.mass, chain.inertia, chain.centre_offset) == (66, drawn.mass, drawn.inertia, drawn.height)
    assert np.mean(chain.hole_pitches) == pytest.approx(P * 1.002 + 2.4 * MM, rel=1e-12)
    ends = sorted(-point[1] for point in (model.plate.flank("left").start, model.plate.flank("left").end))
    assert (chain.crotch, chain.toe) == pytest.approx(ends)


def test_the_driven_sprocket_feels_its_load_alone_at_the_nominal_speed():
    model = build("driven.damping_ratio=0.2")
    driver, driven = chain_drive(model).sprockets
    assert (driver.drive.speed, driver.drive.start, driver.drive.ramp) == (-150.0, -150.0, 0.0)
    assert (driven.torque, driven.reference_speed) == pytest.approx((2.0, -150 * 23 / 31), rel=1e-12)
    width, radius, bore = 2.5 * MM, pitch_radius(31), 9 * MM
    mass = 7850 * width * np.pi * (radius**2 - bore**2)
    assert driven.mass == pytest.approx(mass, rel=1e-12)
    assert driven.inertia == pytest.approx(7850 * width * np.pi / 2 * (radius**4 - bore**4), rel=1e-12)
    free = 0.5 * (66 - np.mean(np.sum(model.closure.states.seated, axis=1)))  # plates of a strand, with a joint more
    stiffness = 2 * (1e8 / 3) / (free + 1)
    assert free == pytest.approx(model.closure.mean / P, abs=3.0)
    assert driven.slide.damping == pytest.approx(2 * 0.2 * np.sqrt(stiffness * mass), rel=1e-12)
    assert driven.damping == pytest.approx(2 * 0.2 * np.sqrt(stiffness * radius**2 * driven.inertia), rel=1e-12)
    assert (driven.slide.direction, driven.slide.force) == (0.0, 160.0)
    assert driven.centre == (model.closure.mean, 0.0)
    assert chain_drive(build('drive.gravity=["1 m/s^2", "-9.81 m/s^2"]')).gravity == (1.0, -9.81)
    ramped = chain_drive(build('drive.ramp="10 ms"')).sprockets
    assert (ramped[0].drive.start, ramped[0].drive.ramp, ramped[1].damping, ramped[1].torque) == (0.0, 0.01, 0.0, 2.0)
    fixed = chain_drive(build('driven.centre_distance="180 mm"')).sprockets[1]
    assert fixed.slide is None and fixed.centre == pytest.approx((0.18, 0.0))


def test_teeth_of_the_moving_system():
    model = build('dynamics.thickness_deviation="5 um"')
    for number, each in enumerate(chain_drive(model).sprockets):
        wheel = model.sprockets[number]
        assert each.tooth.support == pytest.approx(model.sides[number].tooth.support - 5e-6, rel=1e-12)
        assert (each.tip_radius, each.form_radius) == pytest.approx((wheel.tip_radius - wheel.tip_chamfer, wheel.form_radius))
    for each, teeth in zip(chain_drive(build(*ROLLER)).sprockets, (23, 31), strict=True):
        assert each.tooth.roller_radius == pytest.approx(3.175 * MM)
        assert each.tooth.pitch_radius == pytest.approx(pitch_radius(teeth))


def test_further_sprockets_and_guides():
    changes = (
        'sprockets=[{name="idler", teeth=19, centre=["90 mm", "15 mm"], load_torque="0.5 N m"}]',
        'guides=[{name="rail", centre=["90 mm", "-330 mm"], radius="290 mm", start="80 deg", end="100 deg"}, '
        '{name="shoe", centre=["90 mm", "330 mm"], radius="290 mm", start="260 deg", end="280 deg", side="inside", force="30 N", '
        'direction="-80 deg", stiffness="2 N/mm", damping="7 N s/m", mass="40 g"}]',
    )
    model = build(*changes)
    system, radius = bare_drive(model), pitch_radius(19)
    idler = system.sprockets[2]
    assert idler.mass == pytest.approx(7850 * 2.5 * MM * np.pi * (radius**2 - (9 * MM) ** 2), rel=1e-12)
    assert idler.inertia == pytest.approx(0.5 * idler.mass * (radius**2 + (9 * MM) ** 2), rel=1e-12)  # a ring
    assert (idler.torque, idler.centre) == (0.5, pytest.approx((0.09, 0.015)))
    assert idler.tooth.support == pytest.approx(seat_support(model.link, 19), rel=1e-12)
    rail, shoe = system.guides
    assert (rail.distance, shoe.distance) == pytest.approx((model.plate.back, -model.plate.toe))
    assert rail.slide is None
    slide = shoe.slide
    assert (slide.direction, slide.force, slide.stiffness, slide.damping) == pytest.approx((np.radians(-80), 30, 2e3, 7))


# ------------------------------------------------------------------------------------------------------------------------ on the screen


def reach(outline, angle):
    """Distance of an outline from the origin in one direction."""
    points = outline.points(1e-6)
    return np.hypot(*points.T)[np.argmin(np.abs(np.angle(np.exp(1j * (np.arctan2(*points.T[::-1]) - angle)))))]


@pytest.mark.parametrize("changes", [(), ROLLER], ids=["plates", "rollers"])
def test_the_chain_lies_on_its_teeth_on_the_screen(changes):
    kind, model = registry.mechanism("silent-chain"), build(*changes)
    scene = kind.scene(model)
    bodies = {body.name: body for body in scene.bodies}
    assert scene.cycle[[0, -1]] == pytest.approx([0, 4 * np.pi / 23])
    drive, driven = bodies["drive"], bodies["driven"]
    assert drive.poses[-1] == pytest.approx([0, 0, -4 * np.pi / 23])
    assert driven.poses[-1, 2] - driven.poses[0, 2] == pytest.approx(-4 * np.pi / 31, abs=1e-12)
    for wheel, design, teeth in zip((drive, driven), model.sprockets, model.teeth, strict=True):
        outline = next(shape.outline for shape in wheel.shapes if shape.layer == "body")
        assert reach(outline, 0.0) == pytest.approx(design.tip_radius, rel=1e-4)  # tooth 0 lies on x
        assert reach(outline, np.pi / teeth) == pytest.approx(design.root_radius, rel=2e-3)
        hole = next(shape.outline for shape in wheel.shapes if shape.layer == "hole")
        assert reach(hole, 0.3) == pytest.approx(9 * MM, rel=1e-6)
        seated = 0
        for number in range(66):  # plates stand astride of teeth
            at = bodies[f"link{number}"].poses - wheel.poses * np.array([1, 1, 0])
            if np.allclose(np.hypot(at[:, 0], at[:, 1]), seat_height(model.link, teeth), rtol=0, atol=1e-9):
                tooth = (np.arctan2(at[:, 1], at[:, 0]) - wheel.poses[:, 2]) * teeth / (2 * np.pi)
                assert np.abs(tooth - np.round(tooth)).max() < 1e-6
                seated += 1
        assert seated > 6
    layers = [[shape.layer for shape in bodies[name].shapes].count("hole") for name in ("link0", "link1")]
    assert layers == ([0, 0] if changes else [2, 0])
    parts = {part.name: part for part in kind.parts(model)}
    assert sum(name.startswith("link") for name in parts) >= 2  # both kinds
    for name in ("drive", "driven"):
        part, body = parts[name], bodies[name]
        assert part.pose[:2] == pytest.approx(body.poses[0, :2], abs=1e-12)
        for shift, radius in ((0.0, "tip_radius"), (0.5, "root_radius")):
            number = int(name == "driven")
            design, direction = model.sprockets[number], body.poses[0, 2] + shift * 2 * np.pi / model.teeth[number]
            assert reach(part.solids[0].outline, direction - part.pose[2]) == pytest.approx(getattr(design, radius), rel=2e-3)


def test_plates_and_rollers_of_a_roller_chain_stand_side_by_side():
    model = build(*ROLLER)
    parts = [part for part in registry.mechanism("silent-chain").parts(model) if part.name.startswith("link")]
    width, sheet = model.contact_length, 0.5 * MM
    for number, part in enumerate(parts[:2]):
        heights = sorted((solid.z, solid.z + solid.thickness) for solid in part.solids)
        out = 0.5 * width + number * sheet
        assert np.array(heights) == pytest.approx(np.array([(-out - sheet, -out), (-width / 2, width / 2), (out, out + sheet)]))
    roller = next(shape.outline for shape in link_shapes(model)[0] if shape.layer == "roller").points(1e-7)
    assert (roller.min(axis=0) + roller.max(axis=0)) / 2 == pytest.approx([P / 2, 0], abs=1e-7)


# ------------------------------------------------------------------------------------------------------------------ many runs and stress


def known(value, settled=True):
    """An estimate."""
    return Estimate(value, value - 0.5, value + 0.25, "ensemble", settled, 8.0)


def test_the_campbell_diagram_s_rows(monkeypatch):
    asked = []

    def campbell(system, speeds, revolutions, settings, members):
        asked.extend(speeds)
        assert (revolutions, members) == (2, 4)
        frequency = np.arange(9.0)
        level = lambda w: SimpleNamespace(  # noqa: E731
            mean=known(1.0),
            fluctuation=known(2.0, settled=w > -100),
            tension=known(4.0),
            frequency=frequency,
            amplitudes=tuple(known(k * w) for k in (1, 2, 3)),
            spectrum=np.array([9.0, 1, 5, 1, 7, 1, 6, 2, 8]),
            signal=SIGNAL,
        )
        return SimpleNamespace(rows=[SimpleNamespace(case=w, value=level(w), ok=True) for w in speeds], failed=())

    monkeypatch.setattr(many, "campbell", campbell)
    answer = many.speeds(build(), {})
    table, diagram = answer.tables
    assert asked == pytest.approx(-150 * 1.5 * np.arange(1, 13) / 12)
    columns = {column.name: column.data for column in (*table.columns, *diagram.columns)}
    assert columns["speed"] == pytest.approx(-np.array(asked))
    assert columns["mesh_order_3"] == pytest.approx(3 * np.array(asked))
    for name, value in (("fluctuation", 2.0), ("tension", 4.0)):
        assert columns[f"{name}.low"] == pytest.approx([value - 0.5] * 12)
        assert columns[f"{name}.high"] == pytest.approx([value + 0.25] * 12)
    assert "1970 rpm" in answer.findings[0] and " 895" not in answer.findings[0]
    assert columns["mesh_frequency"] == pytest.approx(columns["speed"] * 23 / (2 * np.pi))
    peaks = [columns[f"peak_{k}"][0] for k in range(1, 5)]
    assert peaks == pytest.approx([4, 6, 2, np.nan], nan_ok=True)  # highest first; ends are no peaks


def test_percentiles_and_rest_are_told_as_they_were_found(monkeypatch):
    asked = {}

    def monte_carlo(system, scatter, samples, duration, settings, percentiles, seed):
        asked.update(scatter=scatter, duration=duration)
        ends = np.array([[0.0], [-0.5], [0.25]])
        return SimpleNamespace(
            mean=ends + [1.0, 2.0, 3.0], fluctuation=ends + [4.0, 5.0, np.inf], outcomes=SimpleNamespace(rows=[row], failed=())
        )

    row = SimpleNamespace(value=SimpleNamespace(mean=known(7.0), fluctuation=known(8.0), signal=SIGNAL), ok=True)
    monkeypatch.setattr(many, "monte_carlo", monte_carlo)
    model = build('scatter.tooth_thickness="3 um"', 'scatter.pitch="1 um"', 'dynamics.settling="20 ms"')
    answer = many.scatter(model, {})
    values, drives = answer.values, {column.name: column.data[0] for column in answer.tables[0].columns}
    assert (asked["scatter"].tooth_thickness, asked["scatter"].pitch) == pytest.approx((3e-6, 1e-6))
    assert asked["duration"] == pytest.approx(0.02 + 2 * 66 * 2 * np.pi / (23 * 150), rel=1e-12)  # every plate twice around
    assert [values[f"scatter.{name}.p{p:02d}"].value for name in ("mean", "fluctuation") for p in (5, 50)] == [1, 2, 4, 5]
    assert values["scatter.mean.p50"][3:6] == (1.5, 2.25, "sample")
    assert (drives["mean.low"], drives["fluctuation"], drives["fluctuation.high"]) == (6.5, 8.0, 8.25)

    rest = SimpleNamespace(
        mean=1.0,
        fluctuation=2.0,
        flank_force=np.arange(12.0).reshape(2, 3, 2),
        driver_angle=np.array([0.1, -0.1]),
        centre_distance=np.ones(2),
        contacts=np.ones(2),
        tension=np.arange(6.0).reshape(2, 3),
        transmission_error=lambda sprocket: np.array([2.0, -1.5]) * sprocket,
    )
    monkeypatch.setattr(many, "equilibrium", lambda *given: rest)
    monkeypatch.setattr(many, "compliance_of", lambda *given: SimpleNamespace(rigid_mean=7.0))
    answer = many.quasi_static(model, {})
    told = [answer.values[f"quasi_static.{name}"].value for name in ("transmission_error", "flank_force.maximum", "centre_distance.rigid")]
    assert told == pytest.approx([3.5, 11.0, 7.0])
    assert answer.tables[0].columns[0].data == pytest.approx([0, 0.2])


def made_up(model, member):
    """A run of two settling samples and two revolutions of made-up signals; the numbers of the members differ."""
    system, per_tooth = chain_drive(model), 24
    n = 2 + 2 * 66 * per_tooth + 1
    t = np.arange(n) * tooth_time(system) / per_tooth
    rows, bodies = np.ones((n, len(ROW))), np.zeros((n, 2, len(BODY)))
    wave = (1 + 0.01 * member) * np.sin(2 * np.pi * t / tooth_time(system))
    rows[:, ROW.index("t")], rows[:, ROW.index("utilisation")], rows[:, ROW.index("contacts")] = t, 0.2 + 0.1 * np.abs(wave), 20.0
    for name in (*LOSSES, "open joints"):
        rows[:, ROW.index(name)] = 0.0
    rows[-1, ROW.index("drive")] = -1e-5 * (1 + member)  # J of 2 J that are stored
    bodies[:, 1, BODY.index("q")] = 1e-4 + 3e-6 * wave
    bodies[:, 1, BODY.index("psi")] = 5e-6 * wave
    plate = np.zeros((n, len(PLATE)))
    plate[:, PLATE.index("left flank")], plate[:, PLATE.index("right flank")] = 40 + wave, 50 + 2 * wave
    settings = Settings(settle=t[2], tolerance=model.spec.dynamics.largest_drift)
    return Motion(system, settings, 1e-6, 1, rows, bodies, 90 + 4 * wave[:, None], plate)


def test_the_running_chain_s_numbers(monkeypatch):
    """A made-up ensemble of sines at the mesh frequency: its statistics leave out the first samples, and are those of revolutions."""
    model, asked = build('dynamics.settling="20 ms"', "dynamics.ensemble=6"), {}

    def made(system, duration, settings, members, solve):
        asked.update(duration=duration, settle=settings.settle, members=members, solve=solve)
        return Ensemble(tuple(made_up(model, member) for member in range(6)))

    monkeypatch.setattr(dynamics, "ensemble", made)
    answer = dynamics.dynamics(model, {})
    value = {name.removeprefix("dynamics."): each for name, each in answer.values.items()}
    number = {name: each.value for name, each in value.items()}
    mesh = 23 * 150 / (2 * np.pi)
    assert (asked["settle"], asked["duration"], asked["members"]) == pytest.approx((0.02, 0.02 + 2 * 66 / mesh, 6))
    assert asked["solve"] is dynamics.simulate
    assert number["mesh_frequency"] == pytest.approx(mesh)
    assert number["centre_distance.mean"] == pytest.approx(model.closure.mean + 1e-4, abs=1e-12)
    assert number["centre_distance.mesh_order_amplitude"] == pytest.approx(3.075e-6, rel=2e-5)
    for name in ("fluctuation", "range"):
        found, reach = value[f"centre_distance.{name}"], 2.570582 * 0.1122497e-6 / np.sqrt(6)  # Student's t, five degrees
        assert found.value == pytest.approx(6.15e-6, rel=1e-9)
        assert found.interval == "ensemble"
    assert value["centre_distance.range"].high - 6.15e-6 == pytest.approx(reach, rel=1e-5)
    assert value["centre_distance.fluctuation"].settled and answer.checks[-1].name == "settled" and answer.checks[-1].ok
    assert (number["tension.mean"], number["tension.maximum"]) == pytest.approx((90.0, 94.1))
    assert number["transmission_error"] == pytest.approx(10.25e-6)
    assert (number["flank_force.maximum"], number["friction_utilisation"]) == pytest.approx((52.05, 0.3025))
    assert number["energy_drift"] == pytest.approx(6e-5 / 2 / answer.data.first.t[-1])  # the worst of the members
    running, spectrum = ({column.name: column.data for column in table.columns} for table in answer.tables)
    assert len(running["time"]) == 2 * 66 * 24 + 1 and running["plate.right_flank"][4] == pytest.approx(52.0)
    at = np.flatnonzero(np.isclose(spectrum["order"], 1.0))[0]
    assert spectrum["order"][-1] == 8 and spectrum["frequency"] == pytest.approx(spectrum["order"] * mesh)
    assert spectrum["centre_distance"][at] == pytest.approx(3.075e-6, rel=2e-5)
    assert spectrum["centre_distance.high"][at] - 3.075e-6 == pytest.approx(2.570582 * 0.05612486e-6 / np.sqrt(6), rel=1e-3)
    assert answer.findings == () and len(answer.warnings) == 1
    assert "a coefficient of friction of 0.3 (dynamics.friction_utilisation)" in answer.warnings[0]


def test_pins_are_said_to_slip_above_the_friction_of_dry_steel():
    def warnings(needed):
        return [*dynamics._slipping({"dynamics.friction_utilisation": Value(needed, "-", "")})]

    assert warnings(0.3) == [] and [*dynamics._slipping({})] == []
    assert "of 2.2 " in warnings(2.2)[0] and "0.1 lubricated and 0.3 dry" in warnings(2.2)[0]


@pytest.mark.parametrize(("drifting", "value", "ok"), [((), 2, True), (("mean",), 1, False), (("mean", "fluctuation"), 0, False)])
def test_the_check_settled_counts_what_has_settled(drifting, value, ok):
    names = ("mean", "fluctuation", "range")
    values = {f"dynamics.centre_distance.{name}": Value(1.0, "m", "", settled=name not in (*drifting, "range")) for name in names}
    check = dynamics.settled(values)
    assert (check.value, check.sense, check.limit, check.ok) == (value, ">=", 2, ok)
    assert check.display_label == "Settled statistics, centre distance" and "number of settled statistics" in check.message


def test_the_life_of_a_plate_in_revolutions_and_seconds(monkeypatch):
    model = build()
    lives = SimpleNamespace(
        rows=np.array([2, 0, 1]), life=np.array([1e7, np.inf, 1e5]), damage=np.array([1e-7, 0, 1e-5]), stress=np.ones(3)
    )
    rim = SimpleNamespace(points=np.array([[0.0, 0.0], [1.0, 2.0], [3.0, 5.0]]))
    turn = SimpleNamespace(loads=Loads(np.ones((3, 2, 2)), np.ones((3, 2)), np.ones((3, 2))), whole=True, time=np.array([0.5, 0.6, 0.75]))
    found = (SimpleNamespace(body=SimpleNamespace(rim=rim)), turn)
    monkeypatch.setattr(stress, "plate_life", lambda *given: lives)
    answer = stress.life(model, {"stress": SimpleNamespace(data=found)})
    assert (answer.values["plate.life"].value, answer.values["plate.life.time"].value) == pytest.approx((1e5, 0.25e5))
    picture = {column.name: column.data.reshape(2, 6) for column in answer.tables[1].columns}
    assert picture["life"] == pytest.approx(np.array([[1e7] * 6, [1e5] * 6]))
    assert picture["x"].mean(axis=1) == pytest.approx([3, 1], abs=1e-12) and picture["y"].mean(axis=1) == pytest.approx([5, 2], abs=1e-12)


def test_safety_of_a_plate_is_its_yield_strength_over_its_stress(monkeypatch):
    model = build("limits.yield_safety=1.2")
    peak = SimpleNamespace(stress=400e6, row=0, instant=1, place=(1e-3, -2e-3))
    loads = SimpleNamespace(pins=np.array([[[3.0, 4.0], [6.0, 8.0]]] * 2), flanks=np.array([[1.0, 2.0]] * 2))
    revolution = SimpleNamespace(loads=loads, time=np.array([0.0, 1.0]))
    for name, result in (
        ("plane_basis", None),
        ("plate_revolution", revolution),
        ("worst", peak),
        ("stress_history", np.ones((2, 1, 3))),
        ("stress_picture", None),
    ):
        monkeypatch.setattr(stress, name, lambda *given, result=result: result)
    answer = stress.stress(model, {"dynamics": SimpleNamespace(data=SimpleNamespace(first=None))})
    assert answer.checks[0].value == pytest.approx(835 / 400) and answer.checks[0].limit == 1.2
    columns = {column.name: column.data[0] for column in answer.tables[0].columns}
    assert [columns[name] for name in ("left_pin", "right_pin", "left_flank", "right_flank")] == pytest.approx([5, 10, 1, 2])


def test_an_open_joint_loads_no_plate():
    pins = np.array([[[-5.0, 0.0], [5.0, 0.0]], [[5.0, 1.0], [-5.0, 1.0]], [[-0.1, 5.0], [0.1, 5.0]], [[0.5, 5.0], [-0.5, 5.0]]])
    assert open_seats(pins).tolist() == [[False, False], [True, True], [False, False], [False, False]]


def revolution(count, model):
    """A `PlateRevolution` over a made-up run of so many samples, a ramp in every column."""
    names = ("left x", "left y", "right x", "right y", "left flank", "right flank")
    ramps = {name: (np.arange(count) + 1.0) * (k + 1) * (-1 if name == "left x" else 1) for k, name in enumerate(names)}
    ramps["x"] = np.linspace(-0.01, 1.2 * model.closure.mean, count)
    motion = SimpleNamespace(
        column=ramps.__getitem__,
        t=0.5 * np.arange(count),
        per_tooth=2,
        steady=slice(5, count - 3),
        model=SimpleNamespace(chain=SimpleNamespace(count=model.spec.links)),
    )
    return stress.plate_revolution(model, motion), ramps


def test_one_plate_bears_its_share_of_a_revolution():
    model = build("links=40", "teeth=[11, 13]")
    found, ramps = revolution(200, model)
    rows = slice(116, 197)  # forty pitches of two samples and the first once more, up to the end of the steady part
    assert (found.rows.start, found.rows.stop) == (rows.start, rows.stop)
    assert found.time[-1] - found.time[0] == pytest.approx(40 * 2 * 0.5)
    assert found.loads.pins[:, 0, 0] == pytest.approx(ramps["left x"][rows] / 2)  # two of two and three plates carry the most
    assert found.loads.pins[:, 0, 1] == pytest.approx(ramps["left y"][rows] / 2)
    assert found.loads.pins[:, 1, 1] == pytest.approx(ramps["right y"][rows] / 2)
    assert found.loads.flanks == pytest.approx(np.stack([ramps["left flank"], ramps["right flank"]], axis=1)[rows] / 2)
    at = [model.plate.contact(side.tooth, "right")[1] for side in model.sides]
    assert found.loads.heights[[0, -1], 0] == pytest.approx([at[int(ramps["x"][k] > model.closure.mean / 2)] for k in (116, 196)])
    assert at[0] != pytest.approx(at[1], rel=1e-3)


def test_fewer_instants_keep_the_greatest_and_the_least():
    found, _ = revolution(3000, build("links=1400", "teeth=[11, 13]"))
    assert len(found.loads.flanks) == 2801
    thin = fewer_instants(found.loads, 500)
    assert 250 < len(thin.flanks) <= 500
    size = found.loads.flanks.sum(axis=1)
    kept = thin.flanks.sum(axis=1)
    assert (kept.max(), kept.min()) == (size.max(), size.min())
