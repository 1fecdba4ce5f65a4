"""Values, tables and checks of the kind `shaft` under skew loads, against closed forms and against its bearings alone."""

import numpy as np
import pytest

import drivewright as dw
from drivewright import bearings, materials
from drivewright.mechanisms.shaft.build import tooth_load
from drivewright.oracles.shaft import moment_integrals
from drivewright.oracles.shaft.independent_check import _flexibility, verify
from drivewright.shafts import solid_check

pytestmark = pytest.mark.analytical

E, D, SPAN = 206e9, 0.02, 0.3
I = np.pi / 64 * D**4
BALLS = {
    "balls": 12,
    "ball_diameter": "3.572 mm",
    "pitch_diameter": "26 mm",
    "youngs_modulus": "206 GPa",
    "inner_conformity": 0.515,
    "outer_conformity": 0.53,
}
ANGULAR = {"balls": 14, "ball_diameter": "5 mm", "pitch_diameter": "30 mm", "contact_angle": "25 deg"}
ROLLERS = {"rollers": 15, "roller_diameter": "4 mm", "roller_length": "8 mm", "pitch_diameter": "30 mm"}
UNIFORM = {
    "segments": [{"length": "400 mm", "diameter": "20 mm"}],
    "bearings": [
        {"name": "A", "position": "50 mm", "radial_stiffness": "4e7 N/m"},
        {"name": "B", "position": "350 mm", "radial_stiffness": "4e7 N/m", "axial_stiffness": "1e7 N/m"},
    ],
    "stations": [{"name": "p", "position": "200 mm", "mass": "2 kg"}, {"name": "q", "position": "400 mm", "mass": "1 kg"}],
    "loads": [{"station": "p", "force": "500 N", "angle": "30 deg", "axial_force": "200 N"}],
    "analysis": {"theory": "euler-bernoulli", "direction": "30 deg"},
}


def spec(**changes):
    return dw.Shaft(**(UNIFORM | changes))


def run(*only, **changes):
    return dw.run(spec(**changes), only=only or ("statics",))


def on(bearing, **changes):
    """On two rolling bearings."""
    places = (("A", "50 mm"), ("B", "350 mm"))
    return {"bearings": [{"name": n, "position": z, **bearing} for n, z in places]} | changes


# -- statics -------------------------------------------------------------------------------------------------------------------


def test_a_skew_load_in_the_middle():
    result = run(material={"yield_strength": "300 MPa"}, limits={"deflection": "1 mm", "slope": "1 deg"})
    f, sag, slope = 500.0, 500 * SPAN**3 / (48 * E * I) + 250 / 4e7, 500 * SPAN**2 / (16 * E * I)
    c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
    wanted = {
        "stations.p.deflection": sag,
        "stations.p.deflection_x": sag * c,
        "stations.p.deflection_y": sag * s,
        "stations.q.slope": -slope,
        "stations.q.deflection": 250 / 4e7 - 0.05 * slope,
        "bearings.A.slope": slope,
        "bearings.A.reaction": f / 2,
        "bearings.A.reaction_x": -f / 2 * c,
        "bearings.B.reaction_y": -f / 2 * s,
        "bearings.A.radial_force": f / 2,
        "bearings.B.displacement": 250 / 4e7,
        "bearings.B.axial_force": -200.0,
        "shaft.max_moment": f * SPAN / 4,
        "shaft.max_moment.at": 0.2,
        "shaft.max_deflection": sag,
        "shaft.max_deflection.at": 0.2,
        "bearings.A.stiffness.secant": 4e7,
        "shaft.max_stress": 32 * f * SPAN / 4 / (np.pi * D**3) + 200 / (np.pi / 4 * D**2),
    }
    assert {name: result[name] for name in wanted} == pytest.approx(wanted, rel=1e-6)
    assert "bearings.A.axial_force" not in result.values and "bearings.A.moment" not in result.values
    assert result.check("yield_safety").value == pytest.approx(300e6 / result["shaft.max_stress"], rel=1e-9)
    assert result.check("deflection.p").value == pytest.approx(sag, rel=1e-9)
    assert result.check("slope.B").value == pytest.approx(slope, rel=1e-9)


