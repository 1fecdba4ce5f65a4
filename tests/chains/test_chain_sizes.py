"""Roller chains by number: the table against others, how a number may be written, what is refused and with which neighbours."""

import numpy as np
import pytest

from drivewright.chains.roller_sprocket import design_roller_sprocket
from drivewright.chains.sizes import UnknownChain, chain_numbers, chain_size, similar_numbers
from drivewright.errors import InputError

MM = 1e-3

# Another maker's tables (Galaxy Chain: simplex, duplex, triplex, BS 228 and ANSI B29.1): pitch, row pitch, roller, pin, inner width, plate
# height [mm], minimum tensile strengths [kN] and masses [kg/m] with one, two and three rows.
OTHER = {
    "08B": (12.7, 13.92, 8.51, 4.45, 7.75, 11.81, (17.80, 31.10, 44.50), (0.650, 1.300, 1.920)),
    "10B": (15.875, 16.59, 10.16, 5.08, 9.65, 14.73, (22.27, 44.54, 66.81), (0.928, 1.856, 2.785)),
    "12B": (19.05, 19.46, 12.07, 5.72, 11.68, 16.13, (28.94, 57.88, 86.82), (1.244, 2.487, 3.731)),
    "16B": (25.4, 31.88, 15.88, 8.28, 17.02, 21.08, (60.92, 106.14, 160.10), (2.612, 5.213, 7.819)),
    "20B": (31.75, 36.45, 19.05, 10.19, 19.56, 26.42, (95.16, 170.05, 250.16), (3.802, 7.605, 11.407)),
    "24B": (38.1, 48.36, 25.40, 14.63, 25.40, 33.40, (160.04, 280.07, 425.02), (7.138, 14.278, 21.417)),
    "28B": (44.45, 59.56, 27.94, 15.90, 30.99, 37.08, (200.05, 359.90, 529.95), (8.955, 17.909, 26.864)),
    "32B": (50.8, 58.55, 29.21, 17.81, 30.99, 42.29, (250.60, 449.92, 669.79), (9.695, 19.391, 29.086)),
    "40B": (63.5, 72.29, 39.37, 22.88, 38.10, 52.56, (355.00, 617.81, 931.63), (16.019, 31.734, 47.703)),
    "12A": (19.05, 22.78, 11.91, 5.96, 12.58, 18.08, (31.28, 62.57, 93.85), (1.506, 3.011, 4.516)),
    "16A": (25.4, 29.29, 15.88, 7.94, 15.75, 24.13, (55.62, 111.25, 166.87), (2.572, 5.143, 7.715)),
    "20A": (31.75, 35.76, 19.05, 9.54, 18.90, 30.18, (86.87, 173.54, 260.31), (3.993, 7.814, 11.804)),
    "24A": (38.1, 45.44, 22.23, 11.11, 25.22, 36.20, (126.99, 253.99, 380.98), (6.008, 11.976, 17.994)),
    "28A": (44.45, 48.87, 25.40, 12.71, 25.23, 42.24, (172.40, 344.80, 517.20), (7.623, 15.246, 22.869)),
    "32A": (50.8, 58.55, 28.58, 14.29, 31.55, 48.26, (226.82, 453.55, 680.28), (10.252, 20.360, 30.600)),
}
# ASME B29.1 as two public pages print it (amesweb.info, engineersedge.com): pitch, roller, width, pin, plate [inch], MUTS [lbf].
ASME = {
    "25": (0.250, 0.130, 0.125, 0.0905, 0.030, 780),
    "35": (0.375, 0.200, 0.188, 0.141, 0.050, 1760),
    "41": (0.500, 0.306, 0.250, 0.141, 0.050, 1500),
    "40": (0.500, 0.312, 0.312, 0.156, 0.060, 3125),
    "50": (0.625, 0.400, 0.375, 0.200, 0.080, 4880),
    "60": (0.750, 0.469, 0.500, 0.234, 0.094, 7030),
    "80": (1.000, 0.625, 0.625, 0.312, 0.125, 12500),
    "100": (1.250, 0.750, 0.750, 0.375, 0.156, 19530),
    "120": (1.500, 0.875, 1.000, 0.437, 0.187, 28125),
    "140": (1.750, 1.000, 1.000, 0.500, 0.219, 38280),
    "160": (2.000, 1.125, 1.250, 0.562, 0.250, 50000),
    "180": (2.250, 1.406, 1.406, 0.687, 0.281, 63280),
    "200": (2.500, 1.562, 1.500, 0.781, 0.312, 78125),
    "240": (3.000, 1.875, 1.875, 0.937, 0.375, 112500),
}
ISO_FIRST = (
    "05B",
    "06B",
    "08B",
    "10B",
    "12B",
    "16B",
    "20B",
    "24B",
    "28B",
    "32B",
    "04C",
    "06C",
    "08A",
    "10A",
    "12A",
    "16A",
    "20A",
    "24A",
    "28A",
    "32A",
)


@pytest.mark.golden
@pytest.mark.parametrize("number", OTHER)
def test_another_maker_prints_the_same_chain(number):
    pitch, row_pitch, roller, pin, width, height, strengths, masses = OTHER[number]
    for rows, strength, mass in zip((1, 2, 3), strengths, masses, strict=True):
        size = chain_size(f"{number}-{rows}")
        assert size.pitch == pytest.approx(pitch * MM, abs=1e-9) and size.row_pitch == pytest.approx(row_pitch * MM, abs=1e-9)
        assert size.roller_diameter == pytest.approx(roller * MM, abs=0.01 * MM)
        assert size.pin_diameter == pytest.approx(pin * MM, abs=0.025 * MM)
        assert size.inner_width == pytest.approx(width * MM, abs=0.015 * MM)
        assert size.plate_height == pytest.approx(height * MM, rel=0.03)
        assert size.tensile_strength == pytest.approx(strength * 1e3, rel=0.021) and size.tensile_strength <= 1.021e3 * strength
        assert size.mass_per_length == pytest.approx(mass, rel=0.09)


