"""What the keys of an indexer's spec measure."""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from drivewright.dimensions import Dimension, DimensionSheet, Length, Radius, circles_of, corners_of, origin_of
from drivewright.indexing.drivetrain import SplitShaft
from drivewright.mechanisms.indexer.build import IndexerModel, split_shaft
from drivewright.mechanisms.indexer.scene import input_gear, parts
from drivewright.scene import Bar, Body, Frame, Grooved, Outline, Point, Prism, Scene, Shape, circle, polygon, rectangle
from drivewright.shafts import Shaft
from drivewright.shafts.drawing import turned_drawing


def _pin_wheel(model: IndexerModel, scene: Scene) -> Iterator[Dimension]:
    """Wheel, pins and cranks of a pin-wheel drive."""
    wheel, cam = origin_of(scene, "wheel"), origin_of(scene, "cam1")
    pins = circles_of(scene, "wheel", "roller")
    upper = pins[2]
    yield Length("pin_circle_radius", wheel, upper[0], 0.0)
    yield Radius("pin_radius", *pins[3], np.radians(60))
    yield Length("eccentricity", wheel, cam, -0.12)
    yield Length("shaft_spacing", origin_of(scene, "crank1"), origin_of(scene, "crank2"), -0.56)


def _cycloid(model: IndexerModel, scene: Scene) -> Iterator[Dimension]:
    """Pins, cams and cranks of a cycloid reducer."""
    wheel, cam = origin_of(scene, "wheel"), origin_of(scene, "cam1")
    pins = circles_of(scene, "wheel", "roller")
    yield Length("pin_circle_radius", wheel, pins[len(pins) // 4 - 1][0])
    yield Radius("pin_radius", *pins[len(pins) // 2 - 1], np.radians(150))
    yield Length("eccentricity", wheel, cam, -0.2)
    yield Length("shaft_spacing", origin_of(scene, "crank1"), origin_of(scene, "crank2"), -0.56)


def _gear_alone(model: IndexerModel) -> Scene:
    """The gear as it is cut."""
    (gear,) = input_gear(model)
    return _single("gear", gear.shapes)


def _single(name: str, shapes: tuple[Shape, ...]) -> Scene:
    """A scene of one body that stands still."""
    still = np.zeros((2, 3))
    return Scene(
        np.array([0.0, 1.0]), "", "-", 1.0, (Body(name, name, shapes, still, "blue"),), (Frame("machine", "machine frame", still),)
    )


def _gear(model: IndexerModel, scene: Scene) -> Iterator[Dimension]:
    """The pitch circle is as many modules across as there are teeth."""
    gear = model.spec.gear
    assert gear is not None, "the sheet is that of designs with a gear"
    ((centre, radius),) = set(circles_of(scene, "gear", "pitch"))
    left, right = ((centre[0] + side * radius, centre[1]) for side in (-1, 1))
    yield Length("gear.module", left, right, -0.56, times=gear.teeth)
    yield Radius("shafts.diameters.0", *circles_of(scene, "gear", "hole")[0], np.radians(60), diameter=True)


def _shaft_alone(model: IndexerModel) -> Scene:
    """A split shaft by its stretches, from the gear on the left to the rear support."""
    split = _shaft(model)
    turned = Shaft(split.sections, split.modulus, split.poisson, density=0.0, supports=())
    return _single("shaft", tuple(turned_drawing(turned).shapes))


def _shaft(model: IndexerModel) -> SplitShaft:
    """The stepped shaft of a design that has one."""
    assert model.spec.shafts is not None, "the sheet is that of designs with a split shaft"
    return split_shaft(model.spec.shafts, model.spec.cams)


def _split_shaft(model: IndexerModel, scene: Scene) -> Iterator[Dimension]:
    """Lengths from the gear over front support and cams to the rear support, and the diameters over them."""
    split = _shaft(model)
    corners = corners_of(scene, "shaft", "profile")
    top = max(y for _, y in corners)
    places = (split.gear, split.supports[0], split.cams[0], split.cams[1], split.supports[1])
    for name, start, end, aside in (
        ("overhang", places[0], places[1], 0.1),
        ("front", places[1], places[2], 0.24),
        ("pitch", places[2], places[3], 0.24),
        ("rear", split.cams[-1], places[4], 0.1),
    ):
        yield Length(f"shafts.{name}", (start, top), (end, top), aside)
    for number, (start, end) in enumerate(pairwise(places)):
        radius = max(y for x, y in corners if start - 1e-9 <= x <= end + 1e-9 and _reaches(corners, y, start, end))
        yield Length(f"shafts.diameters.{number}", ((start + end) / 2, -radius), ((start + end) / 2, radius))


def _reaches(corners: list[Point], y: float, start: float, end: float) -> bool:
    """Whether the edge at a height runs from start to end."""
    return all(any(abs(x - at) < 1e-9 and abs(height - y) < 1e-9 for x, height in corners) for at in (start, end))


def _plates_cut(model: IndexerModel) -> Scene:
    """The plate cams cut along the wheel's axis, which runs to the right, from their solids."""
    cams = [part for part in parts(model) if part.name.startswith("cam")]
    shapes = (Shape("profile", _cut(prism)) for part in cams for prism in part.solids if isinstance(prism, Prism))
    return _single("cams", tuple(shapes))


def _cut(prism: Prism) -> Outline:
    """A plate seen from its edge."""
    y = prism.outline.points()[:, 1]
    return rectangle((prism.z + prism.thickness / 2, float(y.min() + y.max()) / 2), prism.thickness, float(np.ptp(y)))


def _widths(model: IndexerModel, scene: Scene) -> Iterator[Dimension]:
    corners = corners_of(scene, "cams", "profile")
    x = sorted({round(each, 9) for each, _ in corners})
    top = max(y for each, y in corners if abs(each - x[0]) < 1e-8)
    yield Length("cam_width", (x[0], top), (x[1], top), 0.08)
    yield Length("shafts.pitch", (x[0], -top), (x[2], -top), -0.1)


def _parallel(model: IndexerModel, scene: Scene) -> Iterator[Dimension]:
    """Wheel and cams of a parallel drive."""
    wheel, cam = origin_of(scene, "wheel"), origin_of(scene, "cam1")
    pins = circles_of(scene, "wheel", "roller")
    pin = max(pins, key=lambda each: each[0][1])
    yield Length("centre_distance", wheel, cam, -0.5)
    yield Length("pin_circle_radius", wheel, pin[0], 0.0)
    yield Radius("pin_radius", *pin, np.radians(60))


def _plan(model: IndexerModel) -> Scene:
    """A drive with a globoidal or barrel cam seen along the wheel's axis: wheel, rollers and the cam's blank cut, from their solids."""
    cam, turret = parts(model)
    still = np.zeros((2, 3))
    (blank,) = (solid for solid in cam.solids if isinstance(solid, Grooved))
    halves = tuple(Shape("profile", blank.section.transformed((0.0, 0.0, 0.0), mirror)) for mirror in (False, True))
    discs = tuple(_flat(solid) for solid in turret.solids if isinstance(solid, Prism))
    rollers = tuple(Shape("roller", _strip(solid)) for solid in turret.solids if isinstance(solid, Bar))
    bodies = (
        Body("cam", "cam", halves, still + cam.pose, "blue"),
        Body("wheel", "wheel with rollers", (*discs, *rollers), still, "orange"),
    )
    return Scene(np.array([0.0, 1.0]), "", "-", 1.0, bodies, (Frame("machine", "machine frame", still),))


def _flat(solid: Prism) -> Shape:
    """A disc of the wheel, or a roller that stands on it, seen along the wheel's axis."""
    return Shape("body" if _around_the_axis(solid) else "roller", solid.outline)


def _around_the_axis(solid: Prism) -> bool:
    return bool(np.allclose(solid.outline.points().mean(axis=0), 0.0, atol=1e-4))


def _side(model: IndexerModel) -> Scene:
    """A barrel drive seen along the cam's axis, the wheel's axis up, from the solids of both."""
    cam, turret = parts(model)
    still = np.zeros((2, 3))
    (blank,) = (solid for solid in cam.solids if isinstance(solid, Grooved))
    outer = float(blank.section.points()[:, 1].max())
    upright = tuple(_upright(solid) for solid in turret.solids if isinstance(solid, Prism))
    bodies = (
        Body("cam", "cam", (Shape("profile", circle((0.0, 0.0), outer)),), still + (cam.pose[0], blank.z, 0.0), "blue"),
        Body("wheel", "wheel with rollers", upright, still, "orange"),
    )
    return Scene(np.array([0.0, 1.0]), "", "-", 1.0, bodies, (Frame("machine", "machine frame", still),))


def _upright(solid: Prism) -> Shape:
    """A disc or a roller seen from the side."""
    x = solid.outline.points()[:, 0]
    middle = (float(x.min() + x.max()) / 2, solid.z + solid.thickness / 2)
    return Shape("body" if _around_the_axis(solid) else "roller", rectangle(middle, float(np.ptp(x)), solid.thickness))


def _barrel(model: IndexerModel, scene: Scene) -> Iterator[Dimension]:
    """Wheel and cylindrical cam, seen along the wheel's axis."""
    wheel, cam = origin_of(scene, "wheel"), origin_of(scene, "cam")
    pins = sorted(circles_of(scene, "wheel", "roller"), key=lambda pin: pin[0])
    upper = max(pins, key=lambda pin: (pin[0][1], pin[0][0]))
    ends = sorted(corners_of(scene, "cam", "profile"), key=lambda corner: (corner[1], -corner[0]))
    right = max(x for x, _ in ends)
    yield Length("centre_distance", wheel, cam, -0.62)
    yield Length("pin_circle_radius", wheel, upper[0])
    yield Radius("pin_radius", *pins[0], np.radians(150))
    yield Length("cam_length", (right, ends[0][1]), (right, ends[-1][1]), -0.1)


def _barrel_side(model: IndexerModel, scene: Scene) -> Iterator[Dimension]:
    """The rollers' length and the cam's radius, seen along the cam's axis."""
    wheel, cam = origin_of(scene, "wheel"), origin_of(scene, "cam")
    ((_, outer),) = set(circles_of(scene, "cam", "profile"))
    corners = corners_of(scene, "wheel", "roller")
    tip, right = max(y for _, y in corners), max(x for x, _ in corners)
    rim = cam[1] - outer
    middle = (cam[0], (tip + rim) / 2)
    first = min(np.array(corners).reshape(-1, 4, 2), key=lambda roller: roller[:, 0].min())
    left, width = (float(bound(first[:, 0])) for bound in (np.min, np.max))
    yield Length("cam_radius", cam, middle)
    yield Length("pin_length", (right, rim), (right, tip), -0.3)
    yield Length("pin_radius", (left, tip), (width, tip), 0.1, times=2)
    yield Length("centre_distance", (wheel[0], cam[1]), cam, 0.35)


def _strip(bar: Bar) -> Outline:
    """A bar seen from above."""
    start, end = np.array(bar.start), np.array(bar.end)
    along = (end - start) / np.hypot(*(end - start))
    side = bar.diameter / 2 * np.array([-along[1], along[0]])
    return polygon([start - side, end - side, end + side, start + side])


def _globoidal(model: IndexerModel, scene: Scene) -> Iterator[Dimension]:
    """Rollers that stand radially on the wheel, between the ribs of an hourglass-shaped cam."""
    wheel, cam = origin_of(scene, "wheel"), origin_of(scene, "cam")
    ((_, throat),) = {arc for arc in circles_of(scene, "cam", "profile") if np.hypot(*arc[0]) < 1e-9}
    corners = np.array(corners_of(scene, "wheel", "roller")).reshape(-1, 4, 2)
    first = corners[np.argmin(np.abs(np.arctan2(*corners.mean(axis=1).T[::-1])))]
    tip = first[1:3].mean(axis=0)
    reach = float(np.hypot(*tip))
    foot, middle = (tuple((tip * length / reach).tolist()) for length in (throat, (throat + reach) / 2))
    ends = sorted(corners_of(scene, "cam", "profile"), key=lambda corner: corner[1])
    third = corners[len(corners) // 4]
    yield Length("centre_distance", wheel, cam, -0.42)
    yield Length("pin_circle_radius", wheel, middle)
    yield Length("pin_length", foot, tuple(tip.tolist()), 0.12)
    yield Length("pin_radius", tuple(third[1].tolist()), tuple(third[2].tolist()), -0.06, times=2)
    yield Length("cam_length", (ends[0][0], ends[0][1]), (ends[0][0], ends[-1][1]), -0.3)


SPLIT = ("shafts.overhang=20 mm", "shafts.front=30 mm", "shafts.rear=40 mm")
BARREL = ("centre_distance=90 mm",)

SHEETS = (
    DimensionSheet("indexer", "Pin-wheel indexer", "default", _pin_wheel, left_out=("normal", "pitch_point"), variant=("kind",)),
    DimensionSheet("indexer-parallel", "Parallel indexer", "parallel", _parallel, left_out=("normal", "pitch_point"), variant=("kind",)),
    DimensionSheet("indexer-cycloid", "Cycloid pin reducer", "cycloid", _cycloid, left_out=("normal", "pitch_point"), variant=("kind",)),
    DimensionSheet("indexer-barrel", "Barrel drive, along the wheel's axis", "barrel", _barrel, BARREL, scene=_plan, variant=("kind",)),
    DimensionSheet(
        "indexer-barrel-side", "Barrel drive, along the cam's axis", "barrel", _barrel_side, BARREL, scene=_side, variant=("kind",)
    ),
    DimensionSheet("indexer-gear", "Gear of input and split shafts", "default", _gear, scene=_gear_alone, variant=("gear",)),
    DimensionSheet(
        "indexer-shaft", "Split shaft of a pin-wheel indexer", "default", _split_shaft, SPLIT, scene=_shaft_alone, variant=("shafts",)
    ),
    DimensionSheet("indexer-section", "Plate cams, cut along their axis", "default", _widths, scene=_plates_cut, variant=("kind",)),
    DimensionSheet("indexer-globoidal", "Globoidal indexer", "globoidal", _globoidal, scene=_plan, variant=("kind",)),
)
