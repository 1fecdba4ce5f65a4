"""A joint that is not in the package: one class in one file, with an equation of its own, moves and is drawn like those of the package."""

import os
import subprocess
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from drivewright._jit import implements
from drivewright.multibody.assembly import assemble
from drivewright.multibody.joints import PointJoint, row_terms, row_velocity_product
from drivewright.multibody.joints.joint import JointDrawing
from drivewright.multibody.model import GROUND, Body, JointDrive, Marker, MultibodyModel, PinSlot, Prismatic, Revolute, line
from drivewright.multibody.observe import observe
from drivewright.multibody.reactions import reactions
from drivewright.multibody.simulate import simulate
from drivewright.multibody.wrenches import ObservedBodies, Wrench
from drivewright.scene import Shape, polygon

pytestmark = pytest.mark.interface


class Ellipse(NamedTuple):
    """(x/a)^2 + (y/b)^2 = 1 for the point of body i seen from the point of body j, in the axes of k; a, b are fields ex, ey of the row."""

    scale: float = 1.0


@implements(row_terms, Ellipse)
def _(equation, row, pose, dx, dy, ti, tj, tl):
    x, y = pose.c * dx + pose.s * dy, pose.c * dy - pose.s * dx
    gx, gy = 2 * x / row.ex**2, 2 * y / row.ey**2
    residual = (x / row.ex) ** 2 + (y / row.ey) ** 2 - 1.0
    return residual, pose.c * gx - pose.s * gy, pose.s * gx + pose.c * gy, 0.0, 0.0, gx * y - gy * x, 0.0


@implements(row_velocity_product, Ellipse)
def _(equation, row, pose, dx, dy, vx, vy, wi, wj, wl):
    x, y, w = pose.c * dx + pose.s * dy, pose.c * dy - pose.s * dx, pose.w
    u, v = pose.c * vx + pose.s * vy, pose.c * vy - pose.s * vx  # rates of d, still in the world, told in the axes of k
    xd, yd = u + w * y, v - w * x
    xdd, ydd = 2 * w * v - w * w * x, -2 * w * u - w * w * y
    return 2 * ((xd * xd + x * xdd) / row.ex**2 + (yd * yd + y * ydd) / row.ey**2)


@dataclass(frozen=True)
class EllipticGuide(PointJoint):
    """A point of `first` runs on an ellipse with half axes a, b [m] about the point of `second`."""

    half_axes: tuple[float, float] = (1.0, 1.0)

    def constraint_rows(self, index):
        pair = self.pair(index)
        return [pair | {"kind": Ellipse(), "k": pair["j"], "ex": self.half_axes[0], "ey": self.half_axes[1]}]

    def wrenches(self, bodies: ObservedBodies) -> list[Wrench]:
        point = bodies.point(self.first)
        apart, angle = point - bodies.point(self.second), bodies.field(self.second.body, "angle")
        x, y = np.cos(angle) * apart[:, 0] + np.sin(angle) * apart[:, 1], np.cos(angle) * apart[:, 1] - np.sin(angle) * apart[:, 0]
        gx, gy = x / self.half_axes[0] ** 2, y / self.half_axes[1] ** 2
        normal = np.stack([np.cos(angle) * gx - np.sin(angle) * gy, np.sin(angle) * gx + np.cos(angle) * gy], axis=-1)
        return [Wrench({}, *self.bodies, normal / np.hypot(*normal.T)[:, None], point)]

    def guide_shapes(self, body: str, drawing: JointDrawing) -> Iterable[Shape]:
        if body == self.second.body:
            turn = np.linspace(0.0, 2 * np.pi, 73)[:-1]
            yield Shape("ground", polygon(np.array(self.second[1:]) + np.stack([np.cos(turn), np.sin(turn)], axis=1) * self.half_axes))


A, B, SPEED = 0.3, 0.2, 3.0


def slotted_crank():
    """A crank turns a stone in its slot; the stone's pin runs on an ellipse of the ground."""
    return MultibodyModel(
        (Body("crank", 1.0, 0.01), Body("stone", 0.5, 0.001)),
        (
            Revolute("O", Marker("crank"), Marker(GROUND)),
            Prismatic("slot", Marker("stone"), Marker("crank", 0.25)),
            EllipticGuide("track", Marker("stone"), Marker(GROUND), (A, B)),
        ),
        drives=(JointDrive("O", line(0.0, SPEED)),),
    )


def radius(angle):
    return A * B / np.hypot(B * np.cos(angle), A * np.sin(angle))


@pytest.fixture(scope="module")
def seen():
    ready = assemble(slotted_crank())
    times = np.linspace(0.0, 2 * np.pi / SPEED, 181)
    run = simulate(ready, times[-1], samples=times)
    part = run.stretches[0]
    return ready, observe(part.system, part.t, part.y)


