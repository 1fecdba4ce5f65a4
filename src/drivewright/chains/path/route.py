"""The taut path of a chain around given bodies, in links and metres.

The chain lies on circles: of a sprocket that of the circumference z p, between the circles of seated pins and of plates' middles, of a
guide its arc and the distance of the plates' line of pins from it.  Strands are common tangents (`standards.loop`); a turn around a
sprocket takes as many links as it has teeth, around a guide pi/atan(p/(2 R)), the plates being tangents to the circle R.  So the path's
length in links is that of a belt, and what a body's move adds to it is the work of the strands' pulls.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from drivewright._typing import Complexes, Floats
from drivewright.chains.link import Link
from drivewright.chains.model import ChainDrive, Guide, Sprocket
from drivewright.chains.standards.loop import tangents
from drivewright.errors import InputError

MOST_WRAP = 11 / 6 * np.pi  # a wrap that misses a whole turn by less is one below 0


class Station(NamedTuple):
    """A body that the chain may meet: its number (sprockets, then guides), radius [m] of the chain around it, turn (-1 inside, +1 outside),
    links to a whole turn, and what people call it."""

    body: int
    radius: float
    turn: int
    per_turn: float
    name: str


class Route(NamedTuple):
    """A taut path: stations in the order in which the chain meets them, sprocket 1 first; heading of the strand that leaves each [rad],
    lengths of these strands [m], wraps [rad], where the strands start [m], and links in all."""

    stations: tuple[Station, ...]
    headings: Floats
    lengths: Floats
    wraps: Floats
    starts: Complexes
    links: float

    def place(self, body: int) -> int | None:
        """Where along the path a body comes; None where the chain does not meet it."""
        return next((k for k, station in enumerate(self.stations) if station.body == body), None)


def bodies(model: ChainDrive) -> tuple[Sprocket | Guide, ...]:
    """All bodies that the chain may meet, by number."""
    return (*model.sprockets, *model.guides)


def stations(model: ChainDrive) -> tuple[Station, ...]:
    """The `Station` of every body, sprockets first."""
    link, found = mean_link(model), []
    for number, sprocket in enumerate(model.sprockets):
        z = sprocket.tooth.teeth
        turn = 1 if sprocket.outside else -1
        found.append(Station(number, z * link.pitch / (2 * np.pi), turn, float(z), body_name(model, number)))
    for number, guide in enumerate(model.guides, len(model.sprockets)):
        radius, turn = guide.radius + guide.distance, 1 if guide.side == "outside" else -1
        found.append(Station(number, radius, turn, float(np.pi / np.arctan(0.5 * link.pitch / radius)), body_name(model, number)))
    return tuple(found)


def mean_link(model: ChainDrive) -> Link:
    """The link with the mean of all hole pitches, worn as they are."""
    return model.chain.link._replace(hole_pitch=float(np.mean(model.chain.hole_pitches)))


def body_name(model: ChainDrive, number: int) -> str:
    """What messages call a body."""
    count = len(model.sprockets)
    own = bodies(model)[number].name
    if not own and number in (model.driver, model.measured):
        return "the driving sprocket" if number == model.driver else "the driven sprocket"
    kind, place = ("sprocket", number + 1) if number < count else ("guide", number - count + 1)
    return f"{kind} {own!r}" if own else f"{kind} {place}"


def short_name(model: ChainDrive, number: int) -> str:
    """What values call a body: drive, driven, or by its name."""
    if number in (model.driver, model.measured):
        return "drive" if number == model.driver else "driven"
    return bodies(model)[number].name or str(number + 1)


def centres(model: ChainDrive, q: Floats) -> Complexes:
    """Centres of all bodies at the places q (bodies,) [m] of their slides  [m]."""
    return np.array([centre_at(body, float(place)) for body, place in zip(bodies(model), q, strict=True)])


def centre_at(body: Sprocket | Guide, q: Any) -> Any:
    """Centre of a body at the place q [m] of its slide."""
    centre = complex(*body.centre)
    return centre if body.slide is None else centre + body.slide.shift(centre, q)


def way_at(body: Sprocket | Guide, q: float) -> complex:
    """Derivative of a sliding body's centre by the place q of its slide  [-]."""
    assert body.slide is not None
    return body.slide.way(complex(*body.centre), q)


def route(model: ChainDrive, chosen: Sequence[Station], q: Floats) -> Route:
    """The `Route` around the stations in this order, with bodies at the places q (bodies,) [m]; InputError where no loop is.

    Strands that would have to pass a body on its other side give it a wrap below 0: it is smooth where a body is about to be left.
    """
    link = mean_link(model)
    centre = centres(model, q)[[s.body for s in chosen]]
    turns, radii = np.array([s.turn for s in chosen]), np.array([s.radius for s in chosen])
    lengths, headings = tangents(np.column_stack([centre.real, centre.imag]), turns * radii, [s.name for s in chosen])
    wraps = (turns * (headings - np.roll(headings, 1))) % (2 * np.pi)
    wraps = np.where(wraps > MOST_WRAP, wraps - 2 * np.pi, wraps)
    if abs(np.sum(turns * wraps) / (2 * np.pi) + 1) > 1e-6:
        names = ", ".join(s.name for s in chosen)
        raise InputError(
            f"chain drive: the chain cannot pass {names} in this order without crossing itself; move a centre, or change the side of the "
            "loop on which a body lies."
        )
    per_turn = np.array([s.per_turn for s in chosen])
    links = np.sum(lengths) / link.pitch + np.sum(per_turn * wraps) / (2 * np.pi)
    starts = centre - turns * radii * 1j * np.exp(1j * headings)
    return Route(tuple(chosen), headings, lengths, wraps, starts, float(links))
