"""Supports from soft to rigid: one limit, reached from one side; what balances, what is small, what has no mass."""

import numpy as np
import pytest

import drivewright as dw
from drivewright import shafts
from drivewright.mechanisms.shaft.build import build
from drivewright.shafts import audit

pytestmark = pytest.mark.property

DECADES = [6, 9, 12, 13, 18, 20, 23, 40, 100, 160, 300]
GEOMETRY = {"balls": 12, "ball_diameter": "3.572 mm", "pitch_diameter": "26 mm"}
PLACES = {"A": "56.5 mm", "B": "136.5 mm"}


def shaft(bearing, **changes):
    """The two-bearing shaft of the examples, both bearings with these keys."""
    tables = {
        "segments": [{"length": "200 mm", "diameter": "20 mm"}, {"length": "140 mm", "diameter": "20 mm", "end_diameter": "15 mm"}],
        "bearings": [{"name": name, "position": place} | bearing for name, place in PLACES.items()],
        "stations": [{"name": "m1", "position": "0 mm", "mass": "3 kg"}, {"name": "m2", "position": "245 mm", "mass": "8 kg"}],
        "loads": [{"station": "m2", "force": "500 N"}, {"station": "m1", "axial_force": "40 N"}],
    }
    return dw.Shaft(**(tables | changes))


def springs(stiffness):
    return {"radial_stiffness": stiffness, "axial_stiffness": "1e7 N/m"}


def housed(stiffness):
    return {"geometry": GEOMETRY, "housing_stiffness": stiffness, "housing_axial_stiffness": stiffness}


def axial(stiffness):
    return {"radial_stiffness": "3e7 N/m", "axial_stiffness": stiffness}


KEYS = (
    "stations.m2.displacement",
    "stations.m1.displacement",
    "bearings.A.radial_force",
    "flexibility.m1.m1",
    "flexibility.m2.m2",
    "modes.1.frequency",
    "modes.2.frequency",
    "axial_modes.1.frequency",
    "critical_speeds.forward.1",
)


@pytest.mark.parametrize("kind", [pytest.param(springs, marks=pytest.mark.slow), pytest.param(housed, marks=pytest.mark.slow), axial])
def test_stiff_becomes_rigid_from_one_side(kind):
    """1e6 ... 1e300 N/m: every number goes one way, and by 1/k; from 1e18 N/m on it is the rigid one to 1e-9."""
    only = ("statics", "flexibility", "modes")
    rigid = dw.run(shaft(kind("rigid")), only=only)
    keys = [key for key in KEYS if key in rigid.values]
    found = np.array([[dw.run(shaft(kind(f"1e{n} N/m")), only=only)[key] for key in keys] for n in DECADES])
    off = found / [rigid[key] for key in keys] - 1
    assert len(keys) >= 8 and np.abs(off[0]).max() > 0.1
    assert np.all(np.abs(off[DECADES.index(18) :]) < 1e-9)
    assert np.all(np.abs(off[1:]) <= np.abs(off[:-1]) + 1e-10)
    late, soft = off[DECADES.index(12)], off[DECADES.index(13)]
    seen = np.abs(late) > 1e-7
    assert np.any(seen) and late[seen] / soft[seen] == pytest.approx(10, rel=0.01)


def cantilever(tilt):
    support = shafts.Support("A", 0.0, (np.inf, np.inf, np.inf, tilt, tilt))
    return shafts.Shaft(
        (shafts.Section(0.3, 0.02, 0.02),), 206e9, 0.3, 7850.0, (support,), (shafts.Station("end", 0.3, 2.0),), shafts.EULER_BERNOULLI
    )


