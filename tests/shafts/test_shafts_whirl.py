"""Whirl, Campbell diagram, critical speeds with damping and stability: closed forms of rigid rotors, limits and symmetries."""

import numpy as np
import pytest
from rotors import CASES, matrix, our_rotor, our_shaft

from drivewright import shafts
from drivewright.errors import InputError

MASS, POLAR, DIAMETRAL, HALF = 12.0, 0.09, 0.4, 0.25  # of a rigid rotor between two bearings
STIFF, DAMPING = 2e6, 300.0  # of each bearing
SPEED = 500.0
STIFF_SHAFT = {"modulus": 1e20, "density": 0.0, "theory": "rayleigh", "sections": [[2 * HALF, 0.05, 0.0]]}


def rigid(stiffness=None, damping=None, **changes):
    """A rigid rotor in the middle of a massless shaft that does not bend."""
    stiffness, damping = stiffness or matrix(STIFF), damping or matrix(0.0)
    bearings = [[place, stiffness, damping] for place in (0.0, 2 * HALF)]
    discs = [[HALF, MASS, POLAR, DIAMETRAL]]
    case = STIFF_SHAFT | {"discs": discs, "bearings": bearings, "unbalance": [HALF, 1e-4], "speed": SPEED}
    return our_rotor(case | changes, 4)[1]


def conical(speed, stiffness=2 * STIFF * HALF**2, damping=0.0):
    """Both roots of  I_d l^2 + (c - i I_p s) l + k = 0 of the angle of a whirl, with the positive imaginary part first."""
    roots = np.roots([DIAMETRAL, damping - 1j * POLAR * speed, stiffness])
    return roots[np.argsort(-roots.imag)]


@pytest.mark.analytical
@pytest.mark.parametrize("speed", [0.0, 500.0, 5000.0])
def test_a_rigid_rotor_swings_on_a_cylinder_and_on_a_cone(speed):
    modes = shafts.whirl_modes(rigid(), speed, 2)
    ahead, back = conical(speed)
    cylinder = np.sqrt(2 * STIFF / MASS)
    assert np.sort(modes.frequency[modes.forward]) == pytest.approx(np.sort([cylinder, ahead.imag]), rel=1e-7)
    assert np.sort(modes.frequency[~modes.forward]) == pytest.approx(np.sort([cylinder, -back.imag]), rel=1e-7)
    assert np.all(modes.sense == pytest.approx(np.where(modes.forward, 1, -1), abs=1e-9))
    assert not modes.damping_ratio.any()


@pytest.mark.analytical
def test_damping_of_a_rigid_rotor():
    modes = shafts.whirl_modes(rigid(damping=matrix(DAMPING)), SPEED, 2)
    roots = np.concatenate([np.roots([MASS, 2 * DAMPING, 2 * STIFF]), conical(SPEED, damping=2 * DAMPING * HALF**2)])
    wanted = roots[np.lexsort([roots.imag, np.abs(roots.imag)])]
    frequency, ratio = np.abs(wanted.imag), -wanted.real / np.abs(wanted)
    assert modes.frequency == pytest.approx(frequency, rel=1e-7)
    assert modes.damping_ratio == pytest.approx(ratio, rel=1e-6)
    assert modes.log_decrement == pytest.approx(2 * np.pi * -wanted.real / frequency, rel=1e-6)


@pytest.mark.analytical
@pytest.mark.parametrize("cross", [1e5, -1e5])
def test_cross_coupling_feeds_the_whirl_that_goes_its_way(cross):
    """m l^2 + c l + k - i q = 0 for z = x + iy, where q makes a force along x of a displacement along y."""
    damping = 100.0
    modes = shafts.whirl_modes(rigid(matrix(STIFF, cross=cross), matrix(damping)), SPEED, 2)
    roots = np.roots([MASS, 2 * damping, 2 * STIFF - 2j * cross])
    for forward, root in ((True, roots[roots.imag > 0][0]), (False, roots[roots.imag < 0][0])):
        at = int(np.argmin(np.abs(modes.frequency - abs(root.imag)) + (modes.forward != forward)))
        assert modes.frequency[at] == pytest.approx(abs(root.imag), rel=1e-7)
        assert modes.damping_ratio[at] == pytest.approx(-root.real / abs(root), rel=1e-6)
    unstable = modes.damping_ratio < 0
    assert unstable.any() and np.all(modes.forward[unstable] == (cross > 0))


