"""Properties of the kind `shaft` that hold exactly: mirror, units, limits, balance, and the same by other routes."""

import copy

import numpy as np
import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright import bearings, registry, scene
from drivewright.mechanisms.shaft.build import tooth_load
from drivewright.mechanisms.shaft.designs import batch
from drivewright.oracles.shaft import moment_integrals
from drivewright.shafts.scenes import exaggeration

pytestmark = pytest.mark.property

STEPPED = {
    "segments": [
        {"length": "90 mm", "diameter": "25 mm", "bore": "8 mm"},
        {"length": "120 mm", "diameter": "30 mm", "end_diameter": "40 mm"},
        {"length": "110 mm", "diameter": "28 mm"},
    ],
    "bearings": [
        {"name": "A", "position": "40 mm", "radial_stiffness": "4e7 N/m"},
        {"name": "B", "position": "170 mm", "radial_stiffness": "9e7 N/m"},
        {"name": "C", "position": "290 mm", "radial_stiffness": "2e7 N/m", "tilt_stiffness": "4e3 N m/rad"},
    ],
    "stations": [{"name": "p", "position": "0 mm", "mass": "2 kg"}, {"name": "q", "position": "230 mm", "mass": "5 kg"}],
    "loads": [{"station": "p", "force": "700 N"}, {"position": "120 mm", "force": "300 N", "angle": "20 deg"}],
}
BALLS = {"balls": 12, "ball_diameter": "3.572 mm", "pitch_diameter": "26 mm", "youngs_modulus": "206 GPa"}


def shaft(**changes):
    return dw.Shaft(**(copy.deepcopy(STEPPED) | changes))


def on_balls(free=(), **changes):
    """The pressure-roller shaft on two deep-groove bearings."""
    tables = {
        "segments": [{"length": "340 mm", "diameter": "20 mm"}],
        "bearings": [{"name": n, "position": z, "geometry": BALLS, "free": list(free)} for n, z in (("A", "56.5 mm"), ("B", "136.5 mm"))],
        "stations": [{"name": "m2", "position": "245 mm"}],
        "loads": [{"station": "m2", "force": "500 N"}],
    }
    return dw.Shaft(**(tables | changes))


# -- symmetry, units, limits ---------------------------------------------------------------------------------------------------


def test_a_mirrored_shaft_has_the_mirrored_answer():
    ours = dw.run(shaft())
    turned = copy.deepcopy(STEPPED)
    turned["segments"] = [dict(s) for s in reversed(turned["segments"])]
    turned["segments"][1] |= {"diameter": "40 mm", "end_diameter": "30 mm"}
    for entry in (*turned["bearings"], *turned["stations"]):
        entry["position"] = f"{320 - float(entry['position'].split()[0])} mm"
    turned["loads"][1]["position"] = "200 mm"
    theirs = dw.run(dw.Shaft(**turned))
    assert theirs.arrays["flexibility"].values == pytest.approx(ours.arrays["flexibility"].values, rel=1e-9)
    for name in (
        "stations.p.deflection_x",
        "stations.q.deflection",
        "bearings.B.reaction_y",
        "modes.2.frequency",
        "critical_speeds.forward.1",
    ):
        assert theirs[name] == pytest.approx(ours[name], rel=1e-7)
    assert theirs["stations.q.slope"] == pytest.approx(-ours["stations.q.slope"], rel=1e-9)


def test_other_units_change_nothing():
    inches = copy.deepcopy(STEPPED)
    for segment in inches["segments"]:
        segment["length"] = f"{float(segment['length'].split()[0]) / 25.4} in"
    inches["bearings"][0]["radial_stiffness"] = "40 N/um"
    assert dw.run(dw.Shaft(**inches))["stations.p.deflection"] == pytest.approx(dw.run(shaft())["stations.p.deflection"], rel=1e-12)


def test_stiffer_bearings_approach_rigid_ones_at_first_order():
    def delta(stiffness):
        tables = copy.deepcopy(STEPPED)
        for bearing in tables["bearings"]:
            bearing["radial_stiffness"] = stiffness
        return dw.run(dw.Shaft(**tables), only=("flexibility",)).arrays["flexibility"].values

    rigid = delta("rigid")
    errors = [np.abs(delta(f"{k} N/m") - rigid).max() for k in (1e10, 1e11)]
    assert np.log10(errors[0] / errors[1]) == pytest.approx(1.0, abs=0.02)


