"""Solids for the sample's four-bar: two that move, one that stands still."""

from drivewright.report.solids import solid_surfaces
from drivewright.scene import Part, Prism, circle, rectangle

PARTS = (
    Part("crank", (Prism(rectangle((0.016, 0.0), 0.03, 0.01), (), 0.0, 0.004),), colour="orange"),
    Part("coupler", (Prism(rectangle((0.06, 0.02), 0.05, 0.01), (), 0.005, 0.004),), colour="blue"),
    Part("frame", (Prism(circle((0.0, 0.0), 0.004), (), -0.01, 0.02),)),
)
SOLIDS = solid_surfaces(PARTS)
