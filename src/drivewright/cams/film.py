"""The oil film between cam and follower: how fast it is carried in, how thick it is, where it reverses."""

import numpy as np

from drivewright._typing import Floats
from drivewright.cams.cycle import Cycle, Quantity
from drivewright.cams.followers import CamContact
from drivewright.cams.pressure import relative_curvature
from drivewright.contact.elastohydrodynamic import LineFilm, line_film
from drivewright.numerics.jets import Jet
from drivewright.numerics.roots import roots_in_brackets

SAME = 1e-6  # rad; reversals nearer than this are one


def entrainment(contact: CamContact, rolls: bool) -> Jet:
    """Mean speed at which the contact runs along both surfaces, per unit of cam speed [m], a jet; negative against the usual sense.

    Along the cam's surface it runs with `rolling`, along the follower's body with rolling - sliding: u = rolling - sliding/2.
    A roller rolls with the cam's surface: u = rolling.
    """
    return contact.rolling if rolls else contact.rolling - 0.5 * contact.sliding


def reversals(cycle: Cycle, speed: Quantity) -> Floats:
    """Cam angles [rad] at which a speed changes its sign, also by a jump between two pieces; ascending."""
    piece, angle = cycle.samples()
    value = speed(*cycle.sampled()).d0 + 0 * angle
    left = np.flatnonzero(np.sign(value[:-1]) * np.sign(value[1:]) < 0)
    own = piece[left]
    root = roots_in_brackets(lambda x: speed(*cycle.at(own, x)).d0 + 0 * x, angle[left], angle[left + 1], value[left], value[left + 1])
    places = np.sort(np.concatenate([np.where(np.isfinite(root), root, angle[left]), angle[value == 0]]))
    return places[np.insert(np.diff(places) > SAME, 0, True)] if len(places) else places


def cam_film(
    contact: CamContact,
    speed: Floats,
    force: Floats,
    radius: float,
    width: float,
    modulus: float,
    viscosity: float,
    pressure_viscosity: float,
) -> LineFilm:
    """The `LineFilm` at each place from the entrainment speed [m/s] and the normal force [N]; radius of the face, width [m], E* [Pa].

    nan where nothing presses.
    """
    load = np.where(force > 0, force / width, np.nan)
    return line_film(speed, load, 1 / relative_curvature(contact, radius).d0, modulus, viscosity, pressure_viscosity)
