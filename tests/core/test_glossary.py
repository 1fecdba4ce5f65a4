"""The glossary of docs/conventions.md names what is in the code."""

import re

import pytest
from places import ROOT

pytestmark = pytest.mark.interface

SOURCE = "\n".join(path.read_text(encoding="utf-8") for path in sorted((ROOT / "src" / "drivewright").rglob("*.py")))
IDENTIFIERS = set(re.findall(r"[A-Za-z_]\w*", SOURCE))


def rows():
    """The rows of all tables of the glossary, as lists of cells."""
    text = (ROOT / "docs" / "conventions.md").read_text(encoding="utf-8").partition("## Glossary")[2]
    lines = [line for line in text.splitlines() if line.startswith("|") and not line.startswith(("| term", "|---"))]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def test_there_is_a_glossary_and_every_row_has_its_four_cells():
    assert len(rows()) > 80 and all(len(row) == 4 and row[0] and row[2] for row in rows())


def test_no_term_stands_twice():
    terms = [row[0] for row in rows()]
    assert len(terms) == len(set(terms))


@pytest.mark.parametrize("name", sorted({name for row in rows() for name in re.findall(r"`([^`]+)`", row[2])}))
def test_a_code_name_is_in_the_code(name):
    missing = [part for part in re.findall(r"[A-Za-z_]\w*", name) if part not in IDENTIFIERS]
    assert not missing, f"{name}: {missing}"
