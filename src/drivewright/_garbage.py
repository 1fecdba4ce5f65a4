"""How often Python looks for unused cycles of objects in a process that is ours alone: a command, a worker."""

import gc

NEW_OBJECTS = 100_000  # between two looks (700 is Python's own choice): a start makes a million objects that all stay


def collect_rarely() -> None:
    """Look for cycles after as many new objects as take some ten megabytes: a start takes a twentieth less time."""
    gc.set_threshold(NEW_OBJECTS, *gc.get_threshold()[1:])
