"""A page of the studio cannot have a file of the server put into a report."""

import pytest

from drivewright.errors import SpecError
from drivewright.registry import mechanism
from drivewright.studio.opening import opened

pytestmark = pytest.mark.error


@pytest.fixture
def design(tmp_path):
    """An opened spec with a logo, beside files that it does not name."""
    home = tmp_path / "home"
    (home / "templates").mkdir(parents=True)
    for name in ("logo.svg", "secret.svg", "templates/report.css"):
        (home / name).write_text("<svg/>", encoding="utf-8")
    source = next(iter(mechanism("cam").presets().values())).read_text(encoding="utf-8")
    (home / "spec.toml").write_text(f'{source}\n[report]\nlogo = "logo.svg"\n', encoding="utf-8")
    return opened(home / "spec.toml")


def test_the_logo_of_an_opened_spec_is_read(design):
    assert design.spec().report.logo.name == "logo.svg"


@pytest.mark.parametrize(
    "changes",
    [{"report.logo": "secret.svg"}, {"report.logo": "nothing.svg"}, {"report.templates": "templates"}, {"report.templates": "nothing"}],
)
def test_other_files_are_not_there_whether_they_exist_or_not(design, changes):
    with pytest.raises(SpecError) as caught:
        design.changed(changes).spec()
    assert caught.value.message.startswith("there is no such data file here")


@pytest.mark.parametrize("path", ["../outside.svg", "/etc/hostname", "/nothing"])
def test_nor_is_anything_outside_the_folder(design, path):
    with pytest.raises(SpecError, match="lies outside the folder of the spec"):
        design.changed({"report.logo": path}).spec()
