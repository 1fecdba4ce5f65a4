"""Sizes of a chain drive that a hand can move on the drawing: sprockets, guides, the number of links, the heights of a plate.

Numbers of teeth and links are whole: their handles move in steps.  All but those of a plate stand in the machine frame.
"""

from collections.abc import Iterator

import numpy as np

from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.scene import Handle, xy

BESIDE = 0.2  # of the pitch: how far beside the middle of a plate the handle of its toes stands from its own toe's root


def handles(model: ChainModel) -> Iterator[Handle]:
    """Handles of driving and driven sprocket, of further sprockets and guides, and of the first link."""
    yield from _sprockets(model)
    for number, given in enumerate(model.spec.sprockets):
        yield from _further(model, f"sprockets.{number}", given)
    for number, given in enumerate(model.spec.guides):
        yield from _guide(f"guides.{number}", given)
    if model.roller_link is None and not model.link.skew:
        yield from _plate(model)


def _by_teeth(model, teeth):
    """(pitch radius [m], how it grows with a tooth [m])."""
    pitch, half = model.link.pitch, np.pi / teeth
    radius = float(pitch / (2 * np.sin(half)))
    return radius, float(radius * half / (teeth * np.tan(half)))


def _sprockets(model):
    """Teeth at the foot of the driving and, of two, of the driven sprocket; centre distance, or the links that determine it; bore."""
    first, grown = _by_teeth(model, model.teeth[0])
    yield Handle("teeth.0", (-first, 0.0), (-grown, 0.0))
    if model.spec.cutter.bore:
        yield Handle("cutter.bore", (0.0, -model.spec.cutter.bore / 2), (0.0, -0.5))
    if fixed := model.spec.driven.centre_distance:
        yield Handle("driven.centre_distance", (float(fixed), 0.0), (1.0, 0.0))
    elif model.closes:
        yield from _closed(model)


def _closed(model):
    """The driven sprocket of a chain whose length determines where it stands."""
    (first, _), (second, grown), distance = _by_teeth(model, model.teeth[0]), _by_teeth(model, model.teeth[1]), float(model.closure.mean)
    lean = float(np.arcsin((second - first) / distance))  # of the strands against the line of centres
    a_link = model.link.pitch / (2 * np.cos(lean))
    yield Handle("links", (distance, 0.0), (a_link, 0.0))
    yield Handle("teeth.1", (distance, -second), (-a_link * (0.5 + lean / np.pi), -grown))


def _further(model, key, given):
    """Centre of a further sprocket; its teeth at its foot."""
    radius, grown = _by_teeth(model, given.teeth)
    x, y = given.centre
    yield Handle(f"{key}.centre", (x, y))
    yield Handle(f"{key}.teeth", (x, y - radius), (0.0, -grown))
    yield from _pivot(key, given)


def _guide(key, given):
    """Centre of a rail's arc, its radius in the middle of the arc, its ends."""
    centre, middle = complex(*given.centre), np.exp(0.5j * (given.start + given.end))
    yield Handle(f"{key}.centre", xy(centre))
    yield Handle(f"{key}.radius", xy(centre + given.radius * middle), xy(middle))
    for end in ("start", "end"):
        out = given.radius * np.exp(1j * getattr(given, end))
        yield Handle(f"{key}.{end}", xy(centre + out), xy(1j * out))
    yield from _pivot(key, given)


def _pivot(key, given):
    if given.pivot:
        yield Handle(f"{key}.pivot", (given.pivot[0], given.pivot[1]))


def _plate(model):
    """Heights of a plate where they are given."""
    given = model.spec.plate
    for name, x in (("back", 0.0), ("crotch", 0.0), ("toe", (0.5 - BESIDE) * model.link.pitch)):
        if (height := getattr(given, name)) is not None:
            yield Handle(f"plate.{name}", (x, height), (0.0, 1.0), "link0")