def test_the_diagram_is_in_the_direction_of_the_unit_loads():
    along, aside = (run(analysis={"theory": "euler-bernoulli", "direction": angle}).tables["diagram"] for angle in ("30 deg", "-60 deg"))
    at = np.argmin(np.abs(along["z"].data - 0.2))
    sag = 500 * SPAN**3 / (48 * E * I) + 250 / 4e7
    assert along["deflection"].data[at] == pytest.approx(sag, rel=1e-6)
    assert np.abs(aside["deflection"].data).max() < 1e-9 * sag
    for name in ("deflection", "slope", "shear", "moment"):
        size = np.abs(along[name].data).max()
        assert np.abs(aside[f"{name}_across"].data) == pytest.approx(np.abs(along[name].data), abs=1e-9 * size)
        assert np.abs(along[f"{name}_across"].data).max() < 1e-9 * size


def test_static_safety_of_a_spring_is_by_its_radial_force():
    rated = [b | {"static_rating": "3 kN"} for b in UNIFORM["bearings"]]
    assert run(bearings=rated).check("static_safety.A").value == pytest.approx(3000 / 250, rel=1e-9)


def test_a_bearing_that_resists_tilting_has_a_moment():
    tilting = [b | {"tilt_stiffness": "2e4 N m/rad"} for b in UNIFORM["bearings"]]
    result = run(bearings=tilting)
    assert result["bearings.A.moment"] == pytest.approx(2e4 * result["bearings.A.slope"], rel=1e-9) and result["bearings.A.moment"] > 1


def test_slenderness_is_by_the_least_diameter():
    pieces = [{"length": "100 mm", "diameter": "30 mm"}, {"length": "300 mm", "diameter": "25 mm", "end_diameter": "16 mm"}]
    assert run(segments=pieces).check("slenderness").value == pytest.approx(400 / 16)


def test_a_spring_with_play_gives_way_by_half_its_clearance_first():
    loose = [b | {"radial_clearance": "30 um"} for b in UNIFORM["bearings"]]
    result = run("statics", "rolling", bearings=loose)
    assert result["bearings.A.displacement"] == pytest.approx(250 / 4e7 + 15e-6, rel=1e-8)
    assert result["bearings.A.stiffness.tangent"] == pytest.approx(4e7, rel=1e-8)
    assert result["bearings.A.stiffness.secant"] == pytest.approx(250 / (250 / 4e7 + 15e-6), rel=1e-8)
    assert "bearings.A.stiffness.tangent" not in run(bearings=loose).values


def test_a_housing_is_in_series_with_every_kind_of_bearing(tmp_path):
    (tmp_path / "k.csv").write_text("displacement [um],force [N]\n0,0\n100,4000\n")
    soft = {"housing_stiffness": "1e7 N/m", "housing_axial_stiffness": "5e6 N/m"}
    kinds = {
        "spring": {"radial_stiffness": "4e7 N/m"},
        "play": {"radial_stiffness": "4e7 N/m", "radial_clearance": "0.02 um"},
        "table": {"table": str(tmp_path / "k.csv")},
    }
    for kind in kinds.values():
        held = [
            {"name": "A", "position": "50 mm", **kind, **soft},
            {"name": "B", "position": "350 mm", **kind, **soft, "axial_stiffness": "1e7 N/m"},
        ]
        result = run(bearings=held)
        wanted = 500 * SPAN**3 / (48 * E * I) + 250 / 4e7 + 250 / 1e7 + (1e-8 if "radial_clearance" in kind else 0)
        assert result["stations.p.deflection"] == pytest.approx(wanted, rel=1e-7)
        loaded = dw.shafts.apply_loads((model := dw.build(spec(bearings=held))).shaft, model.loads)
        node = 6 * loaded.equilibrium.model.beam.node(0.35)
        assert loaded.equilibrium.u[node + 2] == pytest.approx(200 * (1 / 1e7 + 1 / 5e6), rel=1e-8)


