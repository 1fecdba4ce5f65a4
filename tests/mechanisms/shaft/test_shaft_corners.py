"""Shafts that are legal and odd: what a designer meets at the edge of the model is computed, left out with a reason, or refused."""

import re

import numpy as np
import pytest

import drivewright as dw
from drivewright import shafts
from drivewright.mechanisms.shaft.designs import batch

pytestmark = pytest.mark.property

BALLS = {"balls": 12, "ball_diameter": "3.572 mm", "pitch_diameter": "26 mm", "static_rating": "2.32 kN"}
ROLLERS = {"rollers": 14, "roller_diameter": "10 mm", "roller_length": "8.5 mm", "pitch_diameter": "54 mm"}
SPRINGS = [
    {"name": "A", "position": "56.5 mm", "radial_stiffness": "3e7 N/m"},
    {"name": "B", "position": "136.5 mm", "radial_stiffness": "3e7 N/m"},
]


def shaft(**changes):
    tables = {
        "segments": [{"length": "340 mm", "diameter": "20 mm"}],
        "bearings": SPRINGS,
        "stations": [{"name": "m1", "position": "0 mm", "mass": "3 kg"}, {"name": "m2", "position": "245 mm", "mass": "8 kg"}],
        "loads": [{"station": "m2", "force": "500 N"}],
    }
    return dw.Shaft(**(tables | changes))


def pair(key, value, **more):
    """Both bearings with one key of their own in place of the spring."""
    return [{"name": b["name"], "position": b["position"], key: value, **more} for b in SPRINGS]


# -- short pieces --------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("theory", ["timoshenko", "euler-bernoulli"])
@pytest.mark.parametrize("gap", [1e-4, 1e-7, 2e-9])
def test_a_place_beside_another_costs_no_digits(theory, gap):
    """A station 2 nm beside a bearing: the same deflections and reactions as without it."""
    beside = [
        {"name": "m1", "position": "0 mm", "mass": "3 kg"},
        {"name": "m2", "position": "245 mm", "mass": "8 kg"},
        {"name": "c", "position": f"{0.1365 + gap} m"},
    ]
    one, two = (dw.run(shaft(analysis={"theory": theory}, **more), only=("statics", "flexibility")) for more in ({}, {"stations": beside}))
    assert two["bearings.B.reaction"] == pytest.approx(one["bearings.B.reaction"], rel=1e-12)
    assert two.arrays["flexibility"].values[:2, :2] == pytest.approx(one.arrays["flexibility"].values, rel=1e-10)


def test_modes_of_a_shaft_with_short_pieces():
    near = [
        {"name": "m1", "position": "0 mm", "mass": "3 kg"},
        {"name": "m2", "position": "245 mm", "mass": "8 kg"},
        {"name": "c", "position": "0.1365001 m"},
    ]
    one, two = (dw.run(shaft(**more), only=("modes",)) for more in ({}, {"stations": near}))
    assert [two[f"modes.{n}.frequency"] for n in (1, 2)] == pytest.approx([one[f"modes.{n}.frequency"] for n in (1, 2)], rel=1e-6)


# -- supports ------------------------------------------------------------------------------------------------------------------


def test_a_bearing_off_the_axis_loads_a_shaft_without_loads():
    """48 EI s/L^3 again, now through the spec."""
    rigid = [{"name": n, "position": z, "radial_stiffness": "rigid"} for n, z in (("A", "20 mm"), ("M", "170 mm"), ("B", "320 mm"))]
    rigid[1]["seat_offset"] = ["0 mm", "0.05 mm"]
    result = dw.run(shaft(bearings=rigid, loads=[], analysis={"theory": "euler-bernoulli"}))
    force = 48 * 206e9 * np.pi / 64 * 0.02**4 * 5e-5 / 0.3**3
    assert result["bearings.M.reaction_y"] == pytest.approx(force, rel=1e-9)
    assert "shaft.max_stress" in result.values


