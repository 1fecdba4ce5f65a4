"""Symmetries of the kind `cam`: mirror image, reversed turning, another start of the turn, other units, another scale; pickling."""

import pickle
from functools import cache

import numpy as np
import pytest

import drivewright as dw
from drivewright import registry
from drivewright.mechanisms.cam.spec import CamSpec
from drivewright.spec import document, from_document

pytestmark = pytest.mark.property

MECHANISM = registry.mechanism("cam")
SEGMENTS = [(80, "modified-sine", 1.0), (35, "dwell", None), (60, "cycloidal", -0.4), (95, "polynomial-345", -0.6), (90, "dwell", None)]
LEVER = {"motion": "oscillating", "pivot_distance": 90.0, "arm_length": 62.0}
FACES = {
    "roller": {"face": "roller", "roller_radius": 8.0, "prime_radius": 45.0, "offset": 5.0},
    "knife": {"face": "knife", "prime_radius": 45.0},
    "shoe": {"face": "shoe", "face_radius": 15.0, "face_offset": 2.0, "prime_radius": 60.0},
    "flat": {"face": "flat", "base_radius": 60.0},
    "lever": {"face": "roller", "roller_radius": 8.0, "prime_radius": 45.0, **LEVER},
    "flat lever": {"face": "flat", "base_radius": 50.0, "face_offset": 3.0, **LEVER},
}
RISE = {"lever": "18 deg", "flat lever": "8 deg"}
ONLY = ("motion", "geometry", "profile", "forces", "spring", "vibration")


def spec(name, scale=1.0, segments=SEGMENTS, unit="mm", **more):
    follower = {key: f"{value * scale:.12g} {unit}" if isinstance(value, float) else value for key, value in FACES[name].items()}
    swing = RISE.get(name)

    def rise(part):
        return f"{part * float(swing.split()[0]):.12g} deg" if swing else f"{12 * scale * part:.12g} {unit}"

    programme = [{"angle": f"{a} deg", "law": law, **({"rise": rise(part)} if part else {})} for a, law, part in segments]
    data = {
        "mechanism": "cam",
        "follower": follower,
        "programme": programme,
        "drive": {"speed": "300 rpm"},
        "load": {"mass": "0.6 kg", "force": "12 N"},
        "spring": {"stiffness": "3 N/mm", "preload": "40 N"},
        "vibration": {"natural_frequency": "70 Hz"},
        **more,
    }
    return from_document(data, CamSpec)


def values(chosen):
    return {name: value.value for name, value in dw.run(chosen, only=ONLY).values.items()}


@cache
def base(name):
    """Values of the unchanged design."""
    return values(spec(name))


def same(first, second, **tolerance):
    assert first.keys() == second.keys()
    for name in first:
        assert second[name] == pytest.approx(first[name], **{"rel": 1e-7, "abs": 1e-12, **tolerance}), name


@pytest.mark.parametrize("name", ["roller", "knife", "shoe", "flat"])
def test_clockwise_is_the_mirror_image_of_a_slide(name):
    one, other = spec(name), spec(name, rotation="clockwise")
    same(base(name), values(other))
    points = [MECHANISM.drawings(MECHANISM.build(s))[0].on("profile")[0].points(1e-6) for s in (one, other)]
    mirrored = points[1] * (-1, 1)
    nearest = np.min(np.hypot(*(points[0][:, None] - mirrored[None]).transpose(2, 0, 1)), axis=1)
    assert np.max(nearest) < 1e-3  # knots of the same curve, spread from its other end
    assert not np.allclose(points[0].mean(axis=0), points[1].mean(axis=0), atol=1e-4)


@pytest.mark.parametrize("name", ["roller", "lever"])
def test_the_same_cam_run_backwards(name):
    """Turned the other way through the reversed programme, a cam meets its follower in the same places: only signs change."""
    backwards = [(a, law, -part if part else None) for a, law, part in SEGMENTS[::-1]]
    back = spec(name, segments=backwards, rotation="clockwise")
    if name == "roller":  # the mirrored slide stands on the other side; put it back
        back = back.replace(follower={**document(back)["follower"], "offset": "-5 mm"})
    one, other = base(name), values(back)
    for end, opposite in (("max", "min"), ("min", "max")):
        assert one[f"{end}_pressure_angle"] == pytest.approx(-other[f"{opposite}_pressure_angle"], rel=1e-9)
    for value in ("min_convex_radius", "profile.area", "profile.perimeter", "max_contact_force", "spring.jump_speed"):
        assert one[value] == pytest.approx(other[value], rel=1e-9), value
    assert one["min_convex_radius.at"] == pytest.approx(2 * np.pi - other["min_convex_radius.at"], abs=1e-7)
    assert one["max_torque"] == pytest.approx(-other["min_torque"], rel=1e-9)


