"""The public names of `drivewright.indexing` are those that the documentation shows."""

import re

import pytest
from places import ROOT

from drivewright import indexing

pytestmark = pytest.mark.interface

DOCS = ROOT / "docs" / "extending.md"


def test_public_names_are_those_of_the_documentation():
    section = DOCS.read_text(encoding="utf-8").partition("## An indexing drive")[2].partition("\n## ")[0]
    shown = {name for row in re.findall(r"^\| (`.*?) \|", section, re.MULTILINE) for name in re.findall(r"`(\w+)`", row)}
    assert sorted(indexing.__all__) == sorted(shown)


def test_every_name_loads_and_others_do_not():
    assert all(getattr(indexing, name) is not None for name in indexing.__all__)
    with pytest.raises(AttributeError, match="no_such_name"):
        indexing.no_such_name  # noqa: B018
