"""Spec -> model: the mechanism as stated and its ideal twin, assembled; the runs of both."""

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from drivewright.errors import DoesNotAssemble
from drivewright.mechanisms.linkage.describe import describe, output_marker
from drivewright.multibody.assembly import Assembly, assemble
from drivewright.multibody.model import Marker
from drivewright.multibody.record import record
from drivewright.multibody.simulate import Settings, simulate
from drivewright.stopped import collected, uses

TURN = 2 * np.pi
IDEAL_SAMPLES = 7201  # of the ideal mechanism in a turn


@dataclass(frozen=True, eq=False)
class LinkageModel:
    """The spec, its mechanism and the same one without play, both assembled."""

    spec: Any
    assembly: Assembly
    ideal: Assembly

    @property
    def findings(self):
        return self.assembly.findings

    @property
    def played(self):
        """Whether a joint has play or gives way."""
        return _played(self.assembly.model)

    @property
    def period(self):
        return self.spec.period

    @property
    def duration(self):
        """Length of the run [s]; a turn where the spec tells none."""
        return self.spec.duration or self.period

    @property
    def markers(self):
        """Marker of every output; of every body where there is none."""
        if not self.spec.outputs:
            return {name: Marker(name) for name in self.spec.bodies}
        return {output.name: output_marker(self.spec, output) for output in self.spec.outputs}

    @property
    def pins(self):
        """Names of the pins whose contact the kernel simulates, in its order."""
        return [joint.name for joint in self.assembly.model.joints if joint.dry_contact]

    @property
    def links(self):
        """Joints modelled by a massless link."""
        return [joint for joint in self.assembly.model.joints if joint.massless_link]

    @property
    def settings(self):
        """Of the integrator."""
        asked = self.spec.simulate
        if asked is None:
            return Settings(per_step=2)
        return Settings(
            asked.relative_tolerance, asked.absolute_tolerance, None, asked.min_step, asked.max_steps, asked.method, 2, asked.singular
        )

    @property
    def ensemble(self) -> int:
        """Number of runs behind the statistics of a motion that does not repeat itself."""
        return self.spec.simulate.ensemble if self.spec.simulate else 1

    def crank_angle(self, t):
        """Angle of the drive at constant speed, counted from the start of the joint's zero [rad]."""
        driven = self.assembly.system.driven[0]
        return driven.sign * driven.start + self.spec.drive.speed * np.asarray(t)


def _played(model):
    return any(joint.play for joint in model.joints)


def build(spec):
    """The `LinkageModel` of a LinkageSpec."""
    try:
        ideal = assemble(describe(spec, ideal=True))
        whole = describe(spec)
        return LinkageModel(spec, assemble(whole) if _played(whole) else ideal, ideal)
    except DoesNotAssemble as error:
        raise DoesNotAssemble(f"linkage: {error}") from None


def run_of(model):
    """The run that the spec asks for, at every step."""
    return _seen(_run(model))


def record_of(model):
    """Its record."""
    return _seen(_record(model))


def _seen(found):
    """A run or record, which whoever takes it inherits the stop of: what is kept from before has been noted for another analysis."""
    uses(found.stop)
    return found


@lru_cache(maxsize=4)
def _run(model):
    return simulate(model.assembly, model.duration, model.settings)


@lru_cache(maxsize=4)
def _record(model):
    return record(_run(model), model.markers)


def ideal_record(model):
    """The record of the ideal mechanism: over a turn of a drive at constant speed, else over the whole run.

    Its stop is told only where the run itself may have come further.
    """
    with collected():
        found = _ideal_record(model)
    if model.played and found.stop:
        uses(found.stop._replace(where=f"without play, {found.stop.where}"))
    return found


def take_ideal_record(model):
    """The same, computed anew and not kept."""
    length = model.period or model.duration
    samples = np.linspace(0.0, length, IDEAL_SAMPLES)
    return record(simulate(model.ideal, length, model.settings, samples=samples), model.markers)


_ideal_record = lru_cache(maxsize=4)(take_ideal_record)


def ideal_at(model, times):
    """The record of the ideal mechanism at given times of the run, in turns of the drive where it turns at constant speed."""
    times = np.asarray(times)
    folded = np.mod(times, model.period) if model.period and model.ideal.freedom == 0 else times
    order = np.argsort(folded, kind="stable")
    seen = record(simulate(model.ideal, float(folded.max()), model.settings, samples=folded[order]), model.markers)
    back = np.empty_like(order)
    back[order] = np.arange(len(order))
    return {name: values[back] for name, values in seen.points.items()}
