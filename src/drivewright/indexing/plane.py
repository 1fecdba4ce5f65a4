"""What all drives with plate cams share: pins on a wheel, seen from a cam that moves in the wheel's plane.

The wheel turns about 0, the cam stands at p(theta) and has turned by w(theta).  Seen from the cam a pin's centre c is at
(c - p) exp(-i w).  Pin 0 over as many turns of the input as the wheel has stations runs along one closed curve.  Where a step passes one
pin, all pins share it; where it passes m, pin j shares that of pin j - m, and there are m such curves.  The profile is the envelope of a
circle on all of them, on both sides, trimmed by all of it.
"""

from collections.abc import Callable, Iterator
from functools import cached_property, partial
from itertools import pairwise
from typing import Protocol

import numpy as np

from drivewright._typing import ArrayLike, Bools, Complexes, Floats, Numbers
from drivewright.curves import CircleFamily, Member, Piece, Trimmed, trim
from drivewright.curves.touching import Nodes, Touches, nodes_of, touches
from drivewright.errors import InputError, SolverError
from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.motion import TURN, IndexMotion, MotionSegment, refuse_stations
from drivewright.numerics.jets import Jet, exp

PROFILE_TOLERANCE = 1e-6  # a point of contact nearer than this [m] to the profile is on it
_SAMPLES = (48, 96, 240)  # on each piece of the envelope: more where a crossing was missed
_SLOW, _AT_REST = 0.05, 1e-7  # of the greatest speed of a path
_CUSP_MARGIN = 2e-8  # rad
_SETTLED = 1e-13  # rad; a smaller step of Newton's method ends it
_SAME_POINT = 1e-4  # a place nearer than this [m] to the envelope's own point is that point
_LEAST_ARM = 1e-9  # an arm below this, relative to the pin circle, turns the wheel neither way


class IndexingDrive(Protocol):
    """A drive whose wheel moves in steps."""

    @property
    def motion(self) -> IndexMotion:
        """Motion of the wheel over the input angle."""
        ...


class PinDrive(IndexingDrive, Protocol):
    """A drive whose wheel carries pins."""

    @property
    def circle_radius(self) -> float:
        """Radius of the pin circle [m]."""
        ...

    @property
    def levels(self) -> "tuple[PlaneDrive, ...]":
        """One drive for each shape of cam; all of them hold the wheel."""
        ...


