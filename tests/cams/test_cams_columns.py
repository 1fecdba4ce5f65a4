"""Followers and extremes of many designs at once: columns of numbers give what each design gives alone."""

from dataclasses import fields, replace

import numpy as np
import pytest

from drivewright import cams
from drivewright.errors import DoesNotAssemble, InputError
from drivewright.motion import Programme, Segment

pytestmark = pytest.mark.property

DESIGNS = 7
FOLLOWERS = {
    "roller on a slide": (cams.TranslatingRound(0.04, 0.008, 0.004), 0.013),
    "roller on an arm": (cams.OscillatingRound(0.04, 0.008, 0.085, 0.062), 0.3),
    "flat face on a slide": (cams.TranslatingFlat(0.04, 0.1, 0.003), 0.013),
    "flat face on a lever": (cams.OscillatingFlat(0.03, 0.085, 0.062, 0.004), 0.2),
}
QUANTITIES = {
    "pressure angle": lambda contact: contact.pressure_angle,
    "pitch curvature": lambda contact: contact.pitch_curvature,
    "sliding": lambda contact: contact.sliding,
    "leverage": lambda contact: contact.leverage,
    "radius": lambda contact: contact.point.abs2(),
}


def cycle(rise):
    turn = [Segment(np.radians(110), "modified-sine", rise), Segment(np.radians(95), "polynomial-345", -rise)]
    rest = 2 * np.pi - sum(segment.angle for segment in turn)
    return cams.Cycle(Programme((*turn, Segment(rest, "dwell"))).function)


def columns_of(follower, spread=0.08):
    """The follower with columns in the place of its lengths, and the followers one by one."""
    random = np.random.default_rng(3)
    names = [each.name for each in fields(follower) if isinstance(getattr(follower, each.name), float)]
    numbers = {name: getattr(follower, name) * random.uniform(1 - spread, 1 + spread, (DESIGNS, 1)) for name in names}
    return replace(follower, **numbers), [
        replace(follower, **{name: float(column[n, 0]) for name, column in numbers.items()}) for n in range(DESIGNS)
    ]


@pytest.mark.parametrize("quantity", QUANTITIES)
@pytest.mark.parametrize("kind", FOLLOWERS)
def test_extremes_of_columns_are_those_of_each_design(kind, quantity):
    follower, rise = FOLLOWERS[kind]
    turn, (many, each) = cycle(rise), columns_of(follower)
    for extreme in (turn.maximum, turn.minimum):
        together = extreme(lambda angle, lift: QUANTITIES[quantity](many.contact(angle, lift)))
        assert together.value.shape == (DESIGNS, 1)
        alone = [extreme(lambda angle, lift, one=one: QUANTITIES[quantity](one.contact(angle, lift))) for one in each]
        np.testing.assert_allclose(together.value[:, 0], [one.value for one in alone], rtol=1e-12, atol=1e-15)
        np.testing.assert_allclose(together.angle[:, 0], [one.angle for one in alone], atol=1e-7)


@pytest.mark.parametrize("kind", FOLLOWERS)
def test_one_design_of_many_that_is_refused_is_named_with_its_own_numbers(kind):
    follower, rise = FOLLOWERS[kind]
    radius = "prime_radius" if hasattr(follower, "prime_radius") else "base_radius"
    radii = np.full((DESIGNS, 1), getattr(follower, radius))
    radii[4] = 1.0 if hasattr(follower, "pivot_distance") else -0.02
    turn, one = cycle(rise), replace(follower, **{radius: float(radii[4, 0])})
    with pytest.raises(DoesNotAssemble) as alone:
        one.contact(*turn.sampled())
    with pytest.raises(DoesNotAssemble) as together:
        replace(follower, **{radius: radii}).contact(*turn.sampled())
    assert str(together.value) == str(alone.value)


@pytest.mark.parametrize("depth", [0.0309, 0.0319, 0.0321, 0.0331])
def test_a_face_is_clear_of_the_axis_exactly_where_trimming_leaves_a_cam_around_it(depth):
    """A roller of 8 mm that falls from 40 mm by a little less, and a little more, than the 32 mm between it and the axis."""
    turn = (Segment(np.pi, "cycloidal", -depth), Segment(np.pi, "cycloidal", depth))
    programme, follower = Programme(turn), cams.TranslatingRound(0.04, 0.008)
    clear = cams.CamTrack("cam", "", follower, follower.contact).clear_of_axis(cams.Cycle(programme.function))
    assert bool(clear) == (depth < 0.032)
    if clear:
        cams.finished_profile(follower, programme)
    else:
        with pytest.raises(InputError, match="no part is left"):
            cams.finished_profile(follower, programme)
