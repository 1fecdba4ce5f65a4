"""How the flexibility follows dimensions: by the unit states alone, against central differences of whole shafts that are changed."""

import numpy as np
import pytest

import drivewright as dw
from drivewright import shafts
from drivewright.bearings import BallBearing, RollerBearing
from drivewright.shafts import beam as beams
from drivewright.shafts.assembly import assemble, nodal_forces
from drivewright.shafts.linearised import tangent_shaft
from drivewright.shafts.piece_slopes import piece_slopes
from drivewright.shafts.sections import compliance_integrals_of, log_slopes, shear_area

pytestmark = pytest.mark.analytical

MODULUS, POISSON = 206e9, 0.3
DIRECTION = shafts.transverse_direction(np.radians(30))
# A cylinder, a hollow cone, a hollow cylinder; their ends stand at 0.09 and 0.24 m.
SECTIONS = (shafts.Section(0.09, 0.02, 0.02), shafts.Section(0.15, 0.025, 0.035, 0.012), shafts.Section(0.16, 0.03, 0.03, 0.008))
PLACES = {"s": 0.052, "p": 0.13, "q": 0.235, "r": 0.355}
A, B = 0.061, 0.33
BALLS = BallBearing(
    balls=12, ball_diameter="3.572 mm", pitch_diameter="26 mm", inner_conformity=0.515, outer_conformity=0.53, youngs_modulus="206 GPa"
)
ANGULAR = BallBearing(balls=14, ball_diameter="5 mm", pitch_diameter="30 mm", contact_angle="25 deg", youngs_modulus="206 GPa")
ROLLERS = RollerBearing(rollers=15, roller_diameter="4 mm", roller_length="8 mm", pitch_diameter="30 mm", youngs_modulus="206 GPa")


def springs(**changes):
    return shafts.spring_support("A", A, 4e7, **changes), shafts.spring_support("B", B, np.inf, 1e7, 1e3)


SUPPORTS = {
    "springs": springs(),
    "springs over a width": (shafts.spring_support("A", A, 4e7, width=0.02), shafts.spring_support("B", B, 8e7, 1e7, width=0.03)),
    "ball bearings": (shafts.rolling_support("A", A, BALLS), shafts.rolling_support("B", B, BALLS)),
    "preloaded angular contact": (
        shafts.rolling_support("A", A, ANGULAR, preload=200.0, width=0.012),
        shafts.rolling_support("B", B, ANGULAR, preload=200.0, mirrored=True, width=0.06),
    ),
    "rollers and balls": (shafts.rolling_support("A", A, ROLLERS), shafts.rolling_support("B", B, BALLS)),
    "in housings, one free to tilt": (
        shafts.rolling_support("A", A, BALLS, housing=(1e8, np.inf)),
        shafts.rolling_support("B", B, ANGULAR, free=("tilt",)),
    ),
}


def shaft(supports, places=PLACES, sections=SECTIONS, shear=shafts.COWPER):
    stations = tuple(shafts.Station(name, place) for name, place in places.items())
    return shafts.Shaft(sections, MODULUS, POISSON, 7850.0, supports, stations, shear)


def loaded(changed):
    """At rest under a skew load with an axial part."""
    place = changed.stations[1].position
    loads = shafts.ShaftLoads((shafts.ShaftLoad(place, (*(500 * DIRECTION), 200.0 * any(s.law for s in changed.supports))),))
    return shafts.apply_loads(changed, loads).equilibrium


def flexibility(at_rest):
    return shafts.flexibility(at_rest, [s.position for s in at_rest.model.beam.shaft.stations], DIRECTION)


def slopes(at_rest):
    return {name: slope for name, _, slope in shafts.flexibility_slopes(at_rest, flexibility(at_rest), DIRECTION)}


def delta(changed):
    system = assemble(changed)
    return flexibility(shafts.solve(system, 0 * nodal_forces(system, ()))).delta