class PlaneDrive:
    """One cam and the pins that it meets.

    A kind gives pins, circle_radius [m], pin_radius [m] and motion, and defines `pose` and `refuse`; `phase` [rad] is the angle of pin 0 at
    theta = 0, `side` the side of the pins on which the cam lies, `levels` the drives whose cams differ.  The stations of the wheel, the
    divisions of its motion, divide the pins.
    """

    pins: int
    circle_radius: float
    pin_radius: float
    motion: IndexMotion
    side: str = "inside"

    @property
    def phase(self) -> float:
        """Angle of pin 0 at theta = 0 [rad]."""
        return 0.0

    def pose(self, theta: ArrayLike) -> tuple[Jet, Jet]:
        """Place p of the cam's axis [m] and its turn w [rad]: a complex and a real jet by theta."""
        raise NotImplementedError

    def refuse(self) -> None:
        """InputError for measures that leave no cam or no wheel."""
        raise NotImplementedError

    @property
    def pin_pitch(self) -> float:
        """Angle between neighbouring pins [rad]."""
        return TURN / self.pins

    @property
    def pins_passed(self) -> int:
        """Pins that pass the cam in a step of the wheel, and closed curves along which all of them run."""
        return self.pins // self.motion.divisions

    @property
    def levels(self) -> "tuple[PlaneDrive, ...]":
        """The drives of the wheel, one for each shape of cam; all of them hold it."""
        return (self,)

    def pin_centres(self, theta: ArrayLike) -> Jet:
        """Centres of the pins from the wheel's axis: complex jet by theta, shape (..., pins)."""
        phi = _column(self.motion(theta))
        return self.circle_radius * exp(1j * (phi + self.phase + TURN / self.pins * np.arange(self.pins)))

    def seen_from_cam(self, point: Jet, theta: ArrayLike) -> Jet:
        """A point given from the wheel's axis as it is seen from the cam: complex jets by theta [m]."""
        place, turn = self.pose(theta)
        return (point - place) * exp(-1j * turn)

    def pin_paths(self, theta: ArrayLike) -> Jet:
        """Centres of the pins seen from the cam: complex jet by theta, shape (..., pins)."""
        return self.seen_from_cam(self.pin_centres(theta), np.asarray(theta, dtype=float)[..., None])

    @cached_property
    def family(self) -> CircleFamily:
        """All circles that cut the cam: pins 0 .. pins_passed - 1 over as many turns of the input as the wheel has stations, one after
        the other."""
        pieces = [
            Piece(begin, end, Member(self._path, (float(number), float(pin))), f"step {turn}", _shape(segment), loop=pin)
            for number, segment in enumerate(self.motion.segments)
            for pin in range(self.pins_passed)
            for turn, begin, end in _between_cusps(partial(self._path, number, pin), segment, self._turns_of(pin))
        ]
        pieces.sort(key=lambda piece: piece.start)
        return CircleFamily(tuple(pieces), self.pin_radius, self.side, both=True)

    def _turns_of(self, pin: int) -> range:
        """Turns of the input, counted over all pins that a step passes, in which that pin is followed."""
        return range(pin * self.motion.divisions, (pin + 1) * self.motion.divisions)

    def _path(self, number: Numbers, pin: Numbers, theta: ArrayLike) -> Jet:
        """A pin seen from the cam, theta counted over all turns, by the formula of a segment's number; numbers and pins may be arrays."""
        theta, segment = np.asarray(theta, dtype=float), np.asarray(number).astype(int)
        turn = np.round((theta - self._middles[segment]) / TURN)
        phi = self.motion.on_segment(segment, theta - TURN * turn, turn)
        return self.seen_from_cam(self.circle_radius * exp(1j * (phi + (self.phase + self.pin_pitch * pin))), theta)

    def pin_that_cuts(self, theta: ArrayLike) -> tuple[Floats, Floats]:
        """(input angle [rad] in 0 .. 2 pi, number of the pin) of the family's parameter theta, which counts over all turns of all pins.

        A pin that has gone on by a step counts as the next of its kind: where a step passes one pin, the number is that of the turn.
        """
        theta = np.asarray(theta, dtype=float)
        turn = np.floor(np.clip(theta, 0, None) / TURN * (1 - 1e-12))
        start, step = np.divmod(turn, self.motion.divisions)
        return theta - TURN * turn, start + self.pins_passed * step

    @cached_property
    def _middles(self) -> Floats:
        """Input angles [rad] in the middle of the segments."""
        return np.array([0.5 * (segment.start + segment.stop) for segment in self.motion.segments])

    @cached_property
    def profile(self) -> Trimmed:
        """The cam's profile, trimmed by every pin at every angle.

        Raises InputError where no cam is left, SolverError where the parts of the envelope do not chain around it.
        """
        self.refuse()
        for samples in _SAMPLES:
            try:
                found = trim(self.family, least=samples)
            except SolverError:
                if samples == _SAMPLES[-1]:
                    raise
                continue
            if _runs_around(found, self.family):
                return found
        raise SolverError(
            f"profile: the envelope around the cam is not closed; a crossing is missed with {_SAMPLES[-1]} samples per piece, for instance "
            "where two branches nearly touch. Change pin_radius by 0.1 %."
        )

    @cached_property
    def nodes(self) -> Nodes:
        """The profile as nodes, for the search of contacts."""
        return nodes_of(self.profile.spans)

    @cached_property
    def orientation(self) -> float:
        """+1 where the profile's nodes run counter-clockwise."""
        a, b = self.nodes.a, self.nodes.b
        return float(np.sign(np.sum(np.imag(np.conj(a) * b))))


def _runs_around(profile: Trimmed, family: CircleFamily) -> bool:
    """Whether the profile runs the way it must for the part to lie on its side; the edge on the other side of the pins runs against it."""
    side = family.side if family.material == "inside" else -family.side
    return profile.sense * side > 0


