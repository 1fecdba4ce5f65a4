"""The path of a chain with tensioners, guides, further sprockets or a fixed centre distance: lengths, wraps, pulls, and what is wrong with
it in plain words."""

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
from drivewright.mechanisms.silent_chain.closure import SLACK
from drivewright.result import Check, Value

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
    path, spec, drive = DrivePath(model), model.spec, model.drive
    balance, route, density = path.balance, path.balance.route, model.link_mass.mass / spec.pitch
    values = {"layout.chain_length": Value(spec.links * spec.pitch, "m", "pitch times links")}
    if spec.driven.centre_distance:
        values["layout.centre_distance"] = Value(spec.driven.centre_distance, "m", "as given")
    for name, length, wrap, pull in zip(path.names(), route.lengths, route.wraps, balance.pulls, strict=True):
        values[f"layout.wrap.{name}"] = Value(float(wrap), "rad", f"angle of {name} that the chain takes in")
        values[f"layout.strand_length.{name}"] = Value(float(length), "m", f"of the free strand that leaves {name}")
        values[f"layout.pull.{name}"] = Value(float(pull), "N", f"pull of the strand that leaves {name}, without the centrifugal force")
        if pull > 0:
            whole, speed = pull + balance.centrifugal, model.strands.speed
            frequency = float(standards.strand_frequency(whole, density, float(length), speed))
            values[f"layout.strand_frequency.{name}"] = Value(frequency, "Hz", f"of the strand that leaves {name}, as a moving string")
    for place, name in path.tensioners():
        body = route.stations[place].body
        slide, q = bodies(path.drive)[body].slide, float(balance.q[body])
        assert slide is not None
        values[f"layout.tensioner.{name}.travel"] = Value(q, "m", f"travel of tensioner {name} in balance")
        values[f"layout.tensioner.{name}.force"] = Value(slide.force - slide.stiffness * q, "N", f"force of tensioner {name} in balance")
    limit = model.limit_speed
    if 0 < limit < np.inf:  # at 0 a strand is slack for another reason
        values["layout.limit_speed"] = Value(limit, "rad/s", "speed of the driving sprocket that takes all pull from the slack strand")
    values["layout.mesh_frequency"] = Value(
        float(standards.mesh_frequency(model.teeth[0], drive.speed)), "Hz", "teeth that mesh in a second"
    )
    velocity = float(standards.meeting_velocity(spec.pitch, drive.speed))
    values["layout.meeting_velocity"] = Value(velocity, "m/s", "with which a hinged link meets the driving sprocket")
    return values


def path_checks(model: ChainModel) -> Iterator[Check]:
    """Wraps, room of tensioners, arcs of guides, and the limit speed."""
    path, spec = DrivePath(model), model.spec
    balance, route = path.balance, path.balance.route
    for name, wrap in zip(path.names(), route.wraps, strict=True):
        if name in ("drive", "driven"):
            words = "driving sprocket" if name == "drive" else "driven sprocket"
            message = f"angle of the {words} that the chain takes in"
            yield Check(f"wrap.{name}", float(wrap), spec.limits.wrap, ">=", "rad", message, (name,))
    for entry in (*spec.sprockets, *spec.guides):
        place = next((k for k, name in path.tensioners() if name == entry.name), None)
        if place is not None and entry.travel is not None:
            q = abs(float(balance.q[route.stations[place].body]))
            message = f"travel of tensioner {entry.name} in balance, within its room"
            yield Check(f"tensioner.{entry.name}.travel", q, entry.travel, "<=", "m", message, (entry.name,))
    for place, station in enumerate(route.stations):
        guide = bodies(path.drive)[station.body]
        if isinstance(guide, Guide):
            message = f"arc of guide {guide.name} beyond the places where the chain meets and leaves it"
            yield Check(f"guide.{guide.name}.reach", _spare_arc(path, place, guide), 0.0, ">=", "rad", message, (guide.name,))
    if balance.slack and spec.driven.centre_distance:
        message = "length of the chain beyond its taut path, which hangs in the slack strand; more lets it jump"
        yield Check("chain.slack", balance.slack, 2 * SLACK * spec.driven.centre_distance, "<=", "m", message, ("chain",))
    limit = model.limit_speed
    if 0 < limit < np.inf:
        message = (
            "speed of the driving sprocket against that at which the chain's centrifugal force leaves no pull in its slack strand, the "
            "blows of the teeth not counted: beyond, it is overspeed"
        )
        yield Check(
            "chain.overspeed", model.drive.speed, limit, "<=", "rad/s", message, ("chain",), label="Speed below the centrifugal limit"
        )


def _spare_arc(path: DrivePath, place: int, guide: Guide) -> float:
    """The lesser of the arcs of a guide [rad] that are left beyond both ends of its contact."""
    route, station = path.balance.route, path.balance.route.stations[place]
    turned = guide.slide.turn(float(path.balance.q[station.body])) if guide.slide else 0.0
    towards = np.array([route.headings[place - 1], route.headings[place]]) - station.turn * 0.5 * np.pi
    off = np.angle(np.exp(1j * (towards - 0.5 * (guide.start + guide.end) - turned)))
    return float(0.5 * (guide.end - guide.start) - np.max(np.abs(off)))


def path_findings(model: ChainModel) -> Iterator[str]:
    """Guides that the chain does not touch, tensioners on the tight strand, a chain that nothing tensions."""
    path = DrivePath(model)
    balance = path.balance
    for number, body in enumerate(bodies(path.drive)):
        if isinstance(body, Guide) and balance.route.place(number) is None:
            away = clearance(path.drive, balance.q, number)
            yield (
                f"guides.{body.name}: the chain does not touch it, it passes {1e3 * away:.3g} mm away; move it towards the chain, or leave "
                "it out"
            )
    yield from _on_tight_strand(path)
    if balance.slack:
        yield (
            f"nothing tensions the chain: it is {1e3 * balance.slack:.3g} mm longer than its path; a larger driven.centre_distance by "
            f"about {0.5e3 * balance.slack:.3g} mm, or a tensioner, makes it taut"
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
                f"tensioner {name} presses on the tight strand: turning clockwise against a load torque of {torque:.4g} N m, the "
                f"driving sprocket carries the load by the strand that {carrier} the driven one: {own:.4g} N there, and "
                f"{np.min(pulls):.4g} N in the slackest strand. Put the tensioner on the other strand, or it has to hold the load and the "
                "other strand goes slack"
            )
        if path.model.drive.reversing:
            yield (
                f"the drive reverses: then the strand of tensioner {name} is the {'slack' if tight else 'tight'} one, and the other "
                f"{'tight' if tight else 'slack'}, by {load:.4g} N. A tensioner on either "
                "strand, or a preload, has to hold the pull of both senses"
            )
