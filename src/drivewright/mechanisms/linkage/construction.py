"""A linkage built by clicks on its drawing: each tool takes raw tables and the clicked places, and gives raw tables.

Places are those of the machine at its start, in metres.  A new body has the frame of the machine as its own, so that its points are where
they were clicked, joined or not.  What a click means is found here: a place falls upon the points within `near` of it.
"""

import math
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from copy import deepcopy
from itertools import count
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from drivewright.construction import Construction, Place, Tool
from drivewright.errors import DrivewrightError, InputError
from drivewright.mechanisms.linkage.build import build
from drivewright.mechanisms.linkage.sketch import connected, loose_poses, sketch, unfinished
from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.mechanisms.linkage.tables import CENTROID, GROUND, LinkageDrive, points_of

Tables: TypeAlias = dict[str, Any]
SPEED, RUN = "60 rpm", {"turns": 2}
BAR = 1.0  # kg/m of a new body
LISTS = ("joints", "springs", "rotational_springs", "torques", "forces", "outputs")


class Clicked(NamedTuple):
    """Raw tables that a tool changes in place, the points of the mechanism where they are seen, and what counts as upon one."""

    tables: Tables
    spec: LinkageSpec
    poses: Mapping[str, tuple[float, float, float]]
    near: float

    def at(self, place: Place) -> dict[str, str]:
        """{body: point} upon a place, the ground's among them; of several points of a body the nearest."""
        found = sorted(
            (math.dist(seen, place), body, point)
            for body in (GROUND, *self.spec.bodies)
            for point, seen in self.seen(body).items()
            if math.dist(seen, place) <= self.near
        )
        return {body: point for _, body, point in reversed(found)}

    def seen(self, body: str) -> dict[str, Place]:
        """{point: place} of the named points of a body, without its centroid."""
        return {name: self.to_machine(body, point) for name, point in points_of(self.spec, body).items() if name != CENTROID}

    def to_machine(self, body: str, point: Place) -> Place:
        """Where a point of a body is seen."""
        x, y, angle = self.poses[body]
        c, s = math.cos(angle), math.sin(angle)
        return x + c * point[0] - s * point[1], y + s * point[0] + c * point[1]

    def to_body(self, body: str, place: Place) -> Place:
        """What is seen at a place, in the frame of a body."""
        x, y, angle = self.poses[body]
        c, s = math.cos(angle), math.sin(angle)
        return c * (place[0] - x) + s * (place[1] - y), -s * (place[0] - x) + c * (place[1] - y)

    def exactly(self, place: Place) -> Place:
        """The point that a place falls upon, else the place."""
        on = next(iter(self.at(place).items()), None)
        return self.seen(on[0])[on[1]] if on else place

    def bodies_through(self, place: Place) -> list[str]:
        """Bodies whose bar, or side of a plate, passes a place; the last ones lie on top."""
        return [body for body in self.spec.bodies if self._distance(body, place) <= self.near]

    def _distance(self, body: str, place: Place) -> float:
        corners = list(self.seen(body).values())
        if len(corners) > 2 and _is_inside(place, corners):
            return 0.0
        sides = [(a, b) for number, a in enumerate(corners) for b in corners[number:]]
        return min((_from_segment(place, a, b) for a, b in sides), default=math.inf)

    def point(self, body: str, place: Place) -> str:
        """The text BODY.POINT at a place; a point of the body is made where there is none."""
        if name := self.at(place).get(body):
            return f"{body}.{name}"
        table = self.tables.setdefault("ground", {}) if body == GROUND else self.tables["bodies"][body]
        points = table.setdefault("points", {})
        name = _unused(_letters(), {*points, CENTROID})
        points[name] = _lengths(self.to_body(body, place))
        return f"{body}.{name}"

    def append(self, table: str, name: str, **item: Any) -> str:
        """A further table of a list, under a name that none there has; the name."""
        items = self.tables.setdefault(table, [])
        name = _unused(_numbered(name), {each.get("name") for each in items})
        items.append({"name": name, **item})
        return name


# -- tools ---------------------------------------------------------------------------------------------------------------------


