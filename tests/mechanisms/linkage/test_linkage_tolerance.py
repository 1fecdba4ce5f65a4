"""Kinematic tolerances against closed forms, linear theory and exact re-assembly."""

import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from drivewright.errors import DoesNotAssemble, InputError
from drivewright.mechanisms.linkage import analyses
from drivewright.multibody.analyses import tolerances
from drivewright.multibody.assembly import assemble
from drivewright.multibody.model import GROUND, Body, JointDrive, Marker, MultibodyModel, PinSlot, Prismatic, Revolute, Rolling, line
from drivewright.multibody.tolerance import CHUNK, Source, deviations, draw_deviations, gradient, play, posture, sample, shares, worst_moves

pytestmark = pytest.mark.analytical

ARM = 0.424


def folder(coupler=0.158, ground=0.484):
    """The knife folder: crank 66 mm, coupler, rocker 424 mm."""
    return MultibodyModel(
        (Body("crank", 1.0), Body("coupler", 1.0, 1e-3, (0.079, 0.01), angle=-1.0), Body("knife", 6.0, 0.04, (0.243, -0.02), angle=3.4)),
        (
            Revolute("O2", Marker(GROUND), Marker("crank")),
            Revolute("A", Marker("crank", 0.066), Marker("coupler")),
            Revolute("B", Marker("coupler", coupler), Marker("knife", ARM)),
            Revolute("O4", Marker("knife"), Marker(GROUND, ground)),
        ),
        drives=(JointDrive("O2", line(0.0, 10.0)),),
    )


def rolling():
    """A wheel that rolls on a circle in the slot of a crank, and leads a slider by a pin: all kinds of rows and coordinates."""
    return MultibodyModel(
        (Body("crank", 1.0, 0.0, (0.01, 0.0), angle=0.3), Body("wheel", 1.0, 0.1, (0.002, 0.001), angle=0.4), Body("slider", 1.0)),
        (
            Revolute("O", Marker(GROUND, 0.01, 0.02), Marker("crank")),
            PinSlot("C", Marker("wheel"), Marker("crank")),
            Rolling("track", Marker("wheel"), Marker(GROUND, 0.004, 0.0), 0.03, track_radius=0.06),
            PinSlot("slot", Marker("wheel", 0.02, 0.01), Marker("slider"), (0.1, 1.0)),
            Prismatic("guide", Marker("slider"), Marker(GROUND, 0.0, 0.1), (1.0, 0.2)),
        ),
        drives=(JointDrive("O", line(0.0, 1.0)),),
    )


MARKS = {"knife": Marker("knife"), "tip": Marker("knife", 0.418, 0.161)}
PLAYS = [play(name, 5e-5) for name in ("O2", "A", "B", "O4")]


def held_folder(sources, marks=MARKS, angle=np.pi / 3):
    return posture(assemble(folder()), marks, sources, angle)


def differences(held, count, step=1e-6):
    """Central differences of the exactly closed mechanism, laid out as `gradient`."""
    moves = np.zeros((count, 2, 2, count, 2))
    for source in range(count):
        for axis in range(2):
            moves[source, axis, :, source, axis] = (step, -step)
    found = deviations(held, moves.reshape(-1, count, 2)).reshape(count, 2, 2, len(held.marks), 3)
    return np.moveaxis((found[:, :, 0] - found[:, :, 1]) / (2 * step), (2, 3), (0, 1))


def test_the_folder_at_60_degrees_has_the_known_scatter():
    held = held_folder(PLAYS)
    slopes = gradient(held, 4)
    parts = shares(PLAYS, slopes)
    np.testing.assert_allclose(slopes[0, 0, 0], (0.5681, -2.2893), atol=5e-5)
    assert np.sqrt(np.sum(parts.sigma[0, 0] ** 2)) == pytest.approx(1.668e-4, abs=5e-8)
    assert np.sum(parts.worst[0, 0]) == pytest.approx(4.717e-4, abs=5e-8)
    found = sample(held, PLAYS, 200_000, 3).deviations[:, 0, 0]
    assert np.std(found) == pytest.approx(1.668e-4, rel=5e-3)  # three standard errors are 0.4 %
    assert abs(np.mean(found)) < 4 * 1.668e-4 / np.sqrt(200_000) + 1e-7
    assert np.max(np.abs(found)) < 4.717e-4 * 1.001


