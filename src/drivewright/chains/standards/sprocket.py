"""Sprockets of roller chains (ISO 606 family): diameters, dimension over pins, tooth gaps; numbers of inverted-tooth chains (ASME B29.2M).

`SOURCES` tells for every formula that is no plain geometry how far to trust it, and by which property the tests check it.
"""

from typing import Literal, NamedTuple

import numpy as np

from drivewright._typing import Floats, Numbers
from drivewright.chains.standards.given import above_zero, whole_teeth
from drivewright.chains.standards.layout import pitch_diameter
from drivewright.errors import InputError
from drivewright.materials import Source

INCH = 0.0254
Form = Literal["least", "greatest"]
SOURCES = {
    "root_diameter": Source("recalled: ISO 606; the rollers of a closed polygon touch the root circle", recalled=True),
    "tip_range": Source(
        "recalled: ISO 606; limits ordered, equal to tooth heights (p - d1)/2 and 0.625 p - d1/2 + 0.8 p/z above the pitch polygon, and "
        "printed values of ten chains in a public table",
        recalled=True,
    ),
    "over_pins": Source("closed form; the tests place the pins in the gaps and search the greatest distance", recalled=False),
    "tooth_gap": Source(
        "recalled: ISO 606, the same numbers seen in one other public program; arcs tangent, roller seated with play on both sides, the "
        "least gap inside the greatest",
        recalled=True,
    ),
    "silent_chain": Source("excerpt of ASME B29.2M on numbering, read, with its examples SC302, SC1012 and SC0309", recalled=False),
    "max_radius_over_chain": Source(
        "Machinery's Handbook, 27th edition, note on ANSI B29.2M, read in an excerpt; a limit that makers keep, not a computed size",
        recalled=False,
    ),
}


def root_diameter(pitch: Numbers, teeth: Numbers, roller_diameter: Numbers) -> Numbers:
    """df = d - d1 [m]: the circle that the seated rollers touch from outside."""
    _check_roller(pitch, roller_diameter)
    return pitch_diameter(pitch, teeth) - roller_diameter


def tip_range(pitch: float, teeth: Numbers, roller_diameter: float) -> tuple[Numbers, ...]:
    """Least and greatest tip diameter [m]: d + p (1 - 1.6/z) - d1 and d + 1.25 p - d1."""
    root = root_diameter(pitch, teeth, roller_diameter)
    return root + pitch * (1 - 1.6 / np.asarray(teeth)), root + 1.25 * pitch


def over_pins(pitch: Numbers, teeth: Numbers, roller_diameter: Numbers, pin_diameter: Numbers | None = None) -> Numbers:
    """Dimension over two pins in (nearly) opposite gaps  [m]: (df + dR) c + dR, c = 1 for even z, cos(pi/(2 z)) for odd z.

    pin_diameter dR: that of the roller where none is given, which makes it d c + d1.  Pins rest on the root circle.
    """
    pin = roller_diameter if pin_diameter is None else pin_diameter
    above_zero("sprocket", pin_diameter=pin)
    if np.any(np.asarray(pin) > 1.01 * np.asarray(roller_diameter)):
        raise InputError(
            f"sprocket: a pin of {np.max(pin):g} m does not reach the root of a gap for rollers of "
            f"{np.min(roller_diameter):g} m; take the roller's diameter or less."
        )
    lean = np.where(np.asarray(teeth) % 2 == 0, 1.0, np.cos(0.5 * np.pi / np.asarray(teeth)))
    return (root_diameter(pitch, teeth, roller_diameter) + pin) * lean + pin


class ToothGap(NamedTuple):
    """One limit of the gap between two teeth: seat radius ri [m], seat angle a [rad], flank radius re [m]."""

    seat_radius: float
    seat_angle: float
    flank_radius: float


def tooth_gap(teeth: int, roller_diameter: float, form: Form) -> ToothGap:
    """The "least" or "greatest" gap that the standard allows; a real one lies between the two.

    least:    ri = 0.505 d1,                      a = 140 deg - 90 deg/z,  re = 0.12 d1 (z + 2)
    greatest: ri = 0.505 d1 + 0.069 d1^(1/3),     a = 120 deg - 90 deg/z,  re = 0.008 d1 (z^2 + 180)      (d1 in mm in the cube root)
    """
    whole_teeth("sprocket", teeth)
    above_zero("sprocket", roller_diameter=roller_diameter)
    if form == "least":
        return ToothGap(0.505 * roller_diameter, np.radians(140 - 90 / teeth), 0.12 * roller_diameter * (teeth + 2))
    if form == "greatest":
        seat = 0.505 * roller_diameter + 0.069e-3 * np.cbrt(1e3 * roller_diameter)
        return ToothGap(seat, np.radians(120 - 90 / teeth), 0.008 * roller_diameter * (teeth**2 + 180))
    raise InputError(f"sprocket: the form of a gap is 'least' or 'greatest', got {form!r}.")