def test_a_rolling_bearing_in_a_soft_housing():
    """Across: what it yields besides; along: the axial load moves the whole shaft further by F/k."""
    firm = on({"geometry": ANGULAR, "carries": "right"}, loads=[{"position": "50 mm", "force": "100 N", "axial_force": "400 N"}])
    firm["bearings"][1] = UNIFORM["bearings"][1] | {"axial_stiffness": None}
    soft = firm | {
        "bearings": [firm["bearings"][0] | {"housing_stiffness": "1e7 N/m", "housing_axial_stiffness": "5e6 N/m"}, firm["bearings"][1]]
    }
    found = []
    for changes in (firm, soft):
        loaded = dw.shafts.apply_loads((model := dw.build(spec(**changes))).shaft, model.loads)
        node = 6 * loaded.equilibrium.model.beam.node(0.05)
        found.append((loaded.equilibrium.u[node + 1], loaded.equilibrium.u[node + 2], loaded.equilibrium.reactions[0]))
    assert found[1][2][:3] == pytest.approx(found[0][2][:3], rel=1e-2)
    assert found[0][0] - found[1][0] == pytest.approx(found[1][2][1] / 1e7, rel=5e-2)  # less what its tilting gives back
    assert found[1][1] - found[0][1] == pytest.approx(400 / 5e6, rel=2e-2)


def test_seats_out_of_line_in_the_axes_of_the_bearing():
    """A bearing that carries the force to the left points there: its tilts and its place along z are turned round, x and y are not."""
    seat = {"geometry": ANGULAR, "seat_offset": ["10 um", "-20 um"], "seat_tilt": ["1 mrad", "3 mrad"], "width": "8 mm", "preload": "100 N"}
    right, left = (dw.build(spec(**on(seat | {"carries": way}))).shaft.supports[0] for way in ("right", "left"))
    assert right.offset[:2] == left.offset[:2] == pytest.approx((1e-5, -2e-5))
    assert right.offset[3:] == pytest.approx((1e-3, 3e-3)) and left.offset[3:] == pytest.approx((-1e-3, -3e-3))
    alone = bearings.solve(bearings.BallBearing(**ANGULAR), force=[0, 0, 100.0, 0, 0], held=("x", "y", "tilt_x", "tilt_y"))
    assert right.offset[2] == left.offset[2] == pytest.approx(-alone.displacement[2]) and right.offset[2] < 0
    assert right.width == 0.008 and not right.mirrored and left.mirrored
    aside = {key: seat[key] for key in ("seat_offset", "seat_tilt")}
    spring = [UNIFORM["bearings"][0] | aside | {"tilt_stiffness": "2e4 N m/rad"}, UNIFORM["bearings"][1]]
    assert dw.build(spec(bearings=spring)).shaft.supports[0].offset == pytest.approx((1e-5, -2e-5, 0.0, 1e-3, 3e-3))


# -- loads and material --------------------------------------------------------------------------------------------------------


def test_loads_of_the_spec_in_the_shafts_axes():
    loads = [
        {
            "position": "100 mm",
            "force": "10 N",
            "angle": "90 deg",
            "axial_force": "3 N",
            "torque": "2 N m",
            "moment": "4 N m",
            "moment_angle": "60 deg",
        }
    ]
    lines = [
        {"start": "100 mm", "end": "200 mm", "force": "5 N/mm", "end_force": "8 N/mm"},
        {"start": "200 mm", "end": "300 mm", "force": "5 N/mm", "angle": "0 deg"},
    ]
    found = dw.build(spec(loads=loads, line_loads=lines)).loads
    assert found.points[0].force == pytest.approx((0.0, 10.0, 3.0))
    assert found.points[0].moment == pytest.approx((4 * np.cos(np.pi / 3), 4 * np.sin(np.pi / 3), 2.0))
    assert [(*line.first, *line.last) for line in found.lines] == [(0.0, -5000.0, 0.0, -8000.0), (5000.0, 0.0, 5000.0, 0.0)]


@pytest.mark.parametrize("torque", [30.0, -30.0])
def test_the_mate_pushes_a_gear_away_whichever_way_it_turns(torque):
    gear = {"name": "g", "position": "100 mm", "pitch_diameter": "60 mm", "torque": f"{torque} N m", "helix_angle": "15 deg"}
    load = tooth_load(spec(gears=[gear]).gears[0])
    assert load.force == pytest.approx(
        (-1000 * np.tan(np.radians(20)) / np.cos(np.radians(15)), torque / 0.03, torque / 0.03 * np.tan(np.radians(15)))
    )
    assert load.moment == pytest.approx((0.0, -torque * np.tan(np.radians(15)), torque))


