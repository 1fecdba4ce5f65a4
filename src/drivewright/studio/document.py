"""The design of one browser tab with its past and future, its locks, and every way to change it.

A change that is refused raises SpecError in the words of the command line and leaves everything as it was.
"""

import re
from copy import deepcopy

from drivewright.errors import SpecError
from drivewright.spec import set_key
from drivewright.spec.keys import remove_key
from drivewright.spec.parsing import parse_document
from drivewright.studio.entering import drop_empty, enter, fill, form_key, has_place, model_of, overlap, settled, valid, value_in
from drivewright.studio.facts import ABSENT, fact_at
from drivewright.studio.fitting import first_fitting, fresh, renamed, samples_for
from drivewright.studio.form import form, values
from drivewright.studio.sliders import tidied

STEPS = 200  # that can be undone
# Absolute paths in a message, but neither units (N m/rad, 1/mm) nor addresses (https://...).
FOLDERS = re.compile(r"""(?<![\w.)\]/])(?:[A-Za-z]:[\\/]+|\\\\|/)(?:[^\s/\\'":,;<>|]+[/\\]+)+(?=[^\s/\\])""")
QUOTED = re.compile(r"""(['"])(?:[A-Za-z]:[\\/]|\\\\|/)[^'"\n]*[\\/]([^'"\\/\n]+)\1""")