@pytest.mark.parametrize("held", [{"axial_stiffness": "rigid"}, {"axial_stiffness": "1e8 N/m", "tilt_stiffness": "2e3 N m/rad"}])
def test_play_beside_a_rigid_axial_hold(held):
    bearings = [SPRINGS[0] | {"radial_clearance": "10 um"} | held, SPRINGS[1] | {"radial_clearance": "10 um"}]
    result = dw.run(shaft(bearings=bearings))
    assert result.outcome == "complete" and "modes.1.frequency" in result.values
    assert not [name for name in result.values if not np.isfinite(result[name])]
    assert result["sensitivity.m2.m2.bearings.stiffness"] < 0


def test_a_spring_preload_that_nothing_holds_is_refused():
    bearings = [
        {"name": "A", "position": "56.5 mm", "geometry": BALLS, "free": ["axial"], "preload": "100 N"},
        {"name": "B", "position": "136.5 mm", "roller_geometry": ROLLERS},
    ]
    result = dw.run(shaft(bearings=bearings))
    assert result.outcome == "partial" and any(re.search("do not balance.*no support carries", finding) for finding in result.findings)


def test_a_preload_on_a_bearing_without_axial_stiffness_is_refused():
    bearings = [{"name": "A", "position": "56.5 mm", "roller_geometry": ROLLERS, "free": ["axial"], "preload": "100 N"}, SPRINGS[1]]
    with pytest.raises(dw.SpecError, match=r"bearings\.A\.preload.*takes no axial force"):
        dw.run(shaft(bearings=bearings))


def test_axial_modes_are_there_where_the_shaft_is_held_and_only_there():
    """One spring k at a shaft of mass m, the masses of its stations on it: about sqrt(k/m)/2 pi while the shaft itself is stiff."""
    free = dw.run(shaft())
    held = dw.run(shaft(bearings=[SPRINGS[0] | {"axial_stiffness": "1e6 N/m"}, SPRINGS[1]]))
    on_rollers = dw.run(shaft(bearings=pair("roller_geometry", ROLLERS)))
    assert not [name for result in (free, on_rollers) for name in result.values if name.startswith("axial_modes")]
    mass = 11 + 7850 * np.pi / 4 * 0.02**2 * 0.34
    assert held["axial_modes.1.frequency"] == pytest.approx(np.sqrt(1e6 / mass) / (2 * np.pi), rel=0.01)
    assert held["modes.1.frequency"] == pytest.approx(free["modes.1.frequency"], rel=1e-9)


def test_a_play_larger_than_a_millimetre_still_holds_both_ways():
    large = {"balls": 8, "ball_diameter": "38 mm", "pitch_diameter": "160 mm", "radial_clearance": "0.15 mm"}
    for force in ("1000 N", "-1000 N"):
        result = dw.run(shaft(bearings=pair("geometry", large), loads=[{"station": "m2", "force": "500 N", "axial_force": force}]))
        assert result.tables["reactions"]["reaction_z"].data.sum() == pytest.approx(-float(force.split()[0]), rel=1e-6)


def test_light_loads_in_a_play_take_few_steps():
    one = dw.build(shaft(bearings=[b | {"radial_clearance": "40 um"} for b in SPRINGS], loads=[{"station": "m2", "force": "1 mN"}]))
    assert shafts.apply_loads(one.shaft, one.loads).equilibrium.steps <= 12


def test_an_idle_bearing_is_told_and_has_no_life():
    bearings = [
        SPRINGS[0],
        SPRINGS[1],
        {"name": "C", "position": "300 mm", "geometry": BALLS | {"radial_clearance": "40 um"}, "free": ["axial", "tilt"]},
    ]
    result = dw.run(shaft(bearings=bearings, loads=[{"station": "m1", "force": "1 N"}]))
    assert any("'C' carries no load" in finding for finding in result.findings)
    assert "bearings.C.static_safety" not in result.values


# -- beyond all measure --------------------------------------------------------------------------------------------------------


def threads(diameter, **more):
    """The shaft on ball bearings, one seat far off the axis."""
    bearings = [
        {"name": "A", "position": "56.5 mm", "bearing": "61804", "seat_offset": ["1.067 mm", "-3 mm"]},
        {"name": "B", "position": "136.5 mm", "bearing": "61804", "free": ["axial"]},
    ]
    return shaft(segments=[{"length": "340 mm", "diameter": diameter, **more}], bearings=bearings)