def test_rescaling_lengths_loads_and_stiffness_leaves_pure_numbers_alone():
    """All lengths times 2, springs times 2 (a modulus times a length), forces times 4: strains, and shares of a flexibility, stay."""

    def scaled(s):
        tables = copy.deepcopy(STEPPED)

        def times(text, factor):
            number, unit = text.split(maxsplit=1)
            return f"{float(number) * factor} {unit}"

        for entry in (*tables["segments"], *tables["bearings"], *tables["stations"], *tables["loads"]):
            for key, power in (
                ("length", 1),
                ("diameter", 1),
                ("end_diameter", 1),
                ("bore", 1),
                ("position", 1),
                ("radial_stiffness", 1),
                ("tilt_stiffness", 3),
                ("force", 2),
            ):
                if key in entry:
                    entry[key] = times(entry[key], s**power)
        return dw.run(dw.Shaft(**tables))

    one, two = scaled(1), scaled(2)
    shares = [r.arrays["flexibility.shares"].values / r.arrays["flexibility"].values for r in (one, two)]
    assert shares[0] == pytest.approx(shares[1], rel=1e-9, abs=1e-12)
    assert two["stations.p.deflection"] == pytest.approx(2 * one["stations.p.deflection"], rel=1e-9)
    assert two["shaft.max_stress"] == pytest.approx(one["shaft.max_stress"], rel=1e-7)
    for name in ("sensitivity.p.q.bearings.A.stiffness", "sensitivity.p.p.distance.p-A"):
        assert two[name] == pytest.approx(one[name], rel=1e-6, abs=1e-9)


def test_sensitivities_of_a_homogeneous_function_add_up():
    """Bearings and modulus: -1 (delta is homogeneous of degree -1 in them).  All lengths and diameters with rigid bearings: -1 too."""
    stiff = copy.deepcopy(STEPPED)
    for bearing in stiff["bearings"]:
        bearing["radial_stiffness"] = "rigid"
    stiff["bearings"][2].pop("tilt_stiffness")
    stiff["segments"][0].pop("bore")
    soft, rigid = dw.run(shaft()), dw.run(dw.Shaft(**stiff))
    for pair in ("p.p", "p.q", "q.q"):
        assert soft[f"sensitivity.{pair}.youngs_modulus"] + soft[f"sensitivity.{pair}.bearings.stiffness"] == pytest.approx(-1, abs=1e-7)
        each = [soft[f"sensitivity.{pair}.bearings.{name}.stiffness"] for name in "ABC"]
        assert sum(each) == pytest.approx(soft[f"sensitivity.{pair}.bearings.stiffness"], abs=1e-7)
        total = sum(
            v.value for k, v in rigid.values.items() if k.startswith(f"sensitivity.{pair}.") and ("distance." in k or "diameter" in k)
        )
        assert total == pytest.approx(-1, abs=1e-6)


def test_shares_and_reactions_are_arrays_with_names():
    result = dw.run(shaft())
    shares = result.arrays["flexibility.shares"]
    assert shares.axes == ("part", "station", "station") and shares.labels[0] == ("bending", "shear", "A", "B", "C")
    assert shares.values.sum(axis=0) == pytest.approx(result.arrays["flexibility"].values, rel=1e-9)
    unit = result.arrays["reactions.unit_load"]
    assert unit.axes == ("bearing", "station") and unit.values.sum(axis=0) == pytest.approx([1.0, 1.0], abs=1e-9)
    assert result.arrays["stiffness"].values @ result.arrays["flexibility"].values == pytest.approx(np.eye(2), abs=1e-9)


def test_deflections_are_flexibility_times_load():
    tables = copy.deepcopy(STEPPED)
    tables["loads"] = [{"station": "p", "force": "700 N"}, {"station": "q", "force": "-200 N"}]
    result = dw.run(dw.Shaft(**tables))
    wanted = result.arrays["flexibility"].values @ [700.0, -200.0]
    assert [result["stations.p.deflection"], result["stations.q.deflection"]] == pytest.approx(wanted, rel=1e-9)


# -- other routes --------------------------------------------------------------------------------------------------------------


