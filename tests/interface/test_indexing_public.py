"""The public names of `drivewright.indexing` are those that the documentation shows."""

import re
from pathlib import Path

import pytest

from drivewright import indexing

DOCS = Path(__file__).parents[2] / "docs" / "extending.md"


def test_public_names_are_those_of_the_documentation():
    section = DOCS.read_text(encoding="utf-8").partition("## An indexing drive")[2].partition("\n## ")[0]
    shown = {name for row in re.findall(r"^\| (`.*?) \|", section, re.MULTILINE) for name in re.findall(r"`(\w+)`", row)}
    assert sorted(indexing.__all__) == sorted(shown)


def test_every_name_loads_and_others_do_not():
    assert all(getattr(indexing, name) is not None for name in indexing.__all__)
    with pytest.raises(AttributeError, match="no_such_name"):
        indexing.no_such_name  # noqa: B018