class Document:
    """A design that changes step by step.  `design` is the present one; it is always valid, and never changed in place."""

    def __init__(self, design, name=""):
        self.design, self.name = settled(design), name
        self.locks = frozenset()
        self._past, self._future, self._gesture = [], [], None
        self._saved = self.design

    # -- past and future -------------------------------------------------------------------------------------------------------

    @property
    def can_undo(self):
        """Whether there is a step back."""
        return bool(self._past)

    @property
    def can_redo(self):
        """Whether there is a step forward."""
        return bool(self._future)

    @property
    def changed(self):
        """Whether the design is another one than the file has."""
        return self.design.kind != self._saved.kind or self.design.toml() != self._saved.toml()

    def saved(self):
        """The present design is in a file now."""
        self._saved = self.design

    def undo(self):
        """One step back, where there is one."""
        self._step(self._past, self._future)

    def redo(self):
        """One step forward, where there is one."""
        self._step(self._future, self._past)

    def _step(self, source, target):
        if source:
            target.append(self.design)
            self.design, self._gesture = source.pop(), None
            self.locks &= values(form(self.design)).keys()  # of what is no longer there

    def _accept(self, design, gesture=None):
        """The next design, unless it is refused; a step of the same gesture as the one before goes into the same undo step."""
        if self.locks and design.kind == self.design.kind:
            self._refuse_locked(design)
        valid(design)
        if design.toml() == self.design.toml() and design.folder == self.design.folder:
            return
        if gesture is None or gesture != self._gesture:
            self._past = [*self._past[1 - STEPS :], self.design]
        self._future.clear()
        self.design, self._gesture = design, gesture

    # -- locks -----------------------------------------------------------------------------------------------------------------

    def lock(self, key, on):
        """Hold a key against every change but undo and redo, or let it go."""
        key = form_key(self.design.tables, key)
        if on and key not in values(form(self.design)):
            raise SpecError("is no field of this design, so it cannot be locked", key)
        self.locks = self.locks | {key} if on else self.locks - {key}

    def _refuse_locked(self, design):
        for lock in sorted(self.locks):
            if not has_place(design, lock) or value_in(design.tables, lock) != value_in(self.design.tables, lock):
                raise SpecError("is locked, and this would change it; unlock it first", lock)

    def _keeping_locked(self, design):
        """Another design of the same kind with the locked values of this one."""
        tables, model = deepcopy(design.tables), model_of(design)
        for lock in sorted(self.locks):
            value = value_in(self.design.tables, lock)
            try:
                if value is not ABSENT:
                    fill(tables, model, lock.split("."))
                    set_key(tables, lock, deepcopy(value))
                elif value_in(tables, lock) is not ABSENT:
                    remove_key(tables, lock)
            except SpecError as error:
                raise SpecError(f"is locked, and the new design has no place for it ({error.message}); unlock it first", lock) from None
        return design.with_tables(tables)

    # -- changes ---------------------------------------------------------------------------------------------------------------

    def set(self, key, text, gesture=""):
        """One key from typed text; the empty text takes it out.  Steps with the same `gesture` (one drag) on a key are one undo step."""
        key = form_key(self.design.tables, key)
        if not text.strip():
            return self.unset(key)
        tables = deepcopy(self.design.tables)
        enter(tables, model_of(self.design), key, tidied(text) if gesture else text)
        return self._accept(self.design.with_tables(tables), (key, gesture) if gesture else None)

    def load(self, changes):
        """Several keys, {key: typed text}, as one step; locked ones stay."""
        tables, model = deepcopy(self.design.tables), model_of(self.design)
        for key, text in changes.items():
            key = form_key(tables, key)
            if not any(overlap(key, lock) for lock in self.locks):
                enter(tables, model, key, text)
        self._accept(self.design.with_tables(tables))

    def unset(self, key):
        """A key back to its default, or out; a part of a point back to the default of that part."""
        tables, key = deepcopy(self.design.tables), form_key(self.design.tables, key)
        *above, last = key.split(".")
        point = fact_at(model_of(self.design), above) if above else None
        if point and point.fixed and not point.table:
            self._unset_part(tables, point, key, last)
        elif value_in(tables, key) is not ABSENT:
            remove_key(tables, key)
            drop_empty(tables, model_of(self.design), above)
        self._accept(self.design.with_tables(tables))

    def _unset_part(self, tables, point, key, last):
        default = point.items[int(last)].default if last.isdecimal() and int(last) < len(point.items) else None
        if default is not None:
            fill(tables, model_of(self.design), key.split("."))
            set_key(tables, key, default)
        elif point.required:
            raise SpecError(f"wants a value; there are always {len(point.items)} of them", key)
        elif value_in(tables, above := key.rpartition(".")[0]) is not ABSENT:
            remove_key(tables, above)

    def replace(self, design):
        """Another design: a preset, a file.  Of the same kind, it takes over what is locked."""
        design = settled(design)
        if design.kind == self.design.kind:
            return self._accept(self._keeping_locked(design))
        self.locks = frozenset()
        return self._accept(design)

    def text(self, toml):
        """The whole design as edited text; SpecError with the line where it is not TOML."""
        design = settled(self.design.with_tables(parse_document(toml)))
        if design.kind != self.design.kind:
            self.locks = frozenset()
        self._accept(design)

    # -- tables and elements ---------------------------------------------------------------------------------------------------

    def add(self, key):
        """A further element of a list, or of a table whose keys the user chooses: a copy of the last one, else a sample."""
        key = form_key(self.design.tables, key)
        fact, given = self._several(key)
        if isinstance(given, dict):
            return self.put(f"{key}.{fresh(next(reversed(given), 'a'), given)}")
        copies = [renamed(given[-1], given)] if given else samples_for(self.design, fact, key)
        return self._accept(first_fitting(self.design, f"{key}.{len(given)}", [[*given, element] for element in copies], key))

    def drop(self, key, index):
        """An element of a list less."""
        key = form_key(self.design.tables, key)
        _, given = self._several(key)
        if not isinstance(given, list) or not 0 <= int(index) < len(given):
            raise SpecError(f"has no element {index}; it has {len(given)}", key)
        tables = deepcopy(self.design.tables)
        fill(tables, model_of(self.design), [*key.split("."), str(index)])
        set_key(tables, key, [element for number, element in enumerate(given) if number != int(index)])
        self._accept(self.design.with_tables(tables))

    def put(self, key):
        """An optional table, or an entry of a table whose keys the user chooses ("bodies.NAME"), with what it needs."""
        *above, name = key.split(".")
        fact = fact_at(model_of(self.design), above) if above else None
        if value_in(self.design.tables, key) is not ABSENT:
            return None
        if fact and fact.kind == "names":
            given = value_in(self.design.tables, ".".join(above))
            last = list(given.values())[-1:] if isinstance(given, dict) else []
            return self._accept(first_fitting(self.design, key, last or samples_for(self.design, fact, key), key))
        fact = fact_at(model_of(self.design), key.split("."))
        if fact is None or not fact.table or fact.levels:
            raise SpecError("is no table that could be put in", key)
        return self._accept(first_fitting(self.design, key, samples_for(self.design, fact, key), key))

    def take(self, key):
        """An optional table, or an entry that the user has named, out."""
        self.unset(key)

    def _several(self, key):
        """(Fact, raw elements) of a list, or of a table whose keys the user chooses."""
        fact = fact_at(model_of(self.design), key.split("."))
        if fact is None or not fact.levels:
            raise SpecError("is no list, so it has no elements", key)
        given = value_in(self.design.tables, key)
        return fact, deepcopy(given if given is not ABSENT else fact.begun or ({} if fact.kind == "names" else []))


def without_folder(message, *folders):
    """A message without the folders of this machine: "/home/x/y/lift.csv" -> "lift.csv"."""
    for folder in sorted({text for each in folders for text in (str(each), str(each.resolve()))}, key=len, reverse=True):
        message = re.sub(re.escape(folder.rstrip("/\\")) + r"[/\\]+", "", message) if len(folder) > 1 else message
    return FOLDERS.sub("", QUOTED.sub(r"\1\2\1", message))