def past_the_door(spec, table, **numbers):
    """The spec with numbers [SI] that no text could say: what the mechanics answer by themselves."""
    value = getattr(spec, table)
    changed = (value[0].model_copy(update=numbers),) if isinstance(value, tuple | list) else value.model_copy(update=numbers)
    return spec.model_copy(update={table: changed})


@pytest.mark.parametrize(
    "spec, told",
    [
        (threads("0.000468465 mm"), "gave up: shaft: the equations of shaft and bearings are singular to rounding"),
        (
            past_the_door(threads("20 mm"), "segments", diameter=1e-93),
            "no answer for this design: shaft: from 0 to 56.5 mm, with a diameter of 1e-90 mm, the flexibility overflows",
        ),
        (
            past_the_door(threads("20 mm"), "segments", diameter=1e87),
            "with a diameter of 1e\\+90 mm, the flexibility overflows; check the units",
        ),
        (past_the_door(shaft(), "material", youngs_modulus=1e-300), "the flexibility overflows; .* Young's modulus"),
    ],
)
def test_a_shaft_beyond_measure_is_told_in_our_words(spec, told):
    result = dw.run(spec)
    assert result.outcome == "partial" and any(re.search(told, finding) for finding in result.findings)


@pytest.mark.parametrize(
    ("settings", "told"),
    [
        (
            {"segments": [{"length": "340 mm", "diameter": "1e-90 mm"}]},
            "segments.0.diameter: '1e-90 mm' has no meaning: it is smaller than",
        ),
        ({"segments": [{"length": "340 mm", "diameter": "1e90 mm"}]}, "segments.0.diameter: '1e90 mm' has no meaning: it is larger than"),
        ({"material": {"youngs_modulus": "1e-300 Pa"}}, "material.youngs_modulus: '1e-300 Pa' has no meaning: it is smaller than"),
    ],
)
def test_the_door_refuses_what_is_beyond_measure(settings, told):
    with pytest.raises(dw.SpecError, match=told):
        shaft(**settings)


def test_a_thread_on_springs_sags_as_it_should():
    """Springs enter by their compliance: half a micrometre thick, F a^2 (a + l)/(3 E I) at the overhanging load."""
    spec = shaft(
        segments=[{"length": "340 mm", "diameter": "0.000468465 mm"}],
        analysis={"theory": "euler-bernoulli"},
        loads=[{"position": "340 mm", "force": "1 N"}],
        stations=[{"name": "end", "position": "340 mm"}],
    )
    arm, span, stiff = 0.34 - 0.1365, 0.08, 206e9 * np.pi / 64 * 4.68465e-7**4
    assert dw.run(spec, only=("statics",))["stations.end.deflection"] == pytest.approx(arm**2 * (arm + span) / (3 * stiff), rel=1e-9)


def test_a_wall_as_thin_as_rounding_is_told():
    """Beside ball bearings nothing is left of its bending: whatever gives up first says so."""
    bearings = pair("bearing", "61804", free=["axial", "tilt"])
    for load in ({"station": "m2", "force": "500 N"}, {"position": "340 mm", "axial_force": "-500 N"}):
        for seat in ({}, {"seat_offset": ["1.067 mm", "-3 mm"]}):
            result = dw.run(
                shaft(
                    segments=[{"length": "340 mm", "diameter": "20 mm", "bore": "19.9999999999999 mm"}],
                    bearings=[{"name": "A", "position": "56.5 mm", "bearing": "61804", **seat}, bearings[1]],
                    loads=[load],
                )
            )
            assert result.outcome == "partial" or not result.check("equilibrium").ok
            assert not [name for name in result.values if not np.isfinite(result[name])]


def test_a_wall_that_stretches_by_kilometres_is_not_pushed_out_of_its_bearings():
    """F l/EA of the piece right of the bearing that holds; the check of small deflections fails."""
    spec = shaft(
        segments=[{"length": "340 mm", "diameter": "20 mm", "bore": "19.999999999 mm"}],
        stations=[],
        bearings=[SPRINGS[0] | {"axial_stiffness": "1e7 N/m"}, SPRINGS[1]],
        loads=[{"position": "340 mm", "axial_force": "500 N"}],
    )
    result = dw.run(spec, only=("statics",))
    exact = 500 * (0.34 - 0.0565) / (206e9 * np.pi / 4 * (0.02 - 0.019999999999) * 0.039999999999)
    assert result.check("small_deflections").value == pytest.approx(exact / 0.34, rel=1e-3) and not result.check("small_deflections").ok


