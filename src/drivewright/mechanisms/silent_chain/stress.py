"""Stress and life of a plate that goes round: loads from the dynamics, elements by superposition, critical planes."""

from functools import cached_property
from types import SimpleNamespace

import numpy as np

from drivewright import fatigue
from drivewright.chains.explicit.simulate import tooth_time
from drivewright.chains.stress.life import life_table, plate_life
from drivewright.chains.stress.plate import Loads, plate_basis, plate_body, stress_history, stress_picture, worst
from drivewright.mechanisms.silent_chain.dynamics import no_dynamics
from drivewright.result import Answer, Check, Column, Table, Value
from drivewright.solids.plane import plane_von_mises

LEAST = 0.3  # of the greatest stress: points below it are not looked at for life
MOST_INSTANTS = 500  # of a revolution, for life
DOT = 0.015  # of the pitch: a point of the life map
SEAT = 0.17  # sine of how far a seat reaches around its pin beyond a right angle


def no_stress(spec):
    """Why there is none."""
    if spec.roller:
        return "it is for plates of silent chains"
    if spec.sprockets:
        return "it is for two sprockets"
    return no_dynamics(spec)


def stress(model, done):
    """Stress of a plate over a revolution of the chain."""
    reason = model.undrawn
    if reason:
        return Answer(findings=(f"stress is left out: no plate can be drawn: {reason}",), outcome="left out")
    found = Revolution(model, done["dynamics"].data)
    peak = worst(found.basis, found.loads)
    history = plane_von_mises(stress_history(found.basis, found.loads, [peak.row])[:, 0])
    x, y = peak.place
    values = {
        "plate.max_von_mises": Value(peak.stress, "Pa", "greatest von Mises stress of a plate as it goes round, beside its loaded flanks"),
        "plate.max_von_mises.x": Value(x, "m", "where it is, along the plate from its middle"),
        "plate.max_von_mises.y": Value(y, "m", "where it is, above the line of the pins"),
    }
    safety = Check(
        "plate.yield",
        model.spec.material.yield_strength / peak.stress,
        model.spec.limits.yield_safety,
        ">=",
        "-",
        "yield strength over the greatest von Mises stress of a plate",
        ("chain",),
    )
    table = Table(
        "plate_history",
        "Stress of a plate at its worst place over a revolution",
        (
            Column("time", "s", "time", found.time),
            Column("mises", "Pa", "von Mises stress at the worst place", history),
            Column("left_pin", "N", "force of the left pin on one plate", np.hypot(*found.loads.pins[:, 0].T)),
            Column("right_pin", "N", "force of the right pin on one plate", np.hypot(*found.loads.pins[:, 1].T)),
            Column("left_flank", "N", "force on the left flank of one plate", found.loads.flanks[:, 0]),
            Column("right_flank", "N", "force on the right flank of one plate", found.loads.flanks[:, 1]),
        ),
    )
    picture = stress_picture(found.basis, found.loads, peak.instant)
    return Answer(values, (table, picture), (safety,), data=found)


def life(model, done):
    """Life of a plate and of a pin in revolutions of the chain."""
    found, card = done["stress"].data, card_of(model)
    if found is None:
        return Answer(findings=("life is left out: there is no stress",), outcome="left out")
    if not found.whole:
        return Answer(
            findings=("life is left out: the run is shorter than a revolution of the chain; give dynamics.duration more, or none",),
            outcome="left out",
        )
    thin = found.thinned
    lives = plate_life(found.basis, thin, card, model.spec.fatigue.plane, LEAST)
    shortest, revolution = float(np.min(lives.life)), found.time[-1] - found.time[0]
    values = {
        "plate.life": Value(shortest, "-", f"revolutions of the chain, {fatigue.life_text(shortest, card)}"),
        "plate.life.time": Value(shortest * revolution, "s", "the same as time at this speed"),
    }
    findings = [
        f"plate: life of {fatigue.life_text(shortest, card)} revolutions of the chain of {revolution:.4g} s; one revolution takes up "
        f"{float(np.max(lives.damage)):.3g} of it",
        *(
            ["the fatigue data are estimated from the tensile strength by the uniform material law; bring data from tests"]
            if card.estimated
            else []
        ),
        "the pins roll under their contact pressure: its fatigue is not Brown and Miller's; see pin.shakedown",
    ]
    return Answer(values, (life_table(found.basis, lives), _life_map(found.basis, lives, model.link.pitch)), (), tuple(findings))