def test_material_is_as_given_else_of_the_card_else_steel():
    def numbers(**material):
        built = dw.build(spec(material=material))
        return built.shaft.modulus, built.shaft.poisson, built.shaft.density, built.yield_strength

    card = materials.material("C45")
    assert numbers() == (206e9, 0.3, 7850.0, None)
    assert numbers(card="C45") == (card.modulus, card.poisson, card.density, card.yield_strength)
    own = numbers(card="C45", density="7000 kg/m^3", youngs_modulus="200 GPa", poisson_ratio=0.25)
    assert own == (200e9, 0.25, 7000.0, card.yield_strength)
    assert numbers(yield_strength="300 MPa")[3] == 300e6 and numbers(density="0 kg/m^3")[2] == 0


def test_a_shear_coefficient_of_ones_own_and_ratings_of_ones_own():
    assert dw.build(spec(analysis={"shear_coefficient": 0.7})).shaft.shear == 0.7
    rated = on({"bearing": "61804", "dynamic_rating": "1.5 kN", "static_rating": "0.9 kN"})
    model = dw.build(spec(**rated))
    assert model.rolling["A"].dynamic_rating == 1500.0 and model.rolling["B"].static_rating == 900.0
    life = [run("statics", "rolling", **on({"bearing": "61804", "dynamic_rating": f"{c} kN"}))["bearings.A.reference_life"] for c in (2, 4)]
    assert life[1] / life[0] == pytest.approx(8.0, rel=1e-6)


# -- flexibility, what fails first, sensitivities ------------------------------------------------------------------------------


def test_a_bearing_that_carries_little_may_fail_first():
    """A load near A, which bears more of it; B's rating is the lower by far."""
    rated = [UNIFORM["bearings"][0] | {"static_rating": "9 kN"}, UNIFORM["bearings"][1] | {"static_rating": "600 N"}]
    result = run("failure", bearings=rated, stations=[{"name": "p", "position": "110 mm"}], limits={"shock_factor": 3}, loads=[])
    table = result.tables["failure"]
    found = dict(zip(table["part"].data, table["load"].data, strict=True))
    assert found == pytest.approx({"bearing A": 9000 / 0.8, "bearing B": 600 / 0.2})
    assert list(table["first"].data) == [0.0, 1.0] and result["stations.p.limit_load"] == pytest.approx(3000)
    assert table["steady_load"].data == pytest.approx(table["load"].data / 3) and result["stations.p.allowed_load"] == pytest.approx(1000)


def test_the_shaft_yields_where_moment_over_section_modulus_is_largest():
    """A hollow cone under a skew unit load: M(z) 32 D/(pi (D^4 - d^4)) with the diameter there."""
    cone = [{"length": "400 mm", "diameter": "20 mm", "end_diameter": "40 mm", "bore": "12 mm"}]
    result = run("failure", segments=cone, stations=[{"name": "p", "position": "200 mm"}], loads=[], material={"yield_strength": "300 MPa"})
    z = np.linspace(0.05, 0.35, 200001)
    diameter, moment = 0.02 + 0.05 * z, np.where(z < 0.2, z - 0.05, 0.35 - z) / 2
    stress = np.max(moment * 32 * diameter / (np.pi * (diameter**4 - 0.012**4)))
    assert result["stations.p.limit_load"] == pytest.approx(300e6 / stress, rel=1e-4)


def test_a_rating_of_the_catalogue_counts():
    result = run("failure", **on({"bearing": "61804", "free": ["axial", "tilt"]}, loads=[{"station": "p", "force": "500 N"}]))
    assert result["stations.p.limit_load"] == pytest.approx(2 * bearings.bearing("61804").static_rating, rel=1e-6)


def test_the_lines_of_a_unit_load_are_those_of_its_direction():
    """Aslant as straight down; on rigid bearings those that are wide and resist tilting stay so."""
    held = [b | {"tilt_stiffness": "2e4 N m/rad", "width": "20 mm"} for b in UNIFORM["bearings"]]
    slant, down = (run("flexibility", bearings=held, analysis={"direction": angle}).tables["unit_load"] for angle in ("30 deg", "-90 deg"))
    rigid = [b | {"radial_stiffness": "rigid"} for b in held]
    stiff = run("flexibility", bearings=rigid, analysis={"direction": "30 deg"}).tables["unit_load"]
    for name in ("p", "q", "p.rigid", "q.rigid"):
        assert slant[name].data == pytest.approx(down[name].data, rel=1e-9, abs=1e-18)
    assert slant["q.rigid"].data == pytest.approx(stiff["q"].data, rel=1e-7, abs=1e-16)


