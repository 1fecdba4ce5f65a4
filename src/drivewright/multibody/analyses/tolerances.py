"""Kinematic Monte Carlo of a mechanism: clearances and tolerances of points, and what they make of the outputs."""

import math
from collections.abc import Sequence

import numpy as np

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
    values, tables = {"tolerances.unclosed": unclosed.named("-", "share of the random mechanisms that do not close")}, []
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
    estimates = {
        "mean": mean_of(mean, spread, data.size).named(unit, f"mean deviation of {name!r}"),
        "sigma": sigma_of(spread, data.size).named(unit, f"standard deviation of {name!r}"),
    }
    numbers = {
        "worst": (np.max(np.abs(data), initial=0.0) if data.size else np.nan, "largest deviation among the samples, either way"),
        "linear_sigma": (np.sqrt(np.sum(sigma**2)), "standard deviation by linear theory"),
        "linear_worst": (np.sum(worst), "worst case by linear theory (normal dimensions at three standard deviations)"),
        "corner": (corner, "worst combination by linear theory, closed exactly: largest deviation"),
    }
    return {f"tolerances.{name}.{key}": value for key, value in estimates.items() if np.isfinite(value.value)} | {
        f"tolerances.{name}.{key}": Value(float(value), unit, f"{words} of {name!r}")
        for key, (value, words) in numbers.items()
        if np.isfinite(value)
    }


def _histogram(name, unit, data, share):
    """Share of the samples in even bars, and that of the normal distribution with the standard deviation of linear theory."""
    sigma = float(np.sqrt(np.sum(share[1] ** 2)))
    reach = max(float(np.max(np.abs(data), initial=0.0)), 3 * sigma) or 1.0
    edges = np.linspace(-reach, reach, BARS + 1)
    counts = np.histogram(data, edges)[0]
    normal = np.diff([0.5 * math.erfc(-edge / (math.sqrt(2) * sigma)) for edge in edges]) if sigma > 0 else np.zeros(BARS)
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
    if source.law == CIRCLE:
        return f"play {source.name}"
    return f"{source.name} [{source.direction[0]:.3g}, {source.direction[1]:.3g}]"


def _bent(names):
    if names:
        yield (
            f"tolerances: the worst combination by linear theory, closed exactly, is more than {STRAIGHT:.0%} off what linear theory says "
            f"of it: {', '.join(names)}"
        )


def _findings(sources, closed, samples):
    if not closed.all():
        yield (
            f"tolerances: {np.sum(~closed)} of {len(closed)} random mechanisms do not close and are left out of the numbers; the "
            "deviations are too large for this position"
        )
    for source in sources:
        if not source.ends and not source.marks:
            yield f"tolerances: {source.name} carries no joint and no output; its tolerance moves nothing"
    if len(closed) < samples:
        yield f"tolerances: interrupted after {len(closed)} of {samples} samples"
