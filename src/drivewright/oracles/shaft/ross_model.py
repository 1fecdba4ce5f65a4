"""A turning shaft in ROSS: elements, eigenvalues and unbalance response are ROSS'.

Only `verify`, tests and benchmarks import this: ROSS is an optional dependency, whose import takes seconds and prints.
"""

import os
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np

from drivewright._typing import Floats
from drivewright.shafts import Unbalance
from drivewright.shafts.equilibrium import ShaftEquilibrium
from drivewright.shafts.model import COWPER, EULER_BERNOULLI


@contextmanager
def _silence() -> Iterator[None]:
    """What libraries print, also from below Python, goes nowhere."""
    kept = [(stream, os.dup(stream)) for stream in (1, 2)]
    nowhere = os.open(os.devnull, os.O_WRONLY)
    try:
        for stream, _ in kept:
            os.dup2(nowhere, stream)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    finally:
        for stream, copy in kept:
            os.dup2(copy, stream)
            os.close(copy)
        os.close(nowhere)


with _silence():
    import ross as ross_module

ross: Any = ross_module
MODES = 24  # that ROSS is asked for, torsion and the axis among them
PER_NODE = 6


def unknown(equilibrium: ShaftEquilibrium) -> str:
    """What of a shaft ROSS' elements do not have; empty where nothing is missing."""
    shaft = equilibrium.model.beam.shaft
    conditions = {
        "a shear coefficient of one's own": shaft.shear not in (COWPER, EULER_BERNOULLI),
        "bearings that are rigid": any(not np.all(np.isfinite(tangent)) for tangent in equilibrium.tangent),
        "bearings that resist tilting": any(np.any(tangent[3:, 3:]) for tangent in equilibrium.tangent),
        "housings that yield or rings that slide": any(len(mount.ring_freedoms) for mount in equilibrium.model.mounts),
        "bearings with a width": any(support.width for support in shaft.supports),
    }
    return ", ".join(what for what, is_so in conditions.items() if is_so)


def rotor(equilibrium: ShaftEquilibrium) -> Any:
    """ROSS' rotor on the nodes of an equilibrium, its bearings with the tangent stiffness and the damping of the supports there."""
    beam, shaft = equilibrium.model.beam, equilibrium.model.beam.shaft
    steel = ross.Material(name="shaft", rho=max(shaft.density, 1e-9), E=shaft.modulus, Poisson=shaft.poisson)
    with _silence():
        parts = [
            ross.ShaftElement(
                L=length,
                idl=bore,
                odl=start,
                idr=bore,
                odr=end,
                material=steel,
                shear_effects=shaft.shear != EULER_BERNOULLI,
                rotary_inertia=shaft.has_rotary_inertia,
                gyroscopic=shaft.has_rotary_inertia,
            )
            for length, start, end, bore in beam.pieces
        ]
        discs = [ross.DiskElement(n=beam.node(m.position), m=m.mass, Id=m.diametral, Ip=m.polar) for m in shaft.masses if m.mass or m.polar]
        return ross.Rotor(parts, discs, list(map(_bearing, *zip(*_supports(equilibrium), strict=True))))


def _supports(equilibrium):
    """(node, stiffness (2, 2), damping (2, 2), axial stiffness) of every support."""
    for support, tangent in zip(equilibrium.model.beam.shaft.supports, equilibrium.tangent, strict=True):
        yield equilibrium.model.beam.node(support.position), tangent[:2, :2], np.array(support.damping), tangent[2, 2]


def _bearing(node, stiffness, damping, axial):
    numbers = {}
    for kind, matrix in (("k", stiffness), ("c", damping)):
        (xx, xy), (yx, yy) = matrix.tolist()
        numbers |= {f"{kind}xx": xx, f"{kind}xy": xy, f"{kind}yx": yx, f"{kind}yy": yy}
    return ross.BearingElement(n=node, kzz=float(axial), czz=0.0, **numbers)


def whirl_frequencies(model: Any, speed: float) -> tuple[Floats, Floats]:
    """(damped frequencies [rad/s], logarithmic decrements) of all of ROSS' lowest modes at a speed [rad/s]."""
    found = model.run_modal(speed, num_modes=MODES)
    return np.asarray(found.wd), np.asarray(found.log_dec)


def unbalance_amplitudes(
    model: Any, equilibrium: ShaftEquilibrium, unbalances: Sequence[Unbalance], speed: float, places: Sequence[float]
) -> Floats:
    """Major semi-axes (p,) [m] of the orbits at places [m]."""
    beam = equilibrium.model.beam
    found = model.run_unbalance_response(
        node=[beam.node(each.position) for each in unbalances],
        unbalance_magnitude=[each.moment for each in unbalances],
        unbalance_phase=[each.angle for each in unbalances],
        frequency=np.array([speed]),
    )
    at = PER_NODE * np.array([beam.node(place) for place in places])
    x, y = found.forced_resp[at, 0], found.forced_resp[at + 1, 0]
    return 0.5 * (np.abs(x + 1j * y) + np.abs(x - 1j * y))