def test_flexibilities_of_unlike_size_are_no_reason_to_withhold_the_stiffness():
    """Condition 2e5 once both are scaled; 1e13 as they are."""
    delta = np.array([[1.0, (1 - 1e-5) * 1e-4], [(1 - 1e-5) * 1e-4, 1e-8]]) * 1e-6
    assert dw.shafts.stiffness(delta, ("p", "q")) @ delta == pytest.approx(np.eye(2), abs=1e-3)
    with pytest.raises(dw.InputError, match="two stations move together"):
        dw.shafts.stiffness(np.array([[1.0, 1e-4], [1e-4, 1e-8]]) * 1e-6, ("p", "q"))


def test_moving_one_station_leaves_the_other_alone():
    result = run("sensitivities", stations=[{"name": "p", "position": "120 mm"}, {"name": "q", "position": "250 mm"}])
    assert result["sensitivity.p.p.stations.q.position"] == pytest.approx(0.0, abs=1e-9)
    a, b, flex = 0.07, 0.23, 3 * E * I * SPAN  # delta = a^2 b^2/flex + (b^2 + a^2)/(k l^2)
    delta = a**2 * b**2 / flex + (a**2 + b**2) / (4e7 * SPAN**2)
    slope = (2 * a * b**2 - 2 * a**2 * b) / flex + (2 * a - 2 * b) / (4e7 * SPAN**2)
    assert result["sensitivity.p.p.stations.p.position"] == pytest.approx(slope * 0.12 / delta, rel=1e-8)


def test_a_station_on_a_bearing_has_no_distance_from_it():
    result = run("sensitivities", stations=[{"name": "p", "position": "50 mm"}, {"name": "q", "position": "250 mm"}])
    distances = {str(name) for name in result.tables["sensitivities"]["parameter"].data if name.startswith("distance.")}
    assert len(distances) == 2 and {"distance.q-B"} < distances < {"distance.q-B", "distance.A-q", "distance.p-q"}


def test_modulus_and_stiffnesses_sum_to_minus_one_on_rolling_bearings_and_tilt_springs():
    tilt = [b | {"radial_stiffness": "rigid", "axial_stiffness": None, "tilt_stiffness": "2e4 N m/rad"} for b in UNIFORM["bearings"]]
    pair = on({"geometry": ANGULAR, "preload": "200 N"})
    pair["bearings"][1]["carries"] = "left"
    for changes in ({"bearings": tilt}, pair):
        result = run("sensitivities", loads=[{"station": "q", "force": "200 N"}], **changes)
        for names in ("p.p", "p.q", "q.q"):
            parts = [result[f"sensitivity.{names}.{name}"] for name in ("youngs_modulus", "bearings.stiffness")]
            assert sum(parts) == pytest.approx(-1.0, abs=1e-7) and abs(parts[1]) > 1e-3


# -- frequencies ---------------------------------------------------------------------------------------------------------------


def preloaded_pair(*carries):
    """Two angular-contact bearings, an asymmetric shaft."""
    changes = on({"geometry": ANGULAR, "preload": "200 N"}, loads=[{"position": "300 mm", "force": "100 N"}])
    for bearing, way in zip(changes["bearings"], carries, strict=True):
        bearing["carries"] = way
    return changes


def test_modes_on_mirrored_bearings_are_those_of_the_flexibility_they_have():
    """Massless shaft on the tangents of the loaded bearings, by the flexibility and by the modes of a shaft that weighs next to nothing."""
    result = run(
        "flexibility", "modes", **preloaded_pair("right", "left"), material={"density": "0.001 kg/m^3"}, analysis={"direction": "-90 deg"}
    )
    wanted = result["massless_modes.1.frequency"]
    across = [result[f"modes.{n}.frequency"] for n in (1, 2)]
    assert min(abs(f / wanted - 1) for f in across) < 1e-4


