"""Spelling of the documentation: no common misspellings, and British throughout."""

import re
import shutil
import subprocess
import sys
from importlib import resources

import pytest
from markdown_links import prose, written_pages
from places import ROOT

pytestmark = pytest.mark.interface

pytest.importorskip("codespell_lib", reason="needs the extra 'dev'")
ALSO_BRITISH = {"program", "programs", "dialog", "dialogs"}  # of computers
OTHERS = {"catalog"}  # of a maker who calls it so


def american() -> dict[str, str]:
    """{American spelling: British one}."""
    text = resources.files("codespell_lib").joinpath("data/dictionary_en-GB_to_en-US.txt").read_text(encoding="utf-8")
    pairs = [line.split("->") for line in text.splitlines() if "->" in line]
    return {word.strip(): british for british, words in pairs for word in words.split(",") if word.strip()}


def test_no_common_misspellings():
    command = [
        sys.executable,
        "-m",
        "codespell_lib",
        "src",
        "docs",
        "examples",
        "benchmarks",
        "README.md",
        "CONTRIBUTING.md",
        "CHANGELOG.md",
    ]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_pages_are_british():
    words = american()
    assert words["color"] == "colour"
    found = [
        (str(path.relative_to(ROOT)), word, words[word])
        for path in written_pages().values()
        for word in set(re.findall(r"[a-z]+", prose(path.read_text(encoding="utf-8"))))
        if word in words and word not in ALSO_BRITISH | OTHERS
    ]
    assert found == []


def test_a_misspelling_is_found(tmp_path):
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    (tmp_path / "page.md").write_text("The lenght of the lever.\n")
    done = subprocess.run([sys.executable, "-m", "codespell_lib", "page.md"], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode != 0 and "length" in done.stdout