def test_the_width_of_a_bearing_goes_to_nothing_without_a_jump():
    """By shear the deflection changes in proportion to the width; down to less than the nodes of a shaft can tell apart."""
    keys, widths = ("bearings.B.reaction", "flexibility.m2.m2"), (1e-12, 1e-7, 5e-7, 1e-6, 1e-5, 1e-3, 0.1)
    point, *wide = (
        [dw.run(shaft(bearings=[SPRINGS[0], SPRINGS[1] | {"width": f"{width} mm"}]), only=("statics", "flexibility"))[key] for key in keys]
        for width in (0.0, *widths)
    )
    assert wide[-1][1] != point[1]
    for found, width in zip(wide, widths, strict=True):
        assert found == pytest.approx(point, rel=1e-9 + 1e-4 * width, abs=0)


# -- stations on bearings ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("places", [("0 mm", "245 mm"), ("0 mm", "340 mm"), ("56.5 mm", "136.5 mm")])
def test_stations_on_rigid_bearings(places):
    """Flexibility 0, no stiffness, no number for what fails first there, and everything else is computed."""
    rigid = [{"name": n, "position": z, "radial_stiffness": "rigid"} for n, z in zip("AB", places, strict=True)]
    stepped = [{"length": "100 mm", "diameter": "20 mm"}, {"length": "240 mm", "diameter": "54 mm"}]
    on = [{"name": "a", "position": places[0]}, {"name": "b", "position": places[1]}, {"name": "m", "position": "190 mm"}]
    result = dw.run(
        shaft(
            segments=stepped, bearings=rigid, stations=on, loads=[{"station": "m", "force": "1 kN"}], material={"yield_strength": "355 MPa"}
        )
    )
    delta = result.arrays["flexibility"].values
    assert np.abs(delta[:2, :2]).max() < 1e-9 * delta[2, 2] and "stiffness" not in result.arrays
    assert "stations.m.limit_load" in result.values and result.outcome == "complete"
    assert result.values.get("stations.a.limit_load") is None or result["stations.a.limit_load"] < 1e12


def test_a_station_at_the_very_end_has_no_sensitivity_to_its_place_and_all_the_others():
    result = dw.run(shaft(stations=[{"name": "m1", "position": "0 mm"}, {"name": "m2", "position": "340 mm"}]))
    for name in ("m1", "m2"):
        assert f"sensitivity.{name}.{name}.stations.{name}.position" not in result.values
    assert "sensitivity.m2.m2.distance.B-m2" in result.values and "sensitivity.m2.m2.segments.0.diameter" in result.values
    assert "sensitivity.m1.m1.distance.m1-A" in result.values


def test_a_station_as_near_to_the_end_as_can_be_has_its_sensitivity():
    def run(place):
        return dw.run(shaft(stations=[{"name": "m2", "position": f"{place} mm"}]), only=("sensitivities",))

    near, step = run(339.999), 0.0005
    slope = (run(339.999 + step)["flexibility.m2.m2"] - run(339.999 - step)["flexibility.m2.m2"]) / (2 * step)
    wanted = 339.999 * slope / near["flexibility.m2.m2"]
    assert near["sensitivity.m2.m2.stations.m2.position"] == pytest.approx(wanted, rel=1e-6)


# -- other routes and second looks ---------------------------------------------------------------------------------------------


def test_the_batch_knows_no_housing_and_says_so():
    spec = shaft(bearings=[SPRINGS[0] | {"housing_stiffness": "3e7 N/m"}, SPRINGS[1]])
    assert batch(spec, ("bearings.A.radial_stiffness",), ("flexibility.m2.m2",)) is None
    with pytest.raises(dw.DrivewrightError, match="did you mean|no station|entry of stations"):
        batch(shaft(), ("bearings.A.position",), ("flexibility.m2.m9",))
    with pytest.raises(dw.DrivewrightError, match="entry of bearings"):
        batch(shaft(), ("bearings.X.position",), ("flexibility.m2.m2",))


