"""The strength of a shaft's sections as tables and values of a result, and their Haigh diagram."""

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from drivewright._typing import Floats
from drivewright.materials import Strength
from drivewright.result import Column, Plot, Table, Value
from drivewright.shafts.fatigue_strength import SectionStrength

ON_A_LINE = 41  # points


def strength_table(rows: Sequence[SectionStrength]) -> Table:
    """A row for every section, the least safe first."""
    ordered = sorted(rows, key=lambda row: row.safety)
    columns = [_texts("section", "section", [row.name for row in ordered]), _texts("kind", "kind of notch", [row.kind for row in ordered])]
    columns += [Column(name, unit, meaning, _numbers(ordered, name)) for name, unit, meaning in _QUANTITIES]
    columns.append(_texts("source", "source of the notch factors", [row.source for row in ordered]))
    return Table("strength", "Strength of the sections", tuple(columns), missing="there is no stress in the section")


_QUANTITIES = (
    ("position", "m", "distance from the left end"),
    ("diameter", "m", "diameter of the net section"),
    ("sigma_a", "Pa", "nominal bending stress amplitude"),
    ("sigma_m", "Pa", "nominal mean axial stress"),
    ("tau_a", "Pa", "nominal torsional stress amplitude"),
    ("tau_m", "Pa", "nominal mean torsional stress"),
    ("kf_tension", "-", "fatigue notch factor in tension"),
    ("kf_bending", "-", "fatigue notch factor in bending"),
    ("kf_torsion", "-", "fatigue notch factor in torsion"),
    ("amplitude", "Pa", "von Mises stress amplitude at the notch"),
    ("mean", "Pa", "von Mises mean stress at the notch"),
    ("endurance_limit", "Pa", "endurance limit of the smooth section"),
    ("fatigue_safety", "-", "fatigue safety, by the modified Goodman line"),
    ("static_safety", "-", "yield safety, at the shock load"),
)


def strength_values(rows: Sequence[SectionStrength]) -> dict[str, Value]:
    """The least safeties of the shaft, where [m] the least one is, and both safeties of every notch; empty where nothing is stressed."""
    stressed = [row for row in rows if math.isfinite(row.safety)]
    if not stressed:
        return {}
    weakest = min(stressed, key=lambda row: row.safety)
    values = {
        "strength.min_safety": Value(weakest.safety, "-", f"minimum safety of the shaft, at {weakest.name}"),
        "strength.min_safety.at": Value(weakest.position, "m", f"position of the minimum safety, at {weakest.name}"),
        **_safeties("strength", "of the shaft", *(min(getattr(row, name) for row in stressed) for name in _SAFETIES)),
    }
    for row in stressed:
        if row.kind != "smooth":
            values |= _safeties(f"strength.{row.name}", f"at {row.name}", row.fatigue_safety, row.static_safety)
    return values


_SAFETIES = ("fatigue_safety", "static_safety")


def _safeties(name: str, where: str, fatigue: float, static: float) -> dict[str, Value]:
    return {
        f"{name}.fatigue_safety": Value(fatigue, "-", f"fatigue safety {where}, by the modified Goodman line"),
        f"{name}.static_safety": Value(static, "-", f"yield safety {where}, at the shock load with the notch factors"),
    }


def haigh_table(rows: Sequence[SectionStrength], strength: Strength) -> Table:
    """`haigh`: stress amplitude over mean stress, a column each for the weakest section, other notches and smooth places, their points
    apart, and for the lower one of the Goodman line of the lowest endurance limit and the yield line."""
    limit = min(row.endurance_limit for row in rows)
    goodman, langer = _border(limit, strength)
    weakest, *others = sorted(rows, key=lambda row: row.safety)
    groups = [
        ("weakest", f"weakest section, {weakest.name}", *_points([weakest])),
        ("notches", "other notches", *_points([row for row in others if row.kind != "smooth"])),
        ("smooth", "smooth sections", *_points([row for row in others if row.kind == "smooth"])),
        ("goodman", "Goodman line", goodman, limit * (1 - goodman / strength.tensile)),
        ("yield", "yield line", langer, strength.yield_strength - langer),
    ]
    columns, start = [Column("mean", "Pa", "mean stress, von Mises", np.concatenate([mean for _, _, mean, _ in groups]))], 0
    for name, words, mean, amplitude in groups:
        data = np.full(len(columns[0].data), np.nan)
        data[start : start + len(mean)] = amplitude
        start += len(mean)
        columns.append(Column(name, "Pa", f"stress amplitude, {words}", data, words[0].upper() + words[1:]))
    return Table("haigh", "Haigh diagram of the sections", tuple(columns), "each group has rows of its own")


def _points(rows: Sequence[SectionStrength]) -> tuple[Floats, Floats]:
    """(mean, amplitude) of the sections, each followed by a row without amplitude: points that no line joins."""
    mean = np.repeat(_numbers(rows, "mean"), 2)
    amplitude = np.full(len(mean), np.nan)
    amplitude[::2] = _numbers(rows, "amplitude")
    return mean, amplitude


def haigh_plots(tables: Mapping[str, Table]) -> Iterator[Plot]:
    """The Haigh diagram among the tables of a result."""
    if "haigh" in tables:
        names = tuple(column.name for column in tables["haigh"].columns[1:] if np.isfinite(column.data).any())
        meaning = (
            "von Mises stress amplitude over mean stress at the notches: below the Goodman line of the lowest endurance limit the life is "
            "infinite, below the yield line nothing yields in the first revolution"
        )
        yield Plot("haigh", "Haigh diagram of the sections", "haigh", "mean", names, meaning=meaning)


def _border(limit: float, strength: Strength) -> tuple[Floats, Floats]:
    """Mean stresses [Pa] along the Goodman line up to where it meets the yield line, and along the yield line from there; none of that
    where the Goodman line is the lower one everywhere."""
    crossing = (strength.yield_strength - limit) / (1 - limit / strength.tensile)
    crossing = min(max(crossing, 0.0), strength.yield_strength)
    below = np.linspace(crossing, strength.yield_strength, ON_A_LINE) if crossing < strength.yield_strength else np.empty(0)
    return np.linspace(0.0, crossing, ON_A_LINE), below


def _numbers(rows: Sequence[SectionStrength], name: str) -> Floats:
    """A quantity of the rows; nan where a safety is endless."""
    data = np.array([getattr(row, name) for row in rows], float)
    return np.where(np.isfinite(data), data, np.nan)


def _texts(name: str, meaning: str, data: Sequence[str]) -> Column:
    return Column(name, "-", meaning, np.array(data))