def changed(base, parameter, factor):
    """A shaft with one dimension multiplied; bearings keep their tangents."""
    kind, name, *_ = parameter.split(".")
    if kind == "segments":
        parts = list(base.sections)
        parts[int(name)] = parts[int(name)]._replace(start=factor * parts[int(name)].start, end=factor * parts[int(name)].end)
        return base._replace(sections=tuple(parts))
    if kind == "stations":
        return base._replace(stations=tuple(s._replace(position=factor * s.position) if s.name == name else s for s in base.stations))
    left, right = (next(f.position for f in (*base.supports, *base.stations) if f.name == end) for end in name.split("-"))

    def moved(z):
        return z + (factor - 1) * np.clip(z - left, 0.0, right - left)

    ends = moved(base.ends)
    return base._replace(
        sections=tuple(part._replace(length=length) for part, length in zip(base.sections, np.diff(ends), strict=True)),
        supports=tuple(s._replace(position=float(moved(s.position))) for s in base.supports),
        stations=tuple(s._replace(position=float(moved(s.position))) for s in base.stations),
    )


def difference(base, parameter, step=1e-3):
    """d delta/d ln(parameter) by central differences of two steps, their errors of second order taken out."""
    one, two = (
        (delta(changed(base, parameter, np.exp(h))) - delta(changed(base, parameter, np.exp(-h)))) / (2 * h) for h in (step, 2 * step)
    )
    return (4 * one - two) / 3


def assert_equal_for(delta, ours, other, tolerance):
    scale = np.sqrt(np.diag(delta))
    np.testing.assert_allclose(ours / np.outer(scale, scale), other / np.outer(scale, scale), rtol=0, atol=tolerance)


@pytest.mark.parametrize("shear", [shafts.COWPER, 0.85, shafts.EULER_BERNOULLI])
@pytest.mark.parametrize("supports", SUPPORTS)
def test_every_slope_is_that_of_the_changed_shaft(supports, shear):
    at_rest = loaded(shaft(SUPPORTS[supports], shear=shear))
    base, ours = tangent_shaft(at_rest), slopes(at_rest)
    dimensions = [name for name in ours if name.startswith(("segments", "distance", "stations"))]
    assert len(dimensions) == 3 + 5 + 4
    for name in dimensions:
        assert_equal_for(delta(base), ours[name], difference(base, name), 3e-8)


@pytest.mark.parametrize("place", [0.08, 0.1], ids=["on the right", "on the left"])
def test_a_width_that_ends_at_a_step_slides_over_it(place, monkeypatch):
    """The node there cannot be moved with both; what the division of the width leaves open is of second order."""
    supports = (shafts.spring_support("A", place, 2e7, width=0.02), shafts.spring_support("B", B, 8e7, 1e7))
    apart = []
    for divisions in (4, 16):
        monkeypatch.setattr(beams, "BAND", divisions)
        at_rest = loaded(shaft(supports))
        base, ours = tangent_shaft(at_rest), slopes(at_rest)
        off = [ours[name] - difference(base, name) for name in ("distance.s-A", "distance.A-p")]
        apart.append(np.abs(off).max() / np.diag(delta(base)).max())
    assert 1e-7 < apart[0] < 1e-3
    assert apart[1] < 0.1 * apart[0]


