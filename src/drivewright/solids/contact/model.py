"""Elastic bodies that press on each other: condensed once to their skins, then one small quadratic programme for each load.

Small displacements; contact with or without Coulomb's friction.  Every body is a `solids.FreeBody`, held by supports, by symmetry and by
what presses on it.
Numbers at the door are SI.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
import scipy

from drivewright._typing import Bools, Floats
from drivewright.errors import InputError, SolverError
from drivewright.solids.contact.complementarity import Pressed, solve_complementarity, unbalanced
from drivewright.solids.contact.condensing import Condensed, Rows, condense, load_rows, solved
from drivewright.solids.contact.friction import Grips, solve_friction
from drivewright.solids.contact.pairing import GapOf, Pairing, paired
from drivewright.solids.contact.surfaces import Skin, skin_of
from drivewright.solids.elastic import MM, FreeBody
from drivewright.solids.engine import EngineObject

LOOSE = 1e-3  # share in the forces of supports and contacts below which a rigid motion is free
DRIVEN = 1e-3  # part of a load on such a motion that is refused
ACROSS = 2.0  # elements across a contact, at least
MEGA = 1e6


class Pair(NamedTuple):
    """Two named parts of two bodies' boundaries that may touch: (body, regular expression) each.

    The pressure lives on the elements of the first: take the finer or the more curved.  reach [m]: the largest gap that may close; `more`:
    what is added to the gap; press_fit: an overlap before any load is meant; friction: Coulomb's coefficient; label: what a message calls
    the part of the first.
    """

    first: tuple[str, str]
    second: tuple[str, str]
    reach: float
    more: GapOf | None = None
    press_fit: bool = False
    friction: float = 0.0
    label: str = ""


class CoarseContact(InputError):
    """A contact narrower than two of its elements; size and width [mm]: of the elements there, and of the contact, 0 where unknown."""

    def __init__(self, message: str, size: float, width: float) -> None:
        super().__init__(message)
        self.size, self.width = size, width


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


@dataclass(frozen=True, eq=False, repr=False)
class ContactState:
    """Answer to one load.

    For each pair pressure (h,) [Pa] at the hats of its `Pairing`; traction (h, d - 1) [Pa] by friction on the second body along their
    tangents, and how far that body slips (h, d - 1) [m] along them since the state before, both without rows where there is no friction;
    slid (r,) [mm^3]: all slips of all hats so far, times their areas.  links (l,) [N]: the forces along their functionals; motions: {body:
    amounts of its rigid motions} [mm].
    """

    model: "ContactModel"
    forces: Mapping[str, float]
    answer: Pressed
    pressure: tuple[Floats, ...]
    traction: tuple[Floats, ...]
    slip: tuple[Floats, ...]
    slid: Floats
    links: Floats
    motions: Mapping[str, Floats]

    def force(self, pair: int) -> Floats:
        """Force (d,) [N] of a pair on its first body."""
        each = self.model.pairings[pair]
        nodal = each.first.T @ self.pressure[pair]
        if self.traction[pair].size:
            nodal = nodal + each.first_along.T @ self.traction[pair].ravel()
        return -np.asarray(nodal / MEGA).reshape(each.places.shape[1], -1).sum(axis=1)

    @property
    def dissipated(self) -> float:
        """Work [J] lost by friction since the state before."""
        areas = (MM**2 * each.area for each in self.model.pairings)
        return -sum(
            float(np.einsum("h,hk,hk->", area, traction, slip))
            for area, traction, slip in zip(areas, self.traction, self.slip, strict=True)
            if traction.size
        )

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


@dataclass(frozen=True, eq=False, repr=False)
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
        """Which unknowns can only press: pressures of all pairs, and some links; in between stand the tractions, which act either way."""
        pressing, rubbing = sum(self._hats), sum(self._rubbing)
        return np.array([True] * pressing + [False] * rubbing + [link.one_sided for link in self.links])

    def solve(
        self, forces: Mapping[str, float], start: ContactState | None = None, gaps: Sequence[Floats] | None = None, narrow: bool = False
    ) -> ContactState:
        """`ContactState` under forces {load: amount [N]}; `start`: the state before; `gaps`: other gaps [mm^3] of the pairs' hats.

        With friction the answer depends on the way there: what slips is counted from the state before, or from the unloaded bodies.
        Without friction `start` only saves time.

        `CoarseContact` where a contact is too narrow for its elements, unless `narrow` says that it does not matter, as under a load that
        is small beside others.
        """
        if unknown := sorted(set(forces) - set(self.loads)):
            raise InputError(f"contact: no load is called {unknown[0]!r}; there are {', '.join(self.loads)}")
        matrix, right, held, load = self._programme(self._amounts(forces), gaps)
        slid = np.zeros(sum(self._rubbing)) if start is None else start.slid
        right[sum(self._hats) : sum(self._hats) + len(slid)] -= slid
        basis = _held_motions(held, load, self._motions)
        found = self._pressed(matrix, right, held, load, basis, start)
        moved = dict.fromkeys(self.bodies, np.zeros(0))
        moved |= _split(basis @ found.motions, {name: len(body.modes) for name, body in self._motions})
        state = self._state(forces, found, slid, moved)
        if not narrow:
            for number in range(len(self.pairs)):
                self.refuse_narrow(state, number)
        return state

    def refuse_narrow(self, state: ContactState, number: int) -> None:
        """`CoarseContact` where what presses of a pair is narrower than two of the elements there."""
        pair, each, (skin, _) = self.pairs[number], self.pairings[number], self.skins[number]
        pressing = state.pressure[number] > 0
        if not pressing.any():
            return
        size = float(np.median(skin.size[np.isin(skin.corners, each.corners[pressing]).any(axis=1)]))
        width = contact_width(each, pressing, self.bodies[pair.first[0]])
        if width < ACROSS * size:
            raise CoarseContact(
                f"contact: the elements of {size:.3g} mm on {pair.label or f'{pair.first[1]!r} of {pair.first[0]!r}'} are larger than half "
                f"the width of the contact, which is {f'about {width:.3g} mm wide' if width > 0 else 'narrower than one of them'}; give "
                f"elements of {(width or size) / 4:.2g} mm there or smaller.",
                size,
                width,
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
    def _dim(self) -> int:
        return next(iter(self.bodies.values())).mesh.dim

    @property
    def _hats(self) -> list[int]:
        """Number of pressures of each pair."""
        return [len(each.gap) for each in self.pairings]

    @property
    def _rubbing(self) -> list[int]:
        """Number of tractions of each pair, 0 without friction."""
        return [len(each.gap) * (self._dim - 1) if pair.friction else 0 for pair, each in zip(self.pairs, self.pairings, strict=True)]

    @property
    def _grips(self) -> Grips:
        ways, hats = self._dim - 1, self._hats
        rubs = np.repeat([pair.friction for pair in self.pairs], hats)
        normal = np.flatnonzero(rubs)
        return Grips(normal, sum(hats) + np.arange(len(normal) * ways).reshape(-1, ways), rubs[normal])

    def _pressed(self, matrix: Floats, right: Floats, held: Floats, load: Floats, basis: Floats, start: ContactState | None) -> Pressed:
        """Solution of the programme with the rigid motions of `basis` (m, k); InputError where nothing balances the loads."""
        first = None if start is None else start.answer
        held, load = basis.T @ held, basis.T @ load
        try:
            if any(self._rubbing):
                return solve_friction(matrix, right, held, load, self.one_sided, self._grips, first)
            return solve_complementarity(matrix, right, held, load, self.one_sided, None if first is None else first.pressing)
        except SolverError:
            motion = unbalanced(self._rays(held), load)
            if not motion.any():
                raise
            name, way = _largest_motion(self._motions, basis @ motion)
            what = "pressure and friction do not keep" if any(self._rubbing) else "pressure does not keep"
            raise InputError(
                f"contact: {what} {name!r} from {way}, where the loads drive it. Turn a load round, or give the body a support."
            ) from None

    @property
    def _motions(self) -> list[tuple[str, FreeBody]]:
        """The bodies whose rigid motions are unknown."""
        return [(name, body) for name, body in self.bodies.items() if name not in self.flying]

    def _rays(self, held: Floats) -> Floats:
        """Resultants (m, k) of what can act: pressures, with their friction, and links."""
        grips, one_sided = self._grips, self.one_sided
        apart = np.setdiff1d(np.arange(len(one_sided)), np.concatenate([grips.normal, grips.along.ravel()]))
        either_way = held[:, apart[~one_sided[apart]]]
        return np.hstack([held[:, apart[one_sided[apart]]], either_way, -either_way, grips.rays(held)])

    def _state(self, forces: Mapping[str, float], found: Pressed, slid: Floats, moved: Mapping[str, Floats]) -> ContactState:
        """The state with its unknowns told apart."""
        count, ways, ends = len(self.pairs), self._dim - 1, np.cumsum([*self._hats, *self._rubbing])
        parts, slips = np.split(found.x, ends), np.split(found.gap, ends)[count:-1]
        areas = [each.area[: len(slip) // ways, None] for each, slip in zip(self.pairings, slips, strict=True)]
        return ContactState(
            self,
            dict(forces),
            found,
            tuple(MEGA * part for part in parts[:count]),
            tuple(MEGA * part.reshape(-1, ways) for part in parts[count:-1]),
            tuple(MM * slip.reshape(-1, ways) / area for slip, area in zip(slips, areas, strict=True)),
            slid + np.concatenate(slips),
            parts[-1],
            moved,
        )

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
        """All functionals as load rows of one body, 0 where they do not concern it: pressures and tractions of the pairs, links, loads."""
        free, blocks = self.bodies[body], []
        both = list(zip(self.pairs, self.pairings, strict=True))
        pressing = [(pair, each.first, each.second) for pair, each in both]
        rubbing = [(pair, each.first_along, each.second_along) for pair, each in both if pair.friction]
        for pair, first, second in pressing + rubbing:
            rows = Rows((first.shape[0], free.space.ndof))
            if pair.first[0] == body:
                rows = rows - load_rows(free, first)
            if pair.second[0] == body:
                rows = rows + load_rows(free, second)
            blocks.append(Rows(rows))
        for terms in [link.terms for link in self.links] + [(load,) for load in self.loads.values()]:
            mine = [term.vector.FV().NumPy() for term in terms if term.body == body]
            blocks.append(Rows(sum(mine, np.zeros(free.space.ndof))[None]))
        return blocks

    def _programme(self, amounts: Floats, gaps: Sequence[Floats] | None) -> tuple[Floats, Floats, Floats, Floats]:
        """(A, b, H, h) of `solve_complementarity`."""
        count = len(self.one_sided)
        whole = np.sum([each.flexibility for each in self.condensed.values()], axis=0)
        resultants = np.concatenate([self.condensed[name].resultants for name, _ in self._motions] or [np.zeros((0, len(whole)))])
        soft = np.concatenate([np.zeros(count - len(self.links)), [link.compliance / MM for link in self.links]])
        own = [each.gap for each in self.pairings] if gaps is None else list(gaps)
        gap = np.concatenate([*own, np.zeros(sum(self._rubbing)), [link.gap / MM for link in self.links]])
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
        name, way = _largest_motion(bodies, rest)
        raise InputError(
            f"contact: nothing holds {name!r} against {way}, and a load drives it there; give it a support, a plane of symmetry, or a "
            "surface to press on."
        )
    return basis


def _split(values: Floats, sizes: Mapping[str, int]) -> dict[str, Floats]:
    return dict(zip(sizes, np.split(values, np.cumsum(list(sizes.values()))[:-1]), strict=True))


def _largest_motion(bodies: Sequence[tuple[str, FreeBody]], motion: Floats) -> tuple[str, str]:
    """The body that moves most in a motion (m,) of all of them, and the greatest part of how it moves in words."""
    amounts = _split(motion, {name: len(body.modes) for name, body in bodies})
    moves = {name: body.basis @ amounts[name] for name, body in bodies}
    name = max(moves, key=lambda each: np.abs(moves[each]).max())
    part = int(np.abs(moves[name]).argmax())
    shifts, sign = dict(bodies)[name].mesh.dim, "-" if moves[name][part] < 0 else ""
    if part < shifts:
        return name, f"moving along {sign}{'xyz'[part]}"
    return name, "turning" if shifts == 2 else f"turning about {sign}{'xyz'[part - shifts]}"
