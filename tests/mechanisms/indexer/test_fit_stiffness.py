"""`drivewright fit-stiffness` from CSV to run folder: the values, the tables, the model beside the test, the refusals."""

import json
from importlib.metadata import EntryPoint
from pathlib import Path
from typing import Literal

import numpy as np
import pytest
from places import EXAMPLES
from pydantic import Field
from torsion_loops import parallelogram, whole_loop_of

from drivewright import cli, plugins
from drivewright.indexing.torsion_test import Estimate
from drivewright.indexing.torsion_test.answers import estimate_values
from drivewright.mechanisms.indexer import torsion
from drivewright.registry import Analysis, Mechanism
from drivewright.result import Answer, Column, Table
from drivewright.spec import MechanismSpec, Number
from drivewright.units import unit_factor

pytestmark = pytest.mark.interface

ARCMIN = unit_factor("arcmin", "angle")
BRINGING = Mechanism("bench", "bench", object, None, (), Path("."), commands=(torsion.command,))
EXAMPLE = EXAMPLES / "torsion_test.csv"


class DesignSpec(MechanismSpec):
    """A drive whose stiffness is known."""

    mechanism: Literal["design"] = Field("design", description="kind")
    level: Number = Field(2e5, description="mean stiffness")


def computed(spec, done):
    angle = np.radians(np.arange(0.0, 180.1, 4.5))
    secant = np.where(angle > np.radians(150), np.nan, spec.level * (1 + 0.5 * np.cos(2 * angle)))
    columns = (Column("angle", "rad", "angle", angle), Column("secant", "N m/rad", "secant", secant))
    return Answer(tables=(Table("stiffness", "stiffness", columns),))


DESIGN = Mechanism("design", "a design", DesignSpec, lambda spec: spec, (Analysis("stiffness", computed, "s", default=False),), Path("."))


@pytest.fixture(autouse=True)
def bench(monkeypatch, tmp_path):
    """The command, where no installed package brings it yet, a kind of drive with a known stiffness, and an empty folder."""
    real = plugins.entry_points
    ours = [EntryPoint("design", f"{__name__}:DESIGN", "drivewright.mechanisms")]
    if not any(point.name == torsion.command.name for point in real(group="drivewright.commands")):
        ours.append(EntryPoint(torsion.command.name, f"{__name__}:BRINGING", "drivewright.commands"))
    monkeypatch.setattr(plugins, "entry_points", lambda group: [*real(group=group), *(p for p in ours if p.group == group)])
    plugins.installed.cache_clear()
    plugins.load.cache_clear()
    monkeypatch.chdir(tmp_path)
    yield tmp_path
    plugins.installed.cache_clear()
    plugins.load.cache_clear()


@pytest.fixture
def fit(capsys):
    def call(*arguments):
        with pytest.raises(SystemExit) as left:
            cli.main([torsion.command.name, *arguments])
        return (left.value.code or 0, *capsys.readouterr())

    return call


def write(path, readings, header="torque [N m],angle [arcmin]", factors=(1.0, 1 / ARCMIN), crank=()):
    rows = [f"{t * factors[0]!r},{a * factors[1]!r}" for t, a in zip(readings.torque.tolist(), readings.angle.tolist(), strict=True)]
    cranks = [f",{c!r}" for c in crank] or [""] * len(rows)
    path.write_text("\n".join([header, *(row + c for row, c in zip(rows, cranks, strict=True))]) + "\n")
    return str(path)


def values(done):
    assert done[0] == 0, done[2]
    return {name: value["value"] for name, value in json.loads(done[1])["values"].items()}


