"""A strand of plates and pins as solids: links of a and of b plates in turn, their sheets laid alternately."""

import numpy as np

from drivewright._typing import Floats
from drivewright.chains.plate import Plate
from drivewright.errors import InputError
from drivewright.scene import Part, Prism


def sheet_heights(plate: Plate, lacing: tuple[int, int], play: float = 0.0) -> tuple[Floats, Floats]:
    """Heights [m] of the sheets' lower faces for the two kinds of link, middle of the stack at 0: two arrays.

    Sheets alternate, so that the two numbers differ by one at most; play [m] between two sheets.
    """
    a, b = lacing
    if not (a >= 1 and b >= 1 and abs(a - b) <= 1 and float(a).is_integer() and float(b).is_integer()):
        raise InputError(
            f"lacing {a:g} x {b:g}: alternating plates need two whole numbers of at least 1 that differ by at most 1, such as 2 x 3."
        )
    step = plate.thickness + play
    z = (np.arange(float(a + b)) - 0.5 * (a + b)) * step + 0.5 * play
    return (z[::2], z[1::2]) if a >= b else (z[1::2], z[::2])


def strand_parts(plate: Plate, poses: Floats, lacing: tuple[int, int], play: float = 0.0, overhang: float = 0.0) -> tuple[Part, ...]:
    """`Part` of each link at poses (n, 3): its sheets and its own pins, which stick out by `overhang` [m] on both sides.

    A shared hinge pin belongs to the link on its left; the first link has its left one too.
    """
    heights = sheet_heights(plate, lacing, play)
    low, high = min(map(np.min, heights)) - overhang, max(map(np.max, heights)) + plate.thickness + overhang
    left, right = (Prism(pin, (), float(low), float(high - low)) for pin in plate.own_pins)
    parts = []
    for k, pose in enumerate(np.atleast_2d(poses)):
        sheets = tuple(Prism(plate.outline, plate.holes, float(z), plate.thickness) for z in heights[k % 2])
        pins = (left, right) if plate.pins.pins_per_joint == 2 or k == 0 else (right,)
        x, y, turn = map(float, pose)
        parts.append(Part(f"link {k}", (*sheets, *pins), (x, y, turn), ("steel", "blue")[k % 2], f"link{k}"))
    return tuple(parts)