@pytest.mark.parametrize("name", ["roller", "flat", "lever"])
def test_another_start_of_the_turn(name):
    """Beginning in the last dwell shifts every place by its angle and nothing else."""
    one, other = dict(base(name)), values(spec(name, segments=SEGMENTS[-1:] + SEGMENTS[:-1]))
    shift = np.radians(SEGMENTS[-1][0])
    for place in [key for key in one if key.endswith(".at") and one[key] > 0 and other[key] > 0]:
        one[place] = (one[place] + shift) % (2 * np.pi)
    places = {key: value for key, value in one.items() if key.endswith(".at")}
    same({k: v for k, v in one.items() if k not in places}, {k: v for k, v in other.items() if k not in places})
    assert sum(value == pytest.approx(other[place], abs=1e-6) for place, value in places.items()) >= len(places) - 2


@pytest.mark.parametrize("name", ["roller", "flat lever"])
def test_other_units_change_nothing(name):
    same(base(name), values(spec(name, 1e-3, unit="m")), rel=1e-10)


@pytest.mark.parametrize("name", FACES)
def test_a_larger_world_has_the_same_angles(name):
    """Lengths times 7 at the same forces per length: stiffness and mass over 7 keep every force."""
    loads = {"load": {"mass": f"{0.6 / 7!r} kg", "force": "12 N"}, "spring": {"stiffness": f"{3 / 7!r} N/mm", "preload": "40 N"}}
    one, other = dw.run(spec(name), only=ONLY).values, dw.run(spec(name, 7.0, **loads), only=ONLY).values
    power = {"m": 1, "m^2": 2, "-": 0, "N": 0, "N m": 1, "m/s": 1, "m/s^2": 1, "m/s^3": 1, "N/m": -1, "Pa": -0.5}
    for key, value in one.items():
        scale = 7.0 ** (0 if value.unit.startswith("rad") else power[value.unit])
        assert other[key].value == pytest.approx(scale * value.value, rel=1e-7, abs=1e-11), key


def test_twice_the_speed_is_four_times_the_acceleration():
    slow, fast = base("lever"), values(spec("lever", drive={"speed": "600 rpm"}))
    assert fast["max_velocity"] == pytest.approx(2 * slow["max_velocity"], rel=1e-12)
    assert fast["max_acceleration"] == pytest.approx(4 * slow["max_acceleration"], rel=1e-12)
    assert fast["max_jerk"] == pytest.approx(8 * slow["max_jerk"], rel=1e-12)
    assert fast["max_roller_speed"] == pytest.approx(2 * slow["max_roller_speed"], rel=1e-12)
    assert fast["spring.jump_speed"] == pytest.approx(slow["spring.jump_speed"], rel=1e-12)


@pytest.mark.parametrize("name", ["roller", "flat lever"])
def test_rigid_follower_is_the_limit_of_a_stiff_one(name):
    """The error of the follower falls with the square of its natural frequency."""
    models = [spec(name, vibration={"natural_frequency": f"{f} Hz", "damping_ratio": 0.2}) for f in (400, 4000)]
    errors = [dw.run(model, only=("vibration",))["vibration.max_error"] for model in models]
    assert np.log10(errors[0] / errors[1]) == pytest.approx(2, abs=0.1)


@pytest.mark.parametrize("closure", ["force", "groove", "conjugate", "yoke"])
def test_model_and_result_are_values(closure):
    more = {"closure": closure, **({"conjugate": {"prime_radius": "66 mm"}} if closure == "conjugate" else {})}
    chosen = spec("flat" if closure == "yoke" else "lever", **more)
    model = MECHANISM.build(chosen)
    MECHANISM.scene(model), MECHANISM.drawings(model), MECHANISM.parts(model)
    assert pickle.loads(pickle.dumps(model)).spec == chosen
    result = dw.run(chosen)
    assert pickle.loads(pickle.dumps(result)).values == result.values
    assert from_document(document(chosen), CamSpec) == chosen
    assert from_document(document(chosen), CamSpec).digest() == chosen.digest()


@pytest.mark.parametrize("name", FACES)
def test_scene_closes_and_touches(name):
    """First and last frame agree; the contact of cam and follower is on both bodies in every frame."""
    model = MECHANISM.build(spec(name))
    scene = MECHANISM.scene(model)
    for body in scene.bodies:
        turn = (body.poses[-1] - body.poses[0]) / (1, 1, 2 * np.pi)
        assert np.allclose(turn[:2], 0, atol=1e-12)
        assert turn[2] == pytest.approx(round(turn[2]), abs=1e-12)
    if not model.tracks[0].flat:
        follower = next(body for body in scene.bodies if body.name == "follower")
        x, y = scene.traces[0].point
        center = follower.poses[:, 0] + 1j * follower.poses[:, 1] + (x + 1j * y) * np.exp(1j * follower.poses[:, 2])
        expected = model.follower.pitch(*model.cycle.at(np.zeros(1, int), np.zeros(1)))
        assert center[0] == pytest.approx(complex(expected.d0[0]), abs=1e-12)
