"""`drivewright compare`: what it writes, and what it refuses before anything is computed."""

import json

import pytest

from drivewright import cli, registry, runner
from drivewright.errors import InputError

pytestmark = pytest.mark.interface

PRESETS = registry.mechanism("cam").presets()


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """Two cams with the same title, one with another, and a shaft, in the current folder."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("drivewright.execution.helper.worker_count", lambda wanted: 1)
    text = PRESETS["default"].read_text()
    (tmp_path / "a.toml").write_text(text)
    (tmp_path / "b.toml").write_text(text.replace('prime_radius = "40 mm"', 'prime_radius = "46 mm"'))
    (tmp_path / "c.toml").write_text(text.replace('title = "', 'title = "Other: '))
    (tmp_path / "shaft.toml").write_text(registry.mechanism("shaft").presets()["default"].read_text())
    return tmp_path


@pytest.fixture
def drivewright(capsys):
    """Runs a command line: (exit code, stdout, stderr)."""

    def call(*arguments):
        with pytest.raises(SystemExit) as left:
            cli.main(list(arguments))
        return (left.value.code or 0, *capsys.readouterr())

    return call


def test_several_specs_become_one_page(drivewright, folder):
    code, out, err = drivewright("compare", "a.toml", "b.toml", "c.toml", "--out", "page", "--only", "forces")
    assert code == 0 and "wrote page/" in err and "max_contact_force" in out
    record = json.loads((folder / "page" / "compare.json").read_text())
    title = "Disc cam with a spring-loaded roller"
    assert record["labels"] == ["a", "b", f"Other: {title}"]
    a, b, c = record["values"]["max_contact_force"]
    assert a == c != b
    assert (folder / "page" / "index.html").is_file() and list((folder / "page" / "figures").glob("plot-*.svg"))


def test_labels_and_changes_go_to_every_design(drivewright, folder):
    code, *_ = drivewright("compare", "a.toml", "a.toml", "--labels", "left, right", "--set", "drive.speed=300 rpm", "--only", "forces")
    record = json.loads((folder / "out" / "a-compared" / "compare.json").read_text())
    assert code == 0 and record["labels"] == ["left", "right"]
    assert all(left == right for left, right in record["values"].values())


def test_a_spec_is_compared_with_what_set_makes_of_it(drivewright, folder):
    code, out, err = drivewright("compare", "a.toml", "--set", "follower.prime_radius=46 mm", "--json")
    both = drivewright("compare", "a.toml", "b.toml", "--json", "--labels", "a,changed", "--out", "both")[1]
    assert code == 0 and json.loads(out)["labels"] == ["a", "changed"]
    assert json.loads(out)["values"] == json.loads(both)["values"]


def test_of_two_designs_the_terminal_has_the_difference_and_says_when_they_are_identical(drivewright, folder):
    _, out, err = drivewright("compare", "a.toml", "b.toml", "--out", "page")
    row = next(line for line in out.splitlines() if "max_pressure_angle" in line)
    assert "difference" in out and "−2.637° (−9.63\u00a0%)" in row and "identical" not in err
    set_ = ("--set", "follower.prime_radius=44 mm")
    _, out, err = drivewright("compare", "a.toml", "b.toml", "--out", "page", "--only", "forces", *set_)
    assert "note: a and b are identical: their specs differ in no key (--set changes every design)\n" in err


def test_of_several_designs_those_that_are_identical_are_named(drivewright, folder):
    _, out, err = drivewright("compare", "a.toml", "b.toml", "c.toml", "--labels", "A,B,C", "--out", "page", "--only", "forces")
    assert "difference" not in out and "note: A and C are identical: their specs differ in no key\n" in err


@pytest.mark.parametrize(
    ("rise", "message"),
    [
        ("500", 'programme.0.rise: unit missing: a length, e.g. "500 mm"'),
        ("500 mm", "programme: the lift ends 480 mm above its start, and a closed cycle must end where it starts: "),
        ('"-5 mm"', "the lift ends 25 mm below its start"),
        ("5 km", "its rises are 5000000 mm, -20 mm; with -5000000 mm in segment 2 it closes."),
        ("0.5 rad", "programme.0.rise: must be a length"),
    ],
)
@pytest.mark.parametrize("command", [("compare", "a.toml", "b.toml"), ("run", "a.toml")])
def test_a_rise_that_cannot_be_is_one_line_in_the_unit_people_write(drivewright, folder, command, rise, message):
    code, out, err = drivewright(*command, "--set", f"programme.0.rise={rise}")
    assert (code, out, err.count("\n")) == (2, "", 1) and message in err and "rad for a swing" not in err


def test_a_file_given_twice_is_numbered(drivewright, folder):
    code, *_ = drivewright("compare", "a.toml", "a.toml", "--out", "page", "--only", "forces")
    assert code == 0 and json.loads((folder / "page" / "compare.json").read_text())["labels"] == ["a", "a (2)"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["a.toml"], "at least two designs, got 1"),
        (["a.toml", "gone.toml"], "gone.toml: there is no such file"),
        (["a.toml", "shaft.toml"], "designs of one kind can be compared, and these are cam, shaft"),
        (["a.toml", "b.toml", "--labels", "one"], "1 labels for 2 designs"),
        (["a.toml", "b.toml", "--labels", "one,,"], "3 labels for 2 designs"),
        (["a.toml", "b.toml", "--labels", "one,one"], "the label 'one' stands for two designs"),
        (["a.toml", "b.toml", "--only", "torces"], "no analysis is called 'torces'"),
        (["a.toml", "b.toml", "--out", "mine"], "mine: is not empty and is no comparison"),
        (["a.toml", "b.toml", "--set", "follower.roller_radius=3 kg"], "follower.roller_radius"),
    ],
)
def test_bad_input_is_one_message_before_anything_is_computed(drivewright, folder, monkeypatch, arguments, message):
    (folder / "mine").mkdir()
    (folder / "mine" / "notes.txt").write_text("mine")
    monkeypatch.setattr(runner, "build", lambda spec: pytest.fail("something is computed"))
    before = sorted(folder.rglob("*"))
    code, out, err = drivewright("compare", *arguments)
    assert code == 2 and out == "" and err.startswith("drivewright: ") and err.count("\n") == 1 and message in err
    assert sorted(folder.rglob("*")) == before


def test_a_design_that_cannot_be_built_is_named(drivewright, folder, monkeypatch):
    build = runner.build

    def no_other(spec):
        if spec.title.startswith("Other"):
            raise InputError("no such cam can be built")
        return build(spec)

    monkeypatch.setattr(runner, "build", no_other)
    code, out, err = drivewright("compare", "a.toml", "c.toml", "--out", "page")
    assert (code, out, err) == (2, "", "drivewright: c.toml: no such cam can be built\n")
    assert not (folder / "page").exists()