@pytest.mark.parametrize("model", [folder, rolling])
def test_the_gradient_is_that_of_the_closed_mechanism(model):
    ends = [(joint.name, end) for joint in model().joints for end in (0, 1)]
    marks = {"one": Marker(model().bodies[-1].name, 0.1, -0.07), "two": Marker("crank", 0.02, 0.05), "still": Marker(GROUND, 0.3, 0.1)}
    sources = [Source(str(end), 1e-5, "circle", (end,)) for end in ends]
    sources.append(Source("several", 1e-5, "circle", (ends[1], ends[2]), marks=("one", "still")))
    held = posture(assemble(model()), marks, sources, 0.7)
    slopes = gradient(held, len(sources))
    np.testing.assert_allclose(slopes, differences(held, len(sources)), atol=3e-7 * np.max(np.abs(slopes)))
    assert np.min(np.max(np.abs(slopes[:2]), axis=(0, 1, 3))) > 0.02  # no source is without effect


def test_a_displaced_point_is_a_mechanism_built_with_that_length():
    source = Source("knife.B", 1.0, "uniform", (("B", 1),))
    moved = deviations(held_folder([source]), np.array([[[2e-3, -1e-3]]]))[0, 0, 0]
    joints = list(folder().joints)
    joints[2] = Revolute("B", Marker("coupler", 0.158), Marker("knife", ARM + 2e-3, -1e-3))
    other = posture(assemble(replace(folder(), joints=tuple(joints))), MARKS, [source], np.pi / 3)
    angles = [one.work.poses.angle[assemble(folder()).names.index("knife")] for one in (held_folder([source]), other)]
    assert moved == pytest.approx(angles[1] - angles[0], abs=1e-13)
    assert abs(moved) > 1e-4


def test_a_displacement_along_the_ground_shifts_a_mechanism_as_a_whole():
    """Both fixed points together: nothing turns, every point goes along."""
    source = Source("frame", 1.0, "uniform", (("O2", 0), ("O4", 1)))
    found = deviations(held_folder([source]), np.array([[[3e-4, -2e-4]]]))
    np.testing.assert_allclose(found[0], [[0.0, 3e-4, -2e-4]] * 2, atol=1e-14)


@pytest.mark.parametrize(("law", "sigma", "most"), [("uniform", 3**-0.5, 1.0), ("normal", 1 / 3, 2.0), ("circle", 2**-0.5, 1.0)])
def test_displacements_have_the_moments_of_their_law(law, sigma, most):
    source = Source("p", 2e-4, law, (), (0.6, -0.8))
    moves = draw_deviations([source], 100_000, np.random.default_rng(5))[:, 0] / 2e-4
    if law == "circle":
        np.testing.assert_allclose(np.hypot(*moves.T), 1.0, atol=1e-12)
        along = moves[:, 0]
    else:
        np.testing.assert_allclose(moves @ (0.8, 0.6), 0.0, atol=1e-12)
        along = moves @ (0.6, -0.8)
    assert np.std(along) == pytest.approx(sigma, rel=0.01)
    assert 0.99 < np.max(np.abs(along)) < most + 1e-9
    slopes = np.array([3.0, 4.0]).reshape(1, 1, 1, 2)
    parts = shares([source], slopes)
    steep = 5.0 if law == "circle" else abs(3 * 0.6 - 4 * 0.8)
    assert parts.worst.item() == pytest.approx(2e-4 * steep)
    assert parts.sigma.item() == pytest.approx(2e-4 * steep * sigma)