@pytest.mark.parametrize("power", [3, 6, 12, 20, 100, 300, np.inf])
def test_a_stiff_tilt_spring_is_a_clamp(power):
    """F L^3/3EI + F L^2/k at the end, and the frequency of the mass there; k to infinity is the cantilever."""
    tilt, stiff = 10.0**power, 206e9 * np.pi / 64 * 0.02**4
    one = cantilever(tilt)._replace(density=0.0)
    loaded = shafts.apply_loads(one, shafts.ShaftLoads((shafts.ShaftLoad(0.3, (0.0, -100.0, 0.0)),)))
    soft = 0.3**3 / 3 / stiff + 0.3**2 / tilt
    assert -loaded.equilibrium.u[-5] == pytest.approx(100 * soft, rel=1e-10)
    assert loaded.equilibrium.reactions[0, 3] == pytest.approx(-100 * 0.3, rel=1e-12)
    bending, _ = shafts.modes(loaded.equilibrium, 2)
    assert bending.frequencies == pytest.approx([np.sqrt(1 / 2.0 / soft) / 2 / np.pi], rel=1e-9)


def test_the_compiled_batch_meets_the_single_shaft_at_every_stiffness():
    stiffness = 10.0 ** np.array([*DECADES, np.inf])
    many, carried = shafts.flexibilities(
        [[0.1, 0.24]],
        [[0.02, 0.025]],
        [[0.0565, 0.1365, 0.3]],
        np.repeat(stiffness[:, None], 3, 1),
        [[0.0, 0.245]],
        206e9,
        0.3,
        reactions=True,
    )
    diagonal = np.diagonal(many, axis1=1, axis2=2)
    assert np.all(np.diff(diagonal, axis=0) <= 0) and np.all(np.abs(diagonal[DECADES.index(20) :] / diagonal[-1] - 1) < 1e-9)
    assert carried.sum(axis=1) == pytest.approx(1.0, abs=1e-12)
    for number in range(len(stiffness)):
        supports = [shafts.Support(str(z), z, (stiffness[number],) * 2 + (0.0,) * 3) for z in (0.0565, 0.1365, 0.3)]
        one = shafts.Shaft((shafts.Section(0.1, 0.02, 0.02), shafts.Section(0.24, 0.025, 0.025)), 206e9, 0.3, 7850.0, tuple(supports))
        system = shafts.assemble(one, (0.0, 0.245))
        found = shafts.flexibility(shafts.solve(system, shafts.nodal_forces(system, ())), (0.0, 0.245), (0.0, -1.0))
        assert found.delta == pytest.approx(many[number], rel=1e-10, abs=0)
        assert found.reactions == pytest.approx(carried[number], abs=1e-10)


def test_the_displacement_in_a_stiff_spring_is_its_force_over_its_stiffness():
    for power in (8, 20, 200):
        found = dw.run(shaft(springs(f"1e{power} N/m")), only=("statics",))
        for name in PLACES:
            exact = found[f"bearings.{name}.reaction"] / 10.0**power
            assert found[f"bearings.{name}.displacement"] == pytest.approx(exact, rel=1e-9, abs=0)


def test_the_shares_of_stiff_springs_are_their_compliance():
    """r_A r_A'/k_A, to the last power of ten."""
    for power in (8, 20, 200):
        found = dw.run(shaft(springs(f"1e{power} N/m")), only=("flexibility",)).arrays
        shares, pressed = found["flexibility.shares"], found["reactions.unit_load"].values
        for row, name in enumerate(PLACES):
            part = shares.values[shares.labels[0].index(name)]
            assert part == pytest.approx(np.outer(pressed[row], pressed[row]) / 10.0**power, rel=1e-9)


@pytest.mark.parametrize("freedom", ["axial_stiffness", "tilt_stiffness"])
def test_a_stiff_freedom_hides_no_difference_between_the_planes(freedom):
    """A shaft in its play is stiff downwards and soft sideways, whatever holds it along its axis or against tilting."""
    unit = {"axial_stiffness": "N/m", "tilt_stiffness": "N m/rad"}[freedom]
    keys = ("modes.1.frequency", "modes.2.frequency", "critical_speeds.forward.1", "critical_speeds.backward.1")
    found = []
    for value in ("1e13", "1e17", "1e100"):
        play = {"radial_stiffness": "3e7 N/m", "radial_clearance": "10 um", freedom: f"{value} {unit}"}
        result = dw.run(shaft(play, loads=[{"station": "m2", "force": "500 N"}]), only=("statics", "modes"))
        found.append([result[key] for key in keys])
    assert found[0][1] > 1.01 * found[0][0]
    for other in found[1:]:
        assert other == pytest.approx(found[0], rel=1e-6)


