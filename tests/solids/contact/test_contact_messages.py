"""What contact of solids refuses, and with which words; bodies from STEP files."""

import re

import numpy as np
import pytest
from places import ROOT

from drivewright.contact import hertz
from drivewright.errors import InputError
from drivewright.solids.contact import ContactModel, Functional, Link, Pair, SolidBody, press
from drivewright.solids.contact.model import CoarseContact
from drivewright.solids.elastic import FreeBody, Plane
from tests.support.pressed_bodies import NU, SHEET, E, block, quarter_disc

pytestmark = [pytest.mark.error, pytest.mark.needs_fe]
RIGHT = Plane(SHEET)


def lower_block(**held):
    return FreeBody(block((0, 0), (10, 6), 1.5), E, NU, RIGHT, **(held or {"dirichlety": "bottom", "dirichletx": "bottom"}))


def upper_block(gap=0.0, **held):
    return FreeBody(block((1, 6 + gap), (9, 12 + gap), 1.5), E, NU, RIGHT, **held)


def model(upper, lower=None, links=(), region="bottom", reach=1e-4, **more):
    pair = Pair(("upper", region), ("lower", "top"), reach, **more)
    push = Functional("upper", upper.mean("top", (0, -1)))
    shove = Functional("upper", upper.mean("top", (1, 0)))
    return ContactModel({"upper": upper, "lower": lower or lower_block()}, [pair], list(links), {"push": push, "shove": shove})


def test_bodies_that_overlap_are_told_by_how_much_and_where():
    with pytest.raises(InputError, match=r"overlap by 0\.05 mm at \([\d.]+, 5\.95\) mm before any load.*press_fit=True"):
        model(upper_block(-0.05))


def test_a_press_fit_presses_without_a_load():
    lower = FreeBody(block((0, 0), (10, 6), 1.5), E, NU, Plane(SHEET, "stress"), dirichlety="bottom", dirichletx="left")
    upper = FreeBody(block((0, 5.99), (10, 12), 1.5), E, NU, Plane(SHEET, "stress"), dirichlety="top", dirichletx="left")
    state = ContactModel({"u": upper, "l": lower}, [Pair(("u", "bottom"), ("l", "top"), 1e-4, press_fit=True)], [], {}).solve({})
    assert state.pressure[0] == pytest.approx(E * 0.01 / 12.01, rel=5e-3)


def test_bodies_out_of_reach_are_told_how_far_apart_they_are():
    with pytest.raises(InputError, match=r"nothing lies within the reach of 0\.1 mm; .* 0\.3 mm apart"):
        model(upper_block(0.3))


def test_a_body_that_nothing_holds_is_told_with_the_motion():
    with pytest.raises(InputError, match="nothing holds 'upper' against moving along x, and a load drives it there"):
        model(upper_block()).solve({"push": 100.0, "shove": 10.0})


def test_a_motion_that_nothing_holds_and_nothing_drives_is_left_alone():
    state = model(upper_block()).solve({"push": 100.0})
    assert state.force(0)[1] == pytest.approx(100.0, rel=1e-9)


def test_a_load_that_lifts_off_is_refused():
    with pytest.raises(InputError, match="pressure does not keep 'upper' from moving along y, where the loads drive it"):
        model(upper_block()).solve({"push": -100.0})


def test_a_load_that_tips_is_refused_with_the_turn():
    """A push outside the foot tips the block over its edge; the two senses differ."""
    upper = upper_block()
    lower = lower_block()
    turn = Functional("upper", upper.mean("top", (1, 0)))
    stop = Link((Functional("upper", upper.mean("bottom", (1, 0))),))
    push = Functional("upper", upper.mean("top", (0, -1)))
    pair = Pair(("upper", "bottom"), ("lower", "top"), 1e-4)
    made = ContactModel({"upper": upper, "lower": lower}, [pair], [stop], {"push": push, "turn": turn})
    assert made.solve({"push": 100.0, "turn": 10.0}).force(0)[1] == pytest.approx(100.0, rel=1e-6)
    with pytest.raises(InputError, match="pressure does not keep 'upper' from turning, where"):
        made.solve({"push": 100.0, "turn": 200.0})


def test_a_link_holds_it():
    upper = upper_block()
    spring = Link((Functional("upper", upper.mean("top", (1, 0))),), compliance=1e-7)
    state = model(upper, links=[spring]).solve({"push": 1000.0, "shove": 10.0})
    assert state.links == pytest.approx([-10.0], abs=1e-6)
    assert state.travel("shove") == pytest.approx(1e-6, rel=1e-6)


