"""A contact law of another package: in a pin with play, on the flank of a chain's plate, on rollers and guides; compiled and not."""

import os
import subprocess
import sys
from types import SimpleNamespace

import contact_law_plugin as theirs
import numpy as np
import pytest
from places import SUPPORT

from drivewright import contact, plugins
from drivewright._jit import kernel, plain
from drivewright.chains.explicit.bodies import load_guide
from drivewright.chains.explicit.state import BODIES, ContactLaws, compile_model, law_of
from drivewright.chains.explicit.step import load_flanks, load_gravity
from drivewright.chains.implicit import energy, parts
from drivewright.chains.implicit.touch import find_candidates
from drivewright.chains.link import design_link, seat_height, seat_support
from drivewright.chains.model import Chain, ChainContact, ChainDrive, Guide, SpeedRamp, Sprocket
from drivewright.chains.tooth import Tooth
from drivewright.contact import ContactParameters, HuntCrossley, KelvinVoigt, contact_law, mean_force, normal_force, stored_energy, tangent
from drivewright.errors import InputError, UnknownName
from drivewright.multibody.forces.contact import Laws, NoLaws, further_force

pytestmark = pytest.mark.interface

STATED = ContactParameters(4e6, damping=30.0, restitution=0.8)
ANGLE, K, C = np.pi / 6, 1e7, 90.0
JOINT = design_link(9.525e-3, 1.2e-3, ANGLE, 2e-4)
TOOTH = Tooth(12, 9.525e-3 * 12 / (2 * np.pi) * np.cos(ANGLE), seat_support(JOINT, 12))


def plugged(monkeypatch, **points):
    found = {name: SimpleNamespace(load=lambda point=point: point) for name, point in points.items()}
    monkeypatch.setattr(plugins, "installed", lambda group: found if group == "drivewright.contact_laws" else {})
    plugins.load.cache_clear()


def test_a_law_is_made_from_what_a_place_of_contact_states(monkeypatch):
    plugged(monkeypatch, progressive=theirs.progressive)
    assert contact.contact_law_names() == ["progressive"]
    law = contact_law("progressive", STATED)
    assert law == contact_law(theirs.progressive, STATED) == theirs.Progressive(4e6, 1e-4, 1 - 0.8)
    with pytest.raises(UnknownName, match=r"no contact law is called 'progresive' \(did you mean 'progressive'\?\)"):
        contact_law("progresive", STATED)


@pytest.mark.parametrize(
    ("point", "words"),
    [
        (3.0, "entry point gives a float"),
        (lambda stated: 3.0, "returns a float; it must return a record"),
        (lambda stated: stated, "returns a ContactParameters; it must return a record whose class has a formula"),
        (lambda stated: HuntCrossley(np.nan, 1.5, 0.0), "gives nan N across a gap of 1 m"),
    ],
)
def test_what_is_no_law_is_refused(monkeypatch, point, words):
    plugged(monkeypatch, odd=point)
    with pytest.raises(InputError, match=f"contact law 'odd'.*{words}"):
        contact_law("odd", STATED)


def test_energy_and_tangent_follow_from_the_force():
    law = contact_law(theirs.progressive, STATED)
    d, rate = 3e-5, 0.2
    assert stored_energy(law, -d) == pytest.approx(4e6 * (d**2 / 2 + d**3 / (3 * 1e-4)), rel=1e-13)
    assert stored_energy(law, d) == 0.0
    stiffness, damping = tangent(law, -d, -rate)
    assert stiffness == pytest.approx(4e6 * (1 + 2 * d / 1e-4) * (1 + law.chi * rate), rel=1e-8)
    assert damping == pytest.approx(4e6 * d * (1 + d / 1e-4) * law.chi, rel=1e-8)


@pytest.mark.parametrize("rate", [2.0, -2.0])
@pytest.mark.parametrize("depth", [-0.2, -0.09, -0.02, 0.0, 0.05, 0.3])
def test_the_mean_over_a_step_of_a_linear_law_is_that_of_ours(depth, rate):
    ours, other = KelvinVoigt(4e6, 30.0), contact_law(theirs.linear, STATED)
    assert mean_force(other, depth, rate, 0.1) == pytest.approx(mean_force(ours, depth, rate, 0.1), rel=1e-12, abs=1e-9)


# -- chains ----------------------------------------------------------------------------------------------------------------------