def _body(clicked: Clicked, places: Sequence[Place]) -> None:
    """A bar through two places, or a plate through more."""
    corners = [clicked.exactly(place) for place in places]
    if any(math.dist(a, b) <= clicked.near for number, a in enumerate(corners) for b in corners[:number]):
        raise InputError("two points of a body are at the same place; click places that are apart")
    length = sum(math.dist(a, b) for a, b in zip(corners, corners[1:], strict=False))
    mass, size = BAR * length, max(math.dist(a, b) for a in corners for b in corners)
    bodies = clicked.tables.setdefault("bodies", {})
    bodies[_unused((f"link_{number}" for number in count(1)), bodies)] = {
        "mass": f"{mass:.3g} kg",
        "inertia": f"{mass * size**2 / 12:.3g} kg m^2",
        "centroid": _lengths(np.mean(corners, axis=0)),
        "points": dict(zip(_letters(), map(_lengths, corners), strict=False)),
    }


def _pin(clicked: Clicked, places: Sequence[Place]) -> None:
    """A pin through the bodies that share a place; of one body alone, on the frame."""
    first, others = _joined(clicked, places[0])
    place = clicked.exactly(places[0])
    made = 0
    for body in others:
        ends = [clicked.point(first, place), clicked.point(body, place)]
        if not any({end.partition(".")[0] for end in joint["connects"]} == {first, body} for joint in _at(clicked, place)):
            clicked.append("joints", ends[1].partition(".")[2], kind="revolute", connects=ends)
            made += 1
    if not made:
        raise InputError("these bodies are already joined here")


def _slide(clicked: Clicked, places: Sequence[Place]) -> None:
    """A slide of the body at the first place along the line to the second, on the other body there, else on the frame."""
    first, others = _joined(clicked, places[0])
    place = clicked.exactly(places[0])
    angle = math.atan2(places[1][1] - place[1], places[1][0] - place[0]) - clicked.poses[first][2]
    ends = [clicked.point(others[0], place), clicked.point(first, place)]
    axis = [round(math.cos(angle), 6) + 0.0, round(math.sin(angle), 6) + 0.0]
    clicked.append("joints", "slide", kind="prismatic", connects=ends, axis=axis)


def _drive(clicked: Clicked, places: Sequence[Place]) -> None:
    """A drive at constant speed on the pin at a place: a further one where something is still free, else the only one moves here."""
    tables, driven = clicked.tables, _driven(clicked.tables)
    pins = [joint for joint in _at(clicked, places[0]) if joint.get("kind", "revolute") == "revolute"]
    free = [joint["name"] for joint in pins if joint["name"] not in driven]
    if not pins:
        raise InputError("there is no pin here; click the pin that is to turn")
    if not free:
        raise InputError("this pin has a drive already; the tool Delete takes it away")
    speed = tables.get("drive", {}).get("speed") or SPEED
    if not driven or len(driven) == 1 and "drive" in tables and not _freedom(clicked.spec):
        tables["drive"] = {"joint": free[0], "speed": speed}
    elif not _freedom(clicked.spec):
        raise InputError("no degree of freedom is left for another drive; take one away first, with the tool Delete")
    else:
        tables.setdefault("drives", []).append({"joint": _independent(clicked, free), "speed": speed})


def _driven(tables: Tables) -> list[str]:
    """Names of the joints that have a drive."""
    return [drive["joint"] for drive in (*([tables["drive"]] if "drive" in tables else ()), *tables.get("drives", ()))]


def _freedom(spec: LinkageSpec) -> int:
    """Degrees of freedom beside the drives; 0 where that cannot be said."""
    try:
        return build(spec).assembly.freedom
    except DrivewrightError:
        return 0


def _independent(clicked: Clicked, pins: Sequence[str]) -> str:
    """The first pin that a drive can turn whatever the other drives do."""
    spec, before = clicked.spec, _freedom(clicked.spec)
    for pin in pins:
        drive = LinkageDrive.model_validate({"joint": pin, "speed": SPEED})
        with suppress(DrivewrightError):
            if build(spec.model_copy(update={"drives": (*spec.drives, drive)})).assembly.freedom == before - 1:
                return pin
    raise InputError("the other drives already set how this pin turns; click another one")


def _force(clicked: Clicked, places: Sequence[Place]) -> None:
    """A force of 10 N downwards on the body at a place."""
    body = _of_body(clicked, places[0])
    clicked.append("forces", "force", body=body, point=_name(clicked.point(body, places[0])), force=["0 N", "-10 N"])


