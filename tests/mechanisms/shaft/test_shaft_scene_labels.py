"""The words on the picture of a shaft: which there are, and that none lies on an arrow."""

import tomllib

import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright import registry, runner
from drivewright.spec import from_document

pytestmark = pytest.mark.interface


def labels(*changes, name="pressure_roller_shaft"):
    return registry.mechanism("shaft").scene(runner.build(dw.load(EXAMPLES / f"{name}.toml", list(changes)))).labels


def named(*changes, **more):
    return {label.text: label for label in labels(*changes, **more) if label.text}


def test_a_station_is_named_below_the_arrow_that_comes_upon_it_and_above_otherwise():
    found = named()
    assert not found["m2"].above and found["m1"].above and found["m2"].point[1] == -found["m1"].point[1] < 0
    apart = named("loads.0.station=", "loads.0.position=230 mm")  # further from m2 than the shaft is thick
    assert apart["m2"].above


def test_a_station_on_a_bearing_keeps_its_place_above():
    found = named("stations.m2.position=136.5 mm")
    assert found["m2"].above and not found["B"].above


def loaded(text):
    """Labels of forces (value, unit, above, height) and of names, of the same shaft with further loads."""
    tables = tomllib.loads((EXAMPLES / "pressure_roller_shaft.toml").read_text(encoding="utf-8") + text)
    found = registry.mechanism("shaft").scene(runner.build(from_document(tables))).labels
    forces = [(label.value, label.unit, label.above, label.point[1]) for label in found if label.value is not None]
    return forces, {label.text: label for label in found if label.text}


def test_a_load_from_below_has_its_number_below_and_leaves_the_names_above():
    """The picture looks so that the first load points down: one against it comes from below."""
    forces, names = loaded('[[loads]]\nstation = "m1"\nforce = "-300 N"\n')
    assert [force[:3] for force in forces] == [(500.0, "N", True), (300.0, "N", False)]
    assert forces[0][3] == -forces[1][3] > 0.011 and names["m1"].above and not names["m2"].above


def test_a_line_load_has_a_number_at_either_end():
    line = '[[line_loads]]\nstart = "150 mm"\nend = "220 mm"\nforce = "900 N/m"\nend_force = "2 kN/m"\n'
    forces, _ = loaded(line)
    assert [(value, unit) for value, unit, _, _ in forces] == [(500.0, "N"), (900.0, "N/m"), (2000.0, "N/m")]
