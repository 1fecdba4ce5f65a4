"""The inner-translation indexing cam as an assembly of solids in contact: rows and figures of section 3.3 and of its influences."""

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from drivewright import registry
from drivewright._typing import Floats
from drivewright.indexing.drivetrain import PowerLawBearing
from drivewright.reproduction.figures import Chart, Curve, Stated, chart_figure
from drivewright.result import Table
from drivewright.runner import build
from drivewright.spec import load
from drivewright.validation import indexer_paper as numbers
from drivewright.validation.source import OPEN, Row, about, rounded

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawn

PER_ARCMIN = np.pi / 10800  # N m/arcmin in N m/rad
TO_ARCMIN_PER_KNM = 1e3 * 10800 / np.pi
ANGLE, STIFFNESS = "Angle of the input [deg]", "Torsional stiffness [N m/arcmin]"
CRANK, SUPPORT = 4.8e8, 1.7e8  # N/m, those of `numbers.CONSTANT`
SOLIDS = (
    "; cams, split shafts and wheel as solids of second-order elements, wheel and seats of usual proportions; nine positions over the "
    "index period"
)
BODIES = {"cam": "cams", "wheel": "pins, wheel and contacts", "shaft": "shafts", "crank": "crank bearings", "support": "support bearings"}


@cache
def assembly_tables(constant: bool) -> dict[str, Table]:
    """Tables of the analysis `assembly` of the preset with pins that stick, by name; `constant`: bearings of constant stiffness."""
    mechanism = registry.mechanism("indexer")
    model: Any = build(load(mechanism.presets()["default"], ('contact.model="bonded"',)))
    if constant:
        model = replace(model, train=model.train._replace(crank=PowerLawBearing(CRANK), support=PowerLawBearing(SUPPORT)))
    analysis = next(each for each in mechanism.analyses if each.name == "assembly")
    return {table.name: table for table in analysis.answer(model, {}).tables}


def assembly_rows(folder: Path) -> Iterator[Row]:
    """The stated stiffness beside that of the assembly, pins that stick ("No Separation") as in the paper's own finite elements."""
    table, constant = assembly_tables(False)["assembly"], assembly_tables(True)["assembly"]
    mean, fixed = float(np.nanmean(table["bonded"].data)), constant["bonded"].data
    softer = mean / float(np.nanmean(table["lumped_bonded"].data))
    common: dict[str, Any] = {"pinned": OPEN, "unit": "N m/rad", "inputs": numbers.DATA}
    note = (
        f"{numbers.NOT_FOLLOWING}elastic bodies only lower the stiffness, here to {softer:.2f} of that of the lumped model, which is a "
        "fifth of the print already."
    )
    yield Row(
        "mean torsional stiffness, assembly of solids",
        rounded("747.39 N m/arcmin", "N m/rad"),
        mean,
        kind="experiment",
        where="section 2.3",
        assumed=numbers.ASSUMED + SOLIDS,
        note=note,
        reading_of="mean torsional stiffness",
        **common,
    )
    shape = (
        f"{numbers.NOT_FOLLOWING}solids in contact keep the lumped curve's shape, {np.nanmax(fixed) / np.nanmin(fixed):.1f} times stiffer "
        "in the dwell than near 90 deg: contacts that change in number cannot make up for elastic bearings."
    )
    for name, printed, ours in (
        ("mean stiffness", about("about 1020 N m/arcmin", 1020 / PER_ARCMIN, 45 / PER_ARCMIN), float(np.nanmean(fixed))),
        ("range", about("about 90 N m/arcmin", 90 / PER_ARCMIN, 10 / PER_ARCMIN), float(np.nanmax(fixed) - np.nanmin(fixed))),
    ):
        yield Row(
            f"{name}, bearings of constant stiffness, assembly of solids",
            printed,
            ours,
            kind="other code",
            where="section 4, Fig. 17",
            assumed=f"{numbers.ASSUMED}; bearings of 480 and 170 N/um{SOLIDS}",
            note=shape,
            reading_of=f"{name}, bearings of constant stiffness",
            **common,
        )


def _degrees(table: Table) -> Floats:
    return np.degrees(table["angle"].data)


def _curve(label: str, table: Table, name: str) -> Curve:
    return Curve(label, _degrees(table), table[name].data * PER_ARCMIN)


def assembly_stiffness() -> "Drawn":
    """Stiffness of the assembly beside the lumped model, bearings by load and constant."""
    by_load, constant = assembly_tables(False)["assembly"], assembly_tables(True)["assembly"]
    curves = [
        _curve("lumped model, no separation", by_load, "lumped_bonded"),
        _curve("assembly of solids, no separation", by_load, "bonded"),
        _curve("assembly of solids, pins press only", by_load, "unilateral"),
    ]
    fixed = [
        _curve("lumped model, no separation", constant, "lumped_bonded"),
        _curve("assembly of solids, no separation", constant, "bonded"),
    ]
    charts = [
        Chart(STIFFNESS, curves, [Stated("mean of the test, 747.39", y=747.39)], "Bearings by their load"),
        Chart(STIFFNESS, fixed, [Stated("as printed, about 1020", y=1020.0)], "Bearings of constant stiffness"),
    ]
    return chart_figure("Stiffness of the assembly of solids", ANGLE, charts, height=3.2)


def assembly_bodies() -> "Drawn":
    """What each body yields more than in the lumped model."""
    table = assembly_tables(False)["assembly_added"]
    curves = [Curve(label, _degrees(table), table[name].data * TO_ARCMIN_PER_KNM) for name, label in BODIES.items()]
    title = "Compliance that the lumped model leaves out, by bodies"
    return chart_figure(title, ANGLE, [Chart("Compliance [arcmin/(kN m)]", curves)], height=3.4)
