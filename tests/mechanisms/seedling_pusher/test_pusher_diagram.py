"""The rod's programme as a diagram: its courses are the motion of the rod, and the keys of each border move that border alone."""

import numpy as np
import pytest

from drivewright import registry, runner
from drivewright.report.programme import pack_programme
from drivewright.studio.opening import preset
from drivewright.units import BY_NAME

PUSH = registry.mechanism("seedling-pusher")


def built(name="default", **changes):
    design = preset("seedling-pusher", name).changed({f"push.{key}": text for key, text in changes.items()})
    model = runner.build(design.spec())
    return model, PUSH.programme(model)


def numbers(model):
    """{key: number [SI]} of the table push."""
    return {f"push.{name}": getattr(model.spec.push, name) for name in ("stroke", "end", "rise", "hold", "retraction")}


def borders(model, diagram):
    """Carrier angles at which the segments begin [rad]."""
    origin = diagram.origin.constant + sum(factor * numbers(model)[key] for key, factor in diagram.origin.factors.items())
    return origin + np.cumsum([0.0, *(segment.angle for segment in diagram.segments[:-1])])


@pytest.mark.parametrize("name", ["default", "design-a", "paper-104"])
def test_the_courses_are_the_travel_of_the_rod_over_the_carrier_angle(name):
    model, diagram = built(name)
    assert sum(segment.angle for segment in diagram.segments) == pytest.approx(diagram.cycle) == pytest.approx(2 * np.pi)
    for start, segment in zip(borders(model, diagram), diagram.segments, strict=True):
        inside = segment.course[:, 1:-1]
        travel = model.pair.travel(start + inside[0])
        assert inside[1] == pytest.approx(travel.d0, abs=1e-12)
        assert inside[2] == pytest.approx(travel.d1, abs=1e-10)
    rises = [segment.fixed.sense * model.spec.push.stroke if segment.fixed.rise else 0.0 for segment in diagram.segments]
    assert rises == pytest.approx([segment.rise for segment in diagram.segments])


@pytest.mark.parametrize("name", ["default", "design-a"])
@pytest.mark.parametrize("border", range(4))
def test_the_keys_of_a_border_move_it_and_no_other(name, border):
    model, diagram = built(name)
    moved, before, step = diagram.segments[border].fixed.border, borders(model, diagram), np.radians(0.25)
    changes = {key: numbers(model)[key] + by * step for key, by in moved.items()}
    texts = {key.removeprefix("push."): BY_NAME["angle"].text(value) for key, value in changes.items()}
    other, after = built(name, **texts)
    expected = before + np.where(np.arange(4) == border, step if moved else 0.0, 0.0)
    assert borders(other, after) == pytest.approx(expected, abs=1e-12)
    assert bool(moved) == (name == "default" or border != 1)  # of a push that ends at the lowest position the end is no number


def test_a_hold_of_no_length_has_its_place():
    _, diagram = built(hold="0 deg")
    assert [segment.angle for segment in diagram.segments] == pytest.approx(np.radians([21, 0, 36, 303]))
    packed = pack_programme(diagram)
    assert packed["segments"][1]["fixed"]["angle"] == "push.hold" and packed["list"] == ""


def test_what_stands_still_is_said():
    assert built()[1].notes == () and built()[1].origin.factors == {"push.end": 1.0, "push.rise": -1.0}
    model, diagram = built("design-a")
    assert "lowest position of the needle tip" in diagram.notes[0]
    assert borders(model, diagram)[1] == pytest.approx(model.arm.lowest)


@pytest.mark.parametrize("law", [choice.name for choice in built()[1].laws])
def test_every_law_offered_makes_a_motion(law):
    _, diagram = built(law=law)
    assert [segment.law for segment in diagram.segments] == [law, "dwell", law, "dwell"]


def test_its_checks_are_checks_of_a_result():
    model, diagram = built()
    result = runner.run(model.spec, only=("cams",), model=model)
    assert set(diagram.checks) <= {check.name for check in result.checks}