@pytest.mark.analytical
def test_two_planes_of_a_rotor_without_gyroscopic_moments():
    """Lines along x and y: the lower counts as backward."""
    rotor = rigid(matrix(STIFF, 0.5 * STIFF), discs=[[HALF, MASS, 0.0, 0.0]])
    modes = shafts.whirl_modes(rotor, SPEED, 2)
    assert modes.frequency == pytest.approx(np.sqrt(np.array([1.0, 2.0]) * STIFF / MASS), rel=1e-7)
    assert modes.forward.tolist() == [False, True] and np.all(np.abs(modes.sense) < 1e-6)


@pytest.mark.analytical
def test_what_creeps_back_is_no_vibration():
    """c > 2 sqrt(k m): the cylinder creeps, the cone still swings."""
    heavy = 1.1 * np.sqrt(2 * STIFF * MASS)
    modes = shafts.whirl_modes(rigid(damping=matrix(heavy)), 0.0, 2)
    assert len(modes.frequency) == 0 or not np.any(np.abs(modes.damping_ratio) > 0.9999995)
    light = shafts.whirl_modes(rigid(damping=matrix(0.9 * np.sqrt(2 * STIFF * MASS))), 0.0, 2)
    assert len(light.frequency) >= 2


# -- reduction and meshes ------------------------------------------------------------------------------------------------------


@pytest.mark.property
@pytest.mark.parametrize("name", CASES)
def test_few_modes_are_enough(name):
    """The usual coordinates against five times as many."""
    few, many = (shafts.whirl_modes(our_rotor(CASES[name], kept=kept)[1], CASES[name]["speed"], 2) for kept in (12, 60))
    assert few.frequency == pytest.approx(many.frequency, rel=2e-5)
    assert few.damping_ratio == pytest.approx(many.damping_ratio, rel=1e-3, abs=1e-9)


@pytest.mark.property
@pytest.mark.parametrize("name", ["isotropic", "cross-coupled"])
def test_one_plane_for_both_is_two_planes(name):
    """The complex coordinate of round supports against the two planes of supports that are not, by a trace."""
    case = CASES[name]
    (xx, xy), (yx, yy) = case["bearings"][0][1]
    skewed = [[place, ((xx, xy), (yx, yy * (1 + 1e-7))), damping] for place, _, damping in case["bearings"]]
    one, two = our_rotor(case)[1], our_rotor(case | {"bearings": skewed})[1]
    assert one.whirls and not two.whirls
    for speed in (100.0, case["speed"]):
        a, b = (shafts.whirl_modes(each, speed, 2) for each in (one, two))
        assert a.frequency == pytest.approx(b.frequency, rel=1e-6)
        assert a.damping_ratio == pytest.approx(b.damping_ratio, rel=1e-4, abs=1e-9)
        assert a.forward.tolist() == b.forward.tolist() and b.sense == pytest.approx(a.sense, abs=1e-5)


@pytest.mark.property
def test_turning_the_other_way_swaps_the_senses():
    rotor = our_rotor(CASES["anisotropic"])[1]
    one, other = (shafts.whirl_modes(rotor, way * 300.0, 2) for way in (1, -1))
    assert one.frequency == pytest.approx(other.frequency, rel=1e-9)
    assert one.sense == pytest.approx(-other.sense, abs=1e-7)


@pytest.mark.property
def test_a_world_in_other_units_has_the_same_damping_ratios():
    """Lengths ten times, stiffness and modulus as in another system of units: ratios stay, frequencies scale."""
    case, long, heavy = CASES["cross-coupled"], 10.0, 3.0  # units of length and mass; time stays
    scaled = case | {
        "modulus": case["modulus"] * heavy / long,
        "density": case["density"] * heavy / long**3,
        "sections": [[long * each for each in section] for section in case["sections"]],
        "discs": [[long * z, heavy * m, heavy * long**2 * p, heavy * long**2 * d] for z, m, p, d in case["discs"]],
        "bearings": [[long * z, heavy * np.array(k), heavy * np.array(c)] for z, k, c in case["bearings"]],
        "unbalance": [long * case["unbalance"][0], heavy * long * case["unbalance"][1]],
    }
    scaled["bearings"] = [[z, tuple(map(tuple, k)), tuple(map(tuple, c))] for z, k, c in scaled["bearings"]]
    one, other = (shafts.whirl_modes(our_rotor(each)[1], case["speed"], 2) for each in (case, scaled))
    assert one.frequency == pytest.approx(other.frequency, rel=1e-6)
    assert one.damping_ratio == pytest.approx(other.damping_ratio, rel=1e-5)