def _spring(clicked: Clicked, places: Sequence[Place]) -> None:
    """A spring between two places, each on a body or on the frame, as long as it is now where it is without force."""
    start, end = (clicked.exactly(place) for place in places)
    bodies = [next(iter(_bodies_at(clicked, place)), GROUND) for place in (start, end)]
    if bodies[0] == bodies[1]:
        raise InputError("both ends of this spring are on the same body; click points of two")
    ends = [clicked.point(body, place) for body, place in zip(bodies, (start, end), strict=True)]
    clicked.append("springs", "spring", connects=ends, stiffness="1 N/mm", free_length=_length(math.dist(start, end)))


def _load(clicked: Clicked, places: Sequence[Place]) -> None:
    """A torque of 1 N m against the body at a place."""
    clicked.append("torques", "load", body=_of_body(clicked, places[0]), torque="-1 N m")


def _output(clicked: Clicked, places: Sequence[Place]) -> None:
    """An output: its path is drawn, its motion becomes plots and values."""
    body = _of_body(clicked, places[0])
    clicked.append("outputs", "output", body=body, point=_name(clicked.point(body, places[0])))


def _delete(clicked: Clicked, places: Sequence[Place]) -> None:
    """What is at a place: the drive of its pin, else its joints, else the body."""
    tables, joints = clicked.tables, _at(clicked, places[0])
    if driven := {joint["name"] for joint in joints} & set(_driven(tables)):
        _take_drives(tables, driven)
    elif joints:
        tables["joints"] = [joint for joint in tables["joints"] if joint not in joints]
    else:
        body = _of_body(clicked, places[0])
        if len(tables["bodies"]) == 1:
            raise InputError("a linkage has at least one body; this is the last one")
        del tables["bodies"][body]
        before = _ground_points(tables)
        for kind in LISTS:
            kept = [item for item in tables.get(kind, []) if body not in _bodies_of(item)]
            tables[kind] = kept
        for point in before - _ground_points(tables):
            tables["ground"]["points"].pop(point, None)
    for kind in [kind for kind in LISTS if tables.get(kind) == []]:
        del tables[kind]


def _take_drives(tables: Tables, joints: Collection[str]) -> None:
    """Tables without the drives of some joints; where the first drive goes, the next one takes its place."""
    kept = [drive for drive in (tables.pop("drive", None), *tables.pop("drives", ())) if drive and drive["joint"] not in joints]
    if kept:
        tables["drive"] = kept[0]
    if kept[1:]:
        tables["drives"] = kept[1:]


ACTS = {
    "body": _body,
    "pin": _pin,
    "slide": _slide,
    "drive": _drive,
    "force": _force,
    "spring": _spring,
    "load": _load,
    "output": _output,
    "delete": _delete,
}
TOOLS = (
    Tool("body", "Body", "Draw a bar with one stroke, or click the points of the body; Enter or a double click ends it", 2, 12),
    Tool("pin", "Pin", "Click a place that two bodies share, or a body to pin it to the frame"),
    Tool("slide", "Slide", "Click a point, then a second place in the direction of the slide", 2, 2),
    Tool("drive", "Drive", "Click the pin that the drive turns; each degree of freedom can have a drive of its own", picks=True),
    Tool("force", "Force", "Click the point of a body where the force acts"),
    Tool("spring", "Spring", "Click both ends of the spring", 2, 2),
    Tool("load", "Load torque", "Click the body that the torque acts on", picks=True),
    Tool("output", "Output", "Click the point whose path, travel and swing are to be shown"),
    Tool("delete", "Delete", "Click a joint or a body; of a pin with a drive, the drive goes first", picks=True),
)


def build_step(tables: Tables, spec: LinkageSpec, tool: str, places: Sequence[Place], near: float) -> Tables:
    """Other tables: those given after one use of a tool; InputError where the places do not suit it."""
    changed = deepcopy(tables)
    ACTS[tool](Clicked(changed, spec, loose_poses(spec), near), places)
    _match_run(changed)
    return changed


def _match_run(tables: Tables) -> None:
    """No drive of a joint that is gone; a run of turns where, and only where, a drive at constant speed counts them."""
    names = {joint.get("name") for joint in tables.get("joints", [])}
    if gone := set(_driven(tables)) - names:
        _take_drives(tables, gone)
    turns = "speed" in tables.get("drive", {}) or any("speed" in drive for drive in tables.get("drives", []))
    run = tables.get("simulate")
    if turns and run is None:
        tables["simulate"] = dict(RUN)
    elif run is not None and not turns:
        tables["simulate"] = {key: value for key, value in run.items() if key not in ("turns", "discard")}
        if "duration" not in run:
            del tables["simulate"]