def test_the_speed_is_checked_against_the_whirl_with_the_shaft():
    disc = [UNIFORM["stations"][0], UNIFORM["stations"][1] | {"polar_inertia": "0.05 kg m^2", "diametral_inertia": "0.03 kg m^2"}]
    result = run("modes", stations=disc, drive={"speed": "600 rpm"})
    assert result["critical_speeds.forward.1"] > 1.001 * result["critical_speeds.backward.1"]
    assert result.check("critical_speed").value == pytest.approx(result["critical_speeds.forward.1"] / (20 * np.pi), rel=1e-9)


def test_a_station_without_mass_leaves_the_massless_shaft_out():
    stations = [UNIFORM["stations"][0], {"name": "q", "position": "400 mm"}]
    assert not [name for name in run("flexibility", "modes", stations=stations).values if name.startswith("massless")]


def test_shapes_are_one_at_their_largest():
    """Also where the supports are not round and a mode lies aslant or across."""
    result = run("modes", **on({"geometry": BALLS}, loads=[{"station": "p", "force": "500 N", "angle": "-90 deg"}]))
    table = result.tables["modes"]
    for number in (1, 2, 3):
        shape = table[f"mode_{number}"].data
        assert shape.max() == pytest.approx(1.0, rel=1e-12) and shape.min() > -1 - 1e-9
    one, two = table["mode_1"].data, table["mode_2"].data  # the same bow in either plane
    assert one @ two > 0.99 * np.linalg.norm(one) * np.linalg.norm(two)


# -- rolling bearings ----------------------------------------------------------------------------------------------------------


def test_a_rolling_bearing_in_its_tables_is_the_bearing_alone():
    """Under a force that lies along no axis of symmetry."""
    free = on(
        {"geometry": BALLS, "free": ["axial", "tilt"]},
        loads=[{"station": "p", "force": "500 N", "angle": "-80 deg"}],
        analysis={"direction": "0 deg"},
    )
    result = run("statics", "rolling", **free)
    way = np.array([np.cos(np.radians(-80)), np.sin(np.radians(-80))])
    alone = bearings.solve(bearings.BallBearing(**BALLS), force=[*(250 * way), 0, 0, 0])
    assert result["bearings.A.stiffness.tangent"] == pytest.approx(way @ alone.stiffness[:2, :2] @ way, rel=1e-6)
    assert result["bearings.A.stiffness.secant"] == pytest.approx(250 / (way @ alone.displacement[:2]), rel=1e-6)
    for key, freedom in (("axial", 2), ("tilt_x", 3), ("tilt_y", 4)):
        assert result[f"bearings.A.stiffness.{key}"] == pytest.approx(alone.stiffness[freedom, freedom], rel=1e-5)
    table, n = result.tables["elements.A"], 12
    assert table["load"].data == pytest.approx([*alone.element_loads, alone.element_loads[0]], abs=1e-4)
    assert table["inner_pressure"].data[:n] == pytest.approx(alone.pressures[:, 0], rel=1e-5, abs=1e3)
    assert table["outer_pressure"].data[:n] == pytest.approx(alone.pressures[:, 1], rel=1e-5, abs=1e3)
    assert np.diff(table["angle"].data) == pytest.approx(np.full(n, 2 * np.pi / n))
    assert result["bearings.A.loaded_elements"] == np.sum(alone.element_loads > 0) < n
    heaviest = table["angle"].data[np.argmax(alone.element_loads)]
    assert np.cos(heaviest - np.radians(-80)) > np.cos(np.pi / n)
    assert result["bearings.A.static_safety"] == pytest.approx((4200e6 / alone.pressures.max()) ** 3, rel=1e-6)


def test_rollers_are_safe_by_the_square_of_the_pressure():
    result = run("statics", "rolling", **on({"roller_geometry": ROLLERS}, loads=[{"station": "p", "force": "500 N"}]))
    assert result["bearings.A.static_safety"] == pytest.approx((4000e6 / result["bearings.A.max_pressure"]) ** 2, rel=1e-9)
    assert result.check("static_safety.A").value == result["bearings.A.static_safety"]