@pytest.mark.property
def test_a_damper_behind_a_soft_housing_hardly_damps():
    """The damper acts between shaft and ring: what the housing takes, it does not feel."""
    case, found = CASES["isotropic"], []
    for housing in (np.inf, 1e6, 1e5):
        supports = [
            shafts.spring_support(f"{n}", place, 1e6, damping=matrix(500.0), housing=(housing, np.inf))
            for n, (place, *_) in enumerate(case["bearings"])
        ]
        stations = tuple(shafts.Station(f"{n}", place, *rest) for n, (place, *rest) in enumerate(case["discs"]))
        shaft = shafts.Shaft((shafts.Section(1.5, 0.05, 0.05),), 211e9, 0.3, 7810.0, tuple(supports), stations)
        rest = shafts.refined_equilibrium(shafts.apply_loads(shaft, shafts.ShaftLoads()).equilibrium, 0.05)
        found.append(shafts.whirl_modes(shafts.reduced_rotor(rest), 100.0, 1).damping_ratio[0])
    assert found[0] > 1.5 * found[1] > 5 * found[2] > 0


@pytest.mark.analytical
def test_a_damper_and_a_housing_in_series():
    """Rigid rotor: the dynamic stiffness of a bearing k + i w c in series with its housing h, met at the root itself."""
    housing, damping = 3e6, 200.0
    supports = [
        shafts.spring_support(f"{place}", place, STIFF, damping=matrix(damping), housing=(housing, np.inf)) for place in (0.0, 2 * HALF)
    ]
    station = shafts.Station("disc", HALF, MASS, POLAR, DIAMETRAL)
    shaft = shafts.Shaft((shafts.Section(2 * HALF, 0.05, 0.05),), 1e20, 0.3, 0.0, tuple(supports), (station,), shafts.EULER_BERNOULLI)
    modes = shafts.whirl_modes(shafts.reduced_rotor(shafts.apply_loads(shaft, shafts.ShaftLoads()).equilibrium), SPEED, 2)
    left = []
    for frequency, ratio in zip(modes.frequency, modes.damping_ratio, strict=True):
        root = frequency * (1j - ratio / np.sqrt(1 - ratio**2))
        both = 2 / (1 / housing + 1 / (STIFF + root * damping))
        left.append(abs(MASS * root**2 + both) / abs(both))
    assert np.sum(np.array(left) < 1e-5) == 2  # the cylinder, with the shaft and against it


# -- over the speed ------------------------------------------------------------------------------------------------------------


@pytest.mark.property
@pytest.mark.parametrize("name", ["isotropic", "anisotropic", "skewed"])
def test_a_campbell_diagram_has_the_modes_of_every_speed(name):
    rotor, speeds = our_rotor(CASES[name])[1], np.linspace(0, 600, 13)
    diagram = shafts.campbell(rotor, speeds, 2)
    for k, speed in enumerate(speeds):
        assert np.sort(diagram.frequency[k]) == pytest.approx(shafts.whirl_modes(rotor, speed, 4).frequency[:4], rel=1e-9)
    assert np.all(np.abs(np.diff(diagram.frequency, axis=0)) < 0.1 * diagram.frequency[:-1])


@pytest.mark.analytical
def test_critical_speeds_of_a_rigid_rotor():
    """Cylinder: the speed is sqrt(2k/m) both ways; cone: s^2 (I_d -+ I_p) = 2 k a^2."""
    rotor = rigid()
    found = shafts.damped_critical_speeds(rotor, shafts.campbell(rotor, np.linspace(0, 1500, 31), 2))
    cylinder, cone = np.sqrt(2 * STIFF / MASS), np.sqrt(2 * STIFF * HALF**2 / (DIAMETRAL - np.array([1, -1]) * POLAR))
    assert np.sort([each.speed for each in found]) == pytest.approx(np.sort([cylinder, cylinder, *cone]), rel=1e-7)
    assert {each.forward for each in found if each.speed == pytest.approx(cone[0])} == {True}