# -- what is at a place --------------------------------------------------------------------------------------------------------


def _bodies_at(clicked: Clicked, place: Place) -> list[str]:
    """Bodies with a point upon a place, else those whose bar passes it."""
    return [body for body in clicked.at(place) if body != GROUND] or clicked.bodies_through(place)


def _of_body(clicked: Clicked, place: Place) -> str:
    """The uppermost body at a place."""
    bodies = _bodies_at(clicked, place)
    if not bodies:
        raise InputError("there is no body here; click a point or a bar of one")
    return max(bodies, key=list(clicked.spec.bodies).index)


def _joined(clicked: Clicked, place: Place) -> tuple[str, list[str]]:
    """(body, others that a joint at a place connects it with); the frame where the others are none."""
    through = clicked.bodies_through(clicked.exactly(place))
    bodies = sorted({*_bodies_at(clicked, place), *through}, key=list(clicked.spec.bodies).index)
    if not bodies:
        raise InputError("there is no body here; click a point or a bar of one")
    if GROUND in clicked.at(place) or len(bodies) == 1:
        return GROUND, bodies
    return bodies[0], bodies[1:]


def _at(clicked: Clicked, place: Place) -> list[dict[str, Any]]:
    """The joints, as raw tables, that have an end upon a place."""
    points = [(f"{body}.{point}", seen) for body in (GROUND, *clicked.spec.bodies) for point, seen in clicked.seen(body).items()]
    ends = {text for text, seen in points if math.dist(seen, place) <= clicked.near}
    return [joint for joint in clicked.tables.get("joints", []) if ends & set(joint["connects"])]


def _bodies_of(item: Mapping[str, Any]) -> set[str]:
    """The bodies that a table of a list names."""
    return {str(end).partition(".")[0] for end in (*item.get("connects", ()), item.get("body", ""), item.get("on", ""))}


def _is_inside(place: Place, corners: Sequence[Place]) -> bool:
    """Whether a place lies inside a polygon."""
    x, y = place
    edges = zip(corners, [*corners[1:], corners[0]], strict=True)
    return sum((y0 > y) != (y1 > y) and x < x0 + (y - y0) * (x1 - x0) / (y1 - y0) for (x0, y0), (x1, y1) in edges) % 2 == 1


def _ground_points(tables: Tables) -> set[str]:
    """The points of the frame that joints and springs are at."""
    ends = [str(end) for kind in LISTS for item in tables.get(kind, []) for end in item.get("connects", ())]
    return {_name(end) for end in ends if end.startswith(f"{GROUND}.")}


def _from_segment(place: Place, start: Place, end: Place) -> float:
    """Distance of a place from a segment."""
    along, to = np.subtract(end, start), np.subtract(place, start)
    part = np.clip(to @ along / max(along @ along, 1e-300), 0.0, 1.0)
    return float(np.hypot(*(to - part * along)))


# -- names and texts -----------------------------------------------------------------------------------------------------------


def _lengths(place: Iterable[float]) -> list[str]:
    return [_length(part) for part in place]


def _length(value: float) -> str:
    return f"{round(float(value) * 1e3, 4) + 0.0:.10g} mm"


def _name(text: str) -> str:
    return text.partition(".")[2]


def _letters() -> Iterator[str]:
    """A, B ... Z, A2, B2 ..."""
    number = 1
    while True:
        yield from (f"{letter}{number if number > 1 else ''}" for letter in "ABCDEFGHIJKLMNOPQRSTUVWXYZ")
        number += 1


def _numbered(name: str) -> Iterator[str]:
    """pin, pin_2, pin_3 ..."""
    stem, number = re.sub(r"_\d+$", "", name), 1
    while True:
        yield stem if number == 1 else f"{stem}_{number}"
        number += 1


def _unused(names: Iterable[str], taken: Iterable[Any]) -> str:
    known = set(taken)
    return next(name for name in names if name not in known)


CONSTRUCTION = Construction(TOOLS, build_step, sketch, unfinished, connected, "crank")