def test_a_seed_gives_the_same_samples_and_zero_play_none():
    held = held_folder(PLAYS)
    one, two, other = (sample(held, PLAYS, CHUNK + 7, seed).deviations for seed in (4, 4, 5))
    np.testing.assert_array_equal(one, two)
    assert one.shape == (CHUNK + 7, 2, 3) and not np.allclose(one, other)
    assert not np.allclose(one[:7], one[CHUNK:])
    assert not np.any(sample(held, [play(name, 0.0) for name in ("O2", "A", "B", "O4")], 3, 1).deviations)


def test_what_does_not_close_is_nan_and_spoils_no_other():
    held = held_folder(PLAYS)
    moves = np.zeros((3, 4, 2))
    moves[1, 0] = (-9.0, 0.0)
    moves[2, 1] = moves[0, 1] = (1e-4, 2e-4)
    found = deviations(held, moves)
    assert np.isnan(found[1]).all()
    np.testing.assert_array_equal(found[0], found[2])


def test_refusals_tell_why():
    free = replace(folder(), drives=())
    with pytest.raises(InputError, match="1 degrees of freedom.*add drives"):
        posture(assemble(free), MARKS, PLAYS)
    pins = list(folder().joints)
    pins[2] = Revolute("B", Marker("coupler", 0.1), Marker("knife", 0.36))
    long = replace(folder(), joints=tuple(pins))
    with pytest.raises(DoesNotAssemble, match=r"does not close beyond \d+\.\d+°.*to 180.00°"):
        posture(assemble(long), MARKS, PLAYS, np.pi)


def spec(**tables):
    joint = {"kind": "revolute", "model": "ideal", "clearance": None, "carrier": "ground"}
    joints = [("O2", "ground.O2", "crank.O2"), ("A", "crank.A", "coupler.A"), ("B", "coupler.B", "knife.B")]
    joints = [SimpleNamespace(**joint | {"name": name, "connects": ends}) for name, *ends in joints]
    joints[0].clearance, joints[1].clearance, joints[1].model = 1e-4, 2e-4, "dry"
    output = SimpleNamespace(name="tip", body="knife", point="B")
    item = SimpleNamespace(at="knife.B", tolerance=3e-4, axis=(0.0, -2.0), distribution="normal")
    drive = SimpleNamespace(joint="O2", motor=None)
    drives = {"drive": drive} if tables.pop("drive", True) else {}
    known = {"joints": joints, "outputs": [output], "all_drives": drives, "tolerances": SimpleNamespace(dimensions=(item,))}
    return SimpleNamespace(**known | tables)


def test_sources_are_the_plays_of_any_model_and_the_points_with_all_that_hang_on_them():
    first, second, third = analyses.sources_of(spec())
    assert (first, second) == (play("O2", 1e-4), play("A", 2e-4))
    assert third == Source("knife.B", 3e-4, "normal", (("B", 1),), (0.0, -1.0), ("tip",))


@pytest.mark.parametrize(
    ("tables", "reason"),
    [
        ({"tolerances": None}, r"no \[tolerances\]"),
        ({"outputs": []}, r"no \[\[outputs\]\]"),
        ({"drive": None}, "no drive"),
        ({"joints": [], "tolerances": SimpleNamespace(dimensions=())}, "no joint has a clearance"),
    ],
)
def test_what_is_missing_is_named(tables, reason):
    assert re.search(reason, analyses._no_tolerances(spec(**tables)))
    assert analyses._no_tolerances(spec()) is None


