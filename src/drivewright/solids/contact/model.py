"""Elastic bodies that press on each other: condensed once to their skins, then one small quadratic programme for each load.

Small displacements; contact without friction.  Every body is a `solids.FreeBody`, held by supports, by symmetry and by what presses on it.
Numbers at the door are SI.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
import scipy

from drivewright._typing import Bools, Floats
from drivewright.errors import InputError, SolverError
from drivewright.solids.contact.complementarity import Pressed, balance_exists, solve_complementarity
from drivewright.solids.contact.condensing import Condensed, Rows, condense, load_rows, solved
from drivewright.solids.contact.pairing import GapOf, Pairing, paired
from drivewright.solids.contact.surfaces import Skin, skin_of
from drivewright.solids.elastic import MM, FreeBody
from drivewright.solids.engine import EngineObject

LOOSE = 1e-3  # part in what supports and contacts feel below which a rigid motion is held by nothing
DRIVEN = 1e-3  # part of a load on such a motion that is refused
ACROSS = 2.0  # elements across a contact, at least
MEGA = 1e6


class Pair(NamedTuple):
    """Two named parts of two bodies' boundaries that may touch: (body, regular expression) each.

    The pressure lives on the elements of the first: take the finer or the more curved.  reach [m]: the largest gap that may close; `more`:
    what is added to the gap; press_fit: an overlap before any load is meant.
    """

    first: tuple[str, str]
    second: tuple[str, str]
    reach: float
    more: GapOf | None = None
    press_fit: bool = False


class Functional(NamedTuple):
    """A measured displacement of a body, or the unit force that does work on it: a load vector of its finite elements."""

    body: str
    vector: EngineObject


class Link(NamedTuple):
    """What holds the sum of the displacements of `terms`, one for a support, two between bodies; compliance [m/N], 0 is rigid.

    one_sided: it can only be loaded in the sense of its functionals, as a stop that pushes; gap [m] before it does.
    """

    terms: tuple[Functional, ...]
    compliance: float = 0.0
    one_sided: bool = False
    gap: float = 0.0


@dataclass(frozen=True, eq=False)
class ContactState:
    """Answer to one load.

    pressure: for each pair (h,) [Pa] at the hats of its `Pairing`; links (l,) [N]: the forces along their functionals; motions: {body:
    amounts of its rigid motions} [mm].
    """

    model: "ContactModel"
    forces: Mapping[str, float]
    answer: Pressed
    pressure: tuple[Floats, ...]
    links: Floats
    motions: Mapping[str, Floats]

    def force(self, pair: int) -> Floats:
        """Force (d,) [N] of a pair on its first body."""
        each = self.model.pairings[pair]
        return -np.asarray(each.first.T @ (self.pressure[pair] / MEGA)).reshape(each.places.shape[1], -1).sum(axis=1)

    def area(self, pair: int) -> float:
        """Area that presses [m^2]: of the hats that do."""
        each = self.model.pairings[pair]
        return float(each.area[self.pressure[pair] > 0].sum()) * MM**2

    def displacement(self, body: str) -> Floats:
        """Coefficients (unknowns,) [mm] of a body's displacement."""
        return self.model.displacement(body, self)

    def travel(self, load: str) -> float:
        """Displacement [m] of a load, along its own direction."""
        functional = self.model.loads[load]
        return MM * float(functional.vector.FV().NumPy() @ self.displacement(functional.body))