@pytest.mark.needs_fe
@pytest.mark.parametrize(
    "name",
    [
        "pressure_roller_shaft",
        "rubber_roller_61804",
        *(pytest.param(name, marks=pytest.mark.slow) for name in ("rubber_roller_shaft", "spindle")),
    ],
)
def test_every_example_agrees_with_its_independent_routes(name):
    rows = dw.verify(dw.load(EXAMPLES / f"{name}.toml"))
    assert rows and not [row for row in rows if not row.ok]
    assert {"solid of second-order finite elements"} <= {row.route for row in rows}


def test_the_integrals_agree_on_three_bearings_cones_and_bores():
    model = dw.build(shaft(bearings=[{k: v for k, v in b.items() if k != "tilt_stiffness"} for b in STEPPED["bearings"]]))
    springs = [(s.position, s.stiffness[0]) for s in model.shaft.supports]
    other = moment_integrals.flexibility(model.shaft, springs, model.places)
    ours = dw.run(model.spec).arrays["flexibility"].values
    assert ours == pytest.approx(other, rel=1e-9)


def test_the_batch_is_the_run_for_every_design():
    spec = shaft(bearings=[{k: v for k, v in b.items() if k != "tilt_stiffness"} for b in STEPPED["bearings"]])
    keys = ("bearings.B.position", "segments.0.diameter", "segments.2.length", "bearings.A.radial_stiffness", "stations.q.position")
    names = ("flexibility.p.p", "flexibility.p.q")
    rng = np.random.default_rng(3)
    rows = np.array([0.17, 0.025, 0.11, 4e7, 0.23]) * rng.uniform(0.95, 1.05, (4, 5))
    found = batch(spec, keys, names)(rows)
    for row, *values in zip(rows, *found.values(), strict=True):
        one = dw.build(spec)
        sections = (
            one.shaft.sections[0]._replace(start=row[1], end=row[1]),
            one.shaft.sections[1],
            one.shaft.sections[2]._replace(length=row[2]),
        )
        supports = (
            one.shaft.supports[0]._replace(stiffness=(row[3], row[3], 0, 0, 0)),
            one.shaft.supports[1]._replace(position=row[0]),
            one.shaft.supports[2],
        )
        stations = (one.shaft.stations[0], one.shaft.stations[1]._replace(position=row[4]))
        changed = one.shaft._replace(sections=sections, supports=supports, stations=stations)
        system = dw.shafts.assemble(changed)
        delta = dw.shafts.flexibility(
            dw.shafts.solve(system, dw.shafts.nodal_forces(system, ())), [s.position for s in stations], (0, -1)
        ).delta
        assert values == pytest.approx([delta[0, 0], delta[0, 1]], rel=1e-9)
    assert batch(on_balls(), ("segments.0.diameter",), ("flexibility.m2.m2",)) is None  # not linear: design by design


# -- rolling bearings ----------------------------------------------------------------------------------------------------------


def test_a_bearing_alone_finds_the_displacement_that_it_has_under_the_shaft():
    result = dw.run(on_balls(free=("axial", "tilt")))
    inner = bearings.BallBearing(**BALLS)
    state = bearings.solve(inner, force=[0, -result["bearings.B.reaction"], 0, 0, 0])
    assert result["bearings.B.displacement"] == pytest.approx(-state.displacement[1], rel=1e-7)
    assert result["bearings.B.max_pressure"] == pytest.approx(state.pressures.max(), rel=1e-7)
    assert result["bearings.B.stiffness.tangent"] == pytest.approx(state.stiffness[1, 1], rel=1e-6)
    assert result["bearings.B.stiffness.secant"] == pytest.approx(
        result["bearings.B.reaction"] / result["bearings.B.displacement"], rel=1e-12
    )
    assert result["bearings.B.stiffness.load"] == pytest.approx(result["bearings.B.reaction"], rel=1e-12)
    ratio = result["bearings.B.stiffness.secant"] / result["bearings.B.stiffness.tangent"]
    assert ratio == pytest.approx(2 / 3, rel=1e-3)  # no clearance: F ~ d^1.5


def test_flexibility_on_real_bearings_is_the_tangent_of_the_loaded_deflection():
    step = 1e-3
    plus, minus, at = (dw.run(on_balls(loads=[{"station": "m2", "force": f"{500 + d} N"}])) for d in (step, -step, 0.0))
    slope = (plus["stations.m2.deflection"] - minus["stations.m2.deflection"]) / (2 * step)
    assert at["flexibility.m2.m2"] == pytest.approx(slope, rel=1e-5)