@pytest.mark.analytical
def test_a_critical_speed_with_damping_is_where_the_damped_frequency_is_the_speed():
    rotor = rigid(damping=matrix(3 * DAMPING))
    for each in shafts.damped_critical_speeds(rotor, shafts.campbell(rotor, np.linspace(0, 1500, 31), 2)):
        modes = shafts.whirl_modes(rotor, each.speed, 2)
        assert np.min(np.abs(modes.frequency - each.speed)) < 1e-7 * each.speed
        assert np.min(np.abs(modes.damping_ratio - each.damping_ratio)) < 1e-12
        assert each.damping_ratio > 0


@pytest.mark.analytical
def test_the_speed_from_which_a_whirl_grows():
    """A cross-coupling that the damping just bears at the frequency of the cylinder: q = c w.  The cone, whose frequency rises with the
    speed, bears it; going against the shaft it sinks, and is fed by none."""
    cylinder = np.sqrt(2 * STIFF / MASS)
    speeds = np.linspace(0, 1500, 31)
    for part, stable in ((0.99, True), (1.01, False)):
        rotor = rigid(matrix(STIFF, cross=part * DAMPING * cylinder), matrix(DAMPING))
        threshold = shafts.stability_threshold(rotor, shafts.campbell(rotor, speeds, 2))
        assert (threshold is None) == stable
    rotor = rigid(matrix(STIFF, cross=-1.2 * DAMPING * conical(0.0)[0].imag), matrix(DAMPING))
    assert shafts.stability_threshold(rotor, shafts.campbell(rotor, speeds, 2)) == 0.0


@pytest.mark.analytical
@pytest.mark.parametrize("at", [800.0, 837.0])
def test_a_threshold_on_a_speed_and_between_two_is_found(at):
    """The backward cone slows down as the rotor turns faster: from c w_b = q on it grows."""
    slowed = -conical(at)[1].imag
    rotor = rigid(matrix(STIFF, cross=-DAMPING * slowed), matrix(DAMPING), discs=[[HALF, 1e-3 * MASS, POLAR, DIAMETRAL]])
    found = shafts.stability_threshold(rotor, shafts.campbell(rotor, np.linspace(0, 1500, 16), 1))
    assert found == pytest.approx(at, rel=1e-7)


@pytest.mark.error
def test_a_shaft_without_any_mass_is_refused():
    with pytest.raises(InputError, match="nothing that can move has a mass"):
        rigid(discs=[[HALF, 0.0, 0.0, 0.0]])


@pytest.mark.error
@pytest.mark.parametrize(
    "keys, what", [({"damping": matrix(1e12)}, "damping"), ({"stiffness": matrix(STIFF, cross=1e14)}, "cross-coupling")]
)
def test_what_drowns_all_else_is_refused(keys, what):
    with pytest.raises(InputError, match=rf"the {what} of its bearings is .* times the stiffness"):
        rigid(**keys)


@pytest.mark.property
def test_dampers_that_hardly_move_hold_a_shaft_like_rigid_bearings():
    """The slow creep of the dampers hides no whirl."""
    case, found = CASES["isotropic"], []
    for damping in (1e6, 1e8):
        bearings = [[place, stiffness, matrix(damping)] for place, stiffness, _ in case["bearings"]]
        found.append(shafts.whirl_modes(our_rotor(case | {"bearings": bearings})[1], 100.0, 1))
    shaft = our_shaft(case)
    rigid_supports = tuple(support._replace(stiffness=(np.inf, np.inf, 0.0, 0.0, 0.0)) for support in shaft.supports)
    rest = shafts.apply_loads(shaft._replace(supports=rigid_supports), shafts.ShaftLoads()).equilibrium
    wanted = shafts.whirl_modes(shafts.reduced_rotor(shafts.refined_equilibrium(rest, 0.025)), 100.0, 1).frequency
    assert found[1].frequency == pytest.approx(wanted, rel=1e-5)
    assert found[1].damping_ratio == pytest.approx(found[0].damping_ratio / 100, rel=1e-2)


@pytest.mark.property
def test_the_rotor_turns_at_the_frequency_of_a_bent_shaft_at_rest():
    equilibrium, rotor = our_rotor(CASES["isotropic"])
    wanted = 2 * np.pi * shafts.modes(equilibrium, 2)[0].frequencies
    assert shafts.whirl_modes(rotor, 0.0, 2).frequency[::2] == pytest.approx(wanted, rel=1e-6)
