"""The strength of a shaft's sections as tables and values of a result, and their Haigh diagram."""

import math
from collections.abc import Sequence

import numpy as np

from drivewright._typing import Floats
from drivewright.materials import Strength
from drivewright.result import Column, Plot, Table, Value
from drivewright.shafts.fatigue_strength import SectionStrength

ON_A_LINE = 41  # points
HAIGH = Plot(
    "haigh",
    "Haigh diagram of the sections",
    "haigh",
    "mean",
    ("amplitude",),
    style="points",
    by="section",
    meaning="von Mises amplitude over mean stress at the notches; below the Goodman line of the weakest section life is endless, left "
    "of the yield line nothing yields in the first revolution",
)


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
    ("sigma_a", "Pa", "nominal amplitude by bending"),
    ("sigma_m", "Pa", "nominal mean stress by an axial force"),
    ("tau_a", "Pa", "nominal amplitude by torsion"),
    ("tau_m", "Pa", "nominal mean stress by torsion"),
    ("kf_tension", "-", "fatigue notch factor in tension"),
    ("kf_bending", "-", "fatigue notch factor in bending"),
    ("kf_torsion", "-", "fatigue notch factor in torsion"),
    ("amplitude", "Pa", "von Mises amplitude at the notch"),
    ("mean", "Pa", "von Mises mean stress at the notch"),
    ("endurance_limit", "Pa", "endurance limit of the smooth section"),
    ("fatigue_safety", "-", "safety against fatigue (Goodman)"),
    ("static_safety", "-", "safety against yield at the shock load"),
)


def strength_values(rows: Sequence[SectionStrength]) -> dict[str, Value]:
    """The least safeties of the shaft, where [m] the least one is, and both safeties of every notch; empty where nothing is stressed."""
    stressed = [row for row in rows if math.isfinite(row.safety)]
    if not stressed:
        return {}
    weakest = min(stressed, key=lambda row: row.safety)
    values = {
        "strength.min_safety": Value(weakest.safety, "-", f"least safety of the shaft, at {weakest.name}"),
        "strength.min_safety.at": Value(weakest.position, "m", f"place of the least safety, {weakest.name}"),
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
    """Points (mean, amplitude) of the sections, and of the lower one of the Goodman line of the least endurance limit and the yield line,
    for `HAIGH`; smooth places share a name."""
    limit = min(row.endurance_limit for row in rows)
    goodman, langer = _border(limit, strength)
    names = ["smooth places" if row.kind == "smooth" else row.name for row in rows]
    names += ["Goodman line"] * len(goodman) + ["yield line"] * len(langer)
    mean = np.concatenate([_numbers(rows, "mean"), goodman, langer])
    amplitude = np.concatenate([_numbers(rows, "amplitude"), limit * (1 - goodman / strength.tensile), strength.yield_strength - langer])
    columns = (
        _texts("section", "section or line", names),
        Column("mean", "Pa", "mean stress, von Mises", mean),
        Column("amplitude", "Pa", "stress amplitude, von Mises", amplitude),
    )
    return Table("haigh", "Haigh diagram of the sections", columns)


def _border(limit: float, strength: Strength) -> tuple[Floats, Floats]:
    """Mean stresses [Pa] along the Goodman line up to where it meets the yield line, and along the yield line from there."""
    crossing = (strength.yield_strength - limit) / (1 - limit / strength.tensile)
    crossing = min(max(crossing, 0.0), strength.yield_strength)
    return np.linspace(0.0, crossing, ON_A_LINE), np.linspace(crossing, strength.yield_strength, ON_A_LINE)


def _numbers(rows: Sequence[SectionStrength], name: str) -> Floats:
    """A quantity of the rows; nan where a safety is endless."""
    data = np.array([getattr(row, name) for row in rows], float)
    return np.where(np.isfinite(data), data, np.nan)


def _texts(name: str, meaning: str, data: Sequence[str]) -> Column:
    return Column(name, "-", meaning, np.array(data))