def test_a_bearing_that_tilts_more_easily_one_way_is_not_round():
    """Clamped by 1e20 N/m and tilt springs of 3 and 6 kN m/rad: two lowest modes, each that of its own plane."""

    def lowest(*tilts):
        support = shafts.Support("A", 0.0, (1e20, 1e20, 1e20, *tilts))
        one = cantilever(1.0)._replace(supports=(support,))
        return shafts.modes(shafts.apply_loads(one, shafts.ShaftLoads()).equilibrium, 2)[0].frequencies

    soft, stiff, both = lowest(3e3, 3e3)[0], lowest(6e3, 6e3)[0], lowest(6e3, 3e3)
    assert both == pytest.approx([soft, stiff], rel=1e-9) and stiff > 1.1 * soft


# -- rigid as a level ----------------------------------------------------------------------------------------------------------


def test_rigid_is_a_level_of_a_sweep():
    spec = shaft({"radial_stiffness": "1e7 N/m"}, loads=[{"station": "m2", "force": "500 N"}])
    study = dw.sweep(spec, {"bearings.A.radial_stiffness": ["1e7 N/m", "rigid", "1e300 N/m"]})
    found = study["stations.m2.deflection"]
    assert list(study.table["status"].to_pylist()) == ["complete"] * 3
    assert study.table["bearings.A.radial_stiffness"].to_pylist() == ["10000 N/mm", "rigid", "1e+297 N/mm"]
    assert found[1] == pytest.approx(found[2], rel=1e-12) and found[1] < 0.9 * found[0]


def test_rigid_is_a_level_in_a_file_of_points(tmp_path):
    (tmp_path / "points.csv").write_text("bearings.A.radial_stiffness [N/mm],segments.0.diameter [mm]\n1e4,20\nrigid,22\n")
    spec = shaft({"radial_stiffness": "1e7 N/m"}, loads=[{"station": "m2", "force": "500 N"}])
    study = dw.sweep(spec.replace(study={"points": str(tmp_path / "points.csv"), "analyses": ["statics"]}))
    alone = spec.replace(
        bearings=[
            {"name": "A", "position": "56.5 mm", "radial_stiffness": "rigid"},
            {"name": "B", "position": "136.5 mm", "radial_stiffness": "1e7 N/m"},
        ],
        segments=[{"length": "200 mm", "diameter": "22 mm"}, {"length": "140 mm", "diameter": "20 mm", "end_diameter": "15 mm"}],
    )
    assert study["stations.m2.deflection"][1] == dw.run(alone, only=("statics",))["stations.m2.deflection"]


def test_a_range_does_not_end_at_rigid():
    with pytest.raises(dw.errors.SpecError, match="upper.*'rigid'"):
        dw.sweep(
            shaft(
                {"radial_stiffness": "1e7 N/m"},
                study={"vary": [{"key": "bearings.A.radial_stiffness", "lower": "1e6 N/m", "upper": "rigid", "steps": 3}]},
            )
        )


# -- what balances -------------------------------------------------------------------------------------------------------------


LOADED = {
    "gravity": ["1 m/s^2", "-9.81 m/s^2", "0.5 m/s^2"],
    "loads": [{"station": "m2", "force": "500 N", "angle": "30 deg", "axial_force": "40 N", "moment": "7 N m", "moment_angle": "50 deg"}],
    "line_loads": [{"start": "20 mm", "end": "210 mm", "force": "3 N/mm", "end_force": "1 N/mm", "angle": "100 deg"}],
    "gears": [
        {"name": "g", "position": "300 mm", "pitch_diameter": "40 mm", "torque": "9 N m", "helix_angle": "15 deg"},
        {"name": "h", "position": "20 mm", "pitch_diameter": "60 mm", "torque": "-9 N m", "mesh_angle": "200 deg"},
    ],
}