def touching(law, guides=()):
    """One plate astride of a tooth, off its seat and moving."""
    here = Sprocket(TOOTH, ChainContact(K, C, law), drive=SpeedRamp(1.0, 1.0))
    there = Sprocket(TOOTH, ChainContact(K, C, law), (5.0, 0.0), inertia=1.0)
    return ChainDrive(Chain(JOINT, 8, 2.5e-3, 6.4e-8, 3e6), (here, there), guides)


def place(drive, x, y, angle, rates):
    p = drive.plates
    p.x[0], p.y[0], p.angle[0], p.c[0], p.s[0] = x, y, angle, np.cos(angle), np.sin(angle)
    p.vx[0], p.vy[0], p.w[0] = rates
    plain(load_gravity)(drive.chain, p, drive.touches)


def on_flanks(law):
    drive = compile_model(touching(law))
    drive.touches.seat[0] = -np.pi / 2
    place(drive, seat_height(JOINT, 12) - 4e-5, 0.0, 2e-4 - np.pi / 2, (-0.3, 0.02, 4.0))
    plain(load_flanks)(drive.chain, drive.plates, drive.touches, drive.bodies, drive.teeth, 0, 0, 1, 1e-6)
    t = drive.touches
    return np.array([t.right[0], t.left[0], t.damped_right[0], t.damped_left[0], t.stored[0], t.fx[0], t.fy[0], drive.plates.moment[0]])


def on_guide(law):
    drive = compile_model(touching(law, (Guide((0.02, -0.01), 0.03, 0.0, np.pi, "inside", 4e-3, ChainContact(K, C, law), 0.1),)))
    place(drive, 0.021, 0.0239, 0.03, (0.02, 0.3, 4.0))
    plain(load_guide)(drive.chain, drive.plates, drive.touches, drive.bodies, drive.arcs, 0, 0, 1, drive.power, 1e-6)
    return np.array([drive.touches.fx[0], drive.touches.fy[0], drive.touches.stored[0], *drive.power])


@pytest.mark.parametrize("touch", [on_flanks, on_guide])
def test_a_linear_law_of_another_package_acts_like_ours(touch):
    ours, other, stiffer = (touch(law) for law in ("kelvin-voigt", theirs.linear, theirs.progressive))
    assert np.max(np.abs(ours)) > 10
    np.testing.assert_allclose(other, ours, rtol=1e-10, atol=1e-12)
    assert np.max(np.abs(stiffer)) > 1.02 * np.max(np.abs(ours))


def implicit_field(law, shift=None):
    """(energy, gradient by the plates (8, 3), its tangent) of one plate deep between two teeth."""
    made = parts.compile_model(touching(law))
    plates = np.column_stack([np.linspace(0, 1, 8) + 1.0, np.ones(8), np.zeros(8)])
    plates[0] = seat_height(JOINT, 12) - 4e-5, 0.0, 2e-4 - np.pi / 2
    state = parts.at_rest(plates if shift is None else plates + shift, np.zeros((3 - 1, 2)))
    plain(find_candidates)(made, state)
    return plain(energy.assemble)(made, state, 0.0), made.field.plates.copy(), made.field.ring.diagonal.copy()


def test_the_implicit_run_takes_it():
    """Its force is the slope of its energy, and its tangent that of the force."""
    h, found = 1e-8, implicit_field(theirs.progressive)
    for axis in range(3):
        shift = np.zeros((8, 3))
        shift[0, axis] = h
        (up, force_up, _), (down, force_down, _) = implicit_field(theirs.progressive, shift), implicit_field(theirs.progressive, -shift)
        assert found[1][0, axis] == pytest.approx((up - down) / (2 * h), rel=1e-5, abs=1e-3 * np.max(np.abs(found[1][0])))
        np.testing.assert_allclose(
            found[2][0, axis], (force_up - force_down)[0] / (2 * h), rtol=1e-4, atol=1e-6 * np.max(np.abs(found[2][0]))
        )


def test_one_drive_has_one_law():
    model = touching(theirs.linear, (Guide((0.02, -0.01), 0.03, 0.0, np.pi, "inside", 4e-3, ChainContact(K)),))
    with pytest.raises(InputError, match="different contact laws; give all of them the same one"):
        compile_model(model)


# -- compiled --------------------------------------------------------------------------------------------------------------------


@kernel
def mean_in_a_kernel(contacts, laws, body, depth, rate):
    from_pin = further_force(laws, 2, -depth, -rate)
    elastic, force, touching = mean_force(law_of(contacts, body, 1), depth, rate, 1e-6)
    return from_pin, elastic, force, stored_energy(law_of(contacts, body, 1), -depth)


