"""How the flexibility follows every dimension, stiffness and modulus - and what is held while one of them changes.

Derivatives d delta_ij/d ln(p).  With A u_j = f_j the shaft under a unit force at station j and delta_ij = f_i' u_j, the adjoint of
delta_ij is u_i itself, for A is symmetric: no equation is solved but those of the flexibility,

    d delta_ij = -u_i' dA u_j + df_i' u_j + u_i' df_j.

Of the first term a piece of shaft has  f_i' dF f_j + (V_i t_j + t_i V_j) dL + N_i N_j dC,  f being the force V and the moment at its end,
N its pull, F and C its compliances, t the slope at its start and L its length.  A support that has a width has  -(R_i dr_j + dr_i R_j), R
being its force and r the displacement averaged over that width.  The others are those of a station that moves along the shaft.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats, Ints
from drivewright.shafts import beam as beams
from drivewright.shafts.beam import FREEDOMS, PLANES
from drivewright.shafts.equilibrium import ShaftEquilibrium
from drivewright.shafts.influence import Flexibility
from drivewright.shafts.model import Shaft, Station, Support
from drivewright.shafts.piece_slopes import END, LENGTH, START, Compliances, piece_slopes
from drivewright.shafts.sections import shear_area

NO_FLEXIBILITY = 1e-12  # of the largest entry: rounding


class FlexibilitySlope(NamedTuple):
    """How the flexibility follows a parameter p, and what is held meanwhile: `slope` (s, s) is d delta/d ln(p) [m/N], or relative [-]."""

    parameter: str
    held: str
    slope: Floats


def flexibility_slopes(equilibrium: ShaftEquilibrium, flexibility: Flexibility, direction: Floats) -> Iterator[FlexibilitySlope]:
    """(parameter, what is held, d delta/d ln(parameter) (s, s) [m/N]) of the flexibility between the shaft's stations along `direction`.

    Bearings that are not linear keep their tangents at the equilibrium.
    """
    loaded = _unit_states(equilibrium, flexibility)
    yield from _of_parts(equilibrium.model.beam.shaft, flexibility)
    yield from _of_sections(loaded)
    yield from _of_distances(loaded)
    yield from _of_stations(loaded, direction)


def relative_flexibility_slopes(equilibrium: ShaftEquilibrium, flexibility: Flexibility, direction: Floats) -> Iterator[FlexibilitySlope]:
    """`flexibility_slopes` as relative changes over relative changes, d ln(delta)/d ln(p) [-]; nan where delta is 0."""
    known = np.abs(flexibility.delta) > NO_FLEXIBILITY * np.abs(flexibility.delta).max()
    for name, held, slope in flexibility_slopes(equilibrium, flexibility, direction):
        with np.errstate(divide="ignore", invalid="ignore"):
            relative = np.where(known, slope / flexibility.delta, np.nan)
        yield FlexibilitySlope(name, held, relative)


def _of_parts(shaft: Shaft, flexibility: Flexibility) -> Iterator[FlexibilitySlope]:
    """Modulus and bearings: delta is the sum of its shares, each inversely proportional to a stiffness."""
    shares = dict(zip(flexibility.names, flexibility.shares, strict=True))
    elastic = [support.name for support in shaft.supports if is_elastic(support)]
    inside = [share for name, share in shares.items() if name in ("bending", "shear", "tension")]
    yield FlexibilitySlope("youngs_modulus", "shear modulus in proportion, bearings held", -np.sum(inside, axis=0))
    if elastic:
        together = -np.sum([shares[name] for name in elastic], axis=0)
        yield FlexibilitySlope("bearings.stiffness", "all bearings with their housings in proportion", together)
    for name in elastic if len(elastic) > 1 else ():
        yield FlexibilitySlope(f"bearings.{name}.stiffness", "with its housing, all else held", -shares[name])


def is_elastic(support: Support) -> bool:
    """Whether a support yields: by its law, a spring or its seat."""
    return support.law is not None or any(0 < k < np.inf for k in (*support.stiffness, *support.seat))


class _UnitStates(NamedTuple):
    """The shaft under a unit force at each of its s stations: end forces (s, 2, n-1, 2) of its pieces in both planes and pull (s, n-1),
    deflection and slope (s, 2, n) of the nodes, forces (s, supports, 2) on the supports; and what the pieces yield."""

    beam: beams.Beam
    forces: Floats
    pull: Floats
    deflection: Floats
    slope: Floats
    reactions: Floats
    pieces: Compliances
    slopes: Compliances


class _Change(NamedTuple):
    """Rates (n-1, 3) of the length and the diameters of every piece, and of how far the ends of every support's width are ahead of
    their nodes (supports, 2)."""

    pieces: Floats
    edges: Floats


def _unit_states(at_rest: ShaftEquilibrium, flexibility: Flexibility) -> _UnitStates:
    beam, columns = at_rest.model.beam, flexibility.unknowns.T
    nodes = (at_rest.model.basis[: beam.size] @ flexibility.unknowns).T.reshape(len(columns), -1, FREEDOMS)
    return _UnitStates(
        beam,
        np.array([[beams.end_forces(beam, plane, column) for plane in (0, 1)] for column in columns]),
        np.array([beams.tension_and_torque(beam, column)[:, 0] for column in columns]),
        np.stack([nodes[:, :, w] for w, _, _ in PLANES], axis=1),
        np.stack([sign * nodes[:, :, t] for _, t, sign in PLANES], axis=1),
        flexibility.support_forces[:, :2].transpose(2, 0, 1),
        *piece_slopes(beam),
    )


def _of_sections(loaded: _UnitStates) -> Iterator[FlexibilitySlope]:
    """Diameters: those of a cone in proportion."""
    beam = loaded.beam
    at, still = _sections_of_pieces(beam), np.zeros((len(beam.shaft.supports), 2))
    for number in range(len(beam.shaft.sections)):
        rates = np.zeros((len(at), 3))
        rates[:, [START, END]] = np.where((at == number)[:, None], beam.pieces[:, 1:3], 0.0)
        yield FlexibilitySlope(f"segments.{number}.diameter", "lengths and bore held", _delta_rate(loaded, _Change(rates, still)))


def _of_distances(loaded: _UnitStates) -> Iterator[FlexibilitySlope]:
    """Distances from a bearing or station to the next."""
    shaft = loaded.beam.shaft
    features: list[Support | Station] = sorted((*shaft.supports, *shaft.stations), key=lambda each: each.position)
    for one, two in zip(features, features[1:], strict=False):
        if two.position > one.position:
            yield FlexibilitySlope(
                f"distance.{one.name}-{two.name}",
                "all other distances held, parts to the right move along",
                _delta_rate(loaded, _stretch(loaded.beam, one.position, two.position)),
            )


def _of_stations(loaded: _UnitStates, direction: Floats) -> Iterator[FlexibilitySlope]:
    """Places of stations."""
    beam = loaded.beam
    for number, station in enumerate(beam.shaft.stations):
        if 0 < station.position < beam.shaft.length:
            node = beam.node(station.position)
            if _features_at(beam)[node] == 1:
                slope = _delta_rate(loaded, _node_movement(beam, node))
            else:
                slope = _rate_by_line(loaded, number, node, direction)
            yield FlexibilitySlope(f"stations.{station.name}.position", "all else held", station.position * slope)


# -- what moves ----------------------------------------------------------------------------------------------------------------


def _stretch(beam: beams.Beam, start: float, end: float) -> _Change:
    """The stretch from `start` to `end` grows in proportion, everything beyond is carried along; a cone stays straight over its section.

    Nodes move with the shaft; those that there are for the width of a support alone move with the support.  Where the end of a width is
    also a step or a station, the node moves with the shaft, and the support slides over it.
    """

    def carried(z: Floats) -> Floats:
        return np.clip(z - start, 0.0, end - start)

    moved, alone, widths = carried(beam.z), _features_at(beam, with_widths=False) == 0, _width_nodes(beam)
    places = carried(np.array([support.position for support in beam.shaft.supports]))
    for (first, last), place in zip(widths, places, strict=True):
        moved[first : last + 1][alone[first : last + 1]] = place
    return _Change(_piece_rates(beam, moved, carried(beam.shaft.ends)), places[:, None] - moved[widths])


def _node_movement(beam: beams.Beam, node: int) -> _Change:
    """A single node moves along the shaft."""
    moved, shaft = np.eye(1, len(beam.z), node)[0], beam.shaft
    return _Change(_piece_rates(beam, moved, np.zeros(len(shaft.ends))), np.zeros((len(shaft.supports), 2)))


def _piece_rates(beam: beams.Beam, nodes: Floats, ends: Floats) -> Floats:
    """(n-1, 3) rates of length and diameters of the pieces where the nodes (n,) and the ends of the sections move."""
    shaft, at = beam.shaft, _sections_of_pieces(beam)
    length, growth = np.diff(shaft.ends)[at], np.diff(ends)[at]
    taper = np.array([section.end - section.start for section in shaft.sections])[at] / length
    share = [(beam.z[side] - shaft.ends[at]) / length for side in (slice(None, -1), slice(1, None))]
    start, end = (taper * (moved - ends[at] - growth * part) for moved, part in zip((nodes[:-1], nodes[1:]), share, strict=True))
    return np.stack([np.diff(nodes), start, end], axis=1)


def _features_at(beam: beams.Beam, with_widths: bool = True) -> Ints:
    """(n,) how many steps, supports, stations and, where wanted, ends and divisions of a support's width are at each node."""
    shaft = beam.shaft
    widths = [beams.width_places(shaft, support) for support in shaft.supports if with_widths]
    features = [each.position for each in (*shaft.supports, *shaft.stations)]
    return np.bincount(_nodes_at(beam, np.concatenate([shaft.ends, features, *widths])), minlength=len(beam.z))


