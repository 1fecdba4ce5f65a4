"""Bearings by designation: what people write, what comes out of it, what is told of it, and what is refused."""

import itertools

import numpy as np
import pytest

from drivewright import bearings
from drivewright.bearings import catalogue_findings, designations, entry, estimated_keys, parse_designation, rating_findings
from drivewright.bearings.boundary_dimensions import bore_code, boundary_dimensions, clearance_range, known_series
from drivewright.bearings.catalogue import names
from drivewright.bearings.designated_entry import designated_entry
from drivewright.errors import InputError, UnknownName

pytestmark = pytest.mark.interface


@pytest.mark.parametrize(
    ("written", "name"),
    [
        ("6306", "6306"),
        ("6306-2RS1", "6306"),
        ("6306-2Z/C3", "6306"),
        ("6306C3", "6306"),
        ("6306ZZ CM", "6306"),
        ("SKF 6306", "6306"),
        (" fag  6205-2RSR-C3 ", "6205"),
        ("16006", "16006"),
        ("16 006", "16006"),
        ("618 05", "61805"),
        ("61905-2RZ", "61905"),
        ("7208 B", "7208B"),
        ("7208BEP", "7208B"),
        ("7208 BECBP", "7208B"),
        ("7206-B-TVP", "7206B"),
        ("7010 CD/P4A", "7010C"),
        ("7010 ACD", "7010AC"),
        ("7010 A5", "7010AC"),
        ("7010E", "7010AC"),
        ("7208A", "7208A"),
        ("NU 207 ECP", "NU207E"),
        ("nu207", "NU207E"),
        ("NU206-E-TVP2", "NU206E"),
        ("NUP 308 ECML/C3", "NUP308E"),
        ("N 210", "N210E"),
        ("NU1010", "NU1010"),
        ("30206 J2/Q", "30206"),
        ("HR 32006 XJ", "32006"),
        ("32206-A", "32206"),
    ],
)
def test_what_people_write(written, name):
    found = parse_designation(written)
    assert found is not None and found.name == name
    assert parse_designation(name) == found._replace(clearance="", unread="")


@pytest.mark.parametrize(
    ("written", "unread"),
    [
        ("6306 ETN9", "ETN9"),
        ("6306-2RS1/C3WT", "WT"),
        ("6306-2Z", ""),
        ("7208 BECBP", ""),
        ("NU 207 ECML", ""),
        ("6306 XYZ", "XYZ"),
        ("6306-K", "K"),
        ("NU207 K", "K"),
    ],
)
def test_letters_that_are_not_read_are_kept(written, unread):
    found = parse_designation(written)
    assert found is not None and found.unread == unread
    if unread and found.kind == "deep-groove":
        assert f"({unread!r} of the designation is not taken into account)" in entry(written).description


@pytest.mark.parametrize("text", ["6321", "6399", "62/22", "NU1005", "30222", "61824", "foo", "", "63 2 10", "630"])
def test_no_designation(text):
    assert parse_designation(text) is None


@pytest.mark.parametrize(
    ("written", "message"),
    [
        ("6321", r"no bearing is called '6321' \(did you mean '6320' or 6319, .*known: 61804, .*by designation deep-groove 618, 619, 160"),
        ("6399", r"did you mean '6320'"),
        ("NJ 1005", r"did you mean 'NJ1006' or NJ1007"),
        ("7221 B", r"did you mean '7220B' or 7219B"),
        ("NU207F2x", None),
        ("63O6", r"did you mean '63\d6'"),
        ("bearing", r"no bearing is called 'bearing'; known: .* cylindrical NU, NJ, NUP, N 2, 3, 10; .* bores of 10 to 100 mm"),
    ],
)
def test_unknown_designations_come_with_their_neighbours(written, message):
    if message is None:
        assert entry(written).bearing.rollers == 14
        return
    with pytest.raises(UnknownName, match=message):
        entry(written)


