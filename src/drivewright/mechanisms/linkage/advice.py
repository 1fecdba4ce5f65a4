"""What can be computed and should be looked at: checks that need nothing but the spec."""

import itertools
import math

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
            f"joints of kind gear ({', '.join(map(repr, gears))}) pass on a torque alone: the forces of their teeth on the pins are in no "
            "joint force, and cause no friction. Forces and losses in the pins of geared bodies are larger in reality"
        )


def _low_static_friction(joint):
    if joint.static_friction is None or joint.static_friction >= joint.friction:
        return None
    return (
        f"joint {joint.name!r}: static_friction {joint.static_friction:g} is below friction {joint.friction:g}. A joint at rest is "
        "then easier to move than one that slides; dry surfaces behave the other way round"
    )


def _friction_finding(joint):
    rubs = joint.friction or joint.static_friction or joint.viscous_friction
    if not rubs or not joint.is_ideal:
        return None
    if joint.kind not in ("revolute", "prismatic", "pin-slot", "rolling"):
        return f"friction of joint {joint.name!r} is not taken into account: it is a {joint.kind}, and neither pin, slide, slot nor wheel"
    if joint.kind == "revolute" and "bearing_radius" not in joint.model_fields_set:
        return f"friction in joint {joint.name!r} acts at the radius {1e3 * joint.bearing_radius:g} mm, as no bearing_radius is given"
    if joint.kind == "prismatic" and joint.bearing_length is None:
        return (
            f"friction in joint {joint.name!r} is that of the force across the slide alone; what tilts the slider and presses its ends "
            "counts with bearing_length, the length of the guide"
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
    message = f"clearance of joint {joint.name!r} over the shortest link, {length * 1e3:.4g} mm of {body!r}"
    return (
        Check("clearance_share", (joint.clearance or 0.0) / length, spec.limits.clearance_share, "<=", "-", message, (joint.name, body)),
    )


def restitution(spec: LinkageSpec) -> tuple[Check, ...]:
    """Laws that bounce too well where little restitution is asked."""
    return tuple(
        Check(
            f"restitution.{joint.name}",
            joint.restitution,
            spec.limits.least_restitution,
            ">=",
            "-",
            f"{joint.normal} delivers clearly more restitution than is asked below; take flores-2011 or gonthier",
            (joint.name,),
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
            message = f"radius of gyration of {name!r}, which mass between its points cannot exceed; is its inertia about a pivot?"
            checks.append(Check(f"inertia.{name}", gyration, widest, "<=", "m", message, (name,)))
    return tuple(checks)


def window(spec: LinkageSpec, end: float = math.inf) -> tuple[Check, ...]:
    """Turns that are left for peaks and means of a run that may end before its time; of a mechanism without play one is enough."""
    if spec.simulate is None or spec.period is None:
        return ()
    repeats = all(joint.is_ideal for joint in spec.joints)
    turns = max(min(spec.duration or math.inf, end) - spec.start_of_window, 0.0) / spec.period
    message = "turns after discard; the five largest peaks of fewer are not all main peaks"
    if repeats:
        message = "turns after discard; peaks and means of less than one are not those of the mechanism"
    return (Check("window", turns, min(spec.limits.least_turns, 1.0) if repeats else spec.limits.least_turns, ">=", "-", message),)