def _width_nodes(beam: beams.Beam) -> Ints:
    """(supports, 2) nodes at the left and the right end of every support's width."""
    return _nodes_at(beam, np.array([[s.position - s.width / 2, s.position + s.width / 2] for s in beam.shaft.supports]))


def _nodes_at(beam: beams.Beam, places: Floats) -> Ints:
    """Nodes next to places."""
    between = 0.5 * (beam.z[1:] + beam.z[:-1])
    return np.searchsorted(between, places)


def _sections_of_pieces(beam: beams.Beam) -> Ints:
    """(n-1,) the number of the section that every piece belongs to."""
    middles = beam.z[:-1] + 0.5 * beam.pieces[:, 0]
    return np.clip(np.searchsorted(beam.shaft.ends, middles) - 1, 0, len(beam.shaft.sections) - 1)


# -- how delta follows ---------------------------------------------------------------------------------------------------------


def _delta_rate(loaded: _UnitStates, change: _Change) -> Floats:
    """(s, s) rate of delta while the shaft changes under its stations and supports."""
    own = np.flatnonzero(change.pieces.any(axis=1))
    rates, forces, pull = change.pieces[own], loaded.forces[:, :, own], loaded.pull[:, own]
    softer = np.einsum("nc,cnab->nab", rates, loaded.slopes.flexibility[:, own])
    longer = np.einsum("nc,cn->n", rates, loaded.slopes.elongation[:, own])
    lever = _paired(forces[..., 0] * rates[:, LENGTH], loaded.slope[:, :, own])
    total = _paired(_times(softer, forces), forces) + _paired(longer * pull, pull) + lever + lever.T
    for number, (first, last) in enumerate(_width_nodes(loaded.beam)):
        if last > first:
            averaged = _averaged_deflection_rate(loaded, first, last, change.pieces[first:last], change.edges[number])
            work = _paired(loaded.reactions[:, number], averaged)
            total -= work + work.T
    return total


