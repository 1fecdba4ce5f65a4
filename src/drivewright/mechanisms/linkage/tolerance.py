"""Kinematic Monte Carlo of a linkage: clearances and tolerances of points, and what they make of the outputs."""

import math

import numpy as np
from scipy.special import ndtr

from drivewright.mechanisms.linkage.describe import driven_joint
from drivewright.multibody import tolerance
from drivewright.multibody.tolerance import READINGS, Source, gradient, play, posture, sample, shares
from drivewright.result import Answer, Column, Table, Value

BARS = 60  # of a histogram


def no_tolerances(spec):
    """Why there is nothing to vary."""
    if spec.tolerances is None:
        return "the spec has no [tolerances] table"
    if not spec.outputs:
        return "the spec declares no [[outputs]]"
    if not sources_of(spec):
        return "no joint states a clearance and no dimension has a tolerance"
    if spec.drive is None or spec.drive.motor:
        return "no drive says where the mechanism stands"
    return None if driven_joint(spec).kind == "revolute" else f"the drive pushes {spec.drive.joint!r}, so that it has no angle"


def sources_of(spec):
    """All that is random: the play of every pin that states a clearance, whatever its model, and the tolerances of points."""
    plays = [
        play(joint.name, joint.clearance)
        for joint in spec.joints
        if joint.kind == "revolute" and joint.model != "bushing" and joint.clearance
    ]
    return plays + [_deviation(spec, item) for item in spec.tolerances.dimensions if item.tolerance > 0]


def _deviation(spec, item):
    length = math.hypot(*item.axis)
    marks = tuple(output.name for output in spec.outputs if output.point and f"{output.body}.{output.point}" == item.at)
    return Source(
        item.at, item.tolerance, item.distribution, tuple(_ends_at(spec, item.at)), (item.axis[0] / length, item.axis[1] / length), marks
    )


def _ends_at(spec, text):
    """(joint, end) of all joints that hold on to a point."""
    for joint in spec.joints:
        ends = (joint.connects[1], joint.carrier) if joint.kind == "cam" else joint.connects
        for end, at in enumerate(ends):
            if at == text:
                yield joint.name, end


def tolerances(model, done):
    """Scatter of the outputs by Monte Carlo, every mechanism closed exactly, beside linear theory and its shares."""
    spec, asked = model.spec, model.spec.tolerances
    sources = sources_of(spec)
    held = posture(model.ideal, model.markers, sources, asked.angle)
    found = sample(held, sources, asked.samples, spec.simulate.seed if spec.simulate else 1)
    slopes = gradient(held, len(sources))
    parts = shares(sources, slopes)
    closed = np.isfinite(found.deviations).all(axis=(1, 2))
    values, tables = {"tolerances.unclosed": Value(float(np.mean(~closed)), "-", "share of the random mechanisms that do not close")}, []
    for number, output in enumerate(spec.outputs):
        for reading in ("x", "y") if output.point else ("angle",):
            k = READINGS.index(reading)
            name = f"{output.name}.{reading}" if output.point else output.name
            data, share = found.deviations[closed, number, k], (parts.worst[number, k], parts.sigma[number, k])
            values |= _values(name, _unit(output), data, share)
            tables += [_histogram(name, _unit(output), data, share), _tornado(name, _unit(output), sources, share)]
    return Answer(
        values,
        tuple(tables),
        findings=tuple(_findings(model, sources, closed)),
        outcome="partial" if found.interrupted or not closed.all() else "complete",
    )


def _unit(output):
    return "m" if output.point else "rad"


def _values(name, unit, data, share):
    """Numbers of one reading; nan, and so left out, where no mechanism closes."""
    worst, sigma = share
    told = {
        "mean": (np.mean(data) if data.size else np.nan, "mean deviation"),
        "sigma": (np.std(data, ddof=1) if data.size > 1 else np.nan, "standard deviation"),
        "worst": (np.max(np.abs(data), initial=0.0) if data.size else np.nan, "largest deviation among the samples, either way"),
        "linear_sigma": (np.sqrt(np.sum(sigma**2)), "standard deviation by linear theory"),
        "linear_worst": (np.sum(worst), "worst case by linear theory (normal dimensions at three standard deviations)"),
    }
    return {
        f"tolerances.{name}.{key}": Value(float(value), unit, f"{words} of {name!r}")
        for key, (value, words) in told.items()
        if np.isfinite(value)
    }


def _histogram(name, unit, data, share):
    """Share of the samples in even bars, and that of the normal distribution with the standard deviation of linear theory."""
    sigma = float(np.sqrt(np.sum(share[1] ** 2)))
    reach = max(float(np.max(np.abs(data), initial=0.0)), 3 * sigma) or 1.0
    edges = np.linspace(-reach, reach, BARS + 1)
    counts = np.histogram(data, edges)[0]
    normal = np.diff(ndtr(edges / sigma)) if sigma > 0 else np.zeros(BARS)
    return Table(
        f"tolerances.{name}",
        f"Deviation of {name!r}",
        (
            Column("deviation", unit, f"deviation of {name!r}, middle of the bar", 0.5 * (edges[1:] + edges[:-1])),
            Column("share", "-", "share of the samples in the bar", counts / max(len(data), 1)),
            Column("linear_share", "-", "the same of a normal distribution, by linear theory", normal),
        ),
    )


def _tornado(name, unit, sources, share):
    """What each source contributes, the largest first."""
    worst, sigma = share
    order = np.argsort(-worst, kind="stable")
    reach, variance = np.array([source.reach for source in sources]), np.sum(sigma**2)
    return Table(
        f"tornado.{name}",
        f"What makes {name!r} deviate",
        (
            Column("source", "-", "joint with play, or point with a tolerance", np.array([_label(sources[k]) for k in order])),
            Column("worst", unit, f"largest deviation of {name!r} from it alone", worst[order]),
            Column("sigma", unit, f"standard deviation of {name!r} from it alone", sigma[order]),
            Column("variance_share", "-", "its share in the variance", sigma[order] ** 2 / (variance if variance > 0 else 1.0)),
            Column(
                "sensitivity", "-" if unit == "m" else f"{unit}/m", f"deviation of {name!r} over that of the point", (worst / reach)[order]
            ),
        ),
    )


def _label(source):
    if source.law == tolerance.CIRCLE:
        return f"play {source.name}"
    return f"{source.name} [{source.direction[0]:.3g}, {source.direction[1]:.3g}]"


def _findings(model, sources, closed):
    if not closed.all():
        yield (
            f"tolerances: {np.sum(~closed)} of {len(closed)} random mechanisms do not close and are left out of the numbers; the "
            "deviations are too large for this position"
        )
    for source in sources:
        if not source.ends and not source.marks:
            yield f"tolerances: {source.name} carries no joint and no output; its tolerance moves nothing"
    if len(closed) < model.spec.tolerances.samples:
        yield f"tolerances: interrupted after {len(closed)} of {model.spec.tolerances.samples} samples"