@pytest.mark.golden
@pytest.mark.parametrize("number", ASME)
def test_american_chains_are_those_of_the_standard(number):
    pitch, roller, width, pin, plate, strength = ASME[number]
    size = chain_size(number)
    assert size.pitch == pytest.approx(pitch * 25.4 * MM, abs=0.001 * MM) and size.ansi == number
    assert size.roller_diameter == pytest.approx(roller * 25.4 * MM, abs=0.04 * MM)
    assert size.pin_diameter == pytest.approx(pin * 25.4 * MM, rel=0.01)
    assert size.inner_width == pytest.approx(width * 25.4 * MM, rel=0.02), "ISO gives the least width, ASME the nominal one"
    assert size.outer_plate == pytest.approx(plate * 25.4 * MM, rel=0.055)
    assert size.tensile_strength == pytest.approx(strength * 4.4482216, rel=6e-3)


@pytest.mark.parametrize("number", ISO_FIRST)
def test_the_usual_numbers_are_known(number):
    size = chain_size(number)
    assert size.number == number and size.rows == 1 and 0 < size.pin_diameter < size.roller_diameter < size.pitch
    assert size.inner_width < size.bush_length == pytest.approx(size.inner_width + 2 * size.inner_plate)
    assert size.bush_chain == number.endswith("C")


@pytest.mark.property
def test_every_chain_of_the_table_is_one_that_can_be():
    names = [name.partition(" ")[0] for name in chain_numbers()]
    assert len(names) == len(set(names)) == 31
    for name in names:
        size = chain_size(name)
        design_roller_sprocket(19, size.pitch, size.roller_diameter)
        assert size.plate_height < size.pitch and size.outer_plate <= size.inner_plate
        if size.row_pitch:  # a strand of a wider chain: its inner link and at least one plate stand between two middles
            twice, room = chain_size(f"{name}-2"), size.row_pitch - size.bush_length
            assert room > 0.6 * size.outer_plate and 1.5 < twice.tensile_strength / size.tensile_strength <= 2.006
            assert 1.6 < twice.mass_per_length / size.mass_per_length < 2.25


@pytest.mark.property
def test_american_numbers_are_pitches_in_eighths_of_an_inch():
    for number in ASME:
        eighths = int(number[:-1])
        assert chain_size(number).pitch == pytest.approx(eighths * 25.4 / 8 * MM, rel=2e-4)
    for number in ("05B", "06B", "08B", "10B", "12B", "16B", "24B", "32B"):
        assert chain_size(number).pitch == pytest.approx(int(number[:2]) * 25.4 / 16 * MM, rel=0.01)


@pytest.mark.interface
@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("08B", "08B-1"),
        ("8b", "08B-1"),
        ("ISO 606 08B-2", None),
        ("DIN 08 B - 2", "08B-2"),
        ("#40", "08A-1 (ANSI 40)"),
        ("ANSI 80-3", "16A-3 (ANSI 80)"),
        ("RS60", "12A-1 (ANSI 60)"),
        ("08A", "08A-1 (ANSI 40)"),
        ("041", "085-1 (ANSI 41)"),
        ("085", "085-1 (ANSI 41)"),
        ("06C", "06C-1 (ANSI 35)"),
    ],
)
def test_how_a_number_may_be_written(text, name):
    if name is None:
        with pytest.raises(UnknownChain):
            chain_size(text)
    else:
        assert chain_size(text).name == name


@pytest.mark.error
@pytest.mark.parametrize(
    ("text", "nearest"), [("07B", "06B"), ("9B", "08B"), ("45", "40"), ("08X", "08B"), ("16", "15"), ("400", "40"), ("foo", None)]
)
def test_an_unknown_number_is_refused_with_the_nearest(text, nearest):
    with pytest.raises(UnknownChain) as refused:
        chain_size(text)
    message = str(refused.value)
    assert text in message and "known: 04B" in message and "08A = 40" in message
    assert (f"did you mean {nearest}" in message or nearest in similar_numbers(text)) if nearest else "did you mean" not in message


@pytest.mark.error
@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("60H", "heavy-series"),
        ("C2040", "double-pitch"),
        ("208B", "double-pitch"),
        ("SC302", "inverted-tooth"),
        ("08B-4", "1 to 3 rows"),
        ("41-3", "take -2"),
        ("15-2", "one row"),
    ],
)
def test_known_chains_beyond_the_table_are_refused_with_the_reason(text, reason):
    with pytest.raises(InputError, match=reason):
        chain_size(text)


@pytest.mark.property
def test_strengths_of_more_rows_are_below_those_of_as_many_single_chains():
    for number in OTHER:
        strengths = np.array([chain_size(f"{number}-{rows}").tensile_strength for rows in (1, 2, 3)])
        assert np.all(strengths / strengths[0] <= np.array([1, 2, 3]) * 1.003)


@pytest.mark.golden
@pytest.mark.parametrize(
    ("number", "row_pitch", "height"),  # GOST 13568-97, annex A (ISO 606:1994)
    [("05B", 5.64, 7.11), ("06B", 10.24, 8.26), ("08A", 14.38, 12.07), ("08B", 13.92, 11.81), ("10A", 18.11, 15.09), ("32A", 58.55, 48.26)],
)
def test_rows_and_plates_of_the_russian_standard(number, row_pitch, height):
    assert chain_size(number).row_pitch == pytest.approx(row_pitch * MM, abs=1e-9)
    assert chain_size(number).plate_height == pytest.approx(height * MM, rel=0.011)
