"""The cam on screen and for manufacture: scene, plots, drawings, parts."""

from functools import lru_cache

import numpy as np

from drivewright import cams
from drivewright.cams import cam_shapes
from drivewright.cams.follower_shapes import SLIM
from drivewright.mechanisms.cam.build import CamModel, profile
from drivewright.mechanisms.cam.handles import handles
from drivewright.mechanisms.cam.spec import TURN
from drivewright.result import Plot
from drivewright.scene import Body, Drawing, Frame, Part, Prism, Scene, Shape, Trace, circle, polygon, xy

FRAMES = 181
DRAWN = 1e-5  # on screen a profile stays within this part of the cam's size
SURFACES = (("", ""), (".conjugate", ", conjugate cam"), (".outer", ", outer wall"), (".opposite", ", second face"))

PLOTS = (
    Plot("motion", "Lift and its derivatives", "motion", "angle", ("lift", "slope", "bend", "third")),
    Plot("kinematics", "Velocity, acceleration and jerk", "kinematics", "angle", ("velocity", "acceleration", "jerk")),
    Plot("valve", "Motion of the valve", "valve", "angle", ("lift", "velocity", "acceleration")),
    Plot("arm_end", "Motion of the arm end", "arm_end", "angle", ("lift", "velocity", "acceleration")),
    *(
        plot
        for suffix, words in SURFACES
        for plot in (
            Plot(f"pressure_angle{suffix}", f"Pressure angle{words}", f"geometry{suffix}", "angle", ("pressure_angle",)),
            Plot(f"curvature{suffix}", f"Curvature{words}", f"geometry{suffix}", "angle", ("curvature",)),
            Plot(f"undercut{suffix}", f"Undercut ratio{words}", f"undercut{suffix}", "angle", ("ratio",), ((1.0, "undercut above"),)),
        )
    ),
    Plot("load", "Follower force and cam torque", "load", "angle", ("required_force", "torque")),
    *(
        plot
        for suffix, words in SURFACES
        for plot in (
            Plot(
                f"contact{suffix}",
                f"Contact force and speeds{words}",
                f"contact{suffix}",
                "angle",
                ("contact_force", "surface_speed", "rolling_speed"),
            ),
            Plot(f"pressure{suffix}", f"Contact pressure{words}", f"pressure{suffix}", "angle", ("contact_pressure",)),
        )
    ),
    Plot(
        "surge",
        "Spring force over the turn",
        "surge",
        "angle",
        ("spring_force", "surge_force"),
        reference=("static_force",),
        meaning="Dashed: static force of the spring.",
    ),
    Plot("surge_harmonics", "Harmonics of lift and surge", "surge_harmonics", "harmonic", ("lift", "surge_force"), style="bars"),
    *(
        plot
        for suffix, words in SURFACES
        for plot in (
            Plot(f"entrainment{suffix}", f"Entrainment speed{words}", f"film{suffix}", "angle", ("entrainment_speed",)),
            Plot(
                f"film{suffix}", f"Oil film thickness{words}", f"film{suffix}", "angle", ("central_thickness", "min_thickness"), unit="um"
            ),
        )
    ),
    Plot("vibration", "Vibration of the follower", "vibration", "angle", ("error", "acceleration")),
)


# -- the moving picture ----------------------------------------------------------------------------------------------------------


def scene(model: CamModel) -> Scene:
    """Cam and follower over one turn, seen from the machine and from the cam."""
    angle = np.linspace(0, TURN, FRAMES)
    lift = model.programme(angle).s
    turning, still = _poses(0.0, 0.0, model.follower.sense * angle), _poses(0.0, 0.0, 0.0 * angle)
    moving = _poses(model.shapes.origin.real, 0.0, -lift) if model.oscillating else _poses(0.0, lift, 0.0)
    colours = {"cam": "blue", "outer wall": "blue", "conjugate": "green"}
    bodies = [
        Body(track.name, track.words, tuple(_cam_shapes(model, number, _display_profile)), turning, colours[track.name])
        for number, track in enumerate(model.tracks)
        if track.cut
    ]
    bodies += [
        Body("follower", "follower", model.shapes(), moving, "orange"),
        *_valve(model, angle),
        Body("frame", "frame", tuple(_ground(model)), still, "ground"),
    ]
    frames = (Frame("machine", "machine frame", still), Frame("cam", "seen from the cam", turning))
    traces = () if model.tracks[0].flat else (Trace("center", "centre of the follower's face", "follower", xy(model.shapes.centers[0])),)
    programme = model.programme
    marks = tuple((float(start), segment.motion_law.name) for start, segment in zip(programme.starts, programme.segments, strict=False))
    period = TURN / model.speed if model.turns else 2.0
    return Scene(angle, "cam angle", "rad", period, tuple(bodies), frames, traces, "motion", marks, tuple(handles(model)))


def _valve(model, angle):
    """The valve under the second arm."""
    if model.arm:
        yield Body("valve", "valve", tuple(model.shapes.valve()), _poses(0.0, -model.valve_motion(angle).s, 0.0), "green")


