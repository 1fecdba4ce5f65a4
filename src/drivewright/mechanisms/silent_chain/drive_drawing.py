"""What the keys of a drive's layout measure: places and slides of sprockets, guides and tensioners, counted from the driving sprocket."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from drivewright.chains.model import Slide
from drivewright.dimensions import Angle, Dimension, Length, Radius, body_of, circles_of, origin_of
from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.mechanisms.silent_chain.chain_drive import bare_drive
from drivewright.mechanisms.silent_chain.scene import scene
from drivewright.scene import Arc, Body, Point, Scene, Shape, circle

DRIVER: Point = (0.0, 0.0)
PIVOT = 3e-3  # radius of a pivot as drawn [m]


def laid_out(model: ChainModel) -> Scene:
    """The drive with its tensioners at the given positions, from which the keys count, and their pivots."""
    whole = scene(model)
    given = {each.name: each for each in (*model.spec.sprockets, *model.spec.guides)}
    bodies = [
        replace(body, poses=body.poses * (0, 0, 1) + (*given[body.name].centre, 0)) if body.name in given else body for body in whole.bodies
    ]
    for name, each in given.items():
        if each.pivot:
            pin = Shape("body", circle(each.pivot, PIVOT))
            bodies.append(Body(f"pivot {name}", f"pivot of {name}", (pin,), np.zeros_like(whole.bodies[0].poses), "ground"))
    return replace(whole, bodies=tuple(bodies))


def slide_dimensions(model: ChainModel, scene: Scene) -> Iterator[Dimension]:
    """A tensioning sprocket and a tensioning rail on slides between fixed shafts."""
    sprocket, guide = _slides(model)
    idler, (_, bore) = origin_of(scene, "idler"), circles_of(scene, "driven", "hole")[0]
    yield Length("driven.centre_distance", origin_of(scene, "drive"), origin_of(scene, "driven"), 0.34)
    yield Radius("cutter.bore", origin_of(scene, "driven"), bore, np.radians(-40), diameter=True)
    yield from _from_driver("sprockets.idler.centre", idler, 0.24, -0.14)
    yield from _on_slide("sprockets.idler", idler, sprocket)
    yield from _rail("guides.rail", scene, "rail")
    arc = _face(scene, "rail")
    middle, (x, y) = arc.start + 0.5 * arc.sweep, origin_of(scene, "rail")
    yield from _on_slide("guides.rail", (x + arc.radius * float(np.cos(middle)), y + arc.radius * float(np.sin(middle))), guide)


def pivot_dimensions(model: ChainModel, scene: Scene) -> Iterator[Dimension]:
    """A tensioning sprocket and a tensioning rail about pivots."""
    _, guide = _slides(model)
    idler, rail = ((circles_of(scene, f"pivot {name}", "body")[0][0]) for name in ("idler", "rail"))
    yield from _from_driver("sprockets.idler.pivot", idler, 0.2, 0.08)
    yield from _from_driver("guides.rail.pivot", rail, -0.34, -0.08)
    arc, (x, y) = _face(scene, "rail"), origin_of(scene, "rail")
    middle = arc.start + 0.5 * arc.sweep
    way = np.array([x + arc.radius * np.cos(middle) - rail[0], y + arc.radius * np.sin(middle) - rail[1]])
    end = np.array(rail) + abs(guide.lever) * way / np.hypot(*way)
    yield Length("guides.rail.lever", rail, (float(end[0]), float(end[1])))


def _slides(model: ChainModel) -> tuple[Slide, Slide]:
    """Slides of the idler and of the rail."""
    drive = bare_drive(model)
    sprocket, guide = drive.sprockets[2].slide, drive.guides[0].slide
    assert sprocket is not None and guide is not None
    return sprocket, guide


def _from_driver(key: str, point: Point, first: float, second: float) -> Iterator[Dimension]:
    """x and y of a point, with what its two lines of measure lie aside."""
    yield Length(f"{key}.0", DRIVER, (point[0], 0.0), first, times=float(np.sign(point[0])))
    yield Length(f"{key}.1", (point[0], 0.0), point, second, times=float(np.sign(point[1])))


def _on_slide(key: str, place: Point, slide: Slide) -> Iterator[Dimension]:
    """How far and in which direction a place may move."""
    way = complex(slide.shift(complex(*place), slide.travel[1]))
    yield Length(f"{key}.travel", place, (place[0] + way.real, place[1] + way.imag))
    yield Angle(f"{key}.direction", place, 0.0, float(np.angle(way)), 0.08)


def _face(scene: Scene, name: str) -> Arc:
    """The arc of a rail that the plates slide on, about the rail's own origin."""
    arcs = (piece for shape in body_of(scene, name).shapes for piece in shape.outline.pieces if isinstance(piece, Arc))
    return max(arcs, key=lambda arc: arc.radius)


def _rail(key: str, scene: Scene, name: str) -> Iterator[Dimension]:
    """Centre, radius and ends of the arc of a rail."""
    centre, face = origin_of(scene, name), _face(scene, name)
    yield from _from_driver(f"{key}.centre", centre, -0.2, -0.06)
    yield Radius(f"{key}.radius", centre, face.radius, face.start + 0.75 * face.sweep)
    yield Angle(f"{key}.start", centre, 0.0, face.start, 0.16)
    yield Angle(f"{key}.end", centre, 0.0, face.start + face.sweep, 0.1)


_DRIVE = ("joint.pin_diameter=3.28 mm", 'drive={speed="720 rpm",load_torque="8 N m"}', 'driven={centre_distance="317 mm",mass="0.5 kg"}')
_IDLER = (
    '{name="idler",teeth=15,side="outside",force="40 N",stiffness="2 N/mm",direction="-90 deg",travel="15 mm",centre=["130 mm","32 mm"]'
)
_RAIL = (
    '{name="rail",side="outside",centre=["160 mm","-164 mm"],radius="120 mm",start="65 deg",end="115 deg",force="100 N",'
    'stiffness="1000 N/mm",direction="90 deg",travel="10 mm"'
)
ON_SLIDES = (*_DRIVE, "cutter.bore=30 mm", f"sprockets=[{_IDLER}}}]", f"guides=[{_RAIL}}}]")
ON_PIVOTS = (*_DRIVE, f'sprockets=[{_IDLER},pivot=["70 mm","75 mm"]}}]', f'guides=[{_RAIL},pivot=["60 mm","-80 mm"],lever="80 mm"}}]')