@pytest.mark.parametrize(
    "bearing",
    [
        springs("3e7 N/m"),
        springs("1e250 N/m"),
        springs("rigid"),
        housed("1e8 N/m"),
        springs("3e7 N/m") | {"tilt_stiffness": "3e3 N m/rad"},
        springs("3e7 N/m") | {"width": "8 mm"},
    ],
)
def test_forces_and_moments_balance_under_loads_of_every_kind(bearing):
    result = dw.run(shaft(bearing, **LOADED), only=("statics", "flexibility"))
    for name in ("equilibrium", "equilibrium.unit_loads"):
        assert result.check(name).ok and result.check(name).value < 1e-10


@pytest.mark.parametrize("freedom, size", [(0, 3.0), (1, 3.0), (2, 3.0), (3, 0.5), (4, 0.5)])
def test_the_audit_sees_a_reaction_that_is_off(freedom, size):
    spec = shaft(springs("3e7 N/m") | {"tilt_stiffness": "3e3 N m/rad"}, **LOADED)
    model = build(spec)
    loaded = shafts.apply_loads(model.shaft, model.loads)
    wrong = loaded.equilibrium.reactions.copy()
    wrong[1, freedom] += size
    off = shafts.imbalance(loaded._replace(equilibrium=loaded.equilibrium._replace(reactions=wrong)), model.loads)
    assert shafts.imbalance(loaded, model.loads) < 1e-11 and off > 1e-4


def test_the_audit_by_hand():
    """500 N down at 0.2 m of 0.4 m, carried by 300 N and 200 N at the ends: 100 N m less 80 N m are left of 500 + 500 N."""
    rows = np.array([[0, -500.0, 0, 0.2 * 500, 0], [0, 300.0, 0, 0, 0], [0, 200.0, 0, -0.4 * 200, 0]])
    assert audit.residual(rows, 0.4) == pytest.approx(20 / 0.4 / (1000 + 180 / 0.4), rel=1e-12)
    assert audit.residual(np.zeros((1, 5)), 0.4) == 0


def test_a_spring_behind_a_play_that_is_too_stiff_for_its_digits_is_told():
    """A gap of 1e-5 m has its last digit at 1e-21 m, which 1e16 N/m turns into forces."""
    play = {"radial_clearance": "10 um"}
    for stiffness, ok in (("1e12 N/m", True), ("1e16 N/m", False), ("1e20 N/m", False)):
        result = dw.run(shaft({"radial_stiffness": stiffness} | play, loads=[{"station": "m2", "force": "500 N"}]), only=("statics",))
        assert result.check("equilibrium").ok == ok


# -- what is small -------------------------------------------------------------------------------------------------------------


def test_a_shaft_that_sinks_farther_than_a_tenth_of_its_length_fails():
    """1000 N midway between two springs of 1e-6 N/m: 5e8 m without any slope."""
    middle = {
        "loads": [{"position": "96.5 mm", "force": "1000 N"}],
        "segments": [{"length": "193 mm", "diameter": "20 mm"}],
        "stations": [{"name": "m", "position": "96.5 mm", "mass": "1 kg"}],
    }
    result = dw.run(shaft({"radial_stiffness": "1e-6 N/m"}, **middle))
    assert result["stations.m.deflection"] == pytest.approx(5e8, rel=1e-6)
    assert not result.check("small_deflections").ok and result.check("small_slopes").ok
    for stiffness, ok in (("2.55e4 N/m", False), ("2.65e4 N/m", True)):  # 0.1 * 193 mm under 500 N each: 2.59e4 N/m
        assert dw.run(shaft({"radial_stiffness": stiffness}, **middle), only=("statics",)).check("small_deflections").ok == ok