def test_sensitivities_of_runs_are_those_of_whole_runs():
    def run(diameter=1.0, station=1.0, stretch=1.0, modulus=1.0):
        beyond = 200 * (stretch - 1)
        spec = dw.Shaft(
            material={"youngs_modulus": f"{206 * modulus} GPa"},
            segments=[
                {"length": "90 mm", "diameter": f"{25 * diameter} mm"},
                {"length": f"{310 + beyond} mm", "diameter": "30 mm", "bore": "10 mm"},
            ],
            bearings=[
                {"name": "A", "position": "60 mm", "radial_stiffness": "4e7 N/m"},
                {"name": "B", "position": f"{330 + beyond} mm", "radial_stiffness": "rigid"},
            ],
            stations=[{"name": "p", "position": f"{130 * station} mm"}, {"name": "q", "position": f"{390 + beyond} mm"}],
        )
        return dw.run(spec, only=("sensitivities",))

    result, step = run(), 1e-4
    parameters = {
        "diameter": "segments.0.diameter", "station": "stations.p.position", "stretch": "distance.p-B", "modulus": "youngs_modulus"
    }  # fmt: skip
    for key, parameter in parameters.items():
        more, less = (run(**{key: float(np.exp(sign * step))}) for sign in (1, -1))
        for pair in ("p.p", "p.q", "q.q"):
            ratio = more[f"flexibility.{pair}"] / less[f"flexibility.{pair}"]
            assert result[f"sensitivity.{pair}.{parameter}"] == pytest.approx(np.log(ratio) / (2 * step), abs=1e-6)


# -- where the flexibility has a kink -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("place", [0.09, A], ids=["at a step of the diameter", "in a bearing"])
@pytest.mark.parametrize("supports", ["springs", "springs over a width", "ball bearings"])
def test_a_station_that_shares_its_place_has_the_mean_of_both_sides(place, supports):
    at_rest = loaded(shaft(SUPPORTS[supports], PLACES | {"q": place}))
    base, ours = tangent_shaft(at_rest), slopes(at_rest)["stations.q.position"]
    here = delta(base)

    def side(step):
        """One-sided difference of second order."""
        one, two = (delta(changed(base, "stations.q.position", np.exp(n * step))) for n in (1, 2))
        return (4 * one - two - 3 * here) / (2 * step)

    left, right = side(-1e-4), side(1e-4)
    assert_equal_for(here, ours, (left + right) / 2, 2e-6)
    assert np.abs(left - right).max() > 1e-4 * np.abs(ours).max()


def test_without_shear_a_station_in_a_bearing_has_no_kink():
    at_rest = loaded(shaft(SUPPORTS["springs"], PLACES | {"q": A}, shear=shafts.EULER_BERNOULLI))
    base = tangent_shaft(at_rest)
    assert_equal_for(delta(base), slopes(at_rest)["stations.q.position"], difference(base, "stations.q.position", 1e-4), 1e-6)


# -- exact sums ----------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("supports", ["springs", "ball bearings", "rollers and balls", "in housings, one free to tilt"])
def test_solid_diameters_together_are_the_shares(supports):
    """Of a solid shaft bending is proportional to 1/D^4, shear and tension to 1/D^2."""
    solid = tuple(section._replace(bore=0.0) for section in SECTIONS)
    at_rest = loaded(shaft(SUPPORTS[supports], sections=solid))
    found, ours = flexibility(at_rest), slopes(at_rest)
    shares = dict(zip(found.names, found.shares, strict=True))
    wanted = -4 * shares["bending"] - 2 * shares["shear"] - 2 * shares.get("tension", 0.0)
    assert ("tension" in shares) == (supports in ("ball bearings", "in housings, one free to tilt"))
    assert_equal_for(found.delta, sum(ours[f"segments.{n}.diameter"] for n in range(3)), wanted, 1e-12)


def test_in_another_scale_it_is_the_same_shaft():
    """On rigid bearings delta E is a number over a length: all lengths and diameters together change it by -1."""
    solid = tuple(section._replace(bore=0.0) for section in SECTIONS)
    supports = tuple(shafts.spring_support(name, place, np.inf) for name, place in (("A", 0.0), ("B", B)))
    at_rest = loaded(shaft(supports, PLACES | {"end": 0.4}, solid))
    found = flexibility(at_rest).delta
    together = sum(slope for name, slope in slopes(at_rest).items() if name.startswith(("segments", "distance")))
    assert_equal_for(found, together, -found, 1e-11)


