"""Commands that mechanisms bring: listed without an import, options from the keys of a spec, a run folder like any other."""

import json
import subprocess
import sys
from importlib.metadata import EntryPoint
from pathlib import Path
from typing import Literal

import pytest
from pydantic import Field

from drivewright import cli, plugins, registry
from drivewright.errors import InputError
from drivewright.registry import Analysis, Command, Mechanism
from drivewright.result import Answer, Check, Value
from drivewright.spec import DataFile, Flag, Integer, MechanismSpec
from drivewright.units import Length

pytestmark = pytest.mark.interface


class WeighSpec(MechanismSpec):
    """A weighing."""

    mechanism: Literal["weigh"] = Field("weigh", description="kind")
    data: DataFile = Field(description="what to weigh")
    largest_size: Length | None = Field(None, gt=0, description="largest size", examples=["3 mm"])
    times: Integer = Field(2, ge=1, description="how often")
    wet: Flag = Field(False, description="in water")


def weigh(spec, done):
    size = len(spec.data.read_text()) * spec.times
    limit = (Check("size", 0.001 * size, spec.largest_size, "<=", "m", "must fit"),) if spec.largest_size else ()
    return Answer({"size": Value(size, "-", "size"), "wet": Value(spec.wet, "-", "in water")}, checks=limit)


def build(spec):
    if len(spec.data.read_text()) * spec.times == 13 * 7:
        raise InputError("seven times thirteen is refused")
    return spec


WEIGH = Command(Mechanism("weigh", "weigh a file", WeighSpec, build, (Analysis("size", weigh, "size"),), Path(".")), "data")
BRINGING = Mechanism("scales", "scales", object, None, (), Path("."), commands=(WEIGH,))


@pytest.fixture(autouse=True)
def scales(monkeypatch, tmp_path):
    """A mechanism of the kind "scales" that brings `weigh`, and a file to weigh, thirteen characters long."""
    ours = [
        EntryPoint("scales", f"{__name__}:BRINGING", "drivewright.mechanisms"),
        EntryPoint("weigh", f"{__name__}:BRINGING", "drivewright.commands"),
        EntryPoint("run", f"{__name__}:BRINGING", "drivewright.commands"),
        EntryPoint("broken", f"{__name__}:BRINGING", "drivewright.commands"),
    ]
    real = plugins.entry_points
    monkeypatch.setattr(plugins, "entry_points", lambda group: [*real(group=group), *(p for p in ours if p.group == group)])
    plugins.installed.cache_clear()
    plugins.load.cache_clear()
    monkeypatch.chdir(tmp_path)
    (tmp_path / "thing.txt").write_text("thirteen long")
    yield tmp_path
    plugins.installed.cache_clear()
    plugins.load.cache_clear()


@pytest.fixture
def drivewright(capsys):
    def call(*arguments):
        with pytest.raises(SystemExit) as left:
            cli.main(list(arguments))
        return (left.value.code or 0, *capsys.readouterr())

    return call


def test_help_lists_it_with_who_brings_it_and_the_house_stays_first(drivewright, monkeypatch):
    monkeypatch.setattr(registry, "command", lambda name: pytest.fail("help must not import a mechanism"))
    code, out, _ = drivewright("--help")
    lines = [line.split() for line in out.partition("Commands:")[2].splitlines() if line.strip()]
    names = [line[0] for line in lines]
    assert code == 0 and names[:2] == ["new", "run"] and names.count("run") == 1
    assert next(line for line in lines if line[0] == "weigh")[1:4] == ["Brought", "by", "scales;"]


def test_its_own_help_has_every_key_as_an_option(drivewright):
    code, out, _ = drivewright("weigh", "--help")
    text = " ".join(out.split())
    assert code == 0 and "weigh a file" in text and "DATA" in text and "what to weigh" in text
    assert "--largest-size" in text and "largest size, e.g. 3 mm" in text and "how often; default 2" in text
    assert all(option in text for option in ("--out", "--no-figures", "--json", "--strict", "--title", "--wet"))
    assert "--optimise" not in text and "--format" not in text and "--mechanism" not in text