def test_a_seat_that_slides_carries_no_axial_force_and_one_that_turns_no_moment():
    table = dw.run(on_balls(free=("axial", "tilt"))).tables["reactions"]
    assert np.abs(table["reaction_z"].data).max() < 1e-6 and np.abs(table["reaction_tilt_x"].data).max() < 1e-9
    held = dw.run(on_balls()).tables["reactions"]
    assert np.abs(held["reaction_z"].data).max() > 1.0 and np.abs(held["reaction_tilt_x"].data).max() > 0.1
    assert held["reaction_z"].data.sum() == pytest.approx(0.0, abs=1e-6)


ANGULAR = {"balls": 14, "ball_diameter": "5 mm", "pitch_diameter": "30 mm", "contact_angle": "25 deg"}


def pair(preload, carries=("right", "left"), **more):
    return dw.Shaft(
        segments=[{"length": "200 mm", "diameter": "20 mm"}],
        bearings=[
            {"name": n, "position": z, "geometry": ANGULAR, "preload": f"{preload} N", "carries": way, **more}
            for n, z, way in zip("AB", ("50 mm", "150 mm"), carries, strict=True)
        ],
        stations=[{"name": "m", "position": "180 mm", "mass": "1 kg"}],
        loads=[{"station": "m", "axial_force": "0 N", "force": "1 N"}],
    )


def test_preload_is_there_when_the_shaft_is_mounted_and_stiffens_it():
    """Less what the shaft between the bearings yields: a few per cent."""
    results = [dw.run(pair(preload)) for preload in (50, 400)]
    for result, preload in zip(results, (50, 400), strict=True):
        axial = result.tables["reactions"]["reaction_z"].data
        assert np.abs(axial) == pytest.approx([preload, preload], rel=0.06) and axial.sum() == pytest.approx(0.0, abs=1e-6)
        assert axial[0] < 0 < axial[1]  # the left one pushes the shaft to the left
    assert results[1]["stiffness.m.m"] > 1.2 * results[0]["stiffness.m.m"]
    assert results[1]["modes.1.frequency"] > results[0]["modes.1.frequency"]


def test_a_spring_behind_a_sliding_ring_keeps_its_preload():
    spec = dw.Shaft(
        segments=[{"length": "200 mm", "diameter": "20 mm"}],
        bearings=[
            {"name": "A", "position": "50 mm", "geometry": ANGULAR, "carries": "right"},
            {"name": "B", "position": "150 mm", "geometry": ANGULAR, "carries": "left", "preload": "200 N", "free": ["axial"]},
        ],
        loads=[{"position": "180 mm", "force": "300 N"}],
    )
    assert dw.run(spec).tables["reactions"]["reaction_z"].data == pytest.approx([-200.0, 200.0], rel=1e-6)


TAPERED = {"rollers": 15, "roller_diameter": "4 mm", "roller_length": "8 mm", "pitch_diameter": "30 mm", "contact_angle": "14 deg"}
PLACES = {"A": "50 mm", "B": "150 mm"}


def on_tapered(*carries, names="AB", axial="-100 N", more=()):
    """Tapered bearings in the order of `names`, carrying what is given, or nothing said (None)."""
    held = [
        {"name": name, "position": PLACES[name], "roller_geometry": TAPERED} | ({"carries": way} if way else {})
        for name, way in zip(names, carries, strict=True)
    ]
    return dw.Shaft(
        segments=[{"length": "200 mm", "diameter": "20 mm"}],
        bearings=[*held, *more],
        loads=[{"position": "180 mm", "force": "500 N", "axial_force": axial}],
    )


@pytest.mark.parametrize("axial", ["-100 N", "80 N"])
@pytest.mark.parametrize(
    ("names", "said", "given"),
    [
        ("AB", (None, None), ("right", "left")),
        ("BA", (None, None), ("left", "right")),  # by place on the shaft, not by place in the spec
        ("AB", ("right", None), ("right", "left")),
        ("AB", (None, "left"), ("right", "left")),
    ],
)
def test_tapered_bearings_take_axial_forces_in_turn_unless_it_is_given(names, said, given, axial):
    open_to_the_rule, as_given = (dw.run(on_tapered(*carries, names=names, axial=axial)) for carries in (said, given))
    assert open_to_the_rule.outcome == "complete"
    assert {name: value.value for name, value in open_to_the_rule.values.items()} == {n: v.value for n, v in as_given.values.items()}
    table = open_to_the_rule.tables["reactions"]["reaction_z"].data
    assert table.sum() == pytest.approx(-float(axial.split()[0]), rel=1e-6)
    assert np.array_equal(table, as_given.tables["reactions"]["reaction_z"].data)