def gap_outline(pitch: float, teeth: int, roller_diameter: float, gap: ToothGap, tip_diameter: float, points: int = 41) -> Floats:
    """Outline (3 points - 2, 2) [m] of a gap on the y axis, from tip circle to tip circle, x rising; the sprocket's centre is the origin.

    The seat, an arc of ri with its lowest point on the root circle, goes over into the convex flanks, arcs of re with their centres in
    the teeth; both arcs share the tangent at +-a/2 from the lowest point.  Where the flanks of neighbours cross below the tip
    circle the tooth is pointed, and the outline refused.
    """
    root = 0.5 * root_diameter(pitch, teeth, roller_diameter)
    seat_centre = np.array([0.0, root + gap.seat_radius])
    half = 0.5 * gap.seat_angle
    flank_centre = seat_centre + (gap.seat_radius + gap.flank_radius) * _ray(half)
    last = _tip_ray(flank_centre, gap.flank_radius, 0.5 * tip_diameter, half)
    flank = flank_centre - gap.flank_radius * _ray(np.linspace(half, last, points))
    polar = np.arctan2(flank[:, 0], flank[:, 1])
    if polar[-1] > np.pi / teeth:
        pointed = np.interp(np.pi / teeth, polar, np.hypot(*flank.T))
        raise InputError(
            f"sprocket: with {teeth:g} teeth the flanks meet below the tip diameter {tip_diameter:g} m, near "
            f"{2 * pointed:.4g} m. Take a tip diameter below that or a smaller gap."
        )
    seat = seat_centre + gap.seat_radius * _ray(np.linspace(-half, half, points))
    return np.concatenate([flank[:0:-1] * (-1, 1), seat, flank[1:]])


def _ray(angle):
    """Unit vectors at an angle from straight down, to the right."""
    return np.stack([np.sin(angle), -np.cos(angle)], axis=-1)


def _tip_ray(centre, radius, tip, start):
    """Angle of the ray from a point of the flank to its centre where the flank reaches the tip circle: |c - re ray| = ra."""
    distance, along = np.hypot(*centre), np.arctan2(centre[0], -centre[1])
    cosine = (distance**2 + radius**2 - tip**2) / (2 * distance * radius)
    end = along - np.arccos(np.clip(cosine, -1, 1))
    if not (abs(cosine) <= 1 and end < start):
        raise InputError(
            f"sprocket: the flanks do not reach the tip diameter {2 * tip:g} m, or it lies below them; take one of `tip_range`."
        )
    return end


def _check_roller(pitch, roller_diameter):
    above_zero("sprocket", pitch=pitch, roller_diameter=roller_diameter)
    if np.any(np.asarray(roller_diameter) >= pitch):
        raise InputError(
            f"sprocket: rollers of {np.max(roller_diameter):g} m do not fit a pitch of {np.min(pitch):g} m; they would touch each other."
        )


def silent_chain(number: int | str | None) -> tuple[float, float]:
    """Pitch and nominal width [m] of an inverted-tooth chain from its number: "SC302" is 3/8 in by 2/4 in.

    From 3/8 in up: one or two digits of pitch in 1/8 in, two or three of width in 1/4 in.  Four digits are two and two, as no chain of
    one pitch digit is 25 in wide (16 pitches are the limit).  With a leading 0: one digit of pitch in 1/16 in, two of width in 1/32 in.
    """
    digits = number[2:] if isinstance(number, str) and number[:2] == "SC" else ""
    if not (digits.isascii() and digits.isdigit() and 3 <= len(digits) <= 5):
        raise InputError(f"silent chain: a number is SC and three to five digits, such as SC302, SC1012 or SC0309; got {number!r}.")
    small = digits[0] == "0"
    if small and len(digits) != 4:
        raise InputError(f"silent chain: after SC0 come one digit of pitch and two of width, as in SC0309; got {number!r}.")
    cut = 1 if len(digits) == 3 else 2
    pitch, width = int(digits[:cut]), int(digits[cut:])
    if pitch == 0 or width == 0:
        raise InputError(f"silent chain: pitch and width of {number!r} must be above 0.")
    return (pitch * INCH / 16, width * INCH / 32) if small else (pitch * INCH / 8, width * INCH / 4)


def silent_number(pitch: float, width: float) -> str:
    """The number of an inverted-tooth chain from pitch and nominal width [m]; the inverse of `silent_chain`."""
    above_zero("silent chain", pitch=pitch, width=width)
    small = pitch < 3 / 8 * INCH * (1 - 1e-9)
    steps = np.array([pitch, width]) / INCH * ((16, 32) if small else (8, 4))
    count = np.rint(steps).astype(int)
    if np.any(np.abs(steps - count) > 1e-6 * steps):
        units = "1/16 in and its width of 1/32 in" if small else "1/8 in and its width of 1/4 in"
        raise InputError(f"silent chain: the pitch must be a multiple of {units}, got {steps[0]:.4g} and {steps[1]:.4g} of them.")
    if count[0] > 99 or count[1] > (99 if count[0] < 10 else 999):
        raise InputError(
            f"silent chain: no chain number exists for {count[0]} steps of pitch and {count[1]} of width; the largest are 99 and 999, "
            "the width to 99 below ten steps of pitch."
        )
    return f"SC{'0' if small else ''}{count[0]}{count[1]:02d}"


def max_radius_over_chain(pitch: Numbers, teeth: Numbers) -> Numbers:
    """Radius [m] that a new silent chain on its sprocket does not exceed: pitch radius + 0.75 p."""
    return 0.5 * pitch_diameter(pitch, teeth) + 0.75 * pitch