def test_the_batch_takes_a_cone_in_either_order_of_its_keys():
    spec = shaft(segments=[{"length": "340 mm", "diameter": "20 mm"}])
    both = ("segments.0.diameter", "segments.0.end_diameter")
    one = batch(spec, both, ("flexibility.m2.m2",))(np.array([[0.02, 0.03]]))["flexibility.m2.m2"]
    two = batch(spec, both[::-1], ("flexibility.m2.m2",))(np.array([[0.03, 0.02]]))["flexibility.m2.m2"]
    cone = dw.run(shaft(segments=[{"length": "340 mm", "diameter": "20 mm", "end_diameter": "30 mm"}]), only=("flexibility",))
    assert one[0] == two[0] == pytest.approx(cone["flexibility.m2.m2"], rel=1e-9)


def test_the_error_of_a_massless_shaft_is_told_of_the_mode_along_the_unit_loads():
    result = dw.run(shaft(bearings=pair("bearing", "61804", free=["axial", "tilt"])))
    (told,) = (finding for finding in result.findings if "mode" in finding and "own mass" in finding)
    assert float(told.rpartition(" by ")[2].split("%")[0]) < 5 and "mode 2" in told
    heavy = [{"name": "m2", "position": "245 mm", "mass": "8 kg", "diametral_inertia": "1 kg m^2"}]
    assert not any("own mass" in finding for finding in dw.run(shaft(stations=heavy)).findings)


def test_the_lowest_critical_speed_on_bearings_that_are_not_round_counts_both_whirls():
    result = dw.run(shaft(bearings=pair("bearing", "61804", free=["axial", "tilt"]), drive={"speed": "1000 rpm"}))
    lowest = min(result["critical_speeds.forward.1"], result["critical_speeds.backward.1"])
    assert result["critical_speeds.lowest"] == lowest == pytest.approx(2 * np.pi * result["modes.1.frequency"], rel=1e-3)
    assert result.check("critical_speed").value == pytest.approx(lowest / (1000 * np.pi / 30))
    round_ = dw.run(
        shaft(
            stations=[
                {"name": "m2", "position": "245 mm", "mass": "8 kg", "polar_inertia": "0.1 kg m^2", "diametral_inertia": "0.05 kg m^2"}
            ]
        )
    )
    assert round_["critical_speeds.lowest"] == round_["critical_speeds.forward.1"] > round_["critical_speeds.backward.1"]


def test_buckling_of_a_slender_shaft_is_eulers():
    simple = [
        {"name": "A", "position": "0 mm", "radial_stiffness": "rigid", "axial_stiffness": "rigid"},
        {"name": "B", "position": "1 m", "radial_stiffness": "rigid"},
    ]
    slender = {"segments": [{"length": "1 m", "diameter": "20 mm"}], "bearings": simple, "stations": [{"name": "m", "position": "0.5 m"}]}
    euler = np.pi**2 * 206e9 * np.pi / 64 * 0.02**4
    for force, factor in ((-1000.0, euler / 1000), (-euler, 1.0)):
        loads = [{"position": "1 m", "axial_force": f"{force} N"}, {"station": "m", "force": "1 N"}]
        check = dw.run(dw.Shaft(**slender, loads=loads)).check("buckling")
        assert check.value == pytest.approx(factor, rel=2e-3) and check.ok == (factor > 3)
    pulled = dw.run(dw.Shaft(**slender, loads=[{"position": "1 m", "axial_force": "1 kN"}]))
    assert "buckling" not in [check.name for check in pulled.checks]


def test_slopes_beyond_small_ones_fail_a_check():
    assert not dw.run(shaft(loads=[{"station": "m2", "force": "50 kN"}])).check("small_slopes").ok
    assert dw.run(shaft()).check("small_slopes").ok