def test_what_is_given_is_not_turned_round_by_the_rule():
    ways = [[s.mirrored for s in dw.build(on_tapered(*carries)).shaft.supports] for carries in (("left", "right"), ("left", None))]
    assert ways == [[True, False], [True, True]], "the second in turn carries left, whatever the first is told"


def test_a_bearing_without_a_contact_angle_does_not_count_in_the_turn():
    ball = {"name": "M", "position": "100 mm", "bearing": "61804"}
    supports = dw.build(on_tapered(None, None, more=[ball])).shaft.supports
    assert {s.name: s.mirrored for s in supports} == {"A": False, "B": True, "M": False}


def test_bearings_the_wrong_way_round_leave_an_axial_force_to_nobody():
    result = dw.run(on_tapered("right", "right"))
    assert result.outcome == "partial" and any("no bearing that takes a force to the left" in finding for finding in result.findings)


def test_a_clearance_in_the_spec_goes_before_the_bearings_own():
    snug, loose = (
        dw.run(
            on_balls(
                bearings=[
                    {"name": n, "position": z, "bearing": "61804", "radial_clearance": c, "free": ["axial", "tilt"]}
                    for n, z in (("A", "56.5 mm"), ("B", "136.5 mm"))
                ]
            )
        )
        for c in ("0 um", "20 um")
    )
    # the overhung end swings through half the clearance at either bearing
    assert loose["bearings.B.displacement"] - snug["bearings.B.displacement"] > 9e-6
    inner = bearings.bearing("61804")
    wanted = bearings.solve(inner.replace(radial_clearance="20 um"), force=[0, -1178.125, 0, 0, 0])
    assert loose["bearings.B.displacement"] == pytest.approx(-wanted.displacement[1], rel=1e-6)


def test_life_in_time_and_the_checks_of_ratings():
    spec = on_balls(
        bearings=[{"name": n, "position": z, "bearing": "61804"} for n, z in (("A", "56.5 mm"), ("B", "136.5 mm"))],
        drive={"speed": "600 rpm"},
        limits={"life": "1e5 h", "shock_factor": 5},
    )
    result = dw.run(spec)
    assert result["bearings.B.reference_life.time"] == pytest.approx(result["bearings.B.reference_life"] / 10, rel=1e-9)
    assert not result.check("life.B").ok
    assert result.check("static_safety.B").value == pytest.approx(result["bearings.B.static_safety"] / 5)
    assert result["stations.m2.allowed_load"] == pytest.approx(result["stations.m2.limit_load"] / 5)
    assert result["stations.m2.limit_load"] == pytest.approx(2320 / result.arrays["reactions.unit_load"].values[1, 0], rel=1e-9)
    assert result.check("critical_speed").value == pytest.approx(result["critical_speeds.lowest"] / (20 * np.pi))


def test_static_safety_by_pressure_is_the_rating_over_the_load():
    """Of the most loaded ball of a bearing under pure radial load, to what 5 F/Z leaves out."""
    result = dw.run(on_balls(free=("axial", "tilt")))
    rating = bearings.basic_static_rating(bearings.BallBearing(**BALLS))
    assert result["bearings.B.static_safety"] == pytest.approx(rating / result["bearings.B.reaction"], rel=0.15)


def test_a_catalogue_of_ones_own(tmp_path):
    own = tmp_path / "own.toml"
    own.write_text("""
[bearings.X1]
description = "mine"
bore = "20 mm"
outer_diameter = "32 mm"
width = "7 mm"
[bearings.X1.ball]
balls = 12
ball_diameter = "3.572 mm"
pitch_diameter = "26 mm"
[[bearings.X1.sources]]
keys = ["bore", "outer_diameter", "width", "balls", "ball_diameter", "pitch_diameter"]
flag = "read"
text = "drawing"
""")
    spec = on_balls(
        catalogue=str(own), bearings=[{"name": n, "position": z, "bearing": "X1"} for n, z in (("A", "56.5 mm"), ("B", "136.5 mm"))]
    )
    assert dw.run(spec)["bearings.B.reaction"] > 1000


# -- gears, scene, files -------------------------------------------------------------------------------------------------------