def _averaged_deflection_rate(loaded: _UnitStates, first: int, last: int, rates: Floats, edges: Floats) -> Floats:
    """(s, 2) rate of the deflection averaged over the width of a support, between two nodes, at given displacements of all nodes.

    A piece of length L has  int w dz = w L + t L^2/2 + f' s  of it, w and t at its start and s its sag under an even load (reciprocity).
    """
    own, beam = slice(first, last), loaded.beam
    forces, slope, deflection = loaded.forces[:, :, own], loaded.slope[:, :, own], loaded.deflection[:, :, own]
    softer = np.einsum("nc,cnab->nab", rates, loaded.slopes.flexibility[:, own])
    sag = np.einsum("nc,cna->na", rates, loaded.slopes.sag[:, own])
    turned = np.stack([slope * rates[:, LENGTH], np.zeros_like(slope)], axis=-1)
    stiffness = np.asarray(np.linalg.inv(loaded.pieces.flexibility[own]), dtype=float)
    force_rates = -_times(stiffness, turned + _times(softer, forces))
    inside = np.einsum("spna,na->sp", force_rates, loaded.pieces.sag[own]) + np.einsum("spna,na->sp", forces, sag)
    inside += (deflection + slope * beam.pieces[own, 0]) @ rates[:, LENGTH]
    beside = edges[1] * loaded.deflection[:, :, last] - edges[0] * loaded.deflection[:, :, first]
    return (inside + beside) / (beam.z[last] - beam.z[first])


def _rate_by_line(loaded: _UnitStates, number: int, node: int, direction: Floats) -> Floats:
    """(s, s) rate of delta where a station moves along the elastic line, away from the node that it shares with a step or a support.

    The slope of the line is t + V/(kappa G A); where that differs left and right it is the mean of both.
    """
    beam, count = loaded.beam, len(loaded.forces)
    slip_before, slip_after = _slip(beam, *beam.pieces[node - 1, [2, 3]]), _slip(beam, *beam.pieces[node, [1, 3]])
    own = 0.5 * np.eye(count)[:, [number]] * direction  # half of the unit force acts on either side
    before, after = loaded.forces[:, :, node - 1, 0] - own, loaded.forces[:, :, node, 0] + own
    rate = np.zeros((count, count))
    rate[number] = (loaded.slope[:, :, node] + 0.5 * (before * slip_before + after * slip_after)) @ direction
    return rate + rate.T


def _slip(beam: beams.Beam, diameter: float, bore: float) -> float:
    """1/(kappa G A) [1/N] of a section."""
    shaft = beam.shaft
    shear_stiffness = 0.5 * shaft.modulus / (1 + shaft.poisson) * shear_area(np.array(diameter), np.array(bore), shaft.poisson, shaft.shear)
    return float(1 / shear_stiffness)


def _times(matrices: Floats, vectors: Floats) -> Floats:
    """(s, 2, n, a): the matrix (n, a, b) of every piece times its vectors (s, 2, n, b)."""
    return np.einsum("nab,spnb->spna", matrices, vectors)


def _paired(one: Floats, other: Floats) -> Floats:
    """(s, s): one_i . other_j over everything but the stations."""
    return one.reshape(len(one), -1) @ other.reshape(len(other), -1).T
