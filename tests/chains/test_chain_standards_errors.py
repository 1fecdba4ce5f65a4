"""What the formulas of chain drives refuse, and what they say then."""

import numpy as np
import pytest

from drivewright.chains import standards as s
from drivewright.errors import InputError

pytestmark = pytest.mark.error

P = 9.525e-3
NAN = float("nan")
TABLE = s.rating_table([11, 25], [2.0, 60.0], [[100.0, 900.0], [300.0, 2000.0]])


def refused(match, function, *arguments, **named):
    with pytest.raises(InputError, match=match):
        function(*arguments, **named)


@pytest.mark.parametrize(
    ("pitch", "teeth", "match"),
    [
        (-P, 20, "pitch must be finite and above 0, got -0.009525"),
        (NAN, 20, "pitch must be finite and above 0, got nan"),
        (P, 20.5, "tooth numbers must be whole and 5 or more, got 20.5"),
        (P, np.array([20, 4]), "got 4"),
        (P, np.inf, "got inf"),
    ],
)
def test_pitch_and_teeth(pitch, teeth, match):
    refused(match, s.pitch_diameter, pitch, teeth)


def test_sprockets_that_overlap():
    refused(r"at the centre distance 0.1 m the pitch circles overlap; it must exceed 0.109\d+ m", s.chain_links, P, 35, 37, 0.1)
    refused("distance must be finite and above 0, got nan", s.wrap_angles, P, 35, 37, NAN)


def test_too_few_links():
    refused(r"50 links of 0.009525 m do not reach around 35 and 37 teeth.*Take at least 60 links", s.centre_distance, P, 35, 37, 50)
    assert s.centre_distance(P, 35, 37, 60) > 0.1091  # the advice holds
    refused("number of links must be finite and above 0, got -3", s.centre_distance, P, 35, 37, -3)
    refused("30 links are too few around 35 and 37 teeth", s.approximate_centre_distance, P, 35, 37, 30)
    refused("52 links are too few around 17 and 85 teeth", s.approximate_centre_distance, P, 17, 85, 52)
    refused("37 links do not reach around 37 teeth and back; take more than 37", s.distance_factor, 37, 35, 37)
    refused("number of links must be finite and above 0, got nan", s.distance_factor, 35, 37, NAN)
    refused("number of links must be finite and above 0, got 0", s.even_links, 0)
    refused("tooth numbers must be whole and 5 or more, got 3.5", s.approximate_links, P, 3.5, 37, 0.3)


def test_least_wrap():
    for wrap in (0.0, np.pi, 4.0, NAN):
        refused(r"minimum wrap must lie between 0 and 180°, got (0|180|229|nan)", s.min_centre_distance, P, 20, 60, least_wrap=wrap)
    refused("tip diameters must be finite and 0 or more, got -1", s.min_centre_distance, P, 20, 60, (0.1, -1.0))


def test_loops():
    refused("needs two circles or more, got 1", s.loop_length, [(0, 0, 1)])
    refused("turn of circle 2 must be .1 .counter-clockwise. or -1, got 0", s.loop_length, [(0, 0, 1), (5, 0, 1, 0)])
    refused("circle 1 needs a finite centre and a radius of 0 or more", s.loop_length, [(0, NAN, 1), (5, 0, 1)])
    refused("circle 2 needs a finite centre and a radius of 0 or more", s.loop_length, [(0, 0, 1), (5, 0, -1)])
    refused(
        "no strand fits between circle 1 and the next: their centres are 1000 mm apart and must be more than 2000 mm apart",
        s.loop_length,
        [(0, 0, 1), (1, 0, 3)],
    )
    refused("2 tooth numbers for 3 circles", s.taut_loop([(0, 0, 1), (5, 0, 1), (2, 4, 1)]).links, P, (20, 20))


def test_a_loop_that_misses_a_circle_or_crosses_itself():
    refused(
        r"turns 2 times in all.*largest wrap is 3\d\d° on circle 2. Leave out circles that the loop misses",
        s.loop_length,
        [(0, 0, 1), (2.5, 0, 0.2), (5, 0, 1), (2.5, 4, 1)],
    )
    refused("turns 0 times in all instead of once", s.loop_length, [(0, 0, 1), (5, 0, 1, -1)])


def test_rollers_and_pins():
    refused("rollers of 0.01 m do not fit a pitch of 0.009525 m", s.root_diameter, P, 20, 0.01)
    refused("roller diameter must be finite and above 0, got 0", s.tip_range, P, 20, 0.0)
    refused("a pin of 0.0066 m does not reach the root of a gap for rollers of 0.00635 m", s.over_pins, P, 20, 6.35e-3, 6.6e-3)
    refused("pin diameter must be finite and above 0, got -1", s.over_pins, P, 20, 6.35e-3, -1.0)