def test_tooth_forces_make_the_torque_and_push_the_gear_away():
    spec = shaft(
        gears=[
            {
                "name": "g",
                "position": "100 mm",
                "pitch_diameter": "60 mm",
                "torque": "30 N m",
                "mesh_angle": "30 deg",
                "helix_angle": "15 deg",
            }
        ],
        loads=[],
    )
    load = tooth_load(spec.gears[0])
    r = 0.03 * np.array([np.cos(np.pi / 6), np.sin(np.pi / 6), 0.0])
    assert np.cross(r, load.force) == pytest.approx(load.moment, abs=1e-9) and load.moment[2] == pytest.approx(30.0)
    radial, axial = np.dot(load.force, r) / 0.03, load.force[2]
    assert radial == pytest.approx(-1000 * np.tan(np.radians(20)) / np.cos(np.radians(15))) and axial == pytest.approx(
        1000 * np.tan(np.radians(15))
    )


def test_the_scene_bends_the_shaft_as_computed_and_back():
    model = dw.build(shaft())
    drawn = registry.mechanism("shaft").scene(model)
    result = dw.run(shaft())
    slices = [body for body in drawn.bodies if body.name.startswith("shaft.")]
    assert all(np.allclose(body.poses[0], body.poses[-1]) for body in slices)
    factor = float(slices[0].label.split("×")[1])
    largest = max(np.abs(body.poses[:, 1]).max() for body in slices)
    line = result.tables["diagram"]["deflection"].data
    assert largest == pytest.approx(factor * np.abs(line).max(), rel=0.03)
    first = slices[0].poses[30]
    assert first[1] == pytest.approx(-factor * np.interp(first[0], result.tables["diagram"]["z"].data, line), rel=1e-3)  # down is down


def test_exaggeration_is_a_round_number_that_fills_the_picture():
    assert exaggeration(0.0, 1.0) == 0 and exaggeration(1e-4, 0.34) == 200 and exaggeration(2.9e-5, 1.0) == 2000


def test_drawing_and_solid_have_the_volume_of_the_shaft():
    from drivewright.curves import outline_area
    from drivewright.solids.volume import part_volume

    model = dw.build(shaft())
    kind = registry.mechanism("shaft")
    (drawing,), (part,) = kind.drawings(model), kind.parts(model)
    cones = [(0.09, 25, 25, 8), (0.12, 30, 40, 0), (0.11, 28, 28, 0)]
    wanted = sum(np.pi * 1e-6 * length / 12 * (a * a + a * b + b * b) - np.pi / 4 * 1e-6 * bore**2 * length for length, a, b, bore in cones)
    assert part_volume(part) == pytest.approx(wanted, rel=1e-9)
    assert outline_area(drawing.on("profile")[0]) == pytest.approx(sum(1e-3 * length * (a + b) / 2 for length, a, b, _ in cones), rel=1e-9)
    assert isinstance(part.solids[0], scene.Turned)


def test_basic_life_counts_the_axial_load_too():
    rated = {"dynamic_rating": "4.03 kN"}
    places = (("A", "56.5 mm"), ("B", "136.5 mm"))
    free = [{"name": n, "position": z, "geometry": BALLS | rated, "free": ["axial", "tilt"]} for n, z in places]
    result = dw.run(on_balls(bearings=free))
    assert result["bearings.B.basic_life"] == pytest.approx(1e6 * (4030 / 1178.125) ** 3, rel=1e-6)
    assert result["bearings.B.reference_life"] == pytest.approx(result["bearings.B.basic_life"], rel=0.05)
    pushed = dw.run(
        on_balls(
            bearings=[{"name": n, "position": z, "geometry": BALLS | rated} for n, z in places],
            loads=[{"station": "m2", "force": "500 N", "axial_force": "600 N"}],
        )
    )
    load = pushed["bearings.A.equivalent_load"]
    assert pushed["bearings.A.basic_life"] == pytest.approx(1e6 * (4030 / load) ** 3, rel=1e-6)
    assert load > pushed["bearings.A.radial_force"] and "bearings.A.reference_life" in pushed.values


def test_one_bore_through_several_segments_is_drawn_as_one():
    (drawing,) = registry.mechanism("shaft").drawings(dw.build(dw.load(EXAMPLES / "spindle.toml")))
    (hole,) = drawing.on("hole")
    assert np.ptp(hole.points(), axis=0) == pytest.approx([0.35, 0.03])
