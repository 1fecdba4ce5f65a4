"""Two sprockets and the taut chain around them: how many links, how far apart, how much is wrapped.

Joints of a chain lie on the pitch circles, R = p/(2 sin(pi/z)).  A strand that touches both circles makes the *strand angle* g with
the line of centres, sin g = (R2 - R1)/C; arcs are counted in links, z to the turn, as the chain lies there as a polygon.  This is exact
where a joint stands at each of the four tangent points; in between, the polygon action of the strands moves C by micrometres.
"""

import numpy as np

from drivewright._typing import Numbers
from drivewright.chains.standards.given import above_zero, from_zero, whole_teeth
from drivewright.errors import InputError
from drivewright.numerics.roots import bracketed_roots


def pitch_diameter(pitch: Numbers, teeth: Numbers) -> Numbers:
    """Diameter of the circle through the joints of a seated chain, p/sin(pi/z)  [m]."""
    above_zero("sprocket", pitch=pitch)
    whole_teeth("sprocket", teeth)
    return pitch / np.sin(np.pi / np.asarray(teeth))


def strand_angle(pitch: float, teeth1: int, teeth2: int, distance: Numbers) -> Numbers:
    """g [rad]: from the line of centres to a strand, asin((R2 - R1)/C); above 0 where the second sprocket is the larger."""
    radius1, radius2 = 0.5 * pitch_diameter(pitch, teeth1), 0.5 * pitch_diameter(pitch, teeth2)
    above_zero("chain drive", distance=distance)
    if np.any(distance <= radius1 + radius2):
        raise InputError(
            f"chain drive: at the centre distance {np.min(distance):g} m the pitch circles overlap; "
            f"it must exceed {np.max(radius1 + radius2):g} m, and the tip circles need more."
        )
    return np.arcsin((radius2 - radius1) / distance)


def strand_angle_cosine(pitch: float, teeth1: int, teeth2: int, links: float) -> float:
    """cos g [-] of the strands' angle to the line of centres, of the taut chain by pitch circles.

    1, strands along the line of centres, where the chain does not reach around the circles.
    """
    try:
        distance = centre_distance(pitch, teeth1, teeth2, links)
    except InputError:
        return 1.0
    return float(np.cos(strand_angle(pitch, teeth1, teeth2, distance)))


def wrap_angles(pitch: float, teeth1: int, teeth2: int, distance: Numbers) -> tuple[Numbers, Numbers]:
    """Angles [rad] over which the chain lies on each sprocket: pi - 2 g, pi + 2 g."""
    angle = strand_angle(pitch, teeth1, teeth2, distance)
    return np.pi - 2 * angle, np.pi + 2 * angle


def strand_length(pitch: float, teeth1: int, teeth2: int, distance: Numbers) -> Numbers:
    """Length of a taut strand between its tangent points, C cos g  [m]."""
    return distance * np.cos(strand_angle(pitch, teeth1, teeth2, distance))


def chain_links(pitch: float, teeth1: int, teeth2: int, distance: Numbers) -> Numbers:
    """Number of links of the taut chain, no whole number: 2 C cos g/p + (z1 + z2)/2 + (z2 - z1) g/pi."""
    angle = strand_angle(pitch, teeth1, teeth2, distance)
    return 2 * distance * np.cos(angle) / pitch + (teeth1 + teeth2) / 2 + (teeth2 - teeth1) * angle / np.pi


def even_links(links: Numbers) -> Numbers:
    """The least even number of links that is no shorter: what spares a chain the cranked link.

    A number that misses an even one by less than 1e-9 of itself counts as that one.
    """
    above_zero("chain", number_of_links=links)
    return 2 * np.ceil(0.5 * np.asarray(links) * (1 - 1e-9)).astype(int)


def centre_distance(pitch: float, teeth1: int, teeth2: int, links: float) -> float:
    """C [m] at which the chain of this number of links is taut: the inverse of `chain_links`, for single numbers.

    Once the pitch circles are apart the number grows with C, and 2 C/p is below it: the root lies between R1 + R2 and p N/2.
    """
    above_zero("chain drive", number_of_links=links)
    touching = 0.5 * (pitch_diameter(pitch, teeth1) + pitch_diameter(pitch, teeth2)) * (1 + 1e-12)
    least = chain_links(pitch, teeth1, teeth2, touching)
    if links < least:
        raise InputError(
            f"chain drive: {links:g} links of {pitch:g} m do not reach around {teeth1:g} and {teeth2:g} teeth; "
            f"with touching pitch circles it takes {least:.4g}. Take at least {even_links(least)} links."
        )
    ends = np.array([touching, 0.5 * pitch * links], dtype=float)
    root = bracketed_roots(lambda distance: chain_links(pitch, teeth1, teeth2, distance) - links, ends)
    return float(root[0])


