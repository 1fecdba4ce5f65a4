"""Kinematic Monte Carlo of a mechanism: clearances and tolerances of points, and the resulting scatter of the outputs."""

import math
from collections.abc import Sequence

import numpy as np

from drivewright.labels import in_words
from drivewright.multibody.analyses.simulation_model import SimulationModel
from drivewright.multibody.tolerance import CIRCLE, READINGS, Source, deviations, gradient, posture, sample, shares, worst_moves
from drivewright.numerics.samples import mean_of, share_of, sigma_of
from drivewright.result import Answer, Column, Table, Value

BARS = 60  # of a histogram
STRAIGHT = 0.05  # part by which linear theory may be off at its worst combination without a word


def tolerances(model: SimulationModel, sources: Sequence[Source], angle: float, samples: int) -> Answer:
    """Scatter of the outputs by Monte Carlo, every mechanism closed exactly, beside linear theory and its shares.

    The driven body stands at `angle` [rad].
    """
    nominal = posture(model.ideal, model.markers, sources, angle)
    mechanisms = sample(nominal, sources, samples, model.seed)
    slopes = gradient(nominal, len(sources))
    parts = shares(sources, slopes)
    closed = np.isfinite(mechanisms.deviations).all(axis=(1, 2))
    unclosed = share_of(int(np.sum(~closed)), np.size(closed))
    values, tables = {"tolerances.unclosed": unclosed.named("-", "share of samples that do not close")}, []
    bent = []
    for number, output in enumerate(model.outputs):
        for reading in ("x", "y") if output.point else ("angle",):
            k = READINGS.index(reading)
            name = f"{output.name}.{reading}" if output.point else output.name
            data, share = mechanisms.deviations[closed, number, k], (parts.worst[number, k], parts.sigma[number, k])
            corner = _at_corner(nominal, worst_moves(sources, slopes[number, k]), number, k)
            values |= _values(name, _unit(output), data, share, corner)
            bent += [name] if abs(corner - np.sum(share[0])) > STRAIGHT * np.sum(share[0]) else []
            tables += [_histogram(name, _unit(output), data, share), _tornado(name, _unit(output), sources, share)]
    return Answer(
        values,
        tuple(tables),
        findings=(*_findings(sources, closed, samples), *_bent(bent)),
        outcome="partial" if mechanisms.interrupted or not closed.all() else "complete",
    )


def _unit(output):
    return "m" if output.point else "rad"


def _at_corner(nominal, moves, number, reading):
    """Largest deviation of a reading, either way, with all displacements at the ends that linear theory calls worst; nan where the
    mechanism does not close there."""
    return float(np.max(np.abs(deviations(nominal, moves)[:, number, reading])))


def _values(name, unit, data, share, corner):
    """Numbers of one reading; nan, and so left out, where no mechanism closes."""
    worst, sigma = share
    mean, spread = (float(np.mean(data)) if data.size else np.nan, float(np.std(data, ddof=1)) if data.size > 1 else np.nan)
    output = in_words(name)
    estimates = {
        "mean": mean_of(mean, spread, data.size).named(unit, f"mean deviation of {output}"),
        "sigma": sigma_of(spread, data.size).named(unit, f"standard deviation of {output}"),
    }
    numbers = {
        "worst": (
            np.max(np.abs(data), initial=0.0) if data.size else np.nan,
            "maximum magnitude of the deviation among the samples",
            "maximum deviation",
        ),
        "linear_sigma": (np.sqrt(np.sum(sigma**2)), "standard deviation by linear theory", "linear std. deviation"),
        "linear_worst": (
            np.sum(worst),
            "worst-case deviation by linear theory (normal dimensions at three standard deviations)",
            "linear worst case",
        ),
        "corner": (corner, "deviation at the worst-case combination of linear theory, with loops closed exactly", "exact worst case"),
    }
    return {f"tolerances.{name}.{key}": value for key, value in estimates.items() if np.isfinite(value.value)} | {
        f"tolerances.{name}.{key}": Value(float(value), unit, f"{words}, {output}", label=f"{label}, {output}")
        for key, (value, words, label) in numbers.items()
        if np.isfinite(value)
    }


def _histogram(name, unit, data, share):
    """Share of the samples in even bars, and that of the normal distribution with the standard deviation of linear theory."""
    sigma = float(np.sqrt(np.sum(share[1] ** 2)))
    reach = max(float(np.max(np.abs(data), initial=0.0)), 3 * sigma) or 1.0
    edges = np.linspace(-reach, reach, BARS + 1)
    middles = 0.5 * (edges[1:] + edges[:-1])
    counts = np.histogram(data, edges)[0]
    normal = np.diff([0.5 * math.erfc(-edge / (math.sqrt(2) * sigma)) for edge in edges]) if sigma > 0 else np.zeros(BARS)
    return Table(
        f"tolerances.{name}",
        f"Deviation of {in_words(name)}",
        (
            Column("deviation", unit, f"deviation of {in_words(name)} at the bar centre", middles, "deviation at bar centre"),
            Column("share", "-", "share of samples in the bar", counts / max(len(data), 1)),
            Column("linear_share", "-", "share of a normal distribution by linear theory", normal, "share by linear theory"),
        ),
    )


def _tornado(name, unit, sources, share):
    """What each source contributes, the largest first."""
    worst, sigma = share
    order = np.argsort(-worst, kind="stable")
    reach, variance = np.array([source.reach for source in sources]), np.sum(sigma**2)
    labels, output = np.array([_label(sources[k]) for k in order]), in_words(name)
    return Table(
        f"tornado.{name}",
        f"Deviation contributions, {output}",
        (
            Column("source", "-", "joint with clearance, or point with a tolerance", labels, "source of deviation"),
            Column("worst", unit, f"maximum deviation of {output} from this source alone", worst[order], "maximum deviation"),
            Column("sigma", unit, f"standard deviation of {output} from this source alone", sigma[order], "standard deviation"),
            Column(
                "variance_share",
                "-",
                f"share of this source in the variance of {output}",
                sigma[order] ** 2 / (variance if variance > 0 else 1.0),
                "share of variance",
            ),
            Column(
                "sensitivity",
                "-" if unit == "m" else f"{unit}/m",
                f"deviation of {output} relative to the displacement of the source",
                (worst / reach)[order],
                "sensitivity",
            ),
        ),
    )


def _label(source):
    if source.law == CIRCLE:
        return f"clearance {source.name}"
    return f"{source.name} [{source.direction[0]:.3g}, {source.direction[1]:.3g}]"


def _bent(names):
    if names:
        yield (
            f"tolerances: at the worst-case combination, linear theory deviates by more than {STRAIGHT:.0%} from the exactly closed "
            f"mechanism for {', '.join(names)}; use the Monte Carlo values there"
        )


def _findings(sources, closed, samples):
    if not closed.all():
        yield (
            f"tolerances: {np.sum(~closed)} of {len(closed)} sampled mechanisms do not close and are left out of the statistics; the "
            "deviations are too large for this position: choose another angle or smaller tolerances"
        )
    for source in sources:
        if not source.ends and not source.marks:
            yield f"tolerances: {source.name} carries neither a joint nor an output, so its tolerance has no effect"
    if len(closed) < samples:
        yield f"tolerances: interrupted after {len(closed)} of {samples} samples"