def test_a_run_writes_a_run_folder_that_runs_again(drivewright, scales):
    code, out, err = drivewright("weigh", "thing.txt", "--times", "3", "--wet", "true", "--title", "a thing")
    folder = scales / "out" / "thing"
    record = json.loads((folder / "result.json").read_text())
    assert code == 0 and "a thing" in out and f"wrote {folder}/" in err
    assert record["values"]["size"]["value"] == 39 and record["values"]["wet"]["value"] == 1 and record["mechanism"] == "weigh"
    assert {"spec.toml", "report.html", "data", "result.json"} == {path.name for path in folder.iterdir()}
    again = drivewright("run", str(folder / "spec.toml"), "--json", "--out", "again")
    assert again[0] == 0 and json.loads(again[1])["values"] == record["values"] and json.loads(again[1])["digest"] == record["digest"]


def test_json_strict_and_out(drivewright, scales):
    code, out, _ = drivewright("weigh", "thing.txt", "--largest-size", "20 mm", "--json", "--strict", "--out", "here", "--no-figures")
    assert code == 3 and json.loads(out)["checks"][0]["value"] == pytest.approx(0.026) and (scales / "here" / "result.json").is_file()
    assert drivewright("weigh", "thing.txt", "--largest-size", "30 mm", "--strict")[0] == 0


@pytest.mark.parametrize(
    ("arguments", "wanted"),
    [
        (["nope.txt"], "nope.txt: there is no file"),
        (["thing.txt", "--largest-size", "3"], 'thing.txt: --largest-size: unit missing: a length, e.g. "3 mm"'),
        (["thing.txt", "--largest-size", "3 N"], "thing.txt: --largest-size: wants a length, got '3 N' (force)"),
        (["thing.txt", "--largest-size", "-3 mm"], "thing.txt: --largest-size: must be greater than 0 mm"),
        (["thing.txt", "--times", "much"], "thing.txt: --times: "),
        (["thing.txt", "--times", "7"], "thing.txt: seven times thirteen is refused"),
    ],
)
def test_a_mistake_is_one_message_and_nothing_is_written(drivewright, scales, arguments, wanted):
    code, out, err = drivewright("weigh", *arguments)
    assert code == 2 and out == "" and err.count("\n") == 1 and err.startswith(f"drivewright: {wanted}")
    assert [path.name for path in scales.iterdir()] == ["thing.txt"]


@pytest.mark.parametrize("arguments", [["weigh"], ["weigh", "thing.txt", "--bogus", "1"], ["weigh", "a", "b"], ["weihg", "thing.txt"]])
def test_a_command_line_that_is_none_exits_with_2(drivewright, arguments):
    code, out, err = drivewright(*arguments)
    assert code == 2 and out == "" and "Error: " in err and "Traceback" not in err


def test_a_command_that_its_mechanism_does_not_have_is_refused(drivewright):
    code, _, err = drivewright("broken")
    assert code == 2 and err == "drivewright: command 'broken' is not among the commands of 'scales'; repair the package that declares it\n"


def test_the_registry_knows_commands_apart_from_kinds():
    assert registry.commands()["weigh"] == "scales" and "weigh" not in registry.kinds()
    assert registry.mechanism("weigh") is WEIGH.evaluation and registry.is_known("weigh") and not registry.is_known("weihg")
    assert (WEIGH.name, WEIGH.summary) == ("weigh", "weigh a file")


def test_every_declared_command_is_brought_and_every_brought_one_declared():
    plugins.installed.cache_clear()
    declared = {name for name, kind in registry.commands().items() if kind != "scales"}
    brought = {each.name for kind in registry.kinds() if kind != "scales" for each in registry.mechanism(kind).commands}
    assert declared == brought
    for name in declared:
        fields = registry.command(name).evaluation.spec.model_fields
        assert registry.command(name).argument in fields and fields["mechanism"].default == name


def test_ordinary_commands_import_no_mechanism(tmp_path):
    code = (
        "import sys\nfrom drivewright.cli import main\ntry: main(['--version'])\nexcept SystemExit: pass\n"
        "print([m for m in sys.modules if m.startswith('drivewright.mechanisms.') or m == 'numpy'])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=tmp_path, check=True)
    assert done.stdout.splitlines()[-1] == "[]"
