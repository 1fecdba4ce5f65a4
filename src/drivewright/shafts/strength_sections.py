"""Which sections of a loaded shaft are judged: every step, every given notch, and of every segment the most stressed smooth place."""

from collections.abc import Iterator, Sequence

import numpy as np

from drivewright._typing import Floats
from drivewright.errors import InputError
from drivewright.shafts.fatigue_strength import NominalStress, StrengthSection
from drivewright.shafts.loaded import Diagram
from drivewright.shafts.model import Shaft
from drivewright.shafts.notches import (
    Keyway,
    Notch,
    PressFit,
    RectangularGroove,
    ShoulderFillet,
    SmoothPlace,
    Spline,
    net_diameter,
    stress_concentration,
)
from drivewright.shafts.sections import area, second_moment

ASSUMED_FILLET = 0.02  # radius over the smaller diameter of a step without one: the worst that Shigley (9th ed., p. 373) reckons with
MEASURED = (Keyway, PressFit, Spline, RectangularGroove)  # whose factors are measured
SAME = 1e-9  # relative: diameters and places that are the same
SIDE = 3e-9  # of the shaft's length: from a place to either side of the node there (`loaded.diagram`)


def shaft_sections(
    shaft: Shaft, notches: Sequence[Notch], along: Diagram, fillet_radii: Sequence[float | None] = ()
) -> tuple[StrengthSection, ...]:
    """The sections to be judged: steps "shoulder_1" ..., the notches that are given, smooth places "segment_1" ...

    fillet_radii [m]: one for every step between segments, in order, None where it is not known; () knows none.
    """
    every = [*_shoulders(shaft, fillet_radii), *(_placed(shaft, notch, along) for notch in notches), *_smooth_places(shaft, along)]
    places = np.array([notch.position for notch in every])
    outer, bore = np.array([section_at(shaft, place) for place in places]).T
    net = np.array([net_diameter(notch, diameter) for notch, diameter in zip(every, outer, strict=True)])
    for notch, diameter, hole in zip(every, net, bore, strict=True):
        _check_net(notch, diameter, hole)
    stresses = _nominal_stresses(along, places, net, bore, SIDE * shaft.length)
    rows = zip(every, outer.tolist(), net.tolist(), bore.tolist(), stresses, strict=True)
    return tuple(StrengthSection(*row) for row in rows)


def refuse_impossible_notch(shaft: Shaft, notch: Notch) -> None:
    """InputError where a notch leaves the shaft, is deeper than it, or has a radius that does not go into it."""
    length = getattr(notch, "length", 0.0)
    for place in (notch.position, notch.position + length) if length else (notch.position,):
        if not -SAME * shaft.length <= place <= shaft.length * (1 + SAME):
            raise InputError(f"ends at {place * 1e3:.4g} mm, beyond the shaft, which ends at {shaft.length * 1e3:.4g} mm; make it shorter")
    outer, bore = section_at(shaft, notch.position)
    _check_net(notch, net_diameter(notch, outer), bore)
    if isinstance(notch, RectangularGroove) and notch.radius > min(notch.depth, notch.width / 2):
        raise InputError(
            f"corners of {notch.radius * 1e3:.4g} mm do not go into a groove {notch.depth * 1e3:.4g} mm deep and "
            f"{notch.width * 1e3:.4g} mm wide; make the radius smaller"
        )
    if not isinstance(notch, MEASURED):
        stress_concentration(notch, outer, bore)


def section_at(shaft: Shaft, position: float) -> tuple[float, float]:
    """(outer diameter, bore) [m] at a place; where two segments meet, the smaller diameter and the larger bore."""
    near, tiny = [], SAME * shaft.length
    for section, start, end in zip(shaft.sections, shaft.ends, shaft.ends[1:], strict=False):
        if start - tiny <= position <= end + tiny:
            share = min(max((position - start) / section.length, 0.0), 1.0)
            near.append((section.start + (section.end - section.start) * share, section.bore))
    if not near:
        raise InputError(f"a notch at {position * 1e3:.4g} mm is not on the shaft, which ends at {shaft.length * 1e3:.4g} mm.")
    return min(diameter for diameter, _ in near), max(bore for _, bore in near)


def assumed_fillets(sections: Sequence[StrengthSection]) -> str | None:
    """A sentence on steps whose fillet radius was assumed; None without any."""
    fillets = [each.notch for each in sections if isinstance(each.notch, ShoulderFillet) and each.notch.assumed]
    if not fillets:
        return None
    listed = ", ".join(f"{fillet.name} ({fillet.radius * 1e3:.3g} mm)" for fillet in fillets)
    return f"fillet radii are assumed, {ASSUMED_FILLET:g} of the smaller diameter: {listed}. Give fillet_radius."


def _shoulders(shaft: Shaft, radii: Sequence[float | None]) -> Iterator[ShoulderFillet]:
    steps = zip(shaft.ends[1:-1], shaft.sections, shaft.sections[1:], strict=False)
    for number, (place, before, after) in enumerate(steps):
        smaller, larger = sorted((before.end, after.start))
        if larger - smaller > SAME * larger:
            radius = radii[number] if number < len(radii) else None
            assumed = radius is None
            yield ShoulderFillet(
                f"shoulder_{number + 1}", float(place), larger, smaller, ASSUMED_FILLET * smaller if radius is None else radius, assumed
            )


def _placed(shaft: Shaft, notch: Notch, along: Diagram) -> Notch:
    """A notch at its most stressed place, where it has a length."""
    length = getattr(notch, "length", 0.0)
    if not length:
        return notch
    section_at(shaft, notch.position + length)  # refuses one that leaves the shaft
    inside = (along.z > notch.position) & (along.z < notch.position + length)
    places = np.concatenate([[notch.position], along.z[inside], [notch.position + length]])
    stress = np.interp(places, along.z, along.von_mises)
    return notch._replace(position=float(places[np.argmax(stress)]))


def _smooth_places(shaft: Shaft, along: Diagram) -> Iterator[SmoothPlace]:
    tiny = SIDE * shaft.length
    for number, (start, end) in enumerate(zip(shaft.ends, shaft.ends[1:], strict=False), 1):
        rows = np.flatnonzero((along.z >= start) & (along.z < end - 0.1 * tiny))
        rows = rows if len(rows) else np.array([int(np.abs(along.z - start).argmin())])
        place = along.z[rows[np.argmax(along.von_mises[rows])]]
        yield SmoothPlace(f"segment_{number}", float(np.clip(place, start + tiny, end - tiny)))  # of this segment, not of its neighbour


def _nominal_stresses(along: Diagram, places: Floats, diameter: Floats, bore: Floats, side: float) -> list[NominalStress]:
    """`NominalStress` of every section, each load the larger of both sides of its place."""

    def larger(load: Floats) -> Floats:
        return np.maximum(*(np.abs(np.interp(places + step, along.z, load)) for step in (-side, side)))

    moment = np.hypot(*(larger(load) for load in along.moment.T))
    modulus = second_moment(diameter, bore) / (diameter / 2)
    stresses = (moment / modulus, larger(along.axial) / area(diameter, bore), larger(along.torque) / (2 * modulus))
    return [NominalStress(*row) for row in np.array(stresses).T.tolist()]


def _check_net(notch: Notch, diameter: float, bore: float) -> None:
    if not diameter > bore:
        raise InputError(
            f"{notch.name}: nothing is left of the shaft at {notch.position * 1e3:.4g} mm: net diameter {diameter * 1e3:.4g} mm, "
            f"bore {bore * 1e3:.4g} mm. Make the notch shallower."
        )