def test_place_velocity_and_acceleration_are_those_of_the_polar_equation(seen):
    """r(phi) = a b / sqrt((b cos)^2 + (a sin)^2), differentiated as a Fourier series."""
    ready, observed = seen
    stone = ready.names.index("stone")
    way = radius(SPEED * observed.t)[:-1] * np.exp(1j * SPEED * observed.t[:-1])
    orders = np.fft.fftfreq(len(way), 1 / len(way)) * 1j * SPEED
    for fields, derivative in ((("x", "y"), 0), (("vx", "vy"), 1), (("ax", "ay"), 2)):
        ours = observed.body(stone, fields[0])[:-1] + 1j * observed.body(stone, fields[1])[:-1]
        expected = np.fft.ifft(np.fft.fft(way) * orders**derivative)
        assert np.max(np.abs(ours - expected)) < 1e-9 * np.max(np.abs(expected))


def test_its_reaction_balances_the_bodies(seen):
    ready, observed = seen
    found = reactions(ready, ready.system, observed)
    assert np.max(found.residual) < 1e-9
    assert np.max(np.abs(found.joints["track"].force)) > 0.1
    assert np.allclose(found.drives, observed.drives, rtol=1e-9, atol=1e-9)


@pytest.mark.slow  # its equation makes kernels of its own
def test_an_ellipse_on_a_turning_body_moves_a_free_mechanism():
    """Carried by the crank, with the pin held in a straight slot of the ground: energy stays."""
    model = MultibodyModel(
        (Body("disc", 1.0, 0.05, angular_velocity=4.0), Body("pin", 0.5, 0.001)),
        (
            Revolute("O", Marker("disc"), Marker(GROUND)),
            PinSlot("guide", Marker("pin"), Marker(GROUND, 0.25)),
            EllipticGuide("track", Marker("pin"), Marker("disc"), (A, B)),
        ),
    )
    ready = assemble(model)
    assert ready.freedom == 2  # the disc turns, and so does the round pin
    run = simulate(ready, 2.0)
    part = run.stretches[-1]
    observed = observe(part.system, part.t, part.y)
    disc, pin = (ready.names.index(name) for name in ("disc", "pin"))
    place = radius(observed.body(disc, "angle"))
    assert np.allclose(np.abs(observed.body(pin, "x")), place, rtol=0, atol=1e-9)
    energy = 0.5 * (0.05 * observed.body(disc, "w") ** 2 + 0.5 * observed.body(pin, "vx") ** 2)
    assert np.ptp(energy) < 1e-5 * energy[0]


def test_a_model_without_it_has_the_kernels_of_all_others():
    from drivewright.multibody.joints.rows import Equations, NoEquations

    assert isinstance(assemble(slotted_crank()).system.equations, Equations)
    plain = MultibodyModel((Body("crank", 1.0, 0.01),), (Revolute("O", Marker("crank"), Marker(GROUND)),))
    assert assemble(plain).system.equations == NoEquations()


# -- as a kind of joint in a linkage's file --------------------------------------------------------------------------------------


def elliptic(joint, first, second):
    """The entry point: half axes along x and y from the keys `radius` and `track_radius`."""
    return EllipticGuide(joint.name, first, second, (joint.radius, joint.track_radius))


SCRIPT = """
import numpy as np
from drivewright import load, run
from drivewright.registry import mechanism
result = run(load("ellipse.toml"))
x, y = (result.tables["motion"][f"stone.{field}"].data for field in ("x", "y"))
assert np.max(np.abs((x / 0.3) ** 2 + (y / 0.2) ** 2 - 1)) < 1e-9, result.findings
assert np.ptp(x) > 0.59
assert "track.force" in {column.name for column in result.tables["forces"].columns}
shapes = {body.name: body.shapes for body in mechanism("linkage").scene(mechanism("linkage").build(result.spec)).bodies}
assert any(len(shape.outline.pieces) == 72 for shape in shapes["ground"])
"""

SPEC = """
mechanism = "linkage"
[ground.points]
O = ["0 mm", "0 mm"]
[bodies.crank]
mass = "1 kg"
inertia = "0.01 kg m^2"
[bodies.crank.points]
O = ["0 mm", "0 mm"]
S = ["250 mm", "0 mm"]
[bodies.stone]
mass = "0.5 kg"
inertia = "0.001 kg m^2"
[[joints]]
name = "O"
connects = ["crank.O", "ground.O"]
[[joints]]
name = "slot"
kind = "prismatic"
connects = ["stone.centroid", "crank.S"]
[[joints]]
name = "track"
kind = "elliptic"
connects = ["stone.centroid", "ground.O"]
radius = "300 mm"
track_radius = "200 mm"
[drive]
joint = "O"
speed = "60 rpm"
[simulate]
turns = 1
[[outputs]]
name = "stone"
body = "stone"
point = "centroid"
"""


def test_a_package_brings_a_kind_of_joint_to_linkages(tmp_path):
    """The entry point group `drivewright.joints`, as an installed package declares it."""
    declared = tmp_path / "elliptic_joint-1.0.dist-info"
    declared.mkdir()
    (declared / "METADATA").write_text("Metadata-Version: 2.1\nName: elliptic-joint\nVersion: 1.0\n")
    (declared / "entry_points.txt").write_text(f"[drivewright.joints]\nelliptic = {Path(__file__).stem}:elliptic\n")
    (tmp_path / "ellipse.toml").write_text(SPEC)
    paths = [str(tmp_path), str(Path(__file__).parent), os.environ.get("PYTHONPATH", "")]
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": os.pathsep.join(paths)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