@pytest.mark.parametrize(
    ("written", "message"),
    [
        ("1206", "'1206' is a self-aligning ball bearing: two rows .* Give its radial stiffness instead, and none against tilting"),
        ("2306 K", "'2306 K' is a self-aligning ball bearing"),
        ("3205", "a double-row angular-contact ball bearing. Take two of one row"),
        ("4205", "a double-row deep-groove ball bearing"),
        ("22210 E", "a spherical roller bearing"),
        ("51105", "a thrust bearing"),
        ("NU 2207 ECP", "a cylindrical roller bearing of a series whose dimensions are not in the table"),
        ("32310", None),
        ("31306", "a tapered roller bearing of a series whose dimensions are not in the table"),
        ("30206 B", "steeper contact angle than 30206, .* Give its envelope with contact_angle"),
        ("30305 DJ", "steeper contact angle than 30305"),
        ("7208", "'7208': an angular-contact bearing needs the letters of its contact angle.*B 40°, e.g. 7208B"),
        ("7208 C3", "needs the letters of its contact angle"),
    ],
)
def test_known_bearings_that_cannot_be_had(written, message):
    with pytest.raises(InputError, match=message):
        entry(written)


def test_a_hand_entry_goes_before_the_rule_and_a_file_before_both(tmp_path):
    assert entry("61804") == entry("61804-2RZ") and entry("61804").source("balls").flag == "back_fitted"
    assert entry("NU 207 ECP") == entry("NU207E") and entry("nu207").source("rollers").flag == "read"
    assert entry("NJ207").source("rollers").flag == "estimated"
    path = tmp_path / "own.toml"
    path.write_text('[bearings.6306.ball]\nballs = 9\nball_diameter = "8 mm"\npitch_diameter = "51 mm"\n')
    assert entry("6306", path).bearing.balls == entry("6306-2RS1", path).bearing.balls == 9
    assert entry("6306").bearing.balls == entry("6307", path).bearing.balls == 8


def test_the_hand_entry_of_nu207_has_a_dynamic_rating():
    """Its static rating is left to the paper's rollers, which are shorter than those of the maker."""
    card = entry("NU207E")
    assert card.bearing.dynamic_rating == 50.5e3 and card.source("dynamic_rating").flag == "read"
    assert card.bearing.static_rating is None and bearings.static_rating(card.bearing) == pytest.approx(42.4e3, rel=0.01)


def test_the_entry_of_a_designation():
    card = entry("6306")
    assert (card.bore, card.outer_diameter, card.width) == (0.030, 0.072, 0.019)
    assert card.source("bore").flag == "read" and {card.source(key).flag for key in ("balls", "dynamic_rating")} == {"estimated"}
    assert card.bearing.dynamic_rating == pytest.approx(29.6e3, rel=0.10) and card.bearing.radial_clearance == 0
    steep, flat = entry("7208B").bearing, entry("7208C").bearing
    assert np.degrees([steep.contact_angle, flat.contact_angle]) == pytest.approx([40, 15])
    assert steep.balls == 14 and flat.balls == 13 and steep.ball_diameter == entry("6208").bearing.ball_diameter
    taper = entry("30206")
    assert taper.bearing.contact_angle == pytest.approx(np.arctan(0.37 / 1.5)) and taper.width == 0.01725
    assert taper.source("contact_angle").flag == entry("7208B").source("contact_angle").flag == "read"
    roller = entry("NU210").bearing
    assert (roller.roller_diameter, roller.pitch_diameter) == pytest.approx((0.011, 0.0705), rel=1e-12)
    assert "its ribs are not in the model" in entry("NJ210").description


@pytest.mark.parametrize(
    ("written", "limits"),
    [
        ("6306 C3", (13, 28)),
        ("6306/C2", (1, 11)),
        ("6300CN", (2, 13)),
        ("6320-C4", (53, 84)),
        ("6307 C5", (40, 64)),
        ("NU208 C3", (45, 70)),
    ],
)
def test_the_clearance_class_sets_the_middle_of_its_range(written, limits):
    card = entry(written)
    assert card.bearing.radial_clearance == pytest.approx(sum(limits) / 2 * 1e-6, rel=1e-12)
    assert card.source("radial_clearance").text.startswith(f"middle of class {parse_designation(written).clearance} of ISO 5753-1")
    assert f"{limits[0]} to {limits[1]} um" in card.source("radial_clearance").text