def test_deflections_count_along_the_plane_of_the_loads():
    """Loads along x: so are the unit loads; loads in two planes: down."""
    sideways = dw.run(shaft(loads=[{"station": "m2", "force": "500 N", "angle": "0 deg"}]))
    down = dw.run(shaft())
    assert (
        sideways["stations.m2.deflection"]
        == pytest.approx(down["stations.m2.deflection"], rel=1e-12)
        == sideways["stations.m2.deflection_x"]
    )
    both = dw.run(shaft(loads=[{"station": "m2", "force": "500 N", "angle": "0 deg"}, {"station": "m2", "force": "500 N"}]))
    assert both["stations.m2.deflection"] == pytest.approx(-both["stations.m2.deflection_y"], rel=1e-12)
    assert both["stations.m2.displacement"] == pytest.approx(np.sqrt(2) * down["stations.m2.deflection"], rel=1e-9)


@pytest.mark.parametrize(
    ("change", "along"),
    [
        ({"loads": [{"position": "100 mm", "force": "500 N", "angle": "0 deg"}]}, "along the loads"),
        ({"loads": [{"position": "100 mm", "force": "500 N"}], "gravity": ["9.81 m/s^2", "0 m/s^2", "0 m/s^2"]}, "along -y"),
        ({"loads": [{"position": "100 mm", "force": "500 N"}], "analysis": {"direction": "30 deg"}}, "along the given direction"),
    ],
)
def test_without_stations_there_are_no_unit_loads_to_speak_of(change, along):
    result = dw.run(shaft(stations=[], **change))
    told = [column.meaning for column in result.tables["diagram"].columns]
    assert told[1] == f"deflection {along}" and not [text for text in told if "unit load" in text]
    assert {v.meaning.partition("' ")[2] for k, v in result.values.items() if k.endswith(".reaction")} == {f"{along}, on the shaft"}


def test_what_fails_first_knows_the_rating_of_the_inner_geometry():
    bare = {k: v for k, v in BALLS.items() if k != "static_rating"}
    result = dw.run(shaft(bearings=pair("geometry", bare, free=["axial", "tilt"])))
    rating = dw.bearings.basic_static_rating(dw.bearings.BallBearing(**bare))
    assert result["stations.m2.limit_load"] == pytest.approx(rating / 2.35625, rel=1e-6)


@pytest.mark.needs_fe
@pytest.mark.parametrize(
    "change",
    [{"bearings": [SPRINGS[0] | {"position": "0 mm"}, SPRINGS[1]]}, {"bearings": [SPRINGS[0] | {"tilt_stiffness": "1e5 N m/rad"}]}],
)
def test_verify_of_cases_that_the_solid_cannot_hold_as_they_are(change):
    rows = dw.verify(shaft(**change))
    assert rows and all(row.ok for row in rows)


def test_the_solid_stands_on_a_band_where_a_seat_is_a_point():
    from drivewright.shafts.solid_check import bearing_bands

    for width, band in (("0 mm", 2e-3), ("1e-9 mm", 2e-3), ("5 mm", 5e-3)):
        model = dw.build(shaft(bearings=[SPRINGS[0] | {"width": width}, SPRINGS[1]]))
        at_rest = shafts.apply_loads(model.shaft, model.loads).equilibrium
        seats = bearing_bands(at_rest, model.direction, model.spec.analysis.solid_band)
        assert [seat.width for seat in seats] == pytest.approx([band, 2e-3], rel=1e-12)


@pytest.mark.needs_fe
def test_the_solid_stands_on_its_housing_too():
    soft = [
        {"name": b["name"], "position": b["position"], "bearing": "61804", "housing_stiffness": "1e7 N/m", "free": ["axial", "tilt"]}
        for b in SPRINGS
    ]
    result = dw.run(shaft(bearings=soft), only=("flexibility", "solid"))
    assert result["solid.flexibility.m2.m2"] == pytest.approx(result["flexibility.m2.m2"], rel=0.01)


def test_buckling_of_a_shaft_whose_bearings_stand_in_their_play():
    """Pressed along its axis, and held across only by what the load leaves: a number or none, never a crash."""
    bearings = [SPRINGS[0] | {"radial_clearance": "40 um", "axial_stiffness": "rigid"}, SPRINGS[1] | {"radial_clearance": "40 um"}]
    result = dw.run(shaft(bearings=bearings, loads=[{"position": "340 mm", "axial_force": "-500 N"}]))
    assert result["shaft.max_stress"] > 0
