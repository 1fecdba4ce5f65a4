"""Model -> tree: which joint carries which body, which joints close loops, which coordinates there are.

Massless links become bodies without mass between two pins.  Joints are taken into the tree in the order of their `tree_role`, driven ones
first; what is left over closes loops.  Joints with play carry nothing: they are forces.  A body that hangs on nothing is free, with x and
y for coordinates.
"""

from collections.abc import Collection
from dataclasses import dataclass, replace

from drivewright.errors import InputError, UnknownName
from drivewright.multibody.bodies import GROUND, Body, Marker
from drivewright.multibody.joints.gear import Gear
from drivewright.multibody.joints.joint import Joint, PointJoint
from drivewright.multibody.joints.revolute import Revolute, far_end_name
from drivewright.multibody.model import MultibodyModel


@dataclass(frozen=True)
class Link:
    """How a body hangs in the tree: on `parent` by `joint` (None: free), its coordinates by number or -1; `inherits`: its angle counts
    from the parent's."""

    body: Body
    parent: str
    joint: PointJoint | None
    turn: int
    slide: int
    free: int
    inherits: bool


@dataclass(frozen=True)
class Tree:
    """Links in an order in which parents come first; the joints that close loops; the number of coordinates."""

    links: tuple[Link, ...]
    closing: tuple[Joint, ...]
    size: int

    def link(self, name: str) -> Link:
        """How the body of this name hangs in the tree."""
        return next(link for link in self.links if link.body.name == name)


def expand(model: MultibodyModel) -> MultibodyModel:
    """The model with what stands for its joints in the simulation: every massless link as a body of its own, and what a drive turns where
    its pin has play."""
    bodies, joints, forces = list(model.bodies), [], list(model.forces)
    for joint in model.joints:
        expansion = joint.expansion
        if expansion is None:
            joints.append(joint)
            continue
        bodies += expansion.bodies
        forces += expansion.forces
        joints += expansion.joints
    drives = [_expand_drive(drive, model, bodies, joints) for drive in model.drives]
    return replace(model, bodies=tuple(bodies), joints=tuple(joints), forces=tuple(forces), drives=tuple(drives))


def _expand_drive(drive, model, bodies, joints):
    """A drive of a pin with play between two moving bodies turns a body without mass on the second, whose angle the first one has; that
    body and its joints are added to the lists."""
    joint = next((joint for joint in model.joints if joint.name == drive.joint), None)
    if not isinstance(joint, PointJoint) or joint.play is None or GROUND in joint.bodies:
        return drive
    rotor = Body(f"drive:{joint.name}", angle=next((body.angle for body in model.bodies if body.name == joint.first.body), 0.0))
    name = f"{joint.name} (drive)"
    bodies.append(rotor)
    joints += [Revolute(name, Marker(rotor.name), joint.second), Gear(f"{joint.name} (turn)", rotor.name, joint.first.body, 1.0)]
    return replace(drive, joint=name)


def far_end(model: MultibodyModel, joint: Joint) -> Joint | None:
    """The other pin of the massless link that a joint of an expanded model holds, or None."""
    return next((other for other in model.joints if other.name == far_end_name(joint)), None)


def build_tree(model: MultibodyModel) -> Tree:
    """The `Tree` of an expanded model."""
    linked = {joint.name for joint in model.joints if far_end(model, joint)}  # a link stands between the drive's two bodies
    driven = {drive.joint for drive in model.drives} - linked
    chosen = _chosen(model, driven)
    neighbours: dict[str, list[PointJoint]] = {body.name: [] for body in model.bodies} | {GROUND: []}
    for joint in chosen:
        for body in joint.bodies:
            neighbours[body].append(joint)
    bodies = {body.name: body for body in model.bodies}
    links: list[Link] = []
    record, count = {GROUND}, 0
    for root in [GROUND, *bodies]:
        if root in record and root != GROUND:
            continue
        queue = [root]
        if root != GROUND:
            links.append(Link(bodies[root], GROUND, None, count, -1, count + 1, False))
            record, count = record | {root}, count + 3
        while queue:
            parent = queue.pop(0)
            for joint in neighbours[parent]:
                child = next(end for end in joint.bodies if end != parent)
                if child not in record:
                    link = _hang(bodies[child], parent, joint, count, joint.name in driven)
                    links.append(link)
                    record, count = record | {child}, count + (link.turn >= 0) + (link.slide >= 0)
                    queue.append(child)
    closing = tuple(joint for joint in model.joints if joint.is_constraint and joint not in chosen)
    return Tree(tuple(links), closing, count)


def _chosen(model: MultibodyModel, driven: Collection[str]) -> list[PointJoint]:
    """The joints of a spanning forest."""

    def rank(joint: PointJoint):
        return joint.name not in driven, joint.tree_role.order if joint.tree_role else 0

    group = {body.name: body.name for body in model.bodies} | {GROUND: GROUND}

    def root(name: str) -> str:
        while group[name] != name:
            name = group[name]
        return name

    chosen = []
    for joint in sorted((joint for joint in model.joints if isinstance(joint, PointJoint) and joint.tree_role), key=rank):
        first, second = (_known(group, joint, end) for end in joint.bodies)
        if root(first) != root(second):
            group[root(first)] = root(second)
            chosen.append(joint)
        elif joint.name in driven:
            others = ", ".join(repr(other.name) for other in chosen if other.name in driven)
            raise InputError(
                f"the drives of joints {others} and {joint.name!r} conflict: the first ones already move the bodies of {joint.name!r}. "
                "Remove one drive, or give it a motor instead of a motion"
            )
    return chosen


def _known(group, joint, end):
    if end not in group:
        raise UnknownName(f"body of joint {joint.name!r}", end, group)
    return end


def _hang(body: Body, parent: str, joint: PointJoint, count: int, driven: bool) -> Link:
    role = joint.tree_role
    assert role is not None  # only joints that carry are chosen
    from_parent = role.from_parent or (driven and parent != GROUND)
    return Link(body, parent, joint, count if role.turns else -1, count + role.turns if role.slides else -1, -1, from_parent)