@dataclass(frozen=True, eq=False)
class ContactModel:
    """Bodies, pairs of skins, links and unit loads {name: functional}, condensed when made.

    A body in `flying` is held by nothing: inertia forces, spread over its volume, balance its loads, and its mean motion is 0 (d'Alembert).
    """

    bodies: Mapping[str, FreeBody]
    pairs: Sequence[Pair]
    links: Sequence[Link]
    loads: Mapping[str, Functional]
    flying: Sequence[str] = ()
    pairings: tuple[Pairing, ...] = field(init=False)
    skins: tuple[tuple[Skin, Skin], ...] = field(init=False)
    condensed: Mapping[str, Condensed] = field(init=False)

    def __post_init__(self) -> None:
        skins = tuple((self._skin(pair.first), self._skin(pair.second)) for pair in self.pairs)
        pairings = tuple(self._paired(pair, *each) for pair, each in zip(self.pairs, skins, strict=True))
        for name, value in (("skins", skins), ("pairings", pairings)):
            object.__setattr__(self, name, value)
        condensed = {name: condense(body, Rows(scipy.sparse.vstack(self._rows(name))), name) for name, body in self.bodies.items()}
        object.__setattr__(self, "condensed", condensed)

    @property
    def one_sided(self) -> Bools:
        """Which unknowns can only press: those of all pairs, and some links."""
        pressing = sum(len(each.gap) for each in self.pairings)
        return np.array([True] * pressing + [link.one_sided for link in self.links])

    def solve(
        self, forces: Mapping[str, float], start: ContactState | None = None, gaps: Sequence[Floats] | None = None, narrow: bool = False
    ) -> ContactState:
        """`ContactState` under forces {load: amount [N]}; `start`: that of a like load; `gaps`: other gaps [mm^3] of the pairs' hats.

        InputError where a contact is too narrow for its elements, unless `narrow` says that it does not matter, as under a load that is
        small beside others.
        """
        if unknown := sorted(set(forces) - set(self.loads)):
            raise InputError(f"contact: no load is called {unknown[0]!r}; there are {', '.join(self.loads)}")
        matrix, right, held, load = self._programme(self._amounts(forces), gaps)
        basis = _held_motions(held, load, self._motions)
        first = None if start is None else start.answer.pressing
        try:
            found = solve_complementarity(matrix, right, basis.T @ held, basis.T @ load, self.one_sided, first)
        except SolverError:
            if balance_exists(basis.T @ held, basis.T @ load, self.one_sided):
                raise
            words = ", ".join(repr(name) for name, _ in self._motions)
            raise InputError(
                f"contact: no pressure on the surfaces balances the loads on {words}: they pull a body off, or tip it over an edge. "
                "Turn the load round, or give the body a support."
            ) from None
        *parts, links = np.split(found.x, np.cumsum([len(each.gap) for each in self.pairings]))
        moved = dict.fromkeys(self.bodies, np.zeros(0))
        moved |= _split(basis @ found.motions, {name: len(body.modes) for name, body in self._motions})
        state = ContactState(self, dict(forces), found, tuple(MEGA * part for part in parts), links, moved)
        if not narrow:
            for number in range(len(self.pairs)):
                self.refuse_narrow(state, number)
        return state

    def refuse_narrow(self, state: ContactState, number: int) -> None:
        """InputError where what presses of a pair is narrower than two of the elements there."""
        pair, each, (skin, _) = self.pairs[number], self.pairings[number], self.skins[number]
        pressing = state.pressure[number] > 0
        if not pressing.any():
            return
        size = float(np.median(skin.size[np.isin(skin.corners, each.corners[pressing]).any(axis=1)]))
        width = contact_width(each, pressing, self.bodies[pair.first[0]])
        if width < ACROSS * size:
            raise InputError(
                f"contact: the elements of {size:.3g} mm on {pair.first[1]!r} of {pair.first[0]!r} are larger than half the contact's "
                f"width of about {width:.3g} mm; give elements of {width / 4:.2g} mm there or smaller."
            )

    def displacement(self, body: str, state: ContactState) -> Floats:
        """Coefficients (unknowns,) [mm] of a body's displacement, rigid motion included."""
        each = self.condensed[body]
        moved = solved(each.body, each.loads.T @ np.concatenate([state.answer.x, self._amounts(state.forces)]))
        for amount, mode in zip(state.motions[body], each.body.modes, strict=False):
            moved += amount * mode.FV().NumPy()
        return moved

    # -- pieces

    @property
    def _count(self) -> int:
        return len(self.one_sided)

    @property
    def _motions(self) -> list[tuple[str, FreeBody]]:
        """The bodies whose rigid motions are unknown."""
        return [(name, body) for name, body in self.bodies.items() if name not in self.flying]

    def _amounts(self, forces: Mapping[str, float]) -> Floats:
        return np.array([forces.get(name, 0.0) for name in self.loads])

    def _skin(self, part: tuple[str, str]) -> Skin:
        name, region = part
        if name not in self.bodies:
            raise InputError(f"contact: no body is called {name!r}; there are {', '.join(self.bodies)}")
        self.bodies[name].area(region)
        return skin_of(self.bodies[name].mesh, region)

    def _paired(self, pair: Pair, first: Skin, second: Skin) -> Pairing:
        nodes = _nodes(self.bodies[pair.first[0]]), _nodes(self.bodies[pair.second[0]])
        plane = self.bodies[pair.first[0]].plane
        depth = plane.thickness / MM if plane else 1.0
        return paired(first, second, nodes, pair.reach / MM, depth, pair.more, pair.press_fit)

    def _rows(self, body: str) -> list[Rows]:
        """All functionals as load rows of one body, 0 where they do not concern it: hats of the pairs, links, loads."""
        free, blocks = self.bodies[body], []
        for pair, each in zip(self.pairs, self.pairings, strict=True):
            rows = Rows((len(each.gap), free.space.ndof))
            if pair.first[0] == body:
                rows = rows - load_rows(free, each.first)
            if pair.second[0] == body:
                rows = rows + load_rows(free, each.second)
            blocks.append(Rows(rows))
        for terms in [link.terms for link in self.links] + [(load,) for load in self.loads.values()]:
            mine = [term.vector.FV().NumPy() for term in terms if term.body == body]
            blocks.append(Rows(sum(mine, np.zeros(free.space.ndof))[None]))
        return blocks

    def _programme(self, amounts: Floats, gaps: Sequence[Floats] | None) -> tuple[Floats, Floats, Floats, Floats]:
        """(A, b, H, h) of `solve_complementarity`."""
        count = self._count
        whole = np.sum([each.flexibility for each in self.condensed.values()], axis=0)
        resultants = np.concatenate([self.condensed[name].resultants for name, _ in self._motions] or [np.zeros((0, len(whole)))])
        soft = np.concatenate([np.zeros(count - len(self.links)), [link.compliance / MM for link in self.links]])
        own = [each.gap for each in self.pairings] if gaps is None else list(gaps)
        gap = np.concatenate([*own, [link.gap / MM for link in self.links]])
        matrix = whole[:count, :count] + np.diag(soft)
        return matrix, gap + whole[:count, count:] @ amounts, resultants[:, :count], resultants[:, count:] @ amounts