def test_a_class_without_a_table_is_told():
    card = entry("7208B/C3")
    assert card.bearing.radial_clearance == 0 and "'C3' of the designation is not taken into account" in card.description
    assert entry("61804 C3").bearing.radial_clearance == pytest.approx(20.5e-6)


def test_letters_on_a_hand_entry_are_told_too():
    assert entry("61804 ETN9").description == "deep-groove ball bearing ('ETN9' of the designation is not taken into account)"
    assert entry("61804 ETN9").bearing == entry("61804").bearing


def test_every_designation_is_an_entry_and_named_by_itself():
    known = list(designations())
    assert len(known) == len(set(known)) > 400
    for name in known:
        found = parse_designation(name)
        assert found is not None and found.name == name and found.unread == ""
        card = designated_entry(found)
        given = {"bore", "outer_diameter", "width"} | card.bearing.model_fields_set
        assert all(card.source(key).text for key in given) and "dynamic_rating" in estimated_keys(card)


# ------------------------------------------------------------------------------------------------------------ the table itself


def rows():
    return ((kind, series, boundary_dimensions(kind, series)) for kind, all_series in known_series().items() for series in all_series)


def test_dimensions_grow_with_the_bore():
    for _, _, table in rows():
        sizes = list(table.values())
        for small, large in itertools.pairwise(sizes):
            assert small.bore < large.bore and small.outer_diameter < large.outer_diameter and small.width <= large.width
        assert [bore_code(1e3 * size.bore) for size in sizes] == list(table) == sorted(table)


def test_diameter_series_stand_in_their_order():
    tables = [boundary_dimensions("deep-groove", series) for series in ("618", "619", "60", "62", "63", "64")]
    for lighter, heavier in itertools.pairwise(tables):
        for code in lighter.keys() & heavier.keys():
            assert lighter[code].bore == heavier[code].bore and lighter[code].outer_diameter < heavier[code].outer_diameter
            assert lighter[code].width < heavier[code].width
    thin, normal = boundary_dimensions("deep-groove", "160"), boundary_dimensions("deep-groove", "60")
    assert all(thin[code].outer_diameter == normal[code].outer_diameter and thin[code].width < normal[code].width for code in thin)


def test_one_dimension_series_is_one_in_every_type():
    for ball, roller in (("62", "2"), ("63", "3"), ("60", "10")):
        other = boundary_dimensions("deep-groove", ball)
        for code, size in boundary_dimensions("cylindrical", roller).items():
            assert size[:3] == other[code][:3]
    for ball, taper in (("62", "302"), ("63", "303"), ("60", "320"), ("62", "322")):
        other = boundary_dimensions("deep-groove", ball)
        for code, size in boundary_dimensions("tapered", taper).items():
            assert size.outer_diameter == other[code].outer_diameter and size.width > other[code].width
    assert boundary_dimensions("angular-contact", "72") == boundary_dimensions("deep-groove", "62")


def test_raceways_lie_inside_their_rings():
    for series in known_series()["cylindrical"]:
        for size in boundary_dimensions("cylindrical", series).values():
            assert size.bore < size.inner_raceway < size.outer_raceway < size.outer_diameter
            middle = (size.inner_raceway + size.outer_raceway) / 2
            assert middle == pytest.approx((size.bore + size.outer_diameter) / 2, rel=0.016)


def test_clearance_classes_follow_each_other():
    for kind in ("deep-groove", "cylindrical"):
        for bore in (0.010, 0.0125, 0.030, 0.0301, 0.1):
            ranges = [clearance_range(kind, bore, each) for each in ("C2", "CN", "C3", "C4", "C5")]
            for low, high in itertools.pairwise(ranges):
                assert low[0] < low[1] and low[0] < high[0] and low[1] < high[1] and high[0] < low[1] + 20e-6
    assert clearance_range("deep-groove", 0.030, "C3") == (13e-6, 28e-6) and clearance_range("deep-groove", 0.0301, "C3") == (15e-6, 33e-6)
    assert clearance_range("deep-groove", 0.11, "C3") is None and clearance_range("tapered", 0.03, "C3") is None


# ------------------------------------------------------------------------------------------------------------ what is told


