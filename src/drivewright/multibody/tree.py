"""Model -> tree: which joint carries which body, which joints close loops, which coordinates there are.

Massless links become bodies without mass between two pins.  Joints are taken into the tree in this order: driven ones, prismatic
ones, pins, pin-slots; what is left over closes loops.  Joints with play carry nothing: they are forces.  A body that hangs on
nothing is free, with x and y for coordinates.
"""

from dataclasses import dataclass, replace

from drivewright.errors import InputError, UnknownName
from drivewright.multibody.model import GROUND, Body, Ideal, Marker, MasslessLink, PinSlot, Prismatic, Revolute, RotationalSpring


@dataclass(frozen=True)
class Link:
    """How a body hangs in the tree: on `parent` by `joint` (None: free), its coordinates by number or -1."""

    body: Body
    parent: str
    joint: object
    turn: int
    slide: int
    free: int
    inherits: bool


@dataclass(frozen=True)
class Tree:
    """Links in an order in which parents come first; the joints that close loops; the number of coordinates."""

    links: tuple
    closing: tuple
    size: int

    def link(self, name):
        return next(link for link in self.links if link.body.name == name)


def expanded(model):
    """The model with every massless link as a body of its own, named link:JOINT, between two ideal pins."""
    bodies, joints, forces = list(model.bodies), [], list(model.forces)
    for joint in model.joints:
        if not isinstance(getattr(joint, "model", None), MasslessLink):
            joints.append(joint)
            continue
        link = Body(f"link:{joint.name}", angle=joint.model.angle)
        bodies.append(link)
        forces.append(RotationalSpring(link.name, link.name, damping=joint.model.damping))
        joints += [
            Revolute(joint.name, joint.first, Marker(link.name)),
            Revolute(f"{joint.name} (link)", Marker(link.name, joint.model.clearance), joint.second),
        ]
    return replace(model, bodies=tuple(bodies), joints=tuple(joints), forces=tuple(forces))


def far_end(model, joint):
    """The other pin of the massless link that a joint of an expanded model holds, or None."""
    return next((other for other in model.joints if other.name == f"{joint.name} (link)"), None)


def carries(joint):
    """Whether a joint can hold a body: ideal ones can."""
    return isinstance(joint, (Prismatic, PinSlot)) or (isinstance(joint, Revolute) and isinstance(joint.model, Ideal))


def closes(joint):
    """Whether a joint is a constraint at all."""
    return carries(joint) or not isinstance(joint, Revolute)


def ends(joint):
    """Names of the two bodies of a joint that can be in the tree."""
    return joint.first.body, joint.second.body


def grow(model):
    """The `Tree` of an expanded model."""
    linked = {joint.name for joint in model.joints if far_end(model, joint)}  # a link stands between the drive's two bodies
    driven = {drive.joint for drive in model.drives} - linked
    chosen = _chosen(model, driven)
    neighbours = {body.name: [] for body in model.bodies} | {GROUND: []}
    for joint in chosen:
        for body in ends(joint):
            neighbours[body].append(joint)
    bodies = {body.name: body for body in model.bodies}
    links, seen, count = [], {GROUND}, 0
    for root in [GROUND, *bodies]:
        if root in seen and root != GROUND:
            continue
        queue = [root]
        if root != GROUND:
            links.append(Link(bodies[root], GROUND, None, count, -1, count + 1, False))
            seen, count = seen | {root}, count + 3
        while queue:
            parent = queue.pop(0)
            for joint in neighbours[parent]:
                child = next(end for end in ends(joint) if end != parent)
                if child not in seen:
                    link = _hang(bodies[child], parent, joint, count, joint.name in driven)
                    links.append(link)
                    seen, count = seen | {child}, count + (link.turn >= 0) + (link.slide >= 0)
                    queue.append(child)
    closing = tuple(joint for joint in model.joints if closes(joint) and joint not in chosen)
    return Tree(tuple(links), closing, count)


def _chosen(model, driven):
    """The joints of a spanning forest."""

    def rank(joint):
        return (joint.name not in driven, not isinstance(joint, Prismatic), isinstance(joint, PinSlot))

    group = {body.name: body.name for body in model.bodies} | {GROUND: GROUND}

    def root(name):
        while group[name] != name:
            name = group[name]
        return name

    chosen = []
    for joint in sorted(filter(carries, model.joints), key=rank):
        first, second = (_known(group, joint, end) for end in ends(joint))
        if root(first) != root(second):
            group[root(first)] = root(second)
            chosen.append(joint)
        elif joint.name in driven:
            raise InputError(f"joint {joint.name!r} is driven, but the driven joints before it hold its bodies already; drive fewer joints")
    return chosen


def _known(group, joint, end):
    if end not in group:
        raise UnknownName(f"body of joint {joint.name!r}", end, group)
    return end


def _hang(body, parent, joint, count, driven):
    turns = not isinstance(joint, Prismatic)
    slides = isinstance(joint, (Prismatic, PinSlot))
    inherits = isinstance(joint, Prismatic) or (driven and parent != GROUND and isinstance(joint, Revolute))
    return Link(body, parent, joint, count if turns else -1, count + turns if slides else -1, -1, inherits)