def contact_width(pairing: Pairing, pressing: Bools, body: FreeBody) -> float:
    """Width [mm] of what presses, as of an even rectangle with the same second moment across its narrow side; a part at a plane of
    symmetry is completed by its image."""
    points, weight = pairing.places[pressing], pairing.area[pressing]
    dim, free = points.shape[1], np.array(list(body.space.FreeDofs()))
    for axis in range(dim):
        fixed = ~free[body.space.Range(axis).start + pairing.corners[pressing]]
        if fixed.any():
            image = points.copy()
            image[:, axis] = 2 * points[: len(fixed)][fixed, axis].mean() - points[:, axis]
            points, weight = np.concatenate([points, image]), np.concatenate([weight, weight])
    away = points - np.average(points, axis=0, weights=weight)
    spread = np.sort(np.linalg.eigvalsh((away * weight[:, None]).T @ away / weight.sum()))[::-1]
    return float(np.sqrt(12 * max(spread[dim - 2], 0.0)))


def _nodes(body: FreeBody) -> int:
    return body.space.components[0].ndof


def _held_motions(held: Floats, load: Floats, bodies: Sequence[tuple[str, FreeBody]]) -> Floats:
    """Orthonormal rigid motions (m, k) that links and contacts feel; InputError where a load drives another."""
    if not len(held):
        return np.zeros((0, 0))
    columns = np.linalg.norm(held, axis=0)
    axes, sizes, _ = np.linalg.svd(held / np.where(columns > 0, columns, 1.0))
    basis = axes[:, : int(np.sum(sizes > LOOSE * sizes[0]))]
    rest = load - basis @ (basis.T @ load)
    if np.abs(rest).max() > DRIVEN * np.abs(load).max(initial=1e-300):
        name, motion = [(name, k) for name, body in bodies for k in range(len(body.modes))][int(np.abs(rest).argmax())]
        raise InputError(
            f"contact: nothing holds {name!r} against {_words(dict(bodies)[name], motion)}, and a load drives it there; give it a "
            "support, a plane of symmetry, or a surface to press on."
        )
    return basis


def _split(values: Floats, sizes: Mapping[str, int]) -> dict[str, Floats]:
    return dict(zip(sizes, np.split(values, np.cumsum(list(sizes.values()))[:-1]), strict=True))


def _words(body: FreeBody, motion: int) -> str:
    """The rigid motion in words."""
    part = int(np.abs(body.basis[:, motion]).argmax())
    shifts = body.mesh.dim
    if part < shifts:
        return f"moving along {'xyz'[part]}"
    return "turning" if shifts == 2 else f"turning about {'xyz'[part - shifts]}"