def test_what_is_estimated_is_told():
    card = entry("6306")
    (text,) = catalogue_findings("A", "6306-2RS1", card)
    assert text.startswith("bearing 'A' (6306-2RS1): deep-groove ball bearing; its inner geometry is estimated from its dimensions")
    assert "and from it C = 29.4 kN and C0 = 16.4 kN; the ratings of makers scatter about this by ±8 %" in text
    assert text.endswith("give dynamic_rating and static_rating of the maker")
    (text,) = catalogue_findings("A", "6306", card, dynamic_rating_given=True)
    assert "C0 = 16.4 kN" in text and "C = " not in text and text.endswith("give static_rating of the maker")
    (text,) = catalogue_findings("A", "6306", card, static_rating_given=True)
    assert "C = 29.4 kN" in text and "C0" not in text and text.endswith("give dynamic_rating of the maker")
    (text,) = catalogue_findings("B", "NU210", entry("NU210"), True, True)
    assert "estimated" in text and "kN" not in text and text.endswith("depend on that geometry")
    (text,) = catalogue_findings("B", "NU210", entry("NU210"))
    assert "scatter about this by ±6 %" in text
    assert list(catalogue_findings("A", "61804", entry("61804"))) == [] and estimated_keys(entry("61804")) == ()
    assert set(estimated_keys(card)) == {"balls", "ball_diameter", "pitch_diameter", "dynamic_rating", "static_rating"}


def test_a_file_of_ones_own_says_what_it_estimates(tmp_path):
    path = tmp_path / "own.toml"
    path.write_text(
        '[bearings.X.ball]\nballs = 9\nball_diameter = "8 mm"\npitch_diameter = "40 mm"\nstatic_rating = "9 kN"\n'
        '[[bearings.X.sources]]\nkeys = ["balls", "ball_diameter", "pitch_diameter"]\nflag = "read"\ntext = "drawing"\n'
        '[[bearings.X.sources]]\nkeys = ["static_rating"]\nflag = "estimated"\ntext = "by the drawing"\n'
    )
    (text,) = catalogue_findings("A", "X", entry("X", path))
    assert "C0 = 9 kN" in text and "C = " not in text and text.endswith("give static_rating of the maker")


def test_ratings_of_a_bearing_itself_are_no_finding():
    for name in itertools.chain(names(), designations()):
        assert list(rating_findings("A", entry(name).bearing)) == []


def test_ratings_that_contradict_the_geometry_are_told():
    bearing = entry("6306").bearing
    assert list(rating_findings("A", bearing, 29.6e3, 16e3)) == []
    (text,) = rating_findings("A", bearing, 44e3)
    assert text.startswith("bearing 'A': dynamic_rating 44 kN is 1.5 times the 29.4 kN that ISO 281 gives for its inner geometry")
    assert len(list(rating_findings("A", bearing, 20e3))) == 1 and list(rating_findings("A", bearing, 22e3)) == []
    (text,) = rating_findings("A", bearing, static_rating=30e3)
    assert text.startswith("bearing 'A': static_rating 30 kN is 1.9 times the 15.9 kN that ISO 76 gives")
    low, high, both = rating_findings("A", bearing, 10e3, 25e3)
    assert "dynamic_rating 10 kN is 0.34 times" in low and "static_rating 25 kN is 1.6 times" in high
    assert both.startswith("bearing 'A': static_rating is 2.5 times dynamic_rating; for such bearings it is 0.35 to 1.4 times")
    roller = entry("NU210").bearing
    assert list(rating_findings("A", roller, 73.5e3, 69.5e3)) == [] and len(list(rating_findings("A", roller, 73.5e3, 40e3))) == 2
    assert "0.65 to 2 times" in list(rating_findings("A", roller, 73.5e3, 40e3))[1]


def test_no_rating_is_asked_of_wide_grooves():
    wide = entry("6306").bearing.replace(outer_conformity=0.54, dynamic_rating="200 kN", static_rating="100 kN")
    (text,) = rating_findings("A", wide)
    assert "static_rating 100 kN" in text
    bare = bearings.BallBearing(balls=8, ball_diameter="12 mm", pitch_diameter="51 mm")
    assert list(rating_findings("A", bare)) == []