def test_a_displacement_along_the_axis_counts_too():
    spec = shaft({"radial_stiffness": "3e7 N/m", "axial_stiffness": "1 N/m"}, loads=[{"station": "m1", "axial_force": "1 N"}])
    check = dw.run(spec, only=("statics",)).check("small_deflections")
    assert check.value == pytest.approx(0.5 / 0.34, rel=1e-6) and not check.ok


# -- what has no mass ----------------------------------------------------------------------------------------------------------


def test_a_massless_shaft_swings_with_its_stations():
    """K = inv(flexibility) with the masses; torsion of two inertias: w^2 = G Ip/l (1/I + 1/J)."""
    inertia = [
        {"name": "m1", "position": "0 mm", "mass": "3 kg", "polar_inertia": "0.01 kg m^2"},
        {"name": "m2", "position": "200 mm", "mass": "8 kg", "polar_inertia": "0.03 kg m^2"},
    ]
    result = dw.run(
        shaft(
            {"radial_stiffness": "3e7 N/m"}, material={"density": "0 kg/m^3"}, stations=inertia, loads=[{"station": "m2", "force": "500 N"}]
        )
    )
    for n in (1, 2):
        assert result[f"modes.{n}.frequency"] == pytest.approx(result[f"massless_modes.{n}.frequency"], rel=1e-9)
    twist = 206e9 / 2.6 * np.pi / 32 * 0.02**4 / 0.2
    assert result["torsional_modes.1.frequency"] == pytest.approx(np.sqrt(twist * (1 / 0.01 + 1 / 0.03)) / 2 / np.pi, rel=1e-9)
    assert "modes.3.frequency" not in result.values and "torsional_modes.2.frequency" not in result.values


@pytest.mark.parametrize("power", [3, 5, 6, 7, 8, 10, 16, 60])
def test_a_massless_shaft_on_three_springs_swings_by_its_flexibility(power):
    """Held more than enough, each spring works against the others and the shaft: w^2 of K = inv(flexibility) and the masses."""
    bearings = [
        {"name": name, "position": place, "radial_stiffness": f"{factor}e{power} N/m"}
        for name, place, factor in (("A", "30 mm", 1), ("B", "136.5 mm", 3), ("C", "300 mm", 0.7))
    ]
    result = dw.run(
        shaft({}, bearings=bearings, material={"density": "0 kg/m^3"}, loads=[{"station": "m2", "force": "500 N"}]),
        only=("statics", "flexibility", "modes"),
    )
    for n in (1, 2):
        assert result[f"modes.{n}.frequency"] == pytest.approx(result[f"massless_modes.{n}.frequency"], rel=1e-9)


def test_light_shafts_approach_the_massless_one():
    heavy = [
        {"name": "m1", "position": "0 mm", "mass": "3 kg", "polar_inertia": "1 kg m^2", "diametral_inertia": "0.5 kg m^2"},
        {"name": "m2", "position": "245 mm", "mass": "8 kg", "polar_inertia": "1 kg m^2"},
    ]
    keys = ("modes.1.frequency", "modes.3.frequency", "torsional_modes.1.frequency", "critical_speeds.forward.1")
    none, *light = (
        [
            dw.run(
                shaft(
                    {"radial_stiffness": "3e7 N/m"},
                    material={"density": f"{d} kg/m^3"},
                    stations=heavy,
                    loads=[{"station": "m2", "force": "500 N"}],
                ),
                only=("modes",),
            )[key]
            for key in keys
        ]
        for d in ("0", "1e-12", "1e-6", "1e-3")
    )
    for found in light:
        assert found == pytest.approx(none, rel=1e-6)


def test_nothing_to_swing_is_told():
    still = dw.run(shaft({"radial_stiffness": "3e7 N/m"}, material={"density": "0 kg/m^3"}, stations=[], loads=[]), only=("modes",))
    assert any("nothing that can move has a mass" in finding for finding in still.findings)
