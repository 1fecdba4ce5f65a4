"""The [report] table: paths stay in the spec's folder, and the look of a report changes no number."""

import pytest

from drivewright.errors import MissingFile, SpecError
from drivewright.spec import load

pytestmark = pytest.mark.interface


@pytest.fixture
def folder(tmp_path):
    from drivewright.registry import mechanism

    home = tmp_path / "home"
    (home / "templates").mkdir(parents=True)
    (home / "templates" / "report.css").write_text("body { color: red }", encoding="utf-8")
    (home / "templates" / "notes.txt").write_text("not read", encoding="utf-8")
    (home / "logo.svg").write_text("<svg/>", encoding="utf-8")
    (tmp_path / "outside.svg").write_text("<svg/>", encoding="utf-8")
    (home / "link.svg").symlink_to(tmp_path / "outside.svg")
    source = next(iter(mechanism("cam").presets().values()))
    (home / "spec.toml").write_text(source.read_text(encoding="utf-8"), encoding="utf-8")
    return home


FULL = ['report.company="Works"', 'report.logo="logo.svg"', 'report.author="Me"', 'report.templates="templates"']


def test_the_look_of_a_report_is_no_part_of_the_design(folder):
    plain, full = load(folder / "spec.toml"), load(folder / "spec.toml", FULL)
    assert full.digest() == plain.digest() and full.report.company == "Works"
    assert [path.name for path in full.report.templates] == ["report.css"]


def test_logo_and_templates_move_with_the_spec(folder, tmp_path):
    full = load(folder / "spec.toml", FULL)
    full.write(tmp_path / "moved" / "spec.toml")
    moved = load(tmp_path / "moved" / "spec.toml")
    assert moved.report.logo == tmp_path / "moved" / "data" / "logo.svg"
    assert moved.report.templates == (tmp_path / "moved" / "data" / "report.css",)
    assert full.replace(title="another").report == full.report


@pytest.mark.parametrize("path", ["../outside.svg", "{tmp}/outside.svg", "link.svg", "templates/../../outside.svg", "../nothing.svg"])
def test_a_logo_outside_the_folder_is_refused_whether_it_exists_or_not(folder, tmp_path, path):
    with pytest.raises(SpecError, match=r"report\.logo: .* lies outside the folder of the spec; copy it into that folder"):
        load(folder / "spec.toml", [f"report.logo={path.replace('{tmp}', str(tmp_path))!r}"])


def test_templates_outside_the_folder_are_refused(folder, tmp_path):
    with pytest.raises(SpecError, match=r"report\.templates: .* lies outside the folder"):
        load(folder / "spec.toml", ['report.templates=".."'])
    (folder / "templates" / "report.html.j2").symlink_to(tmp_path / "outside.svg")
    with pytest.raises(SpecError, match=r"report\.templates.*lies outside the folder"):
        load(folder / "spec.toml", ['report.templates="templates"'])


@pytest.mark.parametrize("path", ["nothing", "logo.svg", "."])
def test_a_folder_without_templates_is_named(folder, path):
    with pytest.raises(MissingFile, match=r"report\.templates: there is no folder with templates"):
        load(folder / "spec.toml", [f"report.templates={path!r}"])


def test_too_many_templates_are_refused(folder):
    for number in range(30):
        (folder / "templates" / f"{number}.j2").write_text("", encoding="utf-8")
    with pytest.raises(SpecError, match="holds 31 templates; at most 20 are read"):
        load(folder / "spec.toml", ['report.templates="templates"'])