def test_a_parallelogram_comes_back_through_the_command_line(fit, bench):
    data = write(bench / "loop.csv", parallelogram(3e5, 6e-4, 900.0))
    done = fit(data, "--rated-torque", "900 N m", "--json", "--out", "r")
    found, record = values(done), json.loads((bench / "r" / "result.json").read_text())
    assert json.loads(done[1]) == record
    assert found["stiffness.whole_loop"] == pytest.approx(whole_loop_of(3e5, 6e-4, 900.0, 41), rel=1e-9)
    for name in ("per_branch", "inverse", "corrected", "loading", "unloading", "secant", "k1", "k2", "k3"):
        assert found[f"stiffness.{name}"] == pytest.approx(3e5, rel=1e-9)
        assert record["values"][f"stiffness.{name}"]["unit"] == "N m/rad"
    wanted = {"backlash": (1.2e-3, "rad"), "lost_motion": (0.06 * 900 / 3e5, "rad"), "hysteresis_energy": (4 * 6e-4 * 900, "J")}
    for name, (value, unit) in wanted.items():
        assert found[name] == pytest.approx(value, rel=1e-9) and record["values"][name]["unit"] == unit
    assert {"stiffness.whole_loop.uncertainty", "stiffness.per_branch.uncertainty", "stiffness.corrected.uncertainty"} <= set(found)
    assert "stiffness.t1" not in found and any("no stiffness of the loading bar" in text for text in record["findings"])
    assert {p.name for p in (bench / "r" / "figures").iterdir()} == {"plot-loop.svg", "plot-residuals.svg", "plot-mid_line.svg"}
    assert {p.stem for p in (bench / "r" / "tables").iterdir()} == {"loop", "residuals", "mid_line"}
    assert (bench / "r" / "data" / "loop.csv").read_bytes() == Path(data).read_bytes()


def test_other_units_and_a_force_give_the_same_numbers(fit, bench):
    readings = parallelogram(3e5, 6e-4, 900.0, 41, 4)
    plain = values(fit(write(bench / "a.csv", readings), "--json", "--no-figures"))
    other = values(
        fit(
            write(bench / "b.csv", readings, "force [kN],angle [deg]", (1 / 0.4 / 1e3, 180 / np.pi)),
            "--arm",
            "400 mm",
            "--json",
            "--no-figures",
        )
    )
    assert plain.keys() == other.keys() and "stiffness.per_branch.bootstrap.low" in plain
    sure = [name for name in plain if not name.endswith((".uncertainty", ".low", ".high", "drift"))]
    assert {name: other[name] for name in sure} == pytest.approx({name: plain[name] for name in sure}, rel=1e-8)


def test_the_rig_is_taken_off_with_its_uncertainty(fit, bench):
    data = write(bench / "loop.csv", parallelogram(3e5, 6e-4, 900.0))
    found = values(
        fit(
            data,
            "--loading-bar-stiffness",
            "2e6 N m/rad",
            "--loading-bar-uncertainty",
            "1e5 N m/rad",
            "--support-stiffness",
            "1000 N m/arcmin",
            "--support-uncertainty",
            "20 N m/arcmin",
            "--json",
            "--no-figures",
        )
    )
    support = 1000 / ARCMIN
    k = 1 / (1 / 3e5 - 1 / 2e6 - 1 / support)
    assert found["stiffness.corrected"] == pytest.approx(k, rel=1e-9)
    spread = k**2 * np.hypot(1e5 / 2e6**2, 0.02 / support)
    assert found["stiffness.corrected.uncertainty"] == pytest.approx(spread, rel=1e-6)
    assert found["stiffness.corrected.low"] < k < found["stiffness.corrected.high"]


def test_positions_of_the_crank_and_the_model_beside_them(fit, bench):
    cranks = [18.0, 0.0, 90.0, 171.0]
    loops = [parallelogram(1.1 * 2e5 * (1 + 0.5 * np.cos(np.radians(2 * c))), 6e-4, 900.0) for c in cranks]
    joined = type(loops[0])(*(np.concatenate([loop[n] for loop in loops]) for n in (0, 1)))
    data = write(bench / "all.csv", joined, "torque [N m],angle [arcmin],crank [deg]", crank=np.repeat(cranks, 82).tolist())
    (bench / "design.toml").write_text('mechanism = "design"\n')
    done = fit(data, "--model", "design.toml", "--json")
    found = values(done)
    expected = [2.2e5 * (1 + 0.5 * np.cos(np.radians(2 * c))) for c in cranks]
    assert found["stiffness.per_branch"] == pytest.approx(np.mean(expected), rel=1e-9)
    assert found["stiffness.minimum"] == pytest.approx(1.1e5, rel=1e-9) and found["stiffness.minimum.at"] == pytest.approx(np.pi / 2)
    assert found["stiffness.maximum.at"] == 0 and found["stiffness.range"] == pytest.approx(2.2e5, rel=1e-9)
    assert found["model.ratio"] == pytest.approx(1.1, rel=1e-9)
    assert any("no stiffness at 1 of 4 measured positions" in text for text in json.loads(done[1])["findings"])
    figures = {path.name for path in (bench / "out" / "all" / "figures").iterdir()}
    assert {"plot-positions.svg", "plot-comparison.svg"} <= figures
    from pyarrow import parquet

    table = parquet.read_table(bench / "out" / "all" / "tables" / "comparison.parquet").to_pydict()
    assert table["angle"] == pytest.approx(np.radians([0, 18, 90, 171])) and table["measured"][1] == pytest.approx(1.1 * table["model"][1])
    assert np.isnan(table["model"][3])


