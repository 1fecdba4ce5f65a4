"""What `solid_stress` promises: values, plots, tables, reasons for leaving it out, refusals of its spec."""

import tomllib
from functools import cache

import numpy as np
import pytest

import drivewright as dw
from drivewright.errors import DrivewrightError, InputError
from drivewright.mechanisms.silent_chain import solid
from drivewright.solids.contact.model import CoarseContact
from drivewright.spec import from_document
from drivewright.spec.parsing import change_key
from drivewright.view.panels import drawable, known_plots

pytestmark = [pytest.mark.interface, pytest.mark.needs_fe]

SPEC = """
mechanism = "silent-chain"
pitch = "9.525 mm"
links = 40
teeth = [17, 19]
[joint]
kind = "round-pin"
rolling_radius = "1.2 mm"
[plate]
apothem = "2.6 mm"
[drive]
speed = "4000 rpm"
preload = "400 N"
[dynamics]
settling = "5 ms"
duration = "36 ms"
ensemble = 2
largest_drift = 1
[solid]
clearance = "0 mm"
fineness = 0.7
load_steps = 4
"""
PLOTS = (
    "solid_history",
    "solid_plate",
    "solid_pin",
    "hole_section",
    "seat_pressure",
    "rolling_pressure",
    "solid_plate_life",
    "solid_pin_life",
)
UNITS = {
    "solid.plate.max_stress": "Pa",
    "solid.pin.max_stress": "Pa",
    "solid.seat.max_pressure": "Pa",
    "solid.plate.min_life": "-",
    "solid.pin.min_life": "-",
}


def spec(*changes):
    tables = tomllib.loads(SPEC)
    for change in changes:
        change_key(tables, change)
    return from_document(tables)


@cache
def run(*changes):
    return dw.run(spec(*changes), only="solid_stress")


def left_out(*changes):
    """What is said where there is no answer."""
    found = run(*changes)
    assert not any(name.startswith("solid.") for name in found.values)
    return " ".join(found.findings)


# -- what there is


def test_values_have_units_and_intervals():
    found = run()
    for name, unit in UNITS.items():
        value = found.values[name]
        assert value.unit == unit
        assert value.value > 0
        assert value.interval == "ensemble"
        assert value.low <= value.value <= value.high
    assert found.values["solid.rolling.line_load_ratio"].value > 1
    assert found.values["solid.rolling.max_pressure"].unit == "Pa"


def test_stress_is_of_the_size_of_the_plane_plates():
    """Of the first run: plate within a quarter of plane stress with a cosine pressure; the pins bear less than the plate."""
    table, plane = run().tables["solid_history"], dw.run(spec(), only="stress")
    assert table["plate"].data.max() == pytest.approx(plane["plate.max_von_mises"], rel=0.25)
    assert max(table[name].data.max() for name in ("left_pin", "right_pin")) < table["plate"].data.max()


def test_the_rolling_pressure_is_more_than_that_of_an_even_line_load():
    """p0 grows as the root of the line load."""
    found = run()
    table = found.tables["rolling_pressure"]
    line, pressure = table["line_load"].data, table["pressure"].data
    assert found["solid.rolling.max_pressure"] == pytest.approx(pressure.max())
    mean = np.trapezoid(line, table["height"].data) / table["height"].data[-1]
    assert found["solid.rolling.line_load_ratio"] == pytest.approx(line.max() / mean, rel=1e-6)
    assert pressure / pressure.max() == pytest.approx(np.sqrt(line / line.max()))


def test_all_plots_can_be_drawn():
    plots = [plot.name for plot in drawable(run(), known_plots(run()).values())]
    assert set(PLOTS) <= set(plots)


def test_the_history_has_the_steps_asked_for_and_the_greatest_of_the_first_run():
    table = run().tables["solid_history"]
    assert 2 <= len(table["time"].data) <= 4
    assert np.all(np.diff(table["time"].data) > 0)
    value = run().values["solid.plate.max_stress"]
    assert value.low <= table["plate"].data.max() <= value.high


def test_yield_is_checked_of_plate_and_pin():
    found = run()
    checks = {check.name: check for check in found.checks}
    for name in ("plate", "pin"):
        assert checks[f"solid.{name}.yield"].value == pytest.approx(835e6 / found[f"solid.{name}.max_stress"])


def test_findings_say_how_fine_and_what_is_assumed():
    words = " ".join(run().findings)
    assert "unknowns of the plate" in words
    assert "solid.clearance, solid.friction, solid.edge_radius" in words
    assert "estimated from the tensile strength" in words
    assert "endless stack" not in words


# -- what is left out, with the reason


@pytest.mark.parametrize(
    ("words", "changes"),
    [
        ("rolling joints with two pins only", ('joint.kind="revolute"', "joint.rolling_radius=")),
        ("rolling joints with two pins only", ('roller.diameter="6 mm"', 'joint.kind="revolute"', "joint.rolling_radius=")),
        ("add [drive]", ("drive=",)),
        ("shorter than a revolution of the chain; increase dynamics.duration", ('dynamics.duration="10 ms"',)),
        (
            "0.08 mm is too large for the assumption of small displacements around a pin of 1.2 mm in radius; "
            "give a clearance of 0.06 mm or less",
            ('solid.clearance="80 um"',),
        ),
    ],
)
def test_left_out_with_the_reason(words, changes):
    assert words in left_out(*changes)


@pytest.mark.parametrize(
    ("width", "words"),
    [
        (0.08, "width of 0.08 mm, less than two elements of 0.1 mm; .* clearance of 40 µm .* solid.fineness 2.5 or more, or a smaller"),
        (0.05, "Take a smaller solid.clearance"),
        (0.0, "has a width of less than an element, .* Take a smaller solid.clearance"),
    ],
)
def test_a_contact_too_narrow_for_its_elements_is_told_with_the_keys_that_help(width, words):
    with pytest.raises(InputError, match=words), solid._fine_enough(spec('solid.clearance="40 um"', "solid.fineness=1").solid):
        raise CoarseContact("contact: the elements are large", 0.1, width)


# -- what the spec refuses


@pytest.mark.parametrize(
    ("change", "word"),
    [
        ('solid.clearance="-1 um"', "clearance"),
        ('solid.edge_radius="-1 um"', "edge_radius"),
        ('solid.seat="0 deg"', "seat"),
        ("solid.seat=45", "seat"),
        ("solid.load_steps=1", "load_steps"),
        ("solid.load_steps=501", "load_steps"),
        ("solid.fineness=0.2", "fineness"),
        ("solid.fineness=4", "fineness"),
        ("solid.friction=-0.1", "friction"),
        ("solid.friction=2", "friction"),
    ],
)
@pytest.mark.error
def test_refused(change, word):
    with pytest.raises(DrivewrightError, match=word):
        spec(change)
