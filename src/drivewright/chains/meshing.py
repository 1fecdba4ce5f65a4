"""Meshing of a rocker-joint silent chain as An, Cheng, Li and Xu published it (Machines 2022, 10, 325), in numerically stable forms.

Numbers or arrays that broadcast; p pitch, A hole pitch, r rolling radius, e offset of the pin centres below the pitch line, z teeth,
t = pi/z half the seating angle, a flank angle, f apothem.  The equations' numbers are those of the paper; read, corrected where told.
"""

from typing import Literal

import numpy as np

from drivewright._typing import Numbers

IDEALS = ("seat", "rack")
Ideal = Literal["seat", "rack"]


def hole_pitch(p: Numbers, r: Numbers) -> Numbers:
    """A = p + 2 r  (1)  [m]."""
    return p + 2 * r


def equivalent_pitch(A: Numbers, r: Numbers, e: Numbers, t1: Numbers, t2: Numbers) -> Numbers:
    """p'' of a plate whose neighbours are turned by 2 t1 and 2 t2  (3)  [m]."""
    return A - (r - e * np.sin(t1)) / np.cos(t1) - (r - e * np.sin(t2)) / np.cos(t2)


def seated_pitch(A: Numbers, r: Numbers, e: Numbers, z: Numbers) -> Numbers:
    """pp'' = A - 2 (r - e sin t)/cos t  (5)  [m]."""
    return equivalent_pitch(A, r, e, np.pi / z, np.pi / z)


def ideal_pitch(p: Numbers, z: Numbers, ideal: str = "seat") -> Numbers:
    """The seated pitch that leaves no polygonal action in the paper's measure, p/cos t  (16)  [m].

    ideal = "rack": p tan(t)/t instead, which meshes like a rack on the pitch circle p z/(2 pi).
    """
    t = np.pi / z
    return p / np.cos(t) if ideal == "seat" else p * np.tan(t) / t


def pitch_deviation(p: Numbers, r: Numbers, e: Numbers, z: Numbers, ideal: str = "seat") -> Numbers:
    """Seated less ideal pitch, signed  (17)  [m]:  2 (e sin t - A sin^2(t/2))/cos t, free of cancellation."""
    t = np.pi / z
    seat = 2 * (e * np.sin(t) - hole_pitch(p, r) * np.sin(t / 2) ** 2) / np.cos(t)
    return seat if ideal == "seat" else seat + p * (1 / np.cos(t) - np.tan(t) / t)


def matching_offset(p: Numbers, r: Numbers, z: Numbers, ideal: str = "seat") -> Numbers:
    """Offset e that leaves no deviation on a sprocket with z teeth  (21)  [m]: (A/2) tan(t/2) for the seat."""
    return -pitch_deviation(p, r, 0.0, z, ideal) / (2 * np.tan(np.pi / z))


def minimax_offset(p: Numbers, r: Numbers, z1: Numbers, z2: Numbers, ideal: str = "seat") -> Numbers:
    """Offset e with opposite deviations on the two sprockets: the least of the larger one  [m]."""
    both = pitch_deviation(p, r, 0.0, z1, ideal) + pitch_deviation(p, r, 0.0, z2, ideal)
    return -both / (2 * (np.tan(np.pi / z1) + np.tan(np.pi / z2)))


def offset_by_rule(rule: str, p: Numbers, r: Numbers, z1: Numbers, z2: Numbers, ideal: str = "seat") -> Numbers:
    """Offset e [m] by its rule: "match-drive", no deviation on the sprocket with z1 teeth, or "minimax"."""
    return matching_offset(p, r, z1, ideal) if rule == "match-drive" else minimax_offset(p, r, z1, z2, ideal)


def reference_deviation(p: Numbers, z1: Numbers, z2: Numbers) -> Numbers:
    """delta12 = p/cos t1 - p/cos t2  (23)  [m], as p 2 sin((t1+t2)/2) sin((t1-t2)/2)/(cos t1 cos t2)."""
    u, v = np.pi / z1, np.pi / z2
    return 2 * p * np.sin((u + v) / 2) * np.sin((u - v) / 2) / (np.cos(u) * np.cos(v))


def pitch_constant(z1: Numbers, z2: Numbers) -> Numbers:
    """k  (28)  [-] in the form that holds for equal tooth numbers too: cos((t1-t2)/2)/sin((t1+t2)/2)."""
    u, v = np.pi / z1, np.pi / z2
    return np.cos((u - v) / 2) / np.sin((u + v) / 2)


def boundary_radius(p: Numbers, z1: Numbers, z2: Numbers) -> Numbers:
    """r10  (27)  [m]: rolling radius at which a chain matched to the drive deviates by delta12 on the other sprocket.

    p m/(2 (1 - m)), m = k tan(t1/2); infinite where m reaches 1.
    """
    m = pitch_constant(z1, z2) * np.tan(np.pi / (2 * z1))
    finite = m < 1
    return np.where(finite, p * m / (2 * np.where(finite, 1 - m, 1.0)), np.inf)[()]


def monotone_radius(p: Numbers, z1: Numbers) -> Numbers:
    """Rolling radius below which p'' of a chain matched to the drive grows up to the seat, p/(2 cos t1)  [m]."""
    return p / (2 * np.cos(np.pi / z1))


def standard_apothem(f0: Numbers, r: Numbers, e: Numbers, a: Numbers, reference: str = "pitch_line") -> Numbers:
    """f: rotation centre on the pitch line to flank  (2)  [m].

    f0 + r cos a + e sin a; reference = "pin" leaves the last term out, the other reading of the printed equation, which cuts the sprocket
    for a flank e sin a off the real one.
    """
    return f0 + r * np.cos(a) + (e * np.sin(a) if reference == "pitch_line" else 0.0)


def seated_apothem(f: Numbers, p: Numbers, seated: Numbers, a: Numbers) -> Numbers:
    """fp'' = f + (p - pp'') cos a / 2  (6)  [m]."""
    return f + 0.5 * (p - seated) * np.cos(a)


def positioning_diameter(seated: Numbers, z: Numbers) -> Numbers:
    """dp = pp''/sin t  (7)  [m]: circle through the rotation centres of the seated plates."""
    return seated / np.sin(np.pi / z)


def seat_of(f_seated: float, seated: float, z: int, a: float) -> float:
    """Support H of the seated plate's flank from the paper's measures  [m]: (pp''/2) cos a - (pp''/2) cot t sin a + fp''."""
    return 0.5 * seated * (np.cos(a) - np.sin(a) / np.tan(np.pi / z)) + f_seated


def modification(f_seated: Numbers, seated: Numbers, z: Numbers, a: Numbers, p2: Numbers, a2: Numbers) -> Numbers:
    """Modification coefficient x of the sprocket for a cutter of pitch p2 and half angle a2  (9)-(11)  [-]."""
    cot = 1 / np.tan(np.pi / z)
    base = p2 * z * np.cos(a2) / np.pi
    turned = 0.5 * base * (a - a2) + 0.5 * seated * (np.cos(a) - np.sin(a) * cot - np.cos(a2) + np.sin(a2) * cot) + f_seated  # fa'' (11)
    return -z / 2 + 0.75 * np.pi / np.tan(a2) - np.pi * turned / (np.sin(a2) * p2) + 0.5 * np.pi * seated * (cot - 1 / np.tan(a2)) / p2
