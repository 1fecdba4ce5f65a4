"""Spec keys of the wheel's steps: stations, the place of the pins in the dwell, laws through points; what is refused."""

from pathlib import Path

import numpy as np
import pytest

import drivewright as dw
from drivewright import motion, registry
from drivewright.errors import DrivewrightError, SpecError
from drivewright.mechanisms.indexer.batch import batch

pytestmark = pytest.mark.interface

PRESETS = Path(dw.__file__).parent / "mechanisms/indexer/presets"
SMALL = {
    "default": ("pin_radius=6 mm",),
    "cycloid": ("eccentricity=1.5 mm",),
    "parallel": ("pin_radius=6 mm", "motion.motion_to_dwell=2"),
    "barrel": ("pin_radius=9 mm", "motion.motion_to_dwell=3"),
    "globoidal": ("pin_radius=9 mm", "motion.motion_to_dwell=3"),
}


def load(name, *changes):
    return dw.load(PRESETS / f"{name}.toml", [*changes])


def run(name, *changes, only=("motion", "profile", "contacts")):
    return dw.run(load(name, *changes), only)


def columns(result):
    return {(table.name, column.name): column.data for table in result.tables.values() for column in table.columns}


@pytest.mark.parametrize("name", SMALL)
def test_as_many_stations_as_pins_change_no_digit(name):
    spec = load(name)
    plain, told = run(name), run(name, f"stations={spec.pins}")
    assert {key: value.value for key, value in plain.values.items()} == {key: value.value for key, value in told.values.items()}
    others = columns(told)
    for key, data in columns(plain).items():
        np.testing.assert_array_equal(data, others[key], err_msg=str(key))


@pytest.mark.parametrize("name", SMALL)
def test_half_as_many_stations_double_the_step(name):
    pins = load(name).pins
    result = run(name, *SMALL[name], f"stations={pins // 2}")
    wheel = result.tables["motion"]["wheel"].data
    assert wheel[-1] - wheel[0] == pytest.approx(4 * np.pi / pins)
    single = run(name, *SMALL[name], only=("motion",))
    for factor in ("velocity_factor", "acceleration_factor"):
        assert result.values[f"motion.{factor}"].value == pytest.approx(2 * single.values[f"motion.{factor}"].value)
    assert result.values["contacts.minimum"].value >= 1


@pytest.mark.parametrize("name", ["default", "parallel", "globoidal"])
def test_scene_and_solids_have_all_pins_and_turn_by_a_station(name):
    spec = load(name, *SMALL[name], f"stations={load(name).pins // 2}")
    scene = registry.mechanism("indexer").scene(dw.build(spec))
    bodies = {body.name: body for body in scene.bodies}
    if name == "globoidal":
        assert sum(key.startswith("roller") for key in bodies) >= 2
    else:
        assert bodies["wheel"].poses[-1][2] == pytest.approx(4 * np.pi / spec.pins)
        levels = 2 if name == "parallel" else 1
        assert sum(shape.layer == "roller" for shape in bodies["wheel"].shapes) == levels * spec.pins


@pytest.mark.conformance
@pytest.mark.parametrize("name", ["default", "parallel", "globoidal", "barrel"])
def test_independent_check_agrees(name):
    """Profile by polygons of all centre curves, normals through the pole, flanks against all rollers."""
    torque = "load.torque=" if name == "default" else "load.torque=80 N m"  # solids take long
    spec = load(name, *SMALL[name], f"stations={load(name).pins // 2}", torque)
    rows = dw.verify(spec)
    assert len(rows) >= 2
    for row in rows:
        assert abs(row.ours - row.other) <= row.allowed, row


def test_place_of_the_pins_reaches_the_drive():
    first = run("parallel", "pin_phase=0.3", only=("profile",))
    plain, same = run("parallel", only=("profile",)), run("parallel", "pin_phase=0.25", only=("profile",))
    assert same.values["profile.area"].value == plain.values["profile.area"].value
    assert first.values["profile.area"].value != plain.values["profile.area"].value
    assert run("globoidal", "pin_phase=0.5", only=("profile",)).values["pressure_angle.maximum"].value == pytest.approx(
        run("globoidal", only=("profile",)).values["pressure_angle.maximum"].value, rel=1e-15
    )
    middle = run("globoidal", "pin_phase=0", only=("profile", "contacts"))
    assert middle.tables["contacts"]["pins"].data[-2] % 2 == 1  # in the dwell a roller in the middle, and pairs beside it


def test_many_designs_of_such_wheels_are_run_one_by_one():
    keys, names = ["pin_radius"], ["play.forward.maximum"]
    assert batch(load("default"), keys, names) is not None
    for change in ("stations=6", "pin_phase=0.25"):
        assert batch(load("default", change), keys, names) is None
    assert batch(load("default", "stations=12"), ["pins"], names) is None


# -- laws through points ------------------------------------------------------------------------------------------------------------


def samples(count=37):
    u = np.linspace(0, 1, count)
    return u, motion.law("modified-sine")(u).s


