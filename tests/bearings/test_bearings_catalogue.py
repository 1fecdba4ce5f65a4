"""The catalogue of bearings: what is in it, where its numbers come from, files of one's own, and what is said of bad ones."""

import pytest

from drivewright.bearings.approximate_stiffness import liu_ball, liu_roller
from drivewright.bearings.ball import BallBearing
from drivewright.bearings.catalogue import bearing, entry, names, replace_catalogue_values
from drivewright.bearings.catalogue_entry import ENVELOPE
from drivewright.bearings.roller import RollerBearing, roller_static_rating
from drivewright.bearings.solving import solve
from drivewright.errors import InputError, SpecError, UnknownName

pytestmark = pytest.mark.interface

OWN = """
[bearings.NJ-my-205]
description = "from the maker"
bore = "25 mm"
outer_diameter = "52 mm"
[bearings.NJ-my-205.roller]
rollers = 13
roller_diameter = "7.5 mm"
roller_length = "8 mm"
pitch_diameter = "39 mm"
[[bearings.NJ-my-205.sources]]
keys = ["bore", "outer_diameter", "rollers", "roller_diameter", "roller_length", "pitch_diameter"]
flag = "read"
text = "drawing 12-345"
"""


@pytest.fixture
def own(tmp_path):
    def write(*changes):
        text = OWN
        for old, new in changes:
            assert old in text
            text = text.replace(old, new)
        path = tmp_path / "mine.toml"
        path.write_text(text)
        return path

    return write


def test_every_number_has_one_source():
    assert {"61804", "61904", "NU207E", "reference-DGBB", "hypothetical-7014C"} <= set(names())
    for name in names():
        card = entry(name)
        given = {key for key in ENVELOPE if getattr(card, key) is not None} | card.bearing.model_fields_set
        assert all(card.source(key).text and card.source(key).flag for key in given)
        assert isinstance(bearing(name), BallBearing if card.ball else RollerBearing) and bearing(name) == card.bearing
        if name.startswith("hypothetical"):
            assert card.source("pitch_diameter").flag == "assumed"


def test_every_bearing_fits_between_its_rings_and_carries():
    for name in names():
        card = entry(name)
        size = card.ball.ball_diameter if card.ball else card.roller.roller_diameter
        if card.bore is not None:
            assert card.bore < card.bearing.pitch_diameter - size and card.bearing.pitch_diameter + size < card.outer_diameter
        axial = 60.0 if card.bearing.contact_angle else 0.0
        state = solve(card.bearing, force=[100.0, 0, axial, 0, 0], held=("tilt_x", "tilt_y"))
        assert 1e7 < state.stiffness[0, 0] < 1e9 and state.pressures.max() < 4.2e9


def test_numbers_of_the_papers_bearing():
    assert entry("61804").source("balls").flag == "back_fitted" and entry("61804").source("dynamic_rating").flag == "recalled"
    support, crank = bearing("61904"), bearing("NU207E")
    assert liu_ball(500.0, support.balls, support.ball_diameter).tangent == pytest.approx(77935e3, rel=1e-5)
    assert liu_roller(500.0, crank.rollers, crank.roller_length).tangent == pytest.approx(377074e3, rel=1e-5)
    assert entry("NU207E").bore == 0.035 and entry("61904").width == 0.009
    assert solve(bearing("61804"), force=[1000.0, 0, 0, 0, 0]).displacement[0] == pytest.approx(15.82e-6, abs=0.006e-6)


def test_bearings_of_the_catalogue_have_their_stiffness():
    """Tangents at given loads, on a shaft that does not tilt."""
    cases = [
        ("61904", 500, 0, 81783e3),
        ("61904", 10000, 0, 221994e3),
        ("hypothetical-ACBB15-20x32x7", 500, 400, 1.12e8),
        ("hypothetical-ACBB25-20x32x7", 500, 400, 7.35e7),
        ("hypothetical-CRB-20x32x7", 500, 0, 1.911e8),
    ]
    for name, radial, axial, expected in cases:
        state = solve(bearing(name), force=[radial, 0, axial, 0, 0], held=("tilt_x", "tilt_y"))
        assert state.stiffness[0, 0] == pytest.approx(expected, rel=2e-5 if name == "61904" else 2e-3)


