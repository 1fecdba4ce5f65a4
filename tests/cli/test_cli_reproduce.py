"""`drivewright reproduce`: names, bad input, exit codes, what it says."""

import os
import subprocess
import sys

import pytest

from drivewright import cli, reproduction
from drivewright.cli import reproduced
from drivewright.report.content import Picture
from drivewright.reproduction.document import Figure, Input, Paper, Section
from drivewright.reproduction.parts import Computed
from drivewright.validation import AGREES, OPEN, Row, Source, rounded

pytestmark = pytest.mark.interface


def command(*arguments):
    """The exit code of a command."""
    with pytest.raises(SystemExit) as end:
        cli.main(["reproduce", *map(str, arguments)])
    return end.value.code


def test_the_list_has_every_name(capsys):
    assert command("--list") == 0
    out = capsys.readouterr().out
    assert all(name in out for name in reproduction.NAMES)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["hyvo-papr"], "no paper is called 'hyvo-papr' (did you mean 'hyvo-paper'?)"),
        ([], "name one paper (shaft-paper, indexer-paper, hyvo-paper, folding-linkage, pusher-paper), or --all"),
        (["hyvo-paper", "--all"], "name one paper"),
    ],
)
def test_bad_input_is_one_message(arguments, words, capsys):
    assert command(*arguments) == 2
    captured = capsys.readouterr()
    assert words in captured.err and captured.err.count("\n") == 1 and not captured.out


def test_a_folder_of_others_is_refused_before_anything_is_computed(tmp_path, capsys):
    (tmp_path / "mine.txt").write_text("x", encoding="utf-8")
    assert command("indexer-paper", "--out", tmp_path) == 2
    assert "is no reproduced paper" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"]


def paper():
    rows = (
        Row("a", rounded("1", "-"), 1.0, "-", AGREES, "closed form", "here"),
        Row("a again", rounded("1", "-"), 2.0, "-", OPEN, "closed form", "here", reading_of="a"),
    )
    figure = Figure("Fig. 1", "x", lambda folder: Picture("x", "x", "<svg/>"), "A picture.")
    return Paper(
        Source("toy", "A toy.", lambda: rows), "Toy", "About.", (Input("x", "1", True),), (Section("1", ("c",), ("here",), (), (figure,)),)
    )


def test_what_is_missing_is_told_and_the_exit_code_says_so(tmp_path, capsys, monkeypatch):
    rows = paper().source.rows()
    answers = {
        "whole": Computed(rows, {}, {"Fig. 2": "left out by --no-solids"}, frozenset({"Fig. 2"})),
        "part": Computed(rows, {}, {"Fig. 1": "the solid check needs the extra 'fe'"}),
    }
    for name, code in (("whole", 0), ("part", 4)):
        monkeypatch.setattr(reproduced, "reproduce", lambda *a, computed=answers[name]: (tmp_path / "index.html", computed))
        monkeypatch.setattr(reproduction, "papers", lambda chosen=None: (paper(),))
        assert command("hyvo-paper", "--out", tmp_path) == code
        captured = capsys.readouterr()
        assert "toy: 1 printed numbers and claims (1 agrees)\n" in captured.out
        assert ("needs the extra 'fe'" in captured.err) == (code == 4)


def test_the_shell_completes_names():
    asked = {"_DRIVEWRIGHT_COMPLETE": "complete_bash", "COMP_WORDS": "drivewright reproduce s", "COMP_CWORD": "2"}
    code = "from drivewright import cli; cli.main([])"
    found = subprocess.run([sys.executable, "-c", code], env=os.environ | asked, capture_output=True, text=True, check=False)
    assert found.stdout.split() == ["shaft-paper"]
