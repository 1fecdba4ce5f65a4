"""The pages of the Python interface: each lists modules, which mkdocstrings fills with their public names, types and docstrings."""

import pkgutil
from collections.abc import Callable, Iterator
from importlib import import_module
from pathlib import Path
from types import FunctionType, ModuleType
from typing import NamedTuple

from builders.markdown import cell, code, sentence, table, write_page


class Page(NamedTuple):
    """One page: its file, title, what it is about, and the modules and packages that it lists."""

    name: str
    title: str
    about: str
    modules: tuple[str, ...]


PAGES = (
    Page(
        "run",
        "Specs, runs and results",
        "Load a spec, run it, read its result: `dw.load`, `dw.run`, `Result`, units and errors.",
        (
            "spec",
            "runner",
            "result",
            "advice",
            "frames",
            "notebook",
            "dimensions",
            "stops",
            "labels",
            "units",
            "errors",
            "scene",
            "surface_fields",
            "cases",
            "materials",
        ),
    ),
    Page(
        "extending",
        "Registry and plug-ins",
        "What a kind of drive, a law, a joint or a command declares, and the tests that it has to pass.",
        ("registry", "claims", "testing", "plugins", "construction", "motion_diagram"),
    ),
    Page(
        "motion-cams",
        "Motion laws and cams",
        "Motion laws, plane curves, profiles of cams and their contacts.",
        ("motion", "curves", "cams"),
    ),
    Page("gears", "Gears", "Non-circular gears: pitch curves, teeth, trains.", ("gears",)),
    Page("multibody", "Multibody systems", "Planar rigid bodies with joints, contacts and force elements.", ("multibody",)),
    Page("bearings-shafts", "Bearings and shafts", "Rolling bearings, shafts as beams, strength, rotors.", ("bearings", "shafts")),
    Page("chains", "Chains", "Silent and roller chains: meshing, closure, running, stress and life.", ("chains",)),
    Page("indexing", "Indexing drives", "Pin and roller indexers: envelopes, play, stiffness, stress.", ("indexing",)),
    Page(
        "contact-fatigue",
        "Contact and fatigue",
        "Hertzian contact, friction, films, wear, impact; multiaxial fatigue.",
        ("contact", "fatigue"),
    ),
    Page("solids", "Solids", "Finite-element solids, also in contact (extra `fe`).", ("solids",)),
    Page("studies", "Studies", "Sweeps, tolerances, sensitivities, optimisation, and who computes the cases.", ("studies", "execution")),
    Page("drives", "Models of the drives", "What each kind of drive makes of its spec.", ("mechanisms",)),
    Page("numerics", "Numerics", "Quadrature, interpolation, roots and other methods that several packages share.", ("numerics",)),
    Page("reports", "Figures and reports", "Drawing, export, comparison.", ("view", "report")),
)


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write a page for each of `PAGES` and docs/reference/index.md."""
    for page in PAGES:
        progress(page.title)
        write_page(docs / "reference" / "python" / f"{page.name}.md", _lines(page))


def modules_of_pages() -> Iterator[tuple[str, str]]:
    """(full name, page) of all modules that the pages list."""
    for page in PAGES:
        for name in page.modules:
            yield from ((module, page.name) for module in _modules(f"drivewright.{name}"))


def _lines(page: Page) -> Iterator[str]:
    """Lines of one page: a table of its modules, then a section for each."""
    modules = [module for name in page.modules for module in _modules(f"drivewright.{name}")]
    yield from ("---", "search: {boost: 0.3}  # pages that explain come first", "---", f"# {page.title}", "", page.about)
    yield from table(("module", "about"), ((f"[{code(module)}](#{module})", cell(_summary(module))) for module in modules))
    for module in modules:
        yield from ("", f"## {module.removeprefix('drivewright.')} {{#{module}}}", "", f"::: {module}")
        yield from _passed_on(module)


def _passed_on(module: str) -> list[str]:
    """For a package that passes names of its modules on: no members of its own, but a table of those names."""
    package = import_module(module)
    names = {name: getattr(package, name) for name in getattr(package, "__all__", ())}
    rows = [(name, value) for name, value in names.items() if getattr(value, "__module__", module) != module]
    if not rows or not hasattr(package, "__path__"):
        return []
    shown = ((code(f"{module}.{name}"), cell(_first_sentence(value))) for name, value in rows)
    return ["    options:", "      members: false", *table(("name", "about"), shown)]


def _modules(name: str) -> Iterator[str]:
    """A module, or a package with all its public modules, in alphabetical order."""
    yield name
    for found in pkgutil.iter_modules(getattr(import_module(name), "__path__", ())):
        if not found.name.startswith("_"):
            yield from _modules(f"{name}.{found.name}")


def _summary(module: str) -> str:
    """First sentence of a module's docstring."""
    return _first_sentence(import_module(module))


def _first_sentence(value: object) -> str:
    """First paragraph of the docstring of a module, class or function of ours; "" of anything else."""
    home = getattr(value, "__module__", None) or getattr(value, "__name__", "")
    ours = str(home).startswith("drivewright") and isinstance(value, (ModuleType, type, FunctionType))
    return sentence((value.__doc__ or "").strip().split("\n\n")[0]) if ours else ""
