"""Findings on a linkage that the spec alone gives: what can be computed but deserves attention."""

import itertools
import math

from drivewright.labels import in_words
from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.mechanisms.linkage.tables import central_inertia, ends_on, points_of
from drivewright.multibody.bodies import largest_radius_of_gyration
from drivewright.result import Check

BOUNCY = ("lankarani-nikravesh", "hunt-crossley")  # deliver more restitution than asked, the more the less is asked


def advice(spec: LinkageSpec, end: float = math.inf) -> tuple[Check, ...]:
    """All checks of a LinkageSpec that want no results but the time at which its run ends."""
    return (*clearance_share(spec), *restitution(spec), *inertia_extent(spec), *window(spec, end))


def assumed_friction(spec: LinkageSpec) -> tuple[str, ...]:
    """Findings on friction: what was not given for it, where it is not taken into account, a coefficient at rest below that of sliding."""
    findings = tuple(text for joint in spec.joints if (text := _friction_finding(joint)))
    return (*findings, *(text for joint in spec.joints if (text := _low_static_friction(joint))), *_gears_without_teeth(spec))


def _gears_without_teeth(spec):
    """A finding where pins rub that gears press in reality: here a pair of gears is a ratio of angles, which passes on a torque."""
    gears = [joint.name for joint in spec.joints if joint.kind == "gear"]
    if gears and any(joint.friction for joint in spec.joints if joint.kind == "revolute"):
        yield (
            f"joints of kind gear ({', '.join(map(repr, gears))}) transmit torque only: joint forces and friction of the pins exclude the "
            "tooth forces. The real forces and losses in the pins of geared bodies are larger"
        )


def _low_static_friction(joint):
    if joint.static_friction is None or joint.static_friction >= joint.friction:
        return None
    return (
        f"joint {joint.name!r}: static_friction {joint.static_friction:g} is below friction {joint.friction:g}; for dry surfaces static "
        "friction is at least as large as sliding friction"
    )


def _friction_finding(joint):
    rubs = joint.friction or joint.static_friction or joint.viscous_friction
    if not rubs or not joint.is_ideal:
        return None
    if joint.kind not in ("revolute", "prismatic", "pin-slot", "rolling"):
        return f"friction of joint {joint.name!r} is ignored: friction applies to revolute, prismatic, pin-slot and rolling joints only"
    if joint.kind == "revolute" and "bearing_radius" not in joint.model_fields_set:
        return f"friction in joint {joint.name!r} acts at the default radius of {1e3 * joint.bearing_radius:g} mm; give bearing_radius"
    if joint.kind == "prismatic" and joint.bearing_length is None:
        return (
            f"friction in joint {joint.name!r} results from the force across the slide alone; give bearing_length, the length of the "
            "guide, to include the forces at its ends that a tilting moment causes"
        )
    return None


def shortest_link(spec: LinkageSpec) -> tuple[float, str | None]:
    """(length [m], body) of the shortest distance between two joints on one body; (inf, None) where no body has two apart."""
    links = [(math.inf, None)]
    for name in spec.bodies:
        places = {points_of(spec, name)[point] for joint, point in ends_on(spec, name) if point}
        links += [(math.dist(a, b), name) for a, b in itertools.combinations(sorted(places), 2)]
    return min(links, key=lambda link: link[0])


def clearance_share(spec: LinkageSpec) -> tuple[Check, ...]:
    """The largest clearance over the shortest link: beyond some percent the linkage is another one."""
    played = [joint for joint in spec.joints if joint.pin in ("massless-link", "dry", "lubricated")]
    length, body = shortest_link(spec)
    if not played or body is None:
        return ()
    joint = max(played, key=lambda joint: joint.clearance or 0.0)
    message = (
        f"clearance of joint {joint.name!r} relative to the shortest link, {length * 1e3:.4g} mm of {body!r}; a larger share changes "
        "the kinematics: reduce the clearance"
    )
    share, limit, parts = (joint.clearance or 0.0) / length, spec.limits.clearance_share, (joint.name, body)
    return (Check("clearance_share", share, limit, "<=", "-", message, parts, label="clearance over shortest link"),)


def restitution(spec: LinkageSpec) -> tuple[Check, ...]:
    """Impact laws whose restitution is too high where a low one is given."""
    return tuple(
        Check(
            f"restitution.{joint.name}",
            joint.restitution,
            spec.limits.least_restitution,
            ">=",
            "-",
            f"coefficient of restitution; below the limit {joint.normal} returns much more than stated: use flores-2011 or gonthier",
            (joint.name,),
            label=f"restitution of joint {in_words(joint.name)}",
        )
        for joint in spec.joints
        if joint.has_contact and joint.normal in BOUNCY
    )


def inertia_extent(spec: LinkageSpec) -> tuple[Check, ...]:
    """Radius of gyration of each body against the largest that mass within its named points can have."""
    checks = []
    for name, body in spec.bodies.items():
        widest = largest_radius_of_gyration(list(body.points.values()), body.centroid)
        if body.mass > 0 and widest is not None:
            gyration = math.sqrt(max(central_inertia(body), 0.0) / body.mass)
            message = (
                f"radius of gyration of {name!r} against the maximum for mass between its points; check inertia, and inertia_about if it "
                "was given about a pivot"
            )
            label = f"radius of gyration of {in_words(name)}"
            checks.append(Check(f"inertia.{name}", gyration, widest, "<=", "m", message, (name,), label=label))
    return tuple(checks)


def window(spec: LinkageSpec, end: float = math.inf) -> tuple[Check, ...]:
    """Turns that are left for peaks and means of a run that may end before its time; of a mechanism without play one is enough."""
    if spec.simulate is None or spec.period is None:
        return ()
    repeats = all(joint.is_ideal for joint in spec.joints)
    turns = max(min(spec.duration or math.inf, end) - spec.start_of_window, 0.0) / spec.period
    message = "turns after the discarded ones; with fewer the five largest peaks are not all main peaks: raise simulate.turns"
    if repeats:
        message = "turns after the discarded ones; peaks and means need at least one whole turn: raise simulate.turns"
    limit = min(spec.limits.least_turns, 1.0) if repeats else spec.limits.least_turns
    return (Check("window", turns, limit, ">=", "-", message, label="evaluated turns"),)
