"""What makes a study another one than that in a folder, key by key."""

from collections.abc import Mapping
from pathlib import Path

from drivewright.errors import SpecError
from drivewright.spec import MechanismSpec, document, load
from drivewright.spec.differences import flat_tables, is_same_entry

TOLD = 8  # differences that are listed
UNSEEN = ("spec", "plan", "study")  # parts of an identity that the keys tell better
UNTOLD = ("title", "units")  # keys that change no number
PROGRAM = "drivewright"  # the part of an identity that is the program's version


def describe_differences(spec_file: str | Path, spec: MechanismSpec, known: Mapping[str, str], identity: Mapping[str, str]) -> str:
    """One line of what is not the same there and here: other parts of the identity first, then key by key."""
    names = [name for name in dict.fromkeys([*known, *identity]) if known.get(name) != identity.get(name) and name not in UNSEEN]
    rows = [_row(name, known, identity) for name in names]
    if PROGRAM not in names:  # another version may have other keys
        rows += differing_keys(spec_file, spec, "plan" in known)
    more = f" and {len(rows) - TOLD} more" if len(rows) > TOLD else ""
    return "; ".join(rows[:TOLD]) + more if rows else "the content of a data file, or the points of the plan, are not the same"


def _row(name, there, here):
    if all(isinstance(each.get(name), str) and Path(each[name]).is_file() for each in (there, here)):
        return f"{name}: the content of the file is not that of the study's copy; a study keeps one content, also where a file was repaired"
    return f"{name}: {there.get(name, 'not given')} there, {here.get(name, 'not given')} here"


def differing_keys(spec_file: str | Path, spec: MechanismSpec, is_sweep: bool) -> list[str]:
    """A row for each key that is not the same in a spec file, if there is one, and here; the title, the units shown, and the keys of a
    search in a sweep or of a sweep in a search, change nothing."""
    idle = "optimise." if is_sweep else "study."
    try:
        if not Path(spec_file).is_file():
            return []
        there, here = flat_tables(document(load(spec_file))), flat_tables(document(spec))
    except SpecError as error:
        return [f"its spec cannot be read ({error})"]
    keys = [key for key in dict.fromkeys([*there, *here]) if key not in UNTOLD and not key.startswith(idle)]
    return [_row(key, there, here) for key in keys if not is_same_entry(there.get(key), here.get(key))]