@pytest.fixture(scope="module")
def points():
    u, s = samples()
    return "motion.points=[" + ",".join(f"[{a:.15g}, {b:.15g}]" for a, b in zip(u, np.clip(s, 0, 1), strict=True)) + "]"


@pytest.fixture(scope="module")
def rows(tmp_path_factory):
    """Rows of the modified sine over 180 deg to 45 deg."""
    path = tmp_path_factory.mktemp("rows") / "step.csv"
    u, s = samples()
    path.write_text("angle [deg],lift [deg]\n" + "".join(f"{180 * a:.15g},{45 * b:.15g}\n" for a, b in zip(u, s, strict=True)))
    return path


@pytest.mark.analytical
def test_spline_through_a_law_is_that_law(points):
    plain, through = run("parallel"), run("parallel", "motion.law=spline", points)
    for name in ("profile.area", "motion.velocity_factor", "motion.acceleration_factor", "pressure_angle.maximum"):
        assert through.values[name].value == pytest.approx(plain.values[name].value, rel=1e-3 if "acceleration" in name else 3e-5), name
    np.testing.assert_allclose(through.tables["motion"]["wheel"].data, plain.tables["motion"]["wheel"].data, atol=3e-7)


def test_rows_of_a_table_are_the_step_and_its_motion_angle(points, rows):
    spline = run("parallel", "motion.law=spline", points)
    table = dw.run(without_ratio("motion.law=table", f"motion.file={rows}"), ("motion", "profile"))
    assert table.values["motion.motion_angle"].value == pytest.approx(np.pi)
    for name in ("profile.area", "motion.velocity_factor", "motion.acceleration_factor"):
        assert table.values[name].value == pytest.approx(spline.values[name].value, rel=1e-9), name


def without_ratio(*changes):
    return load("parallel", "motion.motion_to_dwell=", *changes)


@pytest.mark.error
@pytest.mark.parametrize(
    ("changes", "key", "words"),
    [
        (("stations=5",), "stations", "stations = 5 does not divide pins = 8: .* pass 1.6 pins.*Take 5 or 10 pins, or stations from 1, 2"),
        (
            ("pin_phase=1.3",),
            "pin_phase",
            "1.3 is out of range; the position of a pin in the dwell is from 0 to below 1 pitch.*0.3 is the same position",
        ),
        (("pin_phase=-0.25",), "pin_phase", "0.75 is the same position"),
        (("motion.law=spline",), "motion.points", "is missing: law = 'spline' needs it"),
        (("motion.points=[[0, 0], [0.4, 0.5], [1, 1]]",), "motion.points", "is for law = 'spline'; the law is 'modified-sine'"),
        (("motion.degree=3",), "motion.degree", "is for law = 'table' or 'spline'"),
        (("motion.law=table", "motion.motion_to_dwell="), "motion.file", "is missing: law = 'table' needs it"),
    ],
)
def test_what_cannot_be_is_refused_by_key(changes, key, words):
    with pytest.raises(SpecError, match=words) as told:
        dw.build(load("parallel", *changes))
    assert told.value.key == key


@pytest.mark.error
@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda text: text.replace("lift [deg]", "lift [mm]"), "lift in the table is a length"),
        (lambda text: text.replace("180,45", "180,40"), "ends at 40°, but a step of 8 stations is 45°"),
        (lambda text: text.replace("180,45", "400,45"), "ends at an input angle of 400°"),
        (lambda text: "\n".join([text.split("\n")[0], "0,0.5", *text.split("\n")[2:]]), "starts at 0.5°"),
        (lambda text: text.replace("\n5,", "\n-5,"), "must increase from row to row"),
    ],
)
def test_rows_that_are_no_step_are_refused(rows, tmp_path, change, words):
    path = tmp_path / "wrong.csv"
    path.write_text(change(rows.read_text()))
    with pytest.raises(SpecError, match=words) as told:
        dw.build(without_ratio("motion.law=table", f"motion.file={path}"))
    assert told.value.key == "motion.file"


@pytest.mark.error
def test_table_tells_the_dwell_itself(rows):
    with pytest.raises(SpecError, match="leave motion_to_dwell out"):
        dw.build(load("parallel", "motion.law=table", f"motion.file={rows}"))


@pytest.mark.error
def test_rounded_rows_are_told(tmp_path):
    path = tmp_path / "rounded.csv"
    u, s = samples(181)
    path.write_text("angle [deg],lift [deg]\n" + "".join(f"{180 * a:.15g},{45 * b:.2f}\n" for a, b in zip(u, s, strict=True)))
    findings = dw.run(without_ratio("motion.law=table", f"motion.file={path}"), "motion").findings
    assert any("as rounded data do" in each for each in findings)


@pytest.mark.error
def test_points_that_are_no_step_are_refused():
    with pytest.raises(DrivewrightError, match="s runs from 0 to 0.9"):
        dw.build(load("parallel", "motion.law=spline", "motion.points=[[0, 0], [0.4, 0.5], [1, 0.9]]"))