def test_the_curve_of_a_bearing_has_its_tangent_and_its_secant():
    result = run("statics", "rolling", **on({"geometry": BALLS, "free": ["axial", "tilt"]}, loads=[{"station": "p", "force": "500 N"}]))
    curve = {name: result.tables["curve.A"][name].data for name in ("load", "displacement", "tangent", "secant")}
    assert curve["secant"] == pytest.approx(curve["load"] / curve["displacement"], rel=1e-12)
    assert curve["load"][[0, -1]] == pytest.approx([0.02 * 250, 4 * 250], rel=1e-6)
    assert curve["tangent"] / curve["secant"] == pytest.approx(np.full(25, 1.5), rel=5e-3)


def test_the_curve_of_an_angular_bearing_takes_the_axial_force_along():
    result = run("statics", "rolling", **preloaded_pair("right", "left"))
    curve, at = result.tables["curve.A"], 20
    reaction = [-result.tables["reactions"][f"reaction_{key}"].data[0] for key in "xyz"]
    factor = curve["load"].data[at] / np.hypot(*reaction[:2])
    alone = bearings.solve(bearings.BallBearing(**ANGULAR), force=[*(factor * np.array(reaction)), 0, 0], held=("tilt_x", "tilt_y"))
    assert curve["displacement"].data[at] == pytest.approx(-alone.displacement[1], rel=1e-4)


def test_what_a_bearing_has_to_say_is_told():
    loose = {"name": "C", "position": "200 mm", "geometry": BALLS, "radial_clearance": "60 um"}
    result = run("statics", "rolling", bearings=[*UNIFORM["bearings"], loose], loads=[{"station": "q", "force": "20 N"}])
    assert any("bearing 'C' carries no load" in finding for finding in result.findings)
    changes = on({"geometry": ANGULAR, "carries": "right"}, loads=[{"station": "p", "force": "100 N", "axial_force": "-300 N"}])
    told = run("statics", "rolling", **changes).findings
    assert any("bear on the side that an angular-contact bearing does not have" in finding for finding in told)
    assert not any("carries no load" in finding for finding in told)


# -- the other routes ----------------------------------------------------------------------------------------------------------

SKEW = {
    "segments": [
        {"length": "90 mm", "diameter": "25 mm", "bore": "8 mm"},
        {"length": "120 mm", "diameter": "30 mm", "end_diameter": "40 mm", "bore": "20 mm"},
        {"length": "110 mm", "diameter": "28 mm"},
    ],
    "bearings": [
        {"name": "B", "position": "170 mm", "radial_stiffness": "9e7 N/m"},
        {"name": "C", "position": "290 mm", "radial_stiffness": "2e7 N/m", "tilt_stiffness": "4e3 N m/rad"},
        {"name": "A", "position": "40 mm", "radial_stiffness": "4e7 N/m"},
    ],
    "stations": [{"name": "p", "position": "0 mm"}, {"name": "q", "position": "230 mm"}],
    "loads": [
        {"position": "120 mm", "force": "300 N", "angle": "20 deg", "moment": "40 N m", "moment_angle": "70 deg"},
        {"position": "100 mm", "torque": "9 N m"},
        {"position": "300 mm", "torque": "-9 N m"},
    ],
    "line_loads": [{"start": "100 mm", "end": "250 mm", "force": "2 N/mm", "end_force": "9 N/mm", "angle": "-50 deg"}],
    "gravity": ["3 m/s^2", "-9.81 m/s^2", "0 m/s^2"],
}


@pytest.mark.parametrize("theory", ["timoshenko", "euler-bernoulli"])
def test_loads_and_reactions_alone_give_the_deflection_of_everything(theory):
    """Forces, couples, spread loads and weight, bearings in any order: agreement to rounding, and limits that would tell a difference."""
    model = dw.build(dw.Shaft(**SKEW, analysis={"theory": theory}))
    rows = list(verify(model, dw.run(model.spec, only=("statics",))))
    assert {name for name, *_ in rows} >= {
        "sum of the reactions along x",
        "moment of the reactions, y",
        "stations.p.deflection_x",
        "stations.q.deflection_y",
    }
    for name, ours, other, _, limit, _ in rows:
        assert abs(ours - other) <= limit and limit < 1e-4 * abs(ours), name


