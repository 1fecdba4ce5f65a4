"""The reference of spec files, read off the fields of each kind: every key with its meaning, unit, limits and default."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from pydantic.fields import FieldInfo

from builders.markdown import cell, code, sentence, table, write_page
from drivewright import registry
from drivewright.spec.commented_template import limits_text
from drivewright.spec.fields import dimension_of, has_user_keys, list_depth, table_of
from drivewright.spec.mechanism_spec import MechanismSpec
from drivewright.spec.serialisation import to_plain, toml_value
from drivewright.view.text import unit_text

HEADS = ("key", "meaning", "unit", "allowed", "default")
SHARED_PAGE = "spec-shared.md"


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write docs/reference/spec-KIND.md for each kind, and a page of the tables that all kinds share."""
    for kind in registry.kinds():
        progress(kind)
        write_page(docs / "reference" / f"spec-{kind}.md", _page(kind, docs))
    write_page(docs / "reference" / SHARED_PAGE, _shared_page())


def _page(kind: str, docs: Path) -> Iterator[str]:
    """Lines of the page of a kind."""
    mechanism = registry.mechanism(kind)
    yield from (f"# Spec of `{kind}`", "", sentence(mechanism.summary), "")
    yield f'A file with `mechanism = "{kind}"`; `drivewright new {kind}` writes one with every key, its meaning and its limits as comments.'
    yield "A quantity is text with a unit; the unit below is the one that is shown, any other of the same kind is read too."
    presets = ", ".join(code(name) for name in mechanism.presets())
    yield from ("", f"Presets: {presets}. Theory: [how each number is computed](../theory/{kind}.md).", "")
    yield from _drawings(kind, docs)
    yield from ("## Keys of the spec itself", *_keys(mechanism.spec))
    yield from _tables(mechanism.spec, "", {})
    yield from ("## [optimise] and [study]", "", f"Shared by all kinds: [tables of every spec]({SHARED_PAGE}).")


def _drawings(kind: str, docs: Path) -> Iterator[str]:
    """The dimension drawings of a kind that were copied, under their titles: what its keys measure; all but the first are folded."""
    sheets = [sheet for sheet in registry.mechanism(kind).dimensions if (docs / "img" / "dimensions" / f"{sheet.name}.svg").is_file()]
    for sheet in sheets[:1]:
        yield from (f"![What the main keys measure: {sheet.title}](../img/dimensions/{sheet.name}.svg)", "")
    for sheet in sheets[1:]:
        image = f"![{sheet.title}](../img/dimensions/{sheet.name}.svg)"
        yield from (f'??? note "What the keys measure. {sheet.title}"', "", f"    {image}", "")


def _shared_page() -> Iterator[str]:
    """Lines of the page of what all kinds have in common."""
    yield from ("# Tables of every spec", "", "Every kind of drive has these keys and tables.", "")
    yield from ("## Keys of the spec itself", *_keys(MechanismSpec))
    for name, field in MechanismSpec.model_fields.items():
        if inner := table_of(field.annotation):
            yield from _section(name, field, inner)
            yield from _tables(inner, f"{name}.", {})


def _tables(model: type[Any], path: str, described: dict[Any, str]) -> Iterator[str]:
    """A section for each table below a table class; a class that was described before is referred to."""
    for name, field in model.model_fields.items():
        inner = table_of(field.annotation)
        if inner is None or (not path and name in MechanismSpec.model_fields):
            continue
        place = f"{path}{name}{'.NAME' if has_user_keys(field.annotation) else ''}"
        if inner in described:
            yield from (f"## {_heading(place, field)}", "", sentence(field.description or inner.__doc__ or ""), "")
            yield from (f"Its keys are those of `{described[inner]}`.", "")
            continue
        described[inner] = _heading(place, field)
        yield from _section(place, field, inner)
        yield from _tables(inner, f"{place}.", described)


def _section(place: str, field: FieldInfo, inner: type[Any]) -> Iterator[str]:
    """Heading, meaning and keys of one table."""
    yield from (f"## {_heading(place, field)}", "", sentence(field.description or inner.__doc__ or ""))
    if not field.is_required() and field.default is None:
        yield "May be left out."
    yield from _keys(inner)


def _heading(place: str, field: FieldInfo) -> str:
    """How the table is written in a file: "[follower]", "[[segments]]", "[bodies.NAME]"."""
    return f"[[{place}]]" if list_depth(field.annotation) and not has_user_keys(field.annotation) else f"[{place}]"


def _keys(model: type[Any]) -> list[str]:
    """Table of the plain keys of a table class."""
    fields = ((name, field) for name, field in model.model_fields.items() if table_of(field.annotation) is None)
    return table(HEADS, (_row(name, field) for name, field in fields))


def _row(name: str, field: FieldInfo) -> tuple[str, ...]:
    dimension = dimension_of(field)
    unit = unit_text(dimension.display_unit) if dimension else ""
    return code(name), cell(sentence(field.description or "")), cell(unit), cell(limits_text(field)), _default(field)


def _default(field: FieldInfo) -> str:
    """The default as it is written in a file; "required" where the key has to be there, "-" where it is simply left out."""
    if field.is_required():
        return "required"
    if field.default is None or field.default in ((), {}):
        return "-"
    return code(toml_value(to_plain(field.default, dimension_of(field))))