def test_slopes_are_symmetric_and_mirrored_with_the_shaft():
    length = sum(section.length for section in SECTIONS)
    turned = tuple(section._replace(start=section.end, end=section.start) for section in SECTIONS[::-1])
    mirrored = [s._replace(position=length - s.position, mirrored=True) for s in SUPPORTS["ball bearings"]]
    places = {name: length - place for name, place in PLACES.items()}
    load = shafts.ShaftLoad(places["p"], (*(500 * DIRECTION), -200.0))
    other = slopes(shafts.apply_loads(shaft(tuple(mirrored), places, turned), shafts.ShaftLoads((load,))).equilibrium)
    at_rest = loaded(shaft(SUPPORTS["ball bearings"]))
    found, ours = flexibility(at_rest).delta, slopes(at_rest)
    for slope in ours.values():
        np.testing.assert_allclose(slope, slope.T, rtol=0, atol=1e-12 * np.abs(slope).max())
    for n in range(3):
        assert_equal_for(found, ours[f"segments.{n}.diameter"], other[f"segments.{2 - n}.diameter"], 1e-7)
    for one, two in zip("sApqB", "ApqBr", strict=True):
        assert_equal_for(found, ours[f"distance.{one}-{two}"], other[f"distance.{two}-{one}"], 1e-7)
    for name, place in PLACES.items():
        moved = ours[f"stations.{name}.position"] / place
        assert_equal_for(found, moved * length, -other[f"stations.{name}.position"] / (length - place) * length, 1e-7)


# -- a piece of shaft ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("shear", [shafts.COWPER, 0.85, shafts.EULER_BERNOULLI])
def test_slopes_of_a_piece_are_differences_of_its_compliances(shear):
    base = beams.beam(shaft(SUPPORTS["springs"], shear=shear))
    together, by = piece_slopes(base)
    even = np.tile([1.0, 0.0, 0.0], (len(base.pieces), 1))

    def compliances(pieces):
        longer = 1 / beams._rod_stiffnesses(base._replace(pieces=pieces))[0]
        sag = beams.clamped_load_displacement(pieces, even, base.shaft)
        return beams.clamped_flexibility(pieces, base.shaft)[0], sag, longer

    for ours, theirs in zip(together, compliances(base.pieces), strict=True):
        np.testing.assert_allclose(ours, theirs, rtol=1e-12)
    for column in range(3):
        step = np.zeros((len(base.pieces), 4))
        step[:, column] = 1e-4 * base.pieces[:, column]
        pairs = zip(compliances(base.pieces + step), compliances(base.pieces - step), strict=True)
        far = zip(compliances(base.pieces + 2 * step), compliances(base.pieces - 2 * step), strict=True)
        for (more, less), (most, least), ours in zip(pairs, far, by, strict=True):
            h = step[:, column].reshape(-1, *(1,) * (more.ndim - 1))
            np.testing.assert_allclose(ours[column], (8 * (more - less) - (most - least)) / (12 * h), rtol=1e-9)


def test_logarithmic_slopes_of_a_section():
    diameter, bore, step = np.array([0.03, 0.05]), np.array([0.0, 0.02]), 1e-6
    bend, shear, area = log_slopes(diameter, bore, POISSON, shafts.COWPER)
    for ours, function in (
        (shear, lambda d: shear_area(d, bore, POISSON, shafts.COWPER)),
        (area, lambda d: shear_area(d, bore, POISSON, 1.0)),
        (bend, lambda d: 1 / compliance_integrals_of(np.stack([np.ones(2), d, d, bore], axis=1), 1.0, POISSON, shafts.COWPER)[:, 0]),
    ):
        np.testing.assert_allclose(ours, np.log(function(diameter + step) / function(diameter - step)) / (2 * step), rtol=1e-7)
    assert np.all(shear_area(diameter, bore, POISSON, shafts.EULER_BERNOULLI) == np.inf)
