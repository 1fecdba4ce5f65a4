"""Another bought part with which a failed check passes: of the list that its field is chosen from, verified by a run."""

import time
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from drivewright import runner
from drivewright.errors import DrivewrightError
from drivewright.result import Check, Result
from drivewright.studio import part_lists
from drivewright.studio.design import Design
from drivewright.studio.form import form
from drivewright.studio.input_parsing import value_in, with_part
from drivewright.studio.jobs.design_keys import is_locked
from drivewright.studio.jobs.progress import Progress

MOST = 10  # parts that are tried


class Place(NamedTuple):
    """A field that names a bought part: its key, the list, the part, and the keys beside it that stand in place of the part's own."""

    key: str
    parts: str
    part: str
    overrides: tuple[str, ...]


def places(design: Design) -> list[Place]:
    """The fields of a design that name a part of a list."""
    fields = [field for group in form(design)["groups"] for field in group["fields"] if field["list"] and field["given"] and field["value"]]
    return [
        Place(
            field["key"],
            field["list"],
            str(field["value"]),
            tuple(".".join([*field["key"].split(".")[:-1], name]) for name in field["overrides"]),
        )
        for field in fields
    ]


def other_part(
    design: Design, result: Result[Any], failed: Check, progress: Progress, seconds: float, locks: Sequence[str]
) -> tuple[Place, str, Result[Any]] | None:
    """(place, part, its run) of the first stronger part with which the check, and what passed before, pass; else the first with which the
    check passes; None where there is none among those that the check concerns."""
    deadline, fallback = time.monotonic() + seconds, None
    passed = {check.name for check in result.checks if check.ok}
    for place, part in _candidates(design, failed, locks):
        if time.monotonic() > deadline:
            break
        progress(0, 0, f"{part} is being computed")
        tried = _run(design, place, part)
        fine = {check.name for check in tried.checks if check.ok} if tried else set()
        if tried is None or failed.name not in fine:
            continue
        if passed <= fine | (passed - {check.name for check in tried.checks}):
            return place, part, tried
        fallback = fallback or (place, part, tried)
    return fallback


def _candidates(design: Design, failed: Check, locks: Sequence[str]) -> Iterator[tuple[Place, str]]:
    for place in places(design):
        name = value_in(design.tables, ".".join([*place.key.split(".")[:-1], "name"]))
        if name in failed.parts and not any(is_locked(design.tables, key, locks) for key in (place.key, *place.overrides)):
            yield from ((place, part) for part in part_lists.stronger(place.parts, place.part)[:MOST])


def _run(design: Design, place: Place, part: str) -> Result[Any] | None:
    """The run of a design with another part, None where it has no whole answer."""
    try:
        tried = runner.run(design.with_tables(with_part(design, place.key, part)).spec_on_screen())
    except DrivewrightError:
        return None
    return tried if tried.outcome == "complete" else None
