"""Linkages by routes that share no equation with the multibody kernel.

exudyn_model          a planar multibody model in Exudyn
four_bar              whether a linkage is a crank-driven four-bar, and its motion in the closed form of `four_bar_closed_form` then
four_bar_closed_form  the four-bar with massless clearance links in closed form
independent_check     the linkage once more, by routes that share no equation with the motion of the multibody kernel
"""

from drivewright.oracles.linkage.independent_check import verify

__all__ = ["verify"]