def test_errors_of_several_positions_are_independent():
    found = estimate_values("k", "k", "stiffness", [Estimate(10.0, 1.0, 8.0, 13.0), Estimate(14.0, 1.0, 12.0, 17.0)] * 2, 0.9)
    numbers = {name: value.value for name, value in found.items()}
    assert numbers == pytest.approx({"k": 12.0, "k.uncertainty": 0.5, "k.low": 11.0, "k.high": 13.5})
    assert "90 % interval" in found["k.low"].meaning and "mean of 4 positions" in found["k"].meaning


def test_a_stiffness_carries_its_interval_of_95_percent():
    estimates = [Estimate(10.0, 1.0, 8.0, 13.0)]
    found = estimate_values("k", "k", "stiffness", estimates, 0.95)
    assert (found["k"].low, found["k"].high, found["k"].interval) == (8.0, 13.0, "fit")
    assert (found["k.low"].value, found["k.high"].value) == (8.0, 13.0)
    assert estimate_values("k", "k", "stiffness", estimates, 0.9)["k"].interval == ""


@pytest.mark.parametrize(
    ("options", "wanted"),
    [
        (["--rated-torque", "1000"], '--rated-torque: unit missing: a torque, e.g. "1000 N m"'),
        (["--rated-torque", "1000 N m/rad"], "--rated-torque: wants a torque, got '1000 N m/rad' (rotational stiffness); write N m"),
        (["--rated-torque", "0 N m"], "--rated-torque: must be greater than 0"),
        (["--support-uncertainty", "1 N m/rad"], "--support-uncertainty: needs support_stiffness, whose uncertainty it is"),
        (["--support-stiffness", "1e5 N m/rad"], "series correction: 1/k = 1/300000 - 1/100000 rad/(N·m) = -6.67e-06 is not positive"),
        (["--confidence", "1"], "--confidence: must be less than 1"),
        (["--arm", "1 m"], "the load is a torque already"),
        (["--model", "nope.toml"], "--model: there is no file"),
    ],
)
def test_a_mistake_is_one_message_and_leaves_nothing(fit, bench, options, wanted):
    data = write(bench / "loop.csv", parallelogram(3e5, 6e-4, 900.0))
    code, out, err = fit(data, *options)
    assert code == 2 and out == "" and err.count("\n") == 1 and wanted in err and "loop.csv" in err
    assert [path.name for path in bench.iterdir()] == ["loop.csv"]


def test_a_model_without_a_stiffness_is_refused(fit, bench):
    data = write(bench / "loop.csv", parallelogram(), "torque [N m],angle [arcmin],crank [deg]", crank=[0.0] * 82)
    (bench / "cam.toml").write_bytes((EXAMPLE.parent / "disc_cam.toml").read_bytes())
    code, _, err = fit(data, "--model", "cam.toml")
    assert code == 4 and "kind cam has no table 'stiffness' with columns angle and secant" in err


def test_the_worked_example_is_said_to_be_made_up_and_gives_what_it_says(fit):
    text = EXAMPLE.read_text()
    assert text.startswith("# A made-up torsion test, no measurement")
    found = values(fit(str(EXAMPLE), "--rated-torque", "1000 N m", "--loading-bar-stiffness", "5e6 N m/rad", "--json", "--out", "ex"))
    assert found["drift"] == pytest.approx(1.1e-7 * 299, rel=0.25)
    assert found["stiffness.corrected"] == pytest.approx(3.9e5, rel=0.02) and found["stiffness.secant"] < found["stiffness.corrected"]
    assert found["stiffness.k1"] < found["stiffness.k3"] and found["stiffness.whole_loop"] < found["stiffness.per_branch"]
    assert found["stiffness.per_branch.uncertainty"] < 0.02 * found["stiffness.per_branch"] and 0 < found["hysteresis_loss"] < 0.2