def test_integrals_agree_with_the_flexibility_within_limits_that_matter():
    plain = SKEW | {"bearings": [{k: v for k, v in b.items() if k != "tilt_stiffness"} for b in SKEW["bearings"]]}
    for theory in ("timoshenko", "euler-bernoulli"):
        model = dw.build(dw.Shaft(**plain, analysis={"theory": theory}))
        rows = list(_flexibility(model, dw.run(model.spec, only=("flexibility",))))
        assert len(rows) == 3
        for name, ours, other, _, limit, _ in rows:
            assert abs(ours - other) <= limit and limit < 1e-6 * abs(ours), name


def test_a_bearing_alone_is_checked_within_a_limit_that_matters():
    model = dw.build(spec(**on({"geometry": BALLS}, loads=[{"station": "q", "force": "500 N", "angle": "-70 deg"}])))
    rows = [row for row in verify(model, dw.run(model.spec, only=("statics",))) if row[0].startswith("bearings.")]
    assert len(rows) == 4
    for name, ours, other, _, limit, _ in rows:
        assert abs(ours - other) <= limit and limit < 1e-4 * abs(ours), name


def test_a_couple_on_a_cantilever_by_the_integrals():
    """Right of a clamped place a couple bends the shaft by x^2/2EI, a force by x^3/6EI."""
    shaft = dw.build(spec()).shaft
    assert moment_integrals.influence(shaft, 0.3, 0.1, couple=True) == pytest.approx(-(0.2**2) / (2 * E * I), rel=1e-12)
    assert moment_integrals.influence(shaft, 0.3, 0.1) == pytest.approx(0.2**3 / (6 * E * I), rel=1e-12)


# -- solid ---------------------------------------------------------------------------------------------------------------------


def test_shoulders_and_steps_of_the_bore_are_allowed_more():
    def allowed(*pieces):
        return solid_check.allowed_difference(
            dw.shafts.Shaft(tuple(dw.shafts.Section(0.1, *piece) for piece in pieces), E, 0.3, 7850.0, ())
        )

    assert allowed((0.02, 0.03, 0.0), (0.03, 0.03, 0.0)) == solid_check.ALLOWED
    assert allowed((0.03, 0.02, 0.0), (0.03, 0.03, 0.0)) == solid_check.AT_SHOULDERS
    assert allowed((0.03, 0.03, 0.0), (0.03, 0.03, 0.01)) == solid_check.AT_SHOULDERS


def test_bands_of_the_solid_are_the_bearings():
    held = [UNIFORM["bearings"][0] | {"width": "12 mm"}, UNIFORM["bearings"][1] | {"radial_stiffness": "rigid"}]
    model = dw.build(spec(bearings=held, analysis={"solid_band": "3 mm", "direction": "-90 deg"}))
    at_rest = dw.shafts.apply_loads(model.shaft, model.loads).equilibrium
    seats = solid_check.bearing_bands(at_rest, model.direction, model.spec.analysis.solid_band)
    assert seats == ((0.05, 0.012, pytest.approx(4e7)), (0.35, 0.003, np.inf))
    wide = [b | {"width": w} for b, w in zip(held, ("12 mm", "3 mm"), strict=True)]
    wanted = run("flexibility", bearings=wide, analysis={"direction": "-90 deg"}).arrays["flexibility"].values
    assert solid_check.beam_on_bands(model.shaft, seats, model.places, model.direction) == pytest.approx(wanted, rel=1e-9)


@pytest.mark.needs_fe
def test_beam_and_solid_are_compared_over_both_diagonals():
    """A stiff place between the bearings beside a soft one on the overhang."""
    result = run(
        "solid",
        bearings=[b | {"radial_stiffness": "rigid", "width": "4 mm"} for b in UNIFORM["bearings"]],
        stations=[{"name": "p", "position": "70 mm"}, {"name": "q", "position": "200 mm"}],
        analysis={"theory": "timoshenko"},
    )
    beam, found = (result.arrays[name].values for name in ("solid.beam", "solid.flexibility"))
    apart = np.abs(beam - found) / np.sqrt(np.outer(np.diag(found), np.diag(found)))
    assert found[1, 1] > 2 * found[0, 0] and apart.max() > 1.5 * (np.abs(beam - found) / found.max()).max()
    assert result["solid.deviation"] == pytest.approx(apart.max(), rel=1e-9) == result.check("solid").value