def _between_cusps(
    at: Callable[[ArrayLike], Jet], segment: MotionSegment, turns: range, samples: int = 181
) -> Iterator[tuple[int, float, float]]:
    """(turn, start, stop) of a segment in each of `turns`, parted where the path stands still and turns back, left out by a trifle."""
    starts = TURN * np.array(turns)
    t = starts[:, None] + np.linspace(segment.start, segment.stop, samples)
    speed = np.abs(np.broadcast_to(at(t).d1, t.shape))
    around = np.pad(speed, ((0, 0), (1, 1)), constant_values=np.inf)
    row, column = np.nonzero((speed <= around[:, :-2]) & (speed <= around[:, 2:]) & (speed < _SLOW * np.max(speed)))
    place = t[row, column]
    low, high = starts[row] + segment.start, starts[row] + segment.stop
    for _ in range(12 if len(place) else 0):  # towards d1 = 0 along d2
        jet, before = at(place), place
        place = np.clip(place - np.real(np.conj(jet.d2) * jet.d1) / np.abs(jet.d2) ** 2, low, high)
        if np.max(np.abs(place - before)) < _SETTLED:
            break
    cusp = np.abs(at(place).d1) < _AT_REST * np.max(speed) if len(place) else np.zeros(0, dtype=bool)
    for k, turn in enumerate(turns):
        own = np.unique(np.round(place[cusp & (row == k)], 12))
        ends = [
            starts[k] + segment.start,
            *(float(end) for spot in own for end in (spot - _CUSP_MARGIN, spot + _CUSP_MARGIN)),
            starts[k] + segment.stop,
        ]
        yield from ((turn, float(a), float(b)) for a, b in zip(ends[::2], ends[1::2], strict=True) if b - a > 2 * _CUSP_MARGIN)


def _shape(segment):
    return "smooth" if segment.law_piece is not None else "arc"


def _column(jet: Jet) -> Jet:
    """The jet with an axis for the pins."""
    return Jet(*(np.asarray(part)[..., None] for part in jet))


def pitch_point(drive: PlaneDrive, theta: ArrayLike) -> Complexes:
    """Instant centre of wheel and cam, (p' - i w' p)/(i (phi' - w')) [m], complex; infinite in the dwell of a cam that does not turn.

    The normal of every contact passes through it.
    """
    place, turn = drive.pose(theta)
    rate = np.asarray(drive.motion(theta).d1 - turn.d1)
    still = np.abs(rate) <= 1e-12
    return np.where(still, np.inf, (place.d1 - 1j * turn.d1 * place.d0) / np.where(still, 1j, 1j * rate))


def envelope_points(drive: PlaneDrive, theta: ArrayLike) -> Complexes:
    """The two candidate points of contact of each pin, complex, shape (..., pins, 2), seen from the cam; nan where a pin stands still."""
    return _both_sides(drive.pin_paths(theta), drive.pin_radius)


def _both_sides(path: Jet, radius: float) -> Complexes:
    """Points at `radius` [m] to the left and the right of a path."""
    with np.errstate(divide="ignore", invalid="ignore"):
        normal = 1j * path.d1 / np.abs(path.d1)
    return path.d0[..., None] + radius * normal[..., None] * np.array([1.0, -1.0])


def centre_curvature(drive: PlaneDrive, theta: ArrayLike) -> Floats:
    """Curvature of the centre curve of each pin, left turns positive [1/m], shape (..., pins)."""
    return _path_curvature(drive.pin_paths(theta))


def _path_curvature(path: Jet) -> Floats:
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.imag(np.conj(path.d1) * path.d2) / np.abs(path.d1) ** 3


def find_contacts(drive: PlaneDrive, theta: float, reach: float = 5e-4, turned: float = 0.0) -> CamContacts:
    """Contacts of the cam at one input angle theta with gaps up to `reach` [m]; `turned` [rad] is how far the wheel is off its place.

    A place is `intended` where it is the envelope's own point, lies on the profile and the wheel stands in its place; its curvature is
    exact, that of the others good to some percent.
    """
    return contacts_at(drive, [float(theta)], reach, turned)[0]


