"""The page's modules fit together: whatever one imports, another has and the studio serves; joined for the report they are in order."""

import re
from pathlib import Path

import pytest

from drivewright.report import html
from drivewright.studio import app

pytestmark = pytest.mark.interface

OWN = Path(app.__file__).parent / "web"
REPORT = Path(html.__file__).parent
IMPORTS = re.compile(r'^(?:import|export) \{(.*)\} from "\./(.*)";$', re.MULTILINE)
ALL = (*html.MODULES, *html.SOLID_MODULES)
DEFINED = re.compile(r"^export (?:const|function\*?|class) (\w+)", re.MULTILINE)


def modules():
    return {name: data.decode() for name, (data, _) in app._files().items() if name.endswith(".js")}


def exported(text):
    """Names that a module gives others, those that it hands on among them."""
    handed = ",".join(re.findall(r"^export \{(.*)\} from", text, re.MULTILINE))
    return {*DEFINED.findall(text), *re.findall(r"\w+", handed)}


def test_every_import_is_of_something_served():
    served = modules()
    wanted = {
        (name, source, each.strip())
        for name, text in served.items()
        for names, source in IMPORTS.findall(text)
        for each in names.split(",")
    }
    assert len(wanted) > 60
    assert sorted((name, source, each) for name, source, each in wanted if each not in exported(served.get(source, ""))) == []


def test_imports_are_written_as_these_tests_and_the_report_read_them():
    for name, text in modules().items():
        assert len(re.findall(r"^\s*import\b|^export .* from", text, re.MULTILINE)) == len(IMPORTS.findall(text)), name


def test_no_module_of_the_studio_takes_the_name_of_one_of_the_report():
    assert not {path.name for path in OWN.iterdir()} & {path.name for path in REPORT.iterdir()}
    assert {path.name for path in REPORT.glob("*.js")} == set(ALL)


@pytest.mark.parametrize("place", range(len(ALL)))
def test_a_module_of_the_report_comes_behind_those_it_imports(place):
    text = (REPORT / ALL[place]).read_text(encoding="utf-8")
    assert {source for _, source in IMPORTS.findall(text)} <= set(ALL[:place])


def test_no_two_modules_of_the_report_use_the_same_name_at_their_top():
    """They become one script there."""
    named = re.compile(r"^(?:export )?(?:const|let|function\*?|class) (\w+)((?: = [\w.-]+, \w+)*)", re.MULTILINE)
    found = [
        name
        for each in ALL
        for name, more in named.findall((REPORT / each).read_text(encoding="utf-8"))
        for name in [name, *re.findall(r", (\w+)", more)]
    ]
    assert len(found) > 100 and sorted(name for name in set(found) if found.count(name) > 1) == []


def test_no_module_takes_a_text_for_markup():
    """Names of bodies, joints, presets, plots and studies come from whoever wrote the spec: they are set as text, never read as HTML."""
    markup = re.compile(
        r"innerHTML|outerHTML|insertAdjacentHTML|document\.write|DOMParser|createContextualFragment|srcdoc|setHTML|eval\(|new Function"
    )
    assert {name: found for name, text in modules().items() if (found := markup.findall(text))} == {}
