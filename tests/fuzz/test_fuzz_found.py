"""What the fuzzer and other attacks found, each by its name."""

import math

import numpy as np
import pytest
from places import EXAMPLES

from drivewright import cli, registry, runner
from drivewright.errors import InputError, SpecError, counted
from drivewright.scene import Arc, circle
from drivewright.spec import load

pytestmark = pytest.mark.error


def preset(kind, name, *changes):
    return load(registry.mechanism(kind).presets()[name], changes)


@pytest.fixture
def drivewright(capsys, tmp_path, monkeypatch):
    """Runs a command line in an empty folder: (exit code, stdout, stderr)."""
    monkeypatch.chdir(tmp_path)

    def call(*arguments):
        with pytest.raises(SystemExit) as left, np.errstate(all="ignore"):
            cli.main([str(argument) for argument in arguments])
        return (left.value.code or 0, *capsys.readouterr())

    return call


def test_a_bore_beyond_the_universe_is_refused(drivewright):
    path = registry.mechanism("cam").presets()["groove"]
    code, out, err = drivewright("run", path, "--only", "motion", "--no-figures", "--set", "manufacture.bore=2e101 mm")
    assert code == 2 and out == "" and "manufacture.bore: '2e101 mm' has no meaning: it is larger than 1e+40 m" in err


def test_a_bore_that_is_merely_absurd_is_drawn(drivewright):
    path = registry.mechanism("cam").presets()["groove"]
    code, _, err = drivewright("run", path, "--only", "motion", "--no-figures", "--set", "manufacture.bore=2e30 mm")
    assert code == 0 and "Traceback" not in err


@pytest.mark.parametrize("text", ["1e-200 mm", "-1e200 mm", "1e300 km"])
def test_a_quantity_without_meaning_is_refused_by_key(text):
    with pytest.raises(SpecError, match=r"cam.*follower.roller_radius: .*(has no meaning: it is (larger|smaller) than|not finite)"):
        preset("cam", "default", f"follower.roller_radius={text}")


def test_ever_stiffer_springs_stay():
    assert preset("shaft", "default", "bearings.0.radial_stiffness=1e300 N/m").bearings[0].radial_stiffness == 1e300


def test_the_word_for_infinitely_stiff_stays():
    spec = preset("shaft", "default", "bearings.0.housing_stiffness=rigid")
    assert math.isinf(spec.bearings[0].housing_stiffness)


def test_a_number_of_plates_beyond_counting_is_refused():
    with pytest.raises(SpecError, match=r"lacing.*has no meaning: nothing here is counted beyond 1e\+15"):
        preset("silent-chain", "default", f"plate.lacing=[1, {10**300}]")


@pytest.mark.parametrize("radius", [1e-14, 1.0, 1e9, 1e40])
def test_an_arc_has_a_bounded_number_of_points(radius):
    points = Arc((0.0, 0.0), radius, 0.0, 2 * np.pi).points(1e-15)
    assert 3 <= len(points) < 80_000 and np.all(np.isfinite(points))
    assert len(circle((0.0, 0.0), radius).points(1e-6)) < 80_000


def test_an_arc_keeps_its_tolerance_where_that_is_not_finer_than_rounding():
    points = Arc((0.0, 0.0), 0.05, 0.0, 1.0).points(1e-8)
    middles = (points[1:] + points[:-1]) / 2
    assert 1e-9 < 0.05 - np.hypot(*middles.T).min() <= 1e-8 * (1 + 1e-6)


def test_an_eccentricity_smaller_than_an_atom_takes_no_memory_to_trim():
    spec = load(EXAMPLES / "pin_indexer_two_way.toml", ["eccentricity=9.946e-25 mm"])
    with np.errstate(all="ignore"):
        result = runner.run(spec, "profile")
    assert result.outcome == "partial"
    assert "pairs of pieces of a curve that lie upon each other are more than" in result.failures["profile"]


def test_a_gear_smaller_than_an_atom_takes_no_memory_to_draw():
    from drivewright.report.content import views

    spec = preset("seedling-pusher", "default", "train.semi_major=1.6e-11 mm")
    with np.errstate(all="ignore"):
        model = runner.build(spec)
        seen = views(runner.run(spec, "train", model=model), model)
    assert seen.drawings and max(len(shape.outline.points()) for drawing in seen.drawings for shape in drawing.shapes) < 100_000


def test_a_budget_says_how_many_of_what_and_what_to_do():
    assert counted(12.0, 20, "points", "take fewer") == 12
    for count in (21.0, math.inf, math.nan):
        with pytest.raises(InputError, match=r"points are more than the 20 that fit into memory and time; take fewer$"):
            counted(count, 20, "points", "take fewer")


def test_a_pin_circle_wider_than_a_galaxy_is_refused_for_its_pins():
    with pytest.raises(SpecError, match="too thin to be followed along the cam") as caught:
        runner.run(load(EXAMPLES / "cycloid_reducer.toml", ["pin_circle_radius=3.9e20 mm"]), "profile")
    assert caught.value.key == "pin_radius"


def test_a_rolling_radius_beside_which_the_pitch_is_rounding_is_refused(drivewright):
    code, out, err = drivewright("run", EXAMPLES / "hyvo_chain.toml", "--no-figures", "--set", "joint.rolling_radius=1.476e37 mm")
    assert code == 2 and out == "" and "joint.rolling_radius: exceeds 1e+09 pitches" in err


def test_a_pin_too_thin_to_be_followed_is_refused_and_a_thicker_one_is_not(drivewright):
    """Pins of an atom's size kept a run busy for hours."""
    code, out, err = drivewright("run", EXAMPLES / "pin_indexer.toml", "--no-figures", "--set", "pin_radius=4.9e-8 mm")
    assert code == 2 and out == "" and "pin_radius: 4.9e-08 mm is less than 1e-05 of the pin circle radius" in err and "0.0012 mm" in err
    runner.build(load(EXAMPLES / "pin_indexer.toml", ["pin_radius=0.00121 mm"]))
