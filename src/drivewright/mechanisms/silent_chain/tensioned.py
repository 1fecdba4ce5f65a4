"""The path of a chain with tensioners, guides, further sprockets or a fixed centre distance: lengths, wrap angles, strand tensions, and
findings on faults of the path."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from drivewright.chains import standards
from drivewright.chains.model import ChainDrive, Guide
from drivewright.chains.path import Balance
from drivewright.chains.path.order import clearance
from drivewright.chains.path.route import bodies, short_name
from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.mechanisms.silent_chain.chain_drive import bare_drive
from drivewright.mechanisms.silent_chain.meshing import SIDE_WORDS
from drivewright.result import Check, Value

OUTWARD = "positive in the direction in which its spring presses"
SLACK = 0.01  # of the taut centre distance that a fixed one may be shorter
LITTLE = 0.05  # of the load's pull: strands that differ by less are alike


@dataclass(frozen=True, eq=False)
class DrivePath:
    """The path of a model: its drive, balance and names."""

    model: ChainModel

    @cached_property
    def drive(self) -> ChainDrive:
        """The drive."""
        return bare_drive(self.model)

    @property
    def balance(self) -> Balance:
        """Its balance."""
        return self.model.balance

    def names(self) -> list[str]:
        """What values call the bodies on the path, in its order."""
        return [short_name(self.drive, station.body) for station in self.balance.route.stations]

    def tensioners(self) -> list[tuple[int, str]]:
        """(place on the path, name) of all tensioners."""
        every = bodies(self.drive)
        found = enumerate(self.balance.route.stations)
        return [(k, every[s.body].name) for k, s in found if every[s.body].slide and s.body != self.drive.measured]


def path_values(model: ChainModel) -> dict[str, Value]:
    """Lengths, wraps, pulls and frequencies along the path, tensioners in balance."""
    path, spec = DrivePath(model), model.spec
    balance, route, density = path.balance, path.balance.route, model.link_mass.mass / spec.pitch
    values = {"layout.chain_length": Value(spec.links * spec.pitch, "m", "pitch times number of links", label="Chain length")}
    if spec.driven.centre_distance:
        values["layout.centre_distance"] = Value(
            spec.driven.centre_distance, "m", "fixed centre distance, as given in the spec", label="Fixed centre distance"
        )
    for name, length, wrap, pull in zip(path.names(), route.lengths, route.wraps, balance.pulls, strict=True):
        words = words_of(name)
        leaving = f"of the strand that leaves {_with_article(name)}"
        meaning = f"angle over which the chain wraps {_with_article(name)}, tensioners in equilibrium"
        values[f"layout.wrap.{name}"] = Value(float(wrap), "rad", meaning, label=f"Path wrap angle, {words}")
        values[f"layout.strand_length.{name}"] = Value(float(length), "m", f"free length {leaving}", label=f"Strand length after {words}")
        meaning = f"tension {leaving}, without the centrifugal tension"
        values[f"layout.pull.{name}"] = Value(float(pull), "N", meaning, label=f"Strand tension after {words}")
        if pull > 0:
            whole, speed = pull + balance.centrifugal, model.strands.speed
            frequency = float(standards.strand_frequency(whole, density, float(length), speed))
            values[f"layout.strand_frequency.{name}"] = Value(
                frequency,
                "Hz",
                f"first natural frequency of the transverse vibration {leaving}, as a moving string",
                label=f"Strand frequency after {words}",
            )
    for place, name in path.tensioners():
        body = route.stations[place].body
        slide, q = bodies(path.drive)[body].slide, float(balance.q[body])
        assert slide is not None
        travel, force = f"travel of tensioner {name} in equilibrium", f"force of tensioner {name} in equilibrium"
        values[f"layout.tensioner.{name}.travel"] = Value(q, "m", travel, convention=OUTWARD)
        values[f"layout.tensioner.{name}.force"] = Value(slide.force - slide.stiffness * q, "N", force)
    limit = model.limit_speed
    if 0 < limit < np.inf:  # at 0 a strand is slack for another reason
        meaning = "speed of the driving sprocket at which the tension of the slack strand falls to zero"
        values["layout.limit_speed"] = Value(limit, "rad/s", meaning, label="Limit speed of the driving sprocket")
    return values


def words_of(name: str) -> str:
    """A body of the path in words: "drive" -> "driving sprocket", others by their own name."""
    return SIDE_WORDS.get(name, name)


def _with_article(name):
    return f"the {SIDE_WORDS[name]}" if name in SIDE_WORDS else name


def path_checks(model: ChainModel) -> Iterator[Check]:
    """Wraps, room of tensioners, arcs of guides, and the limit speed."""
    path, spec = DrivePath(model), model.spec
    balance, route = path.balance, path.balance.route
    for name, wrap in zip(path.names(), route.wraps, strict=True):
        if name in ("drive", "driven"):
            yield wrap_check(model, name, float(wrap))
    for entry in (*spec.sprockets, *spec.guides):
        place = next((k for k, name in path.tensioners() if name == entry.name), None)
        if place is not None and entry.travel is not None:
            q = abs(float(balance.q[route.stations[place].body]))
            message = f"travel of tensioner {entry.name} in equilibrium, either way; if it exceeds the limit, give more travel or move it"
            label = f"Travel of tensioner {entry.name}"
            yield Check(f"tensioner.{entry.name}.travel", q, entry.travel, "<=", "m", message, (entry.name,), label=label)
    for place, station in enumerate(route.stations):
        guide = bodies(path.drive)[station.body]
        if isinstance(guide, Guide):
            message = f"arc of guide {guide.name} beyond both ends of its contact with the chain; if negative, lengthen or turn the arc"
            spare, label = _spare_arc(path, place, guide), f"Spare arc of guide {guide.name}"
            yield Check(f"guide.{guide.name}.reach", spare, 0.0, ">=", "rad", message, (guide.name,), label=label)
    if balance.slack and spec.driven.centre_distance:
        message = (
            "length of the chain beyond its taut path, which sags in the slack strand; above the limit the chain can jump teeth: increase "
            "the centre distance or take fewer links"
        )
        most, label = 2 * SLACK * spec.driven.centre_distance, "Excess length of the chain"
        yield Check("chain.slack", balance.slack, most, "<=", "m", message, ("chain",), label=label)
    limit = model.limit_speed
    if 0 < limit < np.inf:
        message = (
            "speed of the driving sprocket; at the limit the centrifugal tension leaves the slack strand without tension, impacts of the "
            "teeth not included: lower the speed or tension the chain more"
        )
        label = "Speed below the centrifugal limit"
        yield Check("chain.overspeed", model.drive.speed, limit, "<=", "rad/s", message, ("chain",), label=label)


def wrap_check(model: ChainModel, side: str, wrap: float) -> Check:
    """The wrap angle [rad] of the driving or driven sprocket against its limit."""
    words = SIDE_WORDS[side]
    message = f"wrap angle of the chain on the {words}; if too small, change the centre distance or add an idler"
    return Check(f"wrap.{side}", wrap, model.spec.limits.wrap, ">=", "rad", message, (side,), label=f"Wrap angle, {words}")


def _spare_arc(path: DrivePath, place: int, guide: Guide) -> float:
    """The lesser of the arcs of a guide [rad] that are left beyond both ends of its contact."""
    route, station = path.balance.route, path.balance.route.stations[place]
    turned = guide.slide.turn(float(path.balance.q[station.body])) if guide.slide else 0.0
    towards = np.array([route.headings[place - 1], route.headings[place]]) - station.turn * 0.5 * np.pi
    off = np.angle(np.exp(1j * (towards - 0.5 * (guide.start + guide.end) - turned)))
    return float(0.5 * (guide.end - guide.start) - np.max(np.abs(off)))


def path_findings(model: ChainModel) -> Iterator[str]:
    """Guides that the chain does not touch, tensioners on the tight strand, a chain without tension."""
    path = DrivePath(model)
    balance = path.balance
    for number, body in enumerate(bodies(path.drive)):
        if isinstance(body, Guide) and balance.route.place(number) is None:
            away = clearance(path.drive, balance.q, number)
            yield (
                f"guides.{body.name}: the chain does not touch this guide, it passes at a distance of {1e3 * away:.3g} mm; move the guide "
                "towards the chain, or remove it"
            )
    yield from _on_tight_strand(path)
    if balance.slack:
        yield (
            f"the chain has no tension: it is {1e3 * balance.slack:.3g} mm longer than its path; increase driven.centre_distance by about "
            f"{0.5e3 * balance.slack:.3g} mm, or add a tensioner"
        )


def _on_tight_strand(path: DrivePath) -> Iterator[str]:
    """Tensioners on the strand that carries the load, in this or, reversing, in the other sense of rotation."""
    pulls, torque = path.balance.pulls, path.model.drive.load_torque
    load = float(np.ptp(pulls))
    if load < 1e-9:
        return
    carrier = "comes from" if torque >= 0 else "goes to"
    for place, name in path.tensioners():
        own = 0.5 * (pulls[place] + pulls[place - 1])
        tight = own - np.min(pulls) > LITTLE * load
        if tight:
            yield (
                f"tensioner {name} presses on the tight strand: with clockwise rotation and a load torque of {torque:.4g} N·m, the strand "
                f"that {carrier} the driven sprocket transmits the load, with a tension of {own:.4g} N against {np.min(pulls):.4g} N in "
                "the slackest strand. Move the tensioner to the other strand; otherwise its spring carries the load and the other strand "
                "goes slack"
            )
        if path.model.drive.reversing:
            yield (
                f"the drive reverses: in the other sense of rotation the strand of tensioner {name} is the "
                f"{'slack' if tight else 'tight'} one, with a difference in tension of {load:.4g} N. Place a tensioner on each strand, or "
                "preload the chain"
            )