def _life_map(basis, lives, pitch):
    """Small squares around the rim, two triangles each, in the colour of their life; lives without damage are left out."""
    kept = np.isfinite(lives.life)
    centre, half = basis.body.rim.points[lives.rows[kept]], 0.5 * DOT * pitch
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, -1), (1, 1), (-1, 1)]) * half
    x, y = (centre[:, None, :] + corners).reshape(-1, 2).T
    return Table(
        "life_map",
        "Life around a plate",
        (
            Column("x", "m", "along the plate", x),
            Column("y", "m", "across the plate", y),
            Column("depth", "m", "flat", 0 * x),
            Column("life", "-", "power of ten of the revolutions", np.repeat(np.log10(lives.life[kept]), 6)),
        ),
    )


def card_of(model):
    """The strain-life card: as given, else estimated from the tensile strength."""
    material = model.spec.material
    return model.spec.fatigue.card or fatigue.uniform_material_law(
        material.tensile_strength, material.youngs_modulus, material.poisson_ratio, yield_strength=material.yield_strength
    )


def away(pins):
    """Where a pin of pins (n, 2, 2) would pull its plate inwards, off its seat: the joint is open there (n, 2)."""
    outward = pins[:, :, 0] * np.array([-1.0, 1.0])
    return outward < -SEAT * np.hypot(*np.moveaxis(pins, 2, 0))


class Revolution(SimpleNamespace):
    """A plate over one revolution of the chain: its unit answers and its loads, those of the plate that stands alone in its link."""

    def __init__(self, model, motion):
        super().__init__(model=model, motion=motion)

    @cached_property
    def basis(self):
        material = self.model.spec.material
        return plate_basis(
            self.model.plate,
            plate_body(self.model.plate, material.youngs_modulus, material.poisson_ratio, fineness=self.model.spec.fatigue.fineness),
        )

    @property
    def rows(self):
        """The samples of one revolution of the chain, the last ones of the run."""
        count = self.model.spec.links * self.motion.per_tooth
        last = self.motion.steady.stop
        return slice(max(self.motion.steady.start, last - count - 1), last)

    @property
    def whole(self):
        """Whether it is a whole revolution of the chain, of a run that did not fail."""
        turn = self.model.spec.links * tooth_time(self.motion.model)
        return not self.motion.advice and self.time[-1] - self.time[0] > 0.999 * turn

    @property
    def time(self):
        return self.motion.t[self.rows]

    @cached_property
    def loads(self):
        """`Loads` (n,) of a plate of the link with fewer plates, which carries the most."""
        share = 1 / min(self.model.spec.plate.lacing)
        column = {
            name: self.motion.column(name)[self.rows] * share
            for name in ("left x", "left y", "right x", "right y", "left flank", "right flank")
        }
        pins = np.stack([[column["left x"], column["left y"]], [column["right x"], column["right y"]]]).transpose(2, 0, 1)
        pins = np.where(away(pins)[..., None], 0.0, pins)
        flanks = np.stack([column["left flank"], column["right flank"]], axis=1)
        near = self.motion.column("x")[self.rows] < 0.5 * self.model.closure.mean
        at = [self.model.plate.contact(side.tooth, "right")[1] for side in self.model.sides]
        return Loads(pins, flanks, np.where(near, *at)[:, None] * np.ones(2))

    @property
    def thinned(self):
        """The same with fewer instants: the greatest flank forces and pin forces are kept."""
        count = len(self.loads.flanks)
        if count <= MOST_INSTANTS:
            return self.loads
        size = np.abs(self.loads.pins).sum(axis=(1, 2)) + self.loads.flanks.sum(axis=1)
        parts = np.array_split(np.arange(count), MOST_INSTANTS // 2)
        kept = np.unique([part[pick] for part in parts for pick in (np.argmax(size[part]), np.argmin(size[part]))])
        return Loads(*(part[kept] for part in self.loads))