def approximate_links(pitch: float, teeth1: float, teeth2: int, distance: float) -> float:
    """2 C/p + (z1 + z2)/2 + ((z2 - z1)/(2 pi))^2 p/C, the usual formula (ISO 10823, makers' catalogues; recalled).

    Less than the exact number by (C/p) s^4/12 + ..., s = (z2 - z1) p/(2 pi C), nothing at equal tooth numbers.
    """
    above_zero("chain drive", pitch=pitch, distance=distance)
    whole_teeth("chain drive", teeth1, teeth2)
    return 2 * distance / pitch + (teeth1 + teeth2) / 2 + ((teeth2 - teeth1) / (2 * np.pi)) ** 2 * pitch / distance


def approximate_centre_distance(pitch: float, teeth1: int, teeth2: int, links: float) -> float:
    """The C [m] whose `approximate_links` is N: (p/4) (u + sqrt(u^2 - 8 ((z2 - z1)/(2 pi))^2)), u = N - (z1 + z2)/2."""
    above_zero("chain drive", pitch=pitch, number_of_links=links)
    whole_teeth("chain drive", teeth1, teeth2)
    free = links - (teeth1 + teeth2) / 2
    square = free**2 - 8 * ((teeth2 - teeth1) / (2 * np.pi)) ** 2
    if np.any(free <= 0) or np.any(square < 0):
        raise InputError(f"chain drive: {np.min(links):g} links are too few around {np.max(teeth1):g} and {np.max(teeth2):g} teeth.")
    return 0.25 * pitch * (free + np.sqrt(square))


def distance_factor(teeth1: int, teeth2: int, links: float) -> float:
    """f4 [-] of C = f4 p (2 N - z1 - z2), which ISO 10823 tabulates over q = (N - z)/(z' - z), z < z' the tooth numbers (recalled).

    It is the exact drive with pitch circles of the circumference z p: with t the tangent of the half wrap on the smaller sprocket,
    t - atan t = pi (q - 1) and f4 = sqrt(1 + t^2)/(2 pi (2 q - 1)); 1/4 at equal tooth numbers.
    """
    small, large = sorted((teeth1, teeth2))
    whole_teeth("chain drive", small, large)
    above_zero("chain drive", number_of_links=links)
    if links <= large:
        raise InputError(f"chain drive: {links:g} links do not reach around {large:g} teeth and back; take more than {large:g}.")
    if small == large:
        return 0.25
    q = (links - small) / (large - small)
    target = np.pi * (q - 1)
    t = bracketed_roots(lambda t: t - np.arctan(t) - target, [0.0, target + 0.5 * np.pi])[0]
    return float(np.sqrt(1 + t * t) / (2 * np.pi * (2 * q - 1)))


def min_centre_distance(
    pitch: float, teeth1: int, teeth2: int, tip_diameters: tuple[float, float] = (0.0, 0.0), least_wrap: float = 2 * np.pi / 3
) -> float:
    """Least C [m] that keeps tips and pitch circles apart and wraps the smaller sprocket by `least_wrap`.

    The wrap pi - 2 g asks C >= |R2 - R1|/cos(wrap/2): for 120 deg the difference of the pitch diameters.
    """
    if not 0 < least_wrap < np.pi:
        raise InputError(f"chain drive: the minimum wrap must lie between 0 and 180°, got {np.degrees(least_wrap):g}°.")
    from_zero("chain drive", tip_diameters=tip_diameters)
    first, second = 0.5 * pitch_diameter(pitch, teeth1), 0.5 * pitch_diameter(pitch, teeth2)
    return float(max(0.5 * sum(tip_diameters), first + second, abs(second - first) / np.cos(0.5 * least_wrap)))


def usual_centre_distances(pitch: float, teeth1: int, teeth2: int, tip_diameters: tuple[float, float] = (0.0, 0.0)) -> tuple[float, float]:
    """The range of 30 to 50 pitches that makers recommend, raised to `min_centre_distance` where that is more  [m].

    A rule of thumb: HKK Chain and others name these numbers on their pages (read); no law stands behind them.
    """
    least = min_centre_distance(pitch, teeth1, teeth2, tip_diameters)
    return max(30 * pitch, least), max(50 * pitch, least)
