"""A plate's straight flank on the involute of a tooth.

In the plate's frame (along, up) [m] is its pin frame's origin seen from the sprocket's centre.  The right flank is the line n.X = w with
n = (cos a, -sin a), w the `flank_support`; the tooth has the support H at its seat and H + rb delta with the plate turned by delta
against it, rb the base radius.  The left flank is its mirror image.
"""

from drivewright._jit import inner


@inner
def flank_contact(
    cos: float, sin: float, flank_support: float, base_radius: float, support: float, side: float, along: float, up: float, rolled: float
) -> tuple[float, float, float]:
    """(depth, support of the tooth's flank, place of the contact along the plate's flank) [m] of the right (side 1) or left (-1) flank.

    depth = n.D + w - (H + rb delta), with `rolled` = rb delta [m]; the contact lies at rb - t.D along the flank.
    """
    turned = support + side * rolled
    depth = side * cos * along - sin * up + flank_support - turned
    return depth, turned, base_radius - side * sin * along - cos * up


@inner
def is_active(support: float, low: float, high: float, place: float, deepest: float, highest: float) -> bool:
    """Whether the contact lies on the active part of the tooth, between the supports of tip and form, and on that of the plate's flank."""
    return (support > low) & (support < high) & (place > deepest) & (place < highest)