def test_a_stop_pushes_only_after_its_gap():
    upper = upper_block()
    stop = Link((Functional("upper", upper.mean("top", (0, 1))),), one_sided=True, gap=2e-5)
    soft = model(upper, links=[stop])
    free = model(upper).solve({"push": 1000.0}).travel("push")
    touching = soft.solve({"push": 20000.0})
    assert soft.solve({"push": 1000.0}).links == pytest.approx([0.0])
    assert soft.solve({"push": 1000.0}).travel("push") == pytest.approx(free, rel=1e-9)
    assert touching.links[0] > 0
    assert touching.travel("push") == pytest.approx(2e-5, rel=1e-6)


def test_elements_larger_than_half_the_contact_are_told_with_the_size_to_take():
    upper = FreeBody(quarter_disc(1.2, 1, 0.04, 0.2), E, NU, RIGHT, dirichletx="sym")
    lower = FreeBody(quarter_disc(1.2, -1, 0.04, 0.2), E, NU, RIGHT, dirichletx="sym", dirichlety="flat")
    pair = Pair(("upper", "contact"), ("lower", "contact"), 1e-4)
    made = ContactModel({"upper": upper, "lower": lower}, [pair], [], {"push": Functional("upper", upper.mean("flat", (0, -1)))})
    words = r"elements of 0\.04 mm on 'contact' of 'upper' are larger than half the width of the contact, which is .*give elements of"
    with pytest.raises(CoarseContact, match=words) as told:
        made.solve({"push": 0.5})
    assert told.value.size == pytest.approx(0.04, rel=0.2)
    assert told.value.width < 2 * told.value.size
    assert made.solve({"push": 0.5}, narrow=True).force(0)[1] == pytest.approx(0.5)


def test_unknown_names_are_told_with_those_that_there_are():
    with pytest.raises(InputError, match="no load is called 'pull'; there are push, shove"):
        model(upper_block()).solve({"pull": 1.0})
    with pytest.raises(InputError, match="no face of the mesh is called 'side'"):
        model(upper_block(), region="side")


# -- STEP files


@pytest.fixture
def files(tmp_path):
    import netgen.occ as occ

    radius = 10.0
    ball = occ.Sphere(occ.Pnt(0, 0, radius), radius) * occ.Box(occ.Pnt(0, 0, 0), occ.Pnt(radius, radius, radius))
    ball.solids[0].WriteStep(str(tmp_path / "ball.step"))
    occ.Box(occ.Pnt(0, 0, -8), occ.Pnt(8, 8, 0)).WriteStep(str(tmp_path / "block.step"))
    return tmp_path


def ball_and_block(files, force=-125.0, **changes):
    ball = SolidBody(
        files / "ball.step",
        E,
        NU,
        size=2e-3,
        planes=[((0, 4e-3, 6e-3), "x"), ((4e-3, 0, 6e-3), "y")],
        loads=[((1e-3, 1e-3, 10e-3), (0, 0, force))],
    )
    block = SolidBody(
        files / "block.step", E, NU, 2e-3, fixed=[(1e-3, 1e-3, -8e-3)], planes=[((0, 4e-3, -4e-3), "x"), ((4e-3, 0, -4e-3), "y")]
    )
    return {"ball": ball._replace(**changes), "block": block}


@pytest.mark.slow
def test_a_ball_from_a_file_presses_a_block_from_a_file(tmp_path, monkeypatch):
    """The example of the documentation, as written there."""
    examples = re.findall(r"```python\n(.*?)```", (ROOT / "docs/solids_in_contact.md").read_text(), flags=re.DOTALL)
    monkeypatch.chdir(tmp_path)
    told: dict = {}
    for example in examples:
        exec(example, told)
    pressed, points, pressure = told["pressed"], told["points"], told["pressure"]
    half_width = float((3 * 8000 * 10e-3 / (4 * hertz.effective_modulus(E, NU, E, NU))) ** (1 / 3))
    top = 3 * 8000 / (2 * np.pi * half_width**2)
    assert pressed.pairs == (("ball", "block"),)
    assert pressed.force("ball", "block")[2] == pytest.approx(2000.0, rel=1e-9)
    assert pressed.force("block", "ball")[2] == pytest.approx(-2000.0, rel=1e-9)
    kept = pressure > 0.3 * pressure.max()
    fitted = np.sqrt(np.polyfit((points[:, :2] ** 2).sum(axis=1)[kept], pressure[kept] ** 2, 1)[1])  # p^2 = p0^2 (1 - r^2/a^2)
    assert fitted == pytest.approx(top, rel=0.03)
    assert pressed.area("block", "ball") == pytest.approx(np.pi * half_width**2 / 4, rel=0.2)
    skin = pressed.skin("block")
    assert np.array_equal(told["stress"], skin.mises)
    assert skin.stress[0][:, 2, 2].min() == pytest.approx(-top, rel=0.25)


