"""Numbers along a logarithmic axis as text, which a page lets one select, where matplotlib's own are formulas."""

import math

from matplotlib.ticker import LogFormatter

from drivewright.view.text import SUPERSCRIPT

PLAIN = 100  # below it, from 1 on, no powers


class PowersOfTen(LogFormatter):
    """'10⁻³', '2×10⁻³', '20': of the ticks that matplotlib names, those between the decades where there are few of these."""

    def __call__(self, x: float, pos: int | None = None) -> str:
        """The name of the tick at `x`; "" where it has none."""
        return power_of_ten(x) if x > 0 and super().__call__(x, pos) else ""


def power_of_ten(x: float) -> str:
    """'10⁻³', '2×10⁻³'; '1', '20' where a power says less."""
    if 1 <= x < PLAIN:
        return f"{x:g}"
    mantissa, exponent = f"{x:.3e}".split("e")
    power = "10" + str(int(exponent)).translate(SUPERSCRIPT)
    return power if math.isclose(float(mantissa), 1.0) else f"{float(mantissa):g}×{power}"