def test_kernels_dispatch_on_the_type_of_the_law():
    law, other = contact_law(theirs.progressive, STATED), contact_law(theirs.linear, STATED)
    contacts, laws = ContactLaws((other._replace(k=1.0), other)), Laws(2, law, Laws(1, other, NoLaws()))
    body = np.zeros(1, BODIES).view(np.recarray)[0]
    compiled = mean_in_a_kernel(contacts, laws, body, 3e-5, 0.1)
    assert compiled == plain(mean_in_a_kernel)(contacts, laws, body, 3e-5, 0.1)
    assert compiled[0] == normal_force(law, -3e-5, -0.1) and compiled[3] == pytest.approx(stored_energy(other, -3e-5), rel=1e-14)


# -- in files of drives ----------------------------------------------------------------------------------------------------------

SLIDER_CRANK = """
mechanism = "linkage"
[ground.points]
O = ["0 mm", "0 mm"]
[bodies.crank]
mass = "1 kg"
inertia = "1e-3 kg m^2"
[bodies.crank.points]
O = ["0 mm", "0 mm"]
A = ["50 mm", "0 mm"]
[bodies.rod]
mass = "1 kg"
inertia = "1e-2 kg m^2"
angle = "-20 deg"
[bodies.rod.points]
A = ["0 mm", "0 mm"]
B = ["150 mm", "0 mm"]
[bodies.slider]
mass = "1 kg"
[[joints]]
name = "O"
connects = ["crank.O", "ground.O"]
[[joints]]
name = "A"
connects = ["crank.A", "rod.A"]
[[joints]]
name = "B"
connects = ["rod.B", "slider.centroid"]
model = "dry"
clearance = "0.2 mm"
normal = "progressive"
[[joints]]
name = "guide"
kind = "prismatic"
connects = ["slider.centroid", "ground.O"]
[drive]
joint = "O"
speed = "600 rpm"
[simulate]
turns = 0.05
"""
SILENT_CHAIN = """
mechanism = "silent-chain"
pitch = "9.525 mm"
links = 82
teeth = [35, 37]
joint.rolling_radius = "1.2 mm"
plate.apothem = "2.6 mm"
drive.speed = "2000 rpm"
drive.preload = "150 N"
contact.law = "progressive"
"""
SCRIPT = """
from drivewright import build, load
from drivewright.chains.explicit.simulate import Settings, simulate
from drivewright.errors import SpecError
from drivewright.mechanisms.silent_chain.chain_drive import chain_drive
from drivewright.multibody.assembly import assemble
from drivewright.multibody.observe import observe
from drivewright.multibody.simulate import simulate as move
from drivewright.mechanisms.linkage.describe import describe
import contact_law_plugin as theirs

model = chain_drive(build(load("chain.toml")))
assert model.sprockets[0].contact.law == "progressive"
motion = simulate(model, 2e-6, Settings(step=1e-6, run_in=0.0, samples_per_tooth=1250))
assert motion.tension.min() > 0

ready = assemble(describe(load("crank.toml")))
assert type(ready.system.laws.law) is theirs.Progressive and ready.system.laws.law.chi == 1.0 - 0.9
run = move(ready, 4e-3)
part = run.stretches[-1]
pressed = observe(part.system, part.t, part.y).pin(0, "normal")
assert run.outcome == "complete" and pressed.max() > 0, pressed

try:
    load("unknown.toml")
except SpecError as error:
    assert "did you mean 'progressive'" in str(error), error
else:
    raise AssertionError("no error")
"""


@pytest.mark.parametrize("jit", ["plain", pytest.param("compiled", marks=pytest.mark.slow)])
def test_a_package_brings_a_law_to_pins_and_chains(tmp_path, jit):
    """The entry point group `drivewright.contact_laws`, as an installed package declares it."""
    declared = tmp_path / "contact_law-1.0.dist-info"
    declared.mkdir()
    (declared / "METADATA").write_text("Metadata-Version: 2.1\nName: contact-law\nVersion: 1.0\n")
    (declared / "entry_points.txt").write_text("[drivewright.contact_laws]\nprogressive = contact_law_plugin:progressive\n")
    (tmp_path / "crank.toml").write_text(SLIDER_CRANK)
    (tmp_path / "chain.toml").write_text(SILENT_CHAIN)
    (tmp_path / "unknown.toml").write_text(SILENT_CHAIN.replace('"progressive"', '"progresive"'))
    paths = [str(tmp_path), str(SUPPORT), os.environ.get("PYTHONPATH", "")]
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": os.pathsep.join(paths), "NUMBA_DISABLE_JIT": str(int(jit == "plain"))},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