def _poses(x, y, angle):
    return np.stack(np.broadcast_arrays(np.full(FRAMES, x), y, angle), axis=1)


@lru_cache(maxsize=16)
def _display_profile(model, number):
    """The profile of a track for the screen: as fine as that needs where nothing is trimmed away, else the exact one."""
    track = model.tracks[number]
    outline = cams.display_profile(track.follower, model.programme, DRAWN * model.shapes.size, track.flank)
    return cams.FinishedProfile(outline, None) if outline else profile(model, number)


def _cam_shapes(model, number, profile_of=profile):
    """The cam of a track, or the outer wall of its groove, at cam angle 0."""
    track, finished = model.tracks[number], profile_of(model, number)
    if track.flank > 0:
        return cam_shapes.cam_shapes(track, finished, model.programme, model.spec.manufacture.bore)
    return cam_shapes.groove_wall_shapes(track, finished, model.cycle, _disc_radius(model, profile_of))


def _disc_radius(model, profile_of=profile):
    return cam_shapes.groove_disc_radius(profile_of(model, 1), model.spec.limits.wall)


def _ground(model):
    """Bearing of the cam; pivot of a lever or guide of a slide."""
    size = model.shapes.size
    yield Shape("ground", circle((0, 0), 0.05 * size))
    if model.oscillating:
        yield Shape("ground", circle((model.follower.pivot_distance, 0), 0.05 * size))
        return
    x, gap = model.follower.sense * model.spec.follower.offset, 0.6 * SLIM * size
    low = size + 0.35 * size
    for side in (x - gap, x + gap):
        yield Shape("ground", polygon([(side, low), (side, low + 0.4 * size)], closed=False))


# -- drawings and parts ------------------------------------------------------------------------------------------------------------


def drawings(model: CamModel) -> tuple[Drawing, ...]:
    """One drawing for each cam; the two walls of a groove share one."""
    sheets = []
    for number, track in enumerate(model.tracks):
        if track.cut and track.flank > 0:
            shapes = [shape for shape in _cam_shapes(model, number) if shape.layer != "defect"]
            if model.spec.closure == "groove":
                shapes += [shape for shape in _cam_shapes(model, 1) if shape.layer != "defect"]
            reach = 1.1 * model.shapes.size
            ends = (((-reach, 0), (reach, 0)), ((0, -reach), (0, reach)))
            shapes += [Shape("axis", polygon(pair, closed=False)) for pair in ends]
            sheets.append(Drawing(track.name, _title(model, track), tuple(shapes), model.spec.face.width, model.spec.closure != "groove"))
    return tuple(sheets)


def _title(model, track):
    return f"{model.spec.title or 'disc cam'}: {'conjugate cam' if track.name == 'conjugate' else 'cam'}"


def parts(model: CamModel) -> tuple[Part, ...]:
    """The cams with bore and hub, and what runs on them, at the start position."""
    width, cam_parts = model.spec.face.width, []
    for number, track in enumerate(model.tracks):
        if track.cut and track.flank > 0:
            z = -1.5 * width if track.name == "conjugate" else 0.0
            cam_parts.append(Part(track.name, tuple(_cam_solids(model, number, z)), (0.0, 0.0, 0.0), "green" if number else "blue"))
    return (*cam_parts, *_follower_parts(model, width))


def _cam_solids(model, number, z):
    """The disc with its bore, and the hub on the side away from the other cam."""
    make, width, grooved = model.spec.manufacture, model.spec.face.width, model.spec.closure == "groove"
    if grooved:
        yield from cam_shapes.groove_solids(profile(model, 1), _disc_radius(model), width, z, make.bore)
    below = z - make.hub_length - (width if grooved else 0.0)
    start = below if z < 0 or grooved else z + width
    hub = (make.hub_diameter, start, make.hub_length) if make.hub_diameter else None
    yield from cam_shapes.cam_solids(profile(model, number), width, z, make.bore, hub)


def _follower_parts(model, width):
    """Rollers, or the flat or curved face as a block, at the start position."""
    lift = float(model.programme(0.0).s)
    pose = (model.follower.pivot_distance, 0.0, -lift) if model.oscillating else (0.0, lift, 0.0)
    if model.spec.follower.face == "roller":
        for number, center in enumerate(model.shapes.centers):
            track = model.tracks[number] if model.spec.closure == "conjugate" else model.tracks[0]
            z = -1.5 * width if number and model.spec.closure == "conjugate" else 0.0
            outline = circle(xy(center), track.radius)
            pin = circle(xy(center), 0.3 * track.radius)
            yield Part("roller" if not number else "second roller", (Prism(outline, (pin,), z, width),), pose, "orange", "follower")
        return
    bodies = [shape.outline for shape in model.shapes() if shape.layer == "body" and shape.outline.closed]
    yield Part("follower", tuple(Prism(outline, (), 0.0, width) for outline in bodies), pose, "orange")