@pytest.mark.slow
def test_a_block_from_a_file_is_held_by_friction_and_slides_without(files):
    import netgen.occ as occ

    occ.Box(occ.Pnt(1, 1, 0), occ.Pnt(7, 7, 4)).WriteStep(str(files / "weight.step"))
    block = SolidBody(files / "block.step", E, NU, 4e-3, fixed=[(1e-3, 1e-3, -8e-3)])
    weight = SolidBody(files / "weight.step", E, NU, 4e-3, loads=[((4e-3, 4e-3, 4e-3), (20.0, 10.0, -100.0))])
    pressed = press({"weight": weight, "block": block}, 1.5e-3, 1e-6, friction=0.3)
    assert pressed.force("weight", "block") == pytest.approx([-20.0, -10.0, 100.0], rel=1e-6)
    points, traction = pressed.traction("block", "weight")
    area = pressed.state.model.pairings[0].area * 1e-6
    assert points.shape == traction.shape
    assert traction.T @ area == pytest.approx([20.0, 10.0, 0.0], abs=1e-6)
    bound = 0.3 * pressed.pressure("weight", "block")[1]
    assert np.all(np.linalg.norm(traction, axis=1) <= bound * (1 + 1e-9))
    with pytest.raises(InputError, match="pressure and friction do not keep 'weight' from moving along x, where the loads drive it"):
        press({"weight": weight, "block": block}, 1.5e-3, 1e-6, friction=0.2)
    with pytest.raises(InputError, match="coefficient of friction of -1; it must be 0 or more"):
        press({"weight": weight, "block": block}, 1.5e-3, 1e-6, friction=-1.0)


def test_flat_blocks_face_to_face_are_meshed_as_finely_as_asked(files):
    import netgen.occ as occ

    occ.Box(occ.Pnt(0, 0, -6), occ.Pnt(10, 10, 0)).WriteStep(str(files / "low.step"))
    occ.Box(occ.Pnt(3, 3, 0), occ.Pnt(7, 7, 4)).WriteStep(str(files / "top.step"))
    low = SolidBody(files / "low.step", E, NU, 2e-3, fixed=[(1e-3, 1e-3, -6e-3)])
    top = SolidBody(files / "top.step", E, NU, 2e-3, loads=[((5e-3, 5e-3, 4e-3), (0.0, 0.0, -2000.0))])
    pressed = press({"top": top, "low": low}, 1.2e-3, 50e-6)
    assert pressed.force("top", "low")[2] == pytest.approx(2000.0, rel=1e-9)
    assert pressed.area("top", "low") == pytest.approx(16e-6, rel=1e-6)
    assert len(repr(pressed)) < 200


def test_files_and_faces_that_are_not_there_are_told(files):
    bodies = ball_and_block(files)
    with pytest.raises(InputError, match=r"no file .*none\.step.* for the body 'ball'; give the path of a STEP file"):
        press(ball_and_block(files, file=files / "none.step"), 1e-4, 1e-5)
    (files / "broken.step").write_text("nothing")
    with pytest.raises(InputError, match=r"'broken\.step' cannot be read as a STEP file: it does not begin with ISO-10303-21"):
        press(ball_and_block(files, file=files / "broken.step"), 1e-4, 1e-5)
    (files / "broken.step").write_text("ISO-10303-21; nothing more")
    with pytest.raises(InputError, match=r"'broken\.step' cannot be read as a STEP file \("):
        press(ball_and_block(files, file=files / "broken.step"), 1e-4, 1e-5)
    with pytest.raises(InputError, match=re.escape("no face of 'ball' lies at (30, 0, 0) mm; the nearest is")):
        press(ball_and_block(files, loads=[((30e-3, 0, 0), (0, 0, -1.0))]), 1e-4, 1e-5)
    with pytest.raises(InputError, match="modulus of -1 Pa"):
        press(ball_and_block(files, modulus=-1.0), 1e-4, 1e-5)
    with pytest.raises(InputError, match="1 bodies; give two or more"):
        press({"ball": bodies["ball"]}, 1e-4, 1e-5)
    with pytest.raises(InputError, match="plane of symmetry of 'ball' has the axis 'w'"):
        press(ball_and_block(files, planes=[((0, 4e-3, 6e-3), "w")]), 1e-4, 1e-5)
    with pytest.raises(InputError, match="contact_size -1 m"):
        press(bodies, -1.0, 1e-5)
    with pytest.raises(InputError, match="'ball': size is '2 mm'; give a number in SI units, such as 2e-3 for 2 mm"):
        press(ball_and_block(files, size="2 mm"), 1e-4, 1e-5)
    with pytest.raises(InputError, match="contact_size is '0.1 mm'; give a number in SI units"):
        press(bodies, "0.1 mm", 1e-5)  # pyright: ignore[reportArgumentType]


@pytest.mark.slow
def test_elements_too_large_are_told_with_the_bodies_that_touch(files):
    with pytest.raises(CoarseContact, match=r"elements of [\d.]+ mm on 'ball' at 'block' are larger than half"):
        press(ball_and_block(files, force=-0.5), 0.3e-3, 5e-6)
