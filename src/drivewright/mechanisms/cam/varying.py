"""What a design needs besides, so that the angles of its segments may vary."""

from collections.abc import Collection, Mapping
from copy import deepcopy
from typing import Any


def free_rest(tables: Mapping[str, Any], keys: Collection[str]) -> dict[str, Any]:
    """The raw tables with a segment that takes the rest of the turn, where angles of others are among the keys that vary.

    It is the last dwell that keeps its angle, else the last segment; a table of lifts fixes the angle of its own.
    """
    freed = deepcopy(dict(tables))
    segments = freed.get("programme") or []
    varied = {number for number in range(len(segments)) if f"programme.{number}.angle" in keys}
    if not varied or any("angle" not in segment for segment in segments):
        return freed
    kept = [segment for number, segment in enumerate(segments) if number not in varied and segment.get("law") != "table"]
    dwells = [segment for segment in kept if segment.get("law") == "dwell"]
    for segment in (dwells or kept)[-1:]:
        del segment["angle"]
    return freed