def test_a_file_of_ones_own_adds_to_the_catalogue(own):
    path = own()
    assert bearing("NJ-my-205", path).rollers == 13 and bearing("61804", str(path)) == bearing("61804")
    assert set(names(path)) == {*names(), "NJ-my-205"} and "NJ-my-205" not in names()
    assert entry("NJ-my-205", path).source("rollers").text == "drawing 12-345"
    assert roller_static_rating(bearing("NJ-my-205", path)) > 20e3
    path = own(("NJ-my-205", "61804"))
    assert isinstance(bearing("61804", path), RollerBearing)  # one's own goes first
    assert isinstance(bearing("61804"), BallBearing)


def test_unknown_names_come_with_the_nearest():
    with pytest.raises(UnknownName, match=r"no bearing is called '61824' \(did you mean '61820' or 61819, .*\?\); known: 61804, 61904"):
        bearing("61824")
    with pytest.raises(UnknownName, match=r"no number with a source is called 'ball'.*balls"):
        entry("61804").source("ball")


@pytest.mark.parametrize(
    ("old", "new", "complaint"),
    [
        ("rollers = 13", "rollers = 30", r"bearings\.NJ-my-205\.roller\.roller_diameter: 30 rollers of 7\.5 mm overlap"),
        ("rollers = 13\n", "", r"bearings\.NJ-my-205\.roller\.rollers: is missing"),
        ('"8 mm"', "8", r"bearings\.NJ-my-205\.roller\.roller_length: unit missing"),
        ("rollers = 13", "roller = 13", r"bearings\.NJ-my-205\.roller\.roller: unknown key \(did you mean 'rollers'\?\)"),
        ('"39 mm"', '"60 mm"', r"roller\.pitch_diameter: must lie between bore and outer diameter, got 60 mm against 25 and 52 mm"),
        ('"rollers", ', "", r"bearings\.NJ-my-205\.sources: no source names rollers; each number needs one source"),
        ('"rollers", ', '"rollers", "width", ', r"sources: a source names, but the entry lacks, width"),
        ('"rollers", ', '"rollers", "bore", ', r"sources: two sources name bore"),
        ('"read"', '"trust me"', r'sources\.0\.flag: must be one of "read"'),
        ("[bearings.NJ-my-205.roller]", "[bearings.NJ-my-205.needle]", r"bearings\.NJ-my-205\.needle: unknown key"),
        ('description = "from the maker"', "description = from the maker", "is not valid TOML"),
    ],
)
def test_a_bad_file_is_named_with_its_key(own, old, new, complaint):
    path = own((old, new))
    with pytest.raises(SpecError, match=rf"mine\.toml: .*{complaint}"):
        bearing("61804", path)


def test_an_entry_is_one_bearing(own):
    ball = '[bearings.NJ-my-205.ball]\nballs = 9\nball_diameter = "8 mm"\npitch_diameter = "39 mm"\n[bearings.NJ-my-205.roller]'
    with pytest.raises(SpecError, match=r"bearings\.NJ-my-205\.ball: needs one table `ball` or `roller`, has both"):
        names(own(("[bearings.NJ-my-205.roller]", ball)))


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(InputError, match=r"catalogue: there is no file '.*none\.toml'; a catalogue is a TOML file"):
        names(tmp_path / "none.toml")


def test_a_file_of_ones_own_needs_no_sources(tmp_path):
    path = tmp_path / "own.toml"
    path.write_text('[bearings.X1.ball]\nballs = 9\nball_diameter = "8 mm"\npitch_diameter = "40 mm"\n')
    assert bearing("X1", path).balls == 9 and entry("X1", path).sources == ()


def test_ours_has_a_source_for_every_number():
    assert all(entry(name).sources for name in names())


def test_given_values_take_the_place_of_those_of_the_catalogue():
    own = bearing("61904")
    assert replace_catalogue_values(own) is own
    changed = replace_catalogue_values(own, 12e-6, static_rating=2e3)
    assert (changed.radial_clearance, changed.dynamic_rating, changed.static_rating) == (12e-6, own.dynamic_rating, 2e3)
    assert replace_catalogue_values(own, dynamic_rating=5e3).dynamic_rating == 5e3
