"""The design of one browser tab with its locks, and every way to change it.

A change that is refused raises SpecError in the words of the command line and leaves everything as it was.
"""

from collections.abc import Mapping, Sequence
from copy import deepcopy
from typing import Any

from drivewright import registry
from drivewright.errors import InputError, SpecError, brief
from drivewright.spec import set_key
from drivewright.spec.keys import remove_key
from drivewright.studio.design import Design, Tables
from drivewright.studio.field_info import ABSENT, FieldInfo, field_info_at
from drivewright.studio.form import form, values
from drivewright.studio.input_parsing import (
    enter_text,
    form_key,
    insert_parents,
    keys_overlap,
    normalised,
    parent_exists,
    remove_empty_tables,
    spec_class,
    validated_spec,
    value_in,
    with_part,
)
from drivewright.studio.opening import LARGEST
from drivewright.studio.proposals import search_table, varied_keys
from drivewright.studio.sample_values import first_valid_design, sample_values_for, unused_name, with_unused_name
from drivewright.studio.sliders import tidied
from drivewright.studio.undo_history import UndoHistory

FARTHEST = 1e6  # m: what is clicked lies nearer


class Document(UndoHistory):
    """The design of a tab, which is always valid, with the keys that are locked."""

    def __init__(self, design: Design, name: str = "") -> None:
        super().__init__(normalised(design))
        self.name = name
        self.locks: frozenset[str] = frozenset()

    def _step(self, source: list[Design], target: list[Design]) -> None:
        super()._step(source, target)
        self.locks &= values(form(self.design)).keys()  # of what is no longer there

    def follow(self, change: str, after: "Document") -> None:
        """Take over what a change has made of `present()` in another process; `change` is the name of the method."""
        self._follow_steps(change, after)
        self.locks = after.locks

    def _accept(self, design: Design, gesture: tuple[str, str] | None = None) -> None:
        """The next design, unless it is refused; a step of the same gesture as the one before goes into the same undo step."""
        if self.locks and design.kind == self.design.kind:
            self._refuse_locked(design)
        validated_spec(design)
        self._take(design, gesture)

    # -- locks -----------------------------------------------------------------------------------------------------------------

    def lock(self, key: str, on: bool) -> None:
        """Hold a key against every change but undo and redo, or let it go."""
        key = form_key(self.design.tables, key)
        if on and key not in values(form(self.design)):
            raise SpecError("is no field of this design, so it cannot be locked", key)
        self.locks = self.locks | {key} if on else self.locks - {key}

    def _refuse_locked(self, design: Design) -> None:
        for lock in sorted(self.locks):
            if not parent_exists(design, lock) or value_in(design.tables, lock) != value_in(self.design.tables, lock):
                raise SpecError("is locked, and this would change it; unlock it first", lock)

    def _keeping_locked(self, design: Design) -> Design:
        """Another design of the same kind with the locked values of this one."""
        tables, model = deepcopy(design.tables), spec_class(design)
        for lock in sorted(self.locks):
            value = value_in(self.design.tables, lock)
            try:
                if value is not ABSENT:
                    insert_parents(tables, model, lock.split("."))
                    set_key(tables, lock, deepcopy(value))
                elif value_in(tables, lock) is not ABSENT:
                    remove_key(tables, lock)
            except SpecError as error:
                raise SpecError(f"is locked, and the new design has no place for it ({error.message}); unlock it first", lock) from None
        return design.with_tables(tables)

    # -- changes ---------------------------------------------------------------------------------------------------------------

    def set(self, key: str, text: str, gesture: str = "") -> None:
        """One key from typed text; the empty text takes it out.  Steps with the same `gesture` (one drag) on a key are one undo step."""
        key = form_key(self.design.tables, key)
        if not text.strip():
            return self.unset(key)
        tables = deepcopy(self.design.tables)
        enter_text(tables, spec_class(self.design), key, tidied(text) if gesture else text)
        return self._accept(self.design.with_tables(tables), (key, gesture) if gesture else None)

    def pick(self, key: str, text: str) -> None:
        """A part by its name; values beside it that stood in place of what the part before has of its own go with that one."""
        self._accept(self.design.with_tables(with_part(self.design, form_key(self.design.tables, key), text)))

    def drag(self, changes: Mapping[str, str], gesture: str) -> None:
        """Keys that a handle moves, {key: typed text}; the steps of one drag are one undo step."""
        tables, model = deepcopy(self.design.tables), spec_class(self.design)
        keys = [form_key(tables, key) for key in changes]
        for key, text in zip(keys, changes.values(), strict=True):
            enter_text(tables, model, key, tidied(text))
        self._accept(self.design.with_tables(tables), (" ".join(keys), gesture))

    def load(self, changes: Mapping[str, str]) -> None:
        """Several keys, {key: typed text}, as one step; locked ones stay."""
        tables, model = deepcopy(self.design.tables), spec_class(self.design)
        for key, text in changes.items():
            key = form_key(tables, key)
            if not any(keys_overlap(key, lock) for lock in self.locks):
                enter_text(tables, model, key, text)
        self._accept(self.design.with_tables(tables))

    def unset(self, key: str) -> None:
        """A key back to its default, or out; a part of a point back to the default of that part."""
        tables, key = deepcopy(self.design.tables), form_key(self.design.tables, key)
        *above, last = key.split(".")
        point = field_info_at(spec_class(self.design), above) if above else None
        if point and point.fixed and not point.table:
            self._unset_part(tables, point, key, last)
        elif value_in(tables, key) is not ABSENT:
            remove_key(tables, key)
            remove_empty_tables(tables, spec_class(self.design), above)
        self._accept(self.design.with_tables(tables))

    def _unset_part(self, tables: Tables, point: FieldInfo, key: str, last: str) -> None:
        default = point.items[int(last)].default if last.isdecimal() and int(last) < len(point.items) else None
        if default is not None:
            insert_parents(tables, spec_class(self.design), key.split("."))
            set_key(tables, key, default)
        elif point.required:
            raise SpecError(f"wants a value; there are always {len(point.items)} of them", key)
        elif value_in(tables, above := key.rpartition(".")[0]) is not ABSENT:
            remove_key(tables, above)

    def replace(self, design: Design) -> None:
        """Another design: a preset, a file.  Of the same kind, it takes over what is locked."""
        design = normalised(design)
        if design.kind == self.design.kind:
            return self._accept(self._keeping_locked(design))
        self.locks = frozenset()
        return self._accept(design)

    def text(self, toml: str) -> None:
        """The whole design as edited text; SpecError with the line where it is not TOML."""
        design = normalised(self.design.with_text(toml))
        if design.kind != self.design.kind:
            self.locks = frozenset()
        self._accept(design)

    def write(self, name: str, content: Mapping[str, Any]) -> None:
        """The table "optimise" or "study" as its form has it; what the form does not show stays."""
        tables = deepcopy(self.design.tables)
        tables[name] = search_table(self.design, name, content)
        if prepare := registry.mechanism(self.design.kind).before_varying:
            tables = prepare(tables, varied_keys(tables, name))
        self._accept(self.design.with_tables(tables))

    def construct(self, tool: str, places: Sequence[tuple[float, float]], near: float) -> None:
        """One use of a tool of the kind's `Construction` at places of the drawing [m]."""
        construction = registry.mechanism(self.design.kind).construction
        known = {each.name: each for each in construction.tools} if construction else {}
        if construction is None or tool not in known:
            raise InputError(f"{self.design.kind} is not built with {brief(tool)}")
        fewest, most = known[tool].fewest, known[tool].most
        if not fewest <= len(places) <= most or not 0 < near < FARTHEST or any(len(place) != 2 for place in places):
            raise InputError(f"{tool} takes {fewest} to {most} places (x, y)")
        exact = [(float(x), float(y)) for x, y in places]
        if not all(abs(part) <= FARTHEST for place in exact for part in place):
            raise InputError("this place is too far away")
        tables = construction.step(self.design.tables, self.design.spec(), tool, exact, float(near))
        self._accept(self.design.with_tables(tables))

    # -- tables and elements ---------------------------------------------------------------------------------------------------

    def add(self, key: str) -> None:
        """A further element of a list, or of a table whose keys the user chooses: a copy of the last one, else a sample."""
        key = form_key(self.design.tables, key)
        info, given = self._several(key)
        if isinstance(given, dict):
            return self.put(f"{key}.{unused_name(next(reversed(given), 'a'), given)}")
        copies = [with_unused_name(given[-1], given)] if given else sample_values_for(self.design, info, key)
        return self._accept(first_valid_design(self.design, f"{key}.{len(given)}", [[*given, element] for element in copies], key))

    def drop(self, key: str, index: int) -> None:
        """An element of a list less."""
        key = form_key(self.design.tables, key)
        _, given = self._several(key)
        if not isinstance(given, list) or not 0 <= int(index) < len(given):
            raise SpecError(f"has no element {index}; it has {len(given)}", key)
        tables = deepcopy(self.design.tables)
        insert_parents(tables, spec_class(self.design), [*key.split("."), str(index)])
        set_key(tables, key, [element for number, element in enumerate(given) if number != int(index)])
        self._accept(self.design.with_tables(tables))

    def arrange(self, key: str, elements: Sequence[Mapping[str, Any]]) -> None:
        """A list of tables with other elements, as one step.

        Each is {"of": number of the element that it was, None for a new one, "changes": {key: typed text; "" takes it out}}.
        """
        key = form_key(self.design.tables, key)
        info, given = self._several(key)
        if not info.table or not isinstance(given, list):
            raise SpecError("is no list of tables", key)
        uses = [element["of"] for element in elements if element["of"] is not None]
        if any(uses.count(number) > 2 for number in set(uses)):
            raise SpecError("an element stands in the list more than twice; the page may send each one twice at most", key)
        tables = deepcopy(self.design.tables)
        insert_parents(tables, spec_class(self.design), [*key.split("."), "0"])
        set_key(tables, key, [_arranged(info.table, given, key, **element) for element in elements])
        design = self.design.with_tables(tables)
        if len(design.toml()) > max(LARGEST, len(self.design.toml())):
            raise SpecError("is too much for the studio with these elements", key)
        self._accept(design)

    def put(self, key: str) -> None:
        """An optional table, or an entry of a table whose keys the user chooses ("bodies.NAME"), with what it needs."""
        *above, name = key.split(".")
        info = field_info_at(spec_class(self.design), above) if above else None
        if value_in(self.design.tables, key) is not ABSENT:
            return None
        if info and info.kind == "names":
            given = value_in(self.design.tables, ".".join(above))
            last = list(given.values())[-1:] if isinstance(given, dict) else []
            return self._accept(first_valid_design(self.design, key, last or sample_values_for(self.design, info, key), key))
        info = field_info_at(spec_class(self.design), key.split("."))
        if info is None or not info.table or info.levels:
            raise SpecError("is no table that could be put in", key)
        return self._accept(first_valid_design(self.design, key, sample_values_for(self.design, info, key), key))

    def take(self, key: str) -> None:
        """An optional table, or an entry that the user has named, out."""
        self.unset(key)

    def _several(self, key: str) -> tuple[FieldInfo, Any]:
        """(FieldInfo, raw elements) of a list, or of a table whose keys the user chooses."""
        info = field_info_at(spec_class(self.design), key.split("."))
        if info is None or not info.levels:
            raise SpecError("is no list, so it has no elements", key)
        given = value_in(self.design.tables, key)
        return info, deepcopy(given if given is not ABSENT else info.initial_value or ({} if info.kind == "names" else []))


def _arranged(model, given, key, of, changes):
    """The raw table of an element that `Document.arrange` is asked for."""
    if of is not None and not (isinstance(of, int) and 0 <= of < len(given)):
        raise SpecError(f"has no element {of}; it has {len(given)}", key)
    table = {} if of is None else deepcopy(given[of])
    for name, text in changes.items():
        if text.strip():
            enter_text(table, model, name, text)
        elif value_in(table, name) is not ABSENT:
            remove_key(table, name)
    return table