def contacts_at(drive: PlaneDrive, theta: ArrayLike, reach: float = 5e-4, turned: Numbers = 0.0) -> list[CamContacts]:
    """`find_contacts` at the input angles theta (n,) [rad], the wheel off its place by `turned` [rad], one for all or (n,)."""
    theta = np.asarray(theta, dtype=float)
    turned = np.broadcast_to(np.asarray(turned, dtype=float), theta.shape)
    place, turn = (jet.d0 for jet in drive.pose(theta))
    upright, path = np.exp(-1j * turn), drive.pin_paths(theta)
    centre = drive.pin_centres(theta).d0 * np.exp(1j * turned)[:, None]
    touching = touches(drive.nodes, (centre - place[:, None]) * upright[:, None], drive.pin_radius, reach)
    row, pin = np.divmod(touching.centre, drive.pins)
    point, curvature, own = _own_points(drive, touching, path)
    intended = own & (turned[row] == 0.0)
    at = centre[row, pin]
    arm = at - place[row] - np.where(intended, point, touching.point) / upright[row]
    normal = np.asarray(arm / np.abs(arm), dtype=np.complex128)
    arm_about_wheel = np.imag(np.conj(at) * normal)
    arm_about_wheel[np.abs(arm_about_wheel) < _LEAST_ARM * drive.circle_radius] = 0.0
    gap = np.where(intended, 0.0, np.maximum(touching.gap, 0.0))
    curvature = np.where(intended, curvature, drive.orientation * touching.curvature)
    all_contacts = CamContacts(pin, at, normal, arm_about_wheel, gap, curvature, intended)
    ends = np.searchsorted(row, np.arange(len(theta) + 1))
    return [all_contacts.of(slice(low, high)) for low, high in pairwise(ends)]


def _own_points(drive: PlaneDrive, touching: Touches, path: Jet) -> tuple[Complexes, Floats, Bools]:
    """For each touch the envelope's own point that is nearest, the part's curvature there, and whether the touch is that point.

    path (n, pins): of the pins that the touches count one after the other.
    The gap alone would not tell: where the own point is cut away beside a corner, the corner is nearly as near to the pin.
    """
    envelope = _both_sides(path, drive.pin_radius).reshape(-1, 2)
    own = envelope[touching.centre]
    apart = np.nan_to_num(np.abs(touching.point[:, None] - own), nan=np.inf)
    nearest = np.arange(len(apart)), np.argmin(apart, axis=1)
    left = np.zeros(envelope.size, dtype=bool)
    left[touches(drive.nodes, envelope, 0.0, PROFILE_TOLERANCE).centre] = True
    on_profile = left.reshape(envelope.shape)[touching.centre][nearest]
    signed = (1 - 2 * nearest[1]) * _path_curvature(path).ravel()[touching.centre]  # towards the side of the part
    with np.errstate(divide="ignore", invalid="ignore"):
        curvature = signed / (1 - drive.pin_radius * signed)
    return own[nearest], curvature, on_profile & (apart[nearest] < _SAME_POINT) & (touching.gap < PROFILE_TOLERANCE)


def refuse_overlap(wheel: PlaneDrive) -> None:
    """InputError for fewer than three pins, for pins that overlap, and for stations that do not divide them."""
    chord = 2 * wheel.circle_radius * np.sin(np.pi / wheel.pins)
    if wheel.pins < 3:
        raise InputError(f"pins = {wheel.pins}: a wheel needs at least 3 pins.")
    refuse_stations(wheel.pins, wheel.motion.divisions)
    if 2 * wheel.pin_radius >= chord:
        raise InputError(
            f"pin_radius = {wheel.pin_radius * 1e3:.4g} mm: the pins overlap, their centres are {chord * 1e3:.4g} mm apart. "
            f"Take less than {chord * 500:.4g} mm."
        )


def index_angles(drive: IndexingDrive, step: float = float(np.deg2rad(4.5))) -> Floats:
    """Input angles [rad] over the index period from its start to its end, in equal steps of about `step`."""
    return np.linspace(0.0, drive.motion.motion_angle, max(int(round(drive.motion.motion_angle / step)), 1) + 1)


def contact_pressure_angle(drive: PinDrive, theta: ArrayLike, direction: float) -> Floats:
    """acos(h/R) [rad] of the contact with the largest arm h that turns the wheel in the direction, at each of the input angles theta.

    nan where no intended contact of any level does.
    """
    best = np.max([_best_arms(level, np.atleast_1d(theta), direction) for level in drive.levels], axis=0)
    return np.arccos(np.where(best > 0, np.minimum(best / drive.circle_radius, 1.0), np.nan))


def _best_arms(drive: PlaneDrive, theta: Floats, direction: float) -> Floats:
    found = contacts_at(drive, theta, reach=2 * PROFILE_TOLERANCE)
    return np.array([np.max(direction * each.arm[each.intended], initial=0.0) for each in found])