def test_the_tables_add_up():
    held = held_folder(PLAYS)
    worst, sigma = (part[0, 0] for part in shares(PLAYS, gradient(held, 4)))
    table = tolerances._tornado("knife", "rad", PLAYS, (worst * (1.0, 3.0, 2.0, 0.5), sigma * (1.0, 3.0, 2.0, 0.5)))
    assert [text.split()[1] for text in table["source"].data] == ["A", "B", "O2", "O4"]
    np.testing.assert_allclose(table["variance_share"].data, np.array([9.0, 4.0, 1.0, 0.25]) / 14.25, rtol=1e-3)
    np.testing.assert_allclose(table["sensitivity"].data, 2.35873 * np.array([3.0, 2.0, 1.0, 0.5]), rtol=1e-4)
    bars = tolerances._histogram("knife", "rad", sample(held, PLAYS, 20_000, 1).deviations[:, 0, 0], (worst, sigma))
    assert np.sum(bars["share"].data) == pytest.approx(1.0)
    for name, cut in (("share", 0.01), ("linear_share", 0.03)):  # the bars end at three standard deviations of the normal distribution
        assert np.sqrt(np.sum(bars[name].data * bars["deviation"].data ** 2)) == pytest.approx(1.668e-4, rel=cut)


LINES = [Source(f"{name} {end}", 4e-5, "uniform", ((name, end),), way) for name, end, way in (("A", 0, (0.6, 0.8)), ("B", 0, (1.0, 0.0)))]


@pytest.mark.parametrize("reading", [0, 1, 2])
def test_the_worst_combination_by_linear_theory_is_the_worst_of_all(reading):
    """Of all ends of two points and 200 directions of a journal none gives more; and it is linear theory's sum, as far as that is right."""
    sources = [play("O4", 5e-5), *LINES]
    held = held_folder(sources)
    slopes = gradient(held, 3)[0, reading]
    corner = deviations(held, worst_moves(sources, slopes))[:, 0, reading]
    angle = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    circle = 5e-5 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    ends = [4e-5 * np.outer(signs, (1, 1)) * [line_.direction for line_ in LINES] for signs in ((1, 1), (1, -1), (-1, 1), (-1, -1))]
    moves = np.array([[point, *end] for point in circle for end in ends])
    others = deviations(held, moves)[:, 0, reading]
    size = np.sum(shares(sources, gradient(held, 3)).worst[0, reading])
    if size < 1e-12:  # the knife's own origin
        return
    assert corner[0] == pytest.approx(size, rel=2e-3) and corner[1] == pytest.approx(-size, rel=2e-3)
    assert np.max(others) <= corner[0] * (1 + 1e-9) + 1e-6 * size and np.min(others) >= corner[1] * (1 + 1e-9) - 1e-6 * size
    assert np.max(others) > 0.999 * corner[0]


def test_a_source_that_does_nothing_stays_where_it_is():
    moves = worst_moves([play("A", 1e-3), LINES[0]], np.zeros((2, 2)))
    assert moves.shape == (2, 2, 2) and not moves.any()


def test_values_of_a_reading_carry_intervals_and_the_worst_combination():
    rng = np.random.default_rng(2)
    data = rng.normal(1e-4, 2e-4, 400)
    values = tolerances._values("tip.x", "m", data, (np.array([3e-4, 1e-4]), np.array([1e-4, 1e-4])), 4.1e-4)
    mean, sigma = values["tolerances.tip.x.mean"], values["tolerances.tip.x.sigma"]
    assert mean.low < 1e-4 < mean.high and mean.interval == sigma.interval == "sample" and sigma.low < 2e-4 < sigma.high
    assert (mean.value, sigma.value) == pytest.approx((np.mean(data), np.std(data, ddof=1)))
    assert values["tolerances.tip.x.corner"].value == 4.1e-4 and values["tolerances.tip.x.linear_worst"].value == pytest.approx(4e-4)
    assert "tolerances.tip.x.corner" not in tolerances._values("tip.x", "m", data, (np.ones(1), np.ones(1)), np.nan)
    (told,) = tolerances._bent(["tip.x"])
    assert "linear theory deviates by more than 5%" in told and "for tip.x;" in told and not list(tolerances._bent([]))
