"""Where the handles of a shaft stand: upon what they change, in the machine frame with z to the right."""

import pytest
from places import EXAMPLES

from drivewright import registry, runner
from drivewright.spec import load

pytestmark = pytest.mark.interface


def handles_of(name):
    """(spec, {key: handle}) of an example."""
    spec = load(EXAMPLES / f"{name}.toml")
    return spec, {handle.key: handle for handle in registry.mechanism("shaft").scene(runner.build(spec)).handles}


@pytest.mark.parametrize("name", ["gearbox_shaft", "spindle"])
def test_segments_follow_each_other_and_their_sizes_stand_upon_their_edges(name):
    spec, found = handles_of(name)
    start = 0.0
    for number, segment in enumerate(spec.segments):
        end = start + segment.length
        length, diameter = found[f"segments.{number}.length"], found[f"segments.{number}.diameter"]
        assert length.point == pytest.approx((end, -(segment.end_diameter or segment.diameter) / 2)) and length.direction == (1.0, 0.0)
        assert start <= diameter.point[0] < end and diameter.point[1] == pytest.approx(segment.diameter / 2)
        assert diameter.direction == (0.0, 0.5)  # half of a diameter is seen above the axis
        start = end
    assert number > 0


def test_bearings_gears_and_loads_stand_at_their_places():
    spec, found = handles_of("gearbox_shaft")
    widest = max(max(segment.diameter, segment.end_diameter or 0.0) for segment in spec.segments)
    assert spec.bearings and spec.gears
    for number, bearing in enumerate(spec.bearings):
        assert found[f"bearings.{number}.position"].point == pytest.approx((bearing.position, 0.0))
    for number, gear in enumerate(spec.gears):
        above, below = found[f"gears.{number}.pitch_diameter"], found[f"gears.{number}.position"]
        assert above.point == pytest.approx((gear.position, gear.pitch_diameter / 2)) and above.direction == (0.0, 0.5)
        assert below.point == pytest.approx((gear.position, -gear.pitch_diameter / 2)) and below.direction == (1.0, 0.0)
    for number, force in enumerate(spec.loads):
        if force.position is not None:
            x, y = found[f"loads.{number}.position"].point
            assert x == pytest.approx(force.position) and y > widest / 2  # clear of the shaft
