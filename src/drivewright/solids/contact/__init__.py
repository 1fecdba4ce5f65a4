"""Elastic bodies pressed on each other: surfaces that press and do not pull, with clearance and friction, small displacements (extra `fe`).

A pressure is linear over each element of the one skin and acts along normals midway between both; the bodies are condensed to these
pressures once, and every load after that is a small quadratic programme, or with friction a few steps of a semismooth Newton method.

complementarity  which places press: a convex quadratic programme
condensing       functionals of a skin as load vectors, and a body condensed to them
friction         which places stick or slip: Coulomb's law beside the pressures
model            bodies, pairs of skins, links and loads, and the state under a load
pairing          hats of pressure on a first skin, their effect on both, and the gap between
pressing         bodies from STEP files pressed on each other by one call
surfaces         the skin of a meshed body as arrays, and where rays meet it
"""

from drivewright.solids.contact.model import ContactModel, ContactState, Functional, Link, Pair
from drivewright.solids.contact.pressing import PressedBodies, SolidBody, press

__all__ = ["ContactModel", "ContactState", "Functional", "Link", "Pair", "PressedBodies", "SolidBody", "press"]