def test_gaps():
    refused("form of a gap is 'least' or 'greatest', got 'mean'", s.tooth_gap, 20, 6.35e-3, "mean")
    wide, tips = s.tooth_gap(20, 6.35e-3, "greatest"), s.tip_range(P, 20, 6.35e-3)
    refused(
        r"with 20 teeth the flanks meet below the tip diameter 0.0664\d+ m, near 0.0646 m. Take a tip diameter below",
        s.gap_outline,
        P,
        20,
        6.35e-3,
        wide,
        tips[1],
    )
    assert len(s.gap_outline(P, 20, 6.35e-3, wide, 0.0645)) == 3 * 41 - 2  # the advice holds
    for tip in (0.4, 0.056):
        refused("flanks do not reach the tip diameter 0.(4|056) m, or it lies below them", s.gap_outline, P, 20, 6.35e-3, wide, tip)


@pytest.mark.parametrize("number", ["SC30", "SC302505", "302", "SC3-2", "sc302", "SC³02", 302, None])
def test_no_number_of_a_silent_chain(number):
    refused(f"SC and three to five digits, such as SC302, SC1012 or SC0309; got {number!r}", s.silent_chain, number)


def test_numbers_of_silent_chains_that_mean_nothing():
    refused("after SC0 come one digit of pitch and two of width, as in SC0309; got 'SC030'", s.silent_chain, "SC030")
    refused("pitch and width of 'SC300' must be above 0", s.silent_chain, "SC300")
    refused("pitch must be a multiple of 1/8 in and its width of 1/4 in, got 3 and 2.2", s.silent_number, P, 14e-3)
    refused("1/16 in and its width of 1/32 in, got 2.52 and 8", s.silent_number, 4e-3, 6.35e-3)
    refused("no chain number exists for 3 steps of pitch and 100 of width", s.silent_number, P, 25 * 25.4e-3)
    refused("no chain number exists for 100 steps of pitch", s.silent_number, 12.5 * 25.4e-3, 25 * 25.4e-3)


def test_forces():
    refused("speed must be finite and above 0, got 0", s.strand_tension, 100.0, 0.0, 0.5)
    refused("power must be finite and 0 or more, got -100", s.strand_tension, -100.0, 3.0, 0.5)
    refused("mass per length must be finite and 0 or more", s.centrifugal_tension, -0.5, 3.0)
    refused("tension must be finite and above 0, got 0", s.tensile_safety, 2e4, 0.0)
    refused("tension above that at rest must be finite and above 0, got -50", s.max_power, 100.0, 0.5, 150.0)
    refused("bush length must be finite and above 0, got 0", s.articulation_pressure, 100.0, 3e-3, 0.0)
    refused("mass per length must be finite and 0 or more, got -1", s.meeting_energy, P, -1.0, 50.0)


def test_strands():
    refused(
        "speed of 40 m/s exceeds the wave speed of 37.79.*the tension must exceed the centrifugal tension",
        s.strand_frequency,
        1000.0,
        0.7,
        0.4,
        40.0,
    )
    refused("mode must be a whole number from 1 up, got 0", s.strand_frequency, 1000.0, 0.7, 0.4, 4.0, 0)
    refused("harmonic must be a whole number from 1 up, got 1.5", s.resonance_speed, 1000.0, 0.7, 0.4, P, 1, 1.5)
    refused("pull must be finite and above 0, got -1", s.resonance_speed, -1.0, 0.7, 0.4, P)


def test_tables():
    refused(r"powers of shape \(1, 2\) for 2 tooth numbers and 2 speeds", s.rating_table, [11, 25], [2.0, 60.0], [[100.0, 900.0]])
    refused("08B: powers must be finite and above 0, got 0", s.rating_table, [11], [2.0, 60.0], [0.0, 900.0], "08B")
    for teeth, speeds in (([25, 11], [2.0, 60.0]), ([11, 25], [60.0, 2.0])):
        refused("tooth numbers and speeds must increase", s.rating_table, teeth, speeds, np.ones((2, 2)))
    refused("at least two speeds are needed", s.rating_table, [11], [2.0], [[1.0]])


def test_nothing_is_read_off_outside_of_a_table():
    refused("08B: teeth 26 lies outside of it, 11..25; a rating is not extended", s.rated_power, TABLE, 26, 5.0, "08B")
    refused("speed 1.9 rad/s lies outside of it, 2..60 rad/s", s.rated_power, TABLE, 20, 1.9)


def test_selection():
    refused("no table covers 30 teeth at 5 rad/s", s.suitable_chains, {"08B": TABLE}, 10.0, 30, 5.0)
    stronger = TABLE._replace(powers=2 * TABLE.powers)
    refused(
        r"no chain is rated for 5000 W with 25 teeth at 60 rad/s; the strongest, 10B, reaches 4000 W. Take more strands",
        s.suitable_chains,
        {"08B": TABLE, "10B": stronger},
        5000.0,
        25,
        60.0,
    )
    refused("service factor must be finite and above 0, got 0", s.design_power, 100.0, 0.0)
