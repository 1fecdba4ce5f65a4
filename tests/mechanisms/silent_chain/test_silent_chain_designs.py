"""Many chains at once against the run of each, for every key and every rule; what is refused; bits that do not depend on the neighbours."""

from itertools import product

import numpy as np
import pytest

import drivewright as dw
from drivewright.chains.meshing import boundary_radius
from drivewright.errors import InputError
from drivewright.mechanisms.silent_chain import designs
from drivewright.mechanisms.silent_chain.designs import KEYS, batch
from drivewright.result import Check
from drivewright.spec import document, from_document, set_key
from drivewright.units import SI

pytestmark = pytest.mark.property

MM, DEG = 1e-3, np.pi / 180
RANGES = {  # around a usual chain, never its symmetric point
    "pitch": (7 * MM, 13 * MM),
    "links": (75, 120),
    "teeth.0": (17, 41),
    "teeth.1": (17, 61),
    "joint.rolling_radius": (0.2 * MM, 4 * MM),
    "joint.offset": (-0.3 * MM, 2 * MM),
    "plate.flank_angle": (24 * DEG, 36 * DEG),
    "plate.apothem": (1.5 * MM, 3.5 * MM),
    "plate.standard_apothem": (2.5 * MM, 4.5 * MM),
    "cutter.half_angle": (20 * DEG, 35 * DEG),
    "cutter.pitch": (8 * MM, 11 * MM),
    "drive.speed": (50.0, 400.0),
    "drive.preload": (50.0, 300.0),
    "drive.load_torque": (0.0, 20.0),
}
COUNTED = ("links", "teeth.0", "teeth.1")
SIDED = (
    "seated_pitch",
    "ideal_pitch",
    "pitch_deviation",
    "seated_apothem",
    "modification",
    "positioning_diameter",
    "contact_radius",
    "curvature_radius",
    "base_radius",
)
CHAIN = (
    "hole_pitch",
    "pin_offset",
    "standard_apothem",
    "pitch_deviation.reference",
    "k",
    "rolling_radius.boundary",
    "rolling_radius.monotone_limit",
)
MESHING = (*CHAIN, *(f"{name}.{side}" for name in SIDED for side in ("drive", "driven")))
LAYOUT = (
    *(f"layout.{name}.{side}" for name in ("pitch_diameter", "speed_fluctuation") for side in ("drive", "driven")),
    "layout.chain_length",
    "layout.mesh_frequency",
    "layout.meeting_velocity",
)
CHECKS = ("check.offset", "check.teeth.drive", "check.teeth.driven")


def chain(**tables):
    """A silent chain; a table given replaces keys of the usual one, None takes a key away."""
    usual = {
        "joint": {"rolling_radius": "1.2 mm"},
        "plate": {"apothem": "2.6 mm", "link_mass": "2.5 g", "link_inertia": "6e-8 kg m^2"},
        "drive": {"speed": "2000 rpm", "preload": "150 N"},
    }
    merged = {
        name: {key: value for key, value in {**usual.get(name, {}), **tables.get(name, {})}.items() if value is not None}
        for name in usual | tables
    }
    return dw.SilentChain(pitch="9.525 mm", links=82, teeth=[35, 37], **merged)


def random_designs(keys, count, seed):
    rng = np.random.default_rng(seed)
    columns = [rng.integers(*RANGES[key], count).astype(float) if key in COUNTED else rng.uniform(*RANGES[key], count) for key in keys]
    return np.stack(columns, axis=1)


def changed(spec, keys, row):
    tables = document(spec)
    for key, value in zip(keys, row, strict=True):
        set_key(tables, key, int(value) if key in COUNTED and value == int(value) else SI(value))
    return from_document(tables, type(spec))


def run_of_each(spec, keys, rows, names, only=("meshing",)):
    """{name: (n,)} by the runner; margins as a study's table tells them."""
    results = [dw.run(changed(spec, keys, row), only=only) for row in rows]
    found = {name: [] for name in names}
    for result in results:
        margins = {f"check.{c.name}": 0.0 if c.ok and c.margin < 0 else c.margin for c in result.checks}
        numbers = {name: value.value for name, value in result.values.items()} | margins
        for name in names:
            found[name].append(numbers.get(name, np.nan))
    return {name: np.array(column) for name, column in found.items()}


def assert_same(found, wanted):
    assert set(found) == set(wanted)
    for name in wanted:
        np.testing.assert_allclose(found[name], wanted[name], rtol=1e-12, atol=1e-17, err_msg=name)


# -- the numbers of a run ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("offset", "apothem", "reference", "ideal", "kind"),
    [
        *product(
            ("match-drive", "minimax", "0.21 mm"),
            ("apothem", "standard_apothem"),
            ("pitch_line", "pin"),
            ("seat", "rack"),
            ("round-pin", "arc"),
        )
    ],
)
def test_every_rule_gives_the_numbers_of_a_run(offset, apothem, reference, ideal, kind):
    spec = chain(
        joint={"kind": kind, "offset": offset},
        plate={"apothem": None, apothem: "3.1 mm"},
        cutter={"half_angle": "27 deg"},
        meshing={"apothem_reference": reference, "ideal": ideal},
    )
    keys, names = ("joint.rolling_radius", "pitch", "teeth.0", "plate.flank_angle", "teeth.1"), (*MESHING, "check.offset")
    rows = random_designs(keys, 4, seed=len(offset + apothem + reference + ideal))
    assert_same(batch(spec, keys, names)(rows), run_of_each(spec, keys, rows, names))


@pytest.mark.parametrize("key", KEYS)
def test_every_key_gives_the_numbers_of_a_run(key):
    spec = chain(plate={"apothem": None} if key == "plate.standard_apothem" else {}, joint={"offset": "minimax"})
    names, rows = (*MESHING, *LAYOUT, *CHECKS), random_designs((key,), 4, seed=3)
    found = batch(spec, (key,), names)(rows)
    assert_same(found, run_of_each(spec, (key,), rows, names, only=("meshing", "layout")))
    moves = [name for name in names if np.ptp(found[name]) > 0]
    assert bool(moves) == (key not in ("drive.preload", "drive.load_torque"))


def test_many_keys_at_once():
    keys = tuple(key for key in KEYS if key != "plate.standard_apothem")
    names, rows = (*MESHING, *LAYOUT, *CHECKS), random_designs(keys, 12, seed=8)
    assert_same(batch(chain(), keys, names)(rows), run_of_each(chain(), keys, rows, names, only=("meshing", "layout")))


def test_the_boundary_radius_takes_arrays_and_ends_where_there_is_none():
    teeth = np.array([1.5, 6.0, 35.0, 400.0])  # below 2 no radius would do
    found = boundary_radius(9.525 * MM, teeth, 37)
    assert list(found) == [boundary_radius(9.525 * MM, z, 37) for z in teeth] and list(np.isinf(found)) == [True, False, False, False]
    assert isinstance(boundary_radius(9.525 * MM, 35, 37), float)


def test_a_hinge_has_no_radius_to_vary():
    spec = chain(joint={"kind": "revolute", "offset": "0.1 mm"})
    keys, rows = ("joint.rolling_radius", "plate.apothem"), random_designs(("joint.rolling_radius", "plate.apothem"), 4, seed=5)
    found = batch(spec, keys, MESHING)(rows)
    assert_same(found, run_of_each(spec, keys, rows, MESHING))
    assert np.all(found["hole_pitch"] == spec.pitch)
    assert batch(spec, keys, ("check.offset",)) is None


def test_what_the_spec_itself_lacks_may_come_from_the_designs():
    names, rows = (*MESHING, "check.offset"), random_designs(("joint.rolling_radius", "plate.apothem"), 3, seed=6)
    bare = chain(joint={"rolling_radius": None}, plate={"apothem": None})
    keys = ("joint.rolling_radius", "plate.apothem")
    assert_same(batch(bare, keys, names)(rows), batch(chain(), keys, names)(rows))


# -- margins -------------------------------------------------------------------------------------------------------------------


def test_a_margin_is_above_0_where_the_check_passes():
    shares = np.array([0.4, 1 - 1e-12, 1.0, 1 + 1e-12, 1 + 0.9e-9, 1 + 1.1e-9, 1 + 1e-6, 1.7, -0.4, -1 - 1e-12, -1.7])
    rows = 1.2 * MM * shares[:, None]
    margins = batch(chain(), ("joint.offset",), ("check.offset",))(rows)["check.offset"]
    checks = [Check("", abs(share), 1.0, "<=", "-", "") for share in shares]
    assert [bool(margin >= 0) for margin in margins] == [check.ok for check in checks]
    np.testing.assert_allclose(margins, [max(c.margin, 0.0) if c.ok else c.margin for c in checks], atol=1e-15)
    assert margins[5] == pytest.approx(-1.1e-9, rel=1e-6) and margins[3] == margins[4] == 0.0


def test_margins_of_teeth_count_from_the_limit():
    rows = np.array([[6.0], [20.0], [21.0], [40.0]])
    found = batch(chain(limits={"teeth": 20}), ("teeth.0",), CHECKS)(rows)
    assert list(found["check.teeth.drive"]) == [-14, 0, 1, 20] and set(found["check.teeth.driven"]) == {17.0}


# -- refused -------------------------------------------------------------------------------------------------------------------

REFUSED = [
    ("pitch", 0.0),
    ("pitch", -9 * MM),
    ("pitch", np.nan),
    ("pitch", np.inf),
    ("links", 37.0),
    ("links", 5.0),
    ("links", 2001.0),
    ("links", 82.5),
    ("teeth.0", 5.0),
    ("teeth.1", 5.0),
    ("teeth.0", 35.5),
    ("teeth.1", 82.0),
    ("teeth.0", 82.0),
    ("teeth.0", -35.0),
    ("joint.rolling_radius", 0.0),
    ("joint.offset", np.nan),
    ("joint.offset", -np.inf),
    ("plate.flank_angle", 0.0),
    ("plate.flank_angle", 45 * DEG),
    ("plate.standard_apothem", 0.0),
    ("cutter.half_angle", 45 * DEG),
    ("cutter.half_angle", -1e-9),
    ("cutter.pitch", 0.0),
    ("drive.speed", 0.0),
    ("drive.preload", -1.0),
    ("plate.apothem", np.nan),
]
TAKEN = [
    ("links", 38.0),
    ("links", 2000.0),
    ("teeth.0", 6.0),
    ("teeth.1", 81.0),
    ("pitch", 1e-9),
    ("plate.flank_angle", 44.99 * DEG),
    ("joint.offset", 0.0),
    ("plate.apothem", -1 * MM),
    ("drive.load_torque", 0.0),
    ("joint.rolling_radius", 0.5),
]


def with_apothem(key):
    return chain(plate={"apothem": None}) if key == "plate.standard_apothem" else chain()


@pytest.mark.parametrize(("key", "value"), REFUSED)
def test_a_refused_design_is_nan_in_every_name_and_its_neighbours_are_not(key, value):
    spec = with_apothem(key)
    with pytest.raises(InputError):
        changed(spec, (key,), (value,))
    good = random_designs((key,), 2, seed=1)
    names = (*MESHING, *LAYOUT[:4], *CHECKS)
    found = batch(spec, (key,), names)(np.array([good[0], [value], good[1]]))
    alone = batch(spec, (key,), names)(good)
    for name in names:
        assert np.isnan(found[name][1])
        np.testing.assert_array_equal(found[name][[0, 2]], alone[name])
        assert np.all(np.isfinite(alone[name]))


@pytest.mark.parametrize(("key", "value"), TAKEN)
def test_a_design_at_the_edge_of_what_is_taken(key, value):
    rows = np.array([[value]])
    assert_same(batch(chain(), (key,), MESHING)(rows), run_of_each(chain(), (key,), rows, MESHING))


def test_teeth_and_links_are_held_against_each_other():
    keys, rows = ("links", "teeth.0", "teeth.1"), np.array([[40.0, 40, 20], [41, 40, 20], [40, 20, 40], [41, 20, 40], [41, 40.5, 20]])
    found = batch(chain(), keys, ("k", "modification.driven"))(rows)
    assert list(np.isfinite(found["k"])) == list(np.isfinite(found["modification.driven"])) == [False, True, False, True, False]


def test_a_chain_too_short_for_its_circles_has_no_layout():
    rows = np.arange(50.0, 61.0)[:, None]
    found = batch(chain(), ("links",), LAYOUT)(rows)
    wanted = run_of_each(chain(), ("links",), rows, LAYOUT, only=("layout",))
    reaches = np.isfinite(wanted["layout.chain_length"])
    assert 0 < np.sum(reaches) < len(rows) and np.all(np.isfinite(wanted["layout.pitch_diameter.drive"]))
    for name in LAYOUT:
        np.testing.assert_allclose(found[name], np.where(reaches, wanted[name], np.nan), rtol=1e-12)
    assert np.all(np.isfinite(batch(chain(), ("links",), LAYOUT[:4])(rows)[LAYOUT[0]]))


def test_numbers_beyond_the_floats_are_told_as_none():
    found = batch(chain(), ("pitch",), ("hole_pitch", *LAYOUT))(np.array([[9 * MM], [1e308], [8 * MM]]))
    for column in found.values():
        assert list(np.isfinite(column)) == [True, False, True]


# -- what is left to the run ---------------------------------------------------------------------------------------------------


def test_beyond_the_batch():
    radius, names = ("joint.rolling_radius",), ("pin_offset",)
    roller = dw.load(designs.__file__.replace("designs.py", "presets/roller.toml"))
    assert batch(roller, ("pitch",), ("layout.pitch_diameter.drive",)) is None
    for keys in (("plate.thickness",), (*radius, "joint.kind"), ("teeth",)):
        assert batch(chain(), keys, names) is None
    for more in ("layout.centre_distance", "layout.strand_frequency.1", "centre_distance.mean", "check.wrap.drive"):
        assert batch(chain(), radius, (*names, more)) is None
    assert batch(chain(), ("plate.standard_apothem",), names) is None  # it contradicts the spec's own apothem
    still = dw.SilentChain(pitch="9.525 mm", links=82, teeth=[35, 37], joint={"rolling_radius": "1.2 mm"}, plate={"apothem": "2.6 mm"})
    assert batch(still, ("drive.speed",), names) is None and batch(still, radius, ("layout.mesh_frequency",)) is None
    assert batch(still, radius, ("layout.chain_length",)) is not None
    idler = [{"name": "idler", "teeth": 21, "centre": ["100 mm", "60 mm"]}]
    assert batch(still.replace(sprockets=idler), radius, ("layout.chain_length",)) is None


# -- bits ----------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "keys",
    [
        ("joint.rolling_radius",),
        ("joint.offset", "plate.flank_angle", "teeth.1", "links", "cutter.half_angle"),
        ("teeth.0", "teeth.1", "pitch", "plate.apothem", "joint.rolling_radius", "drive.speed"),
    ],
)
def test_a_row_has_the_same_bits_in_any_company(keys, monkeypatch):
    names = (*MESHING, *LAYOUT, *CHECKS)
    rows = random_designs(keys, 1000, seed=12)
    rows[::17, 0] = -1.0 if keys[0] != "joint.offset" else np.nan
    evaluate, order = batch(chain(), keys, names), np.random.default_rng(2).permutation(1000)
    together, shuffled = evaluate(rows), evaluate(rows[order])
    sevens = [evaluate(np.asfortranarray(rows[at : at + 7])) for at in range(0, 105, 7)]
    ones = [evaluate(rows[at : at + 1]) for at in range(60)]
    monkeypatch.setattr("drivewright.spec.designs.BLOCK", 13)
    split = evaluate(rows)
    for name in names:
        np.testing.assert_array_equal(shuffled[name], together[name][order])
        np.testing.assert_array_equal(np.concatenate([each[name] for each in sevens]), together[name][:105])
        np.testing.assert_array_equal(np.concatenate([each[name] for each in ones]), together[name][:60])
        np.testing.assert_array_equal(split[name], together[name])
        exist = np.isfinite(together[name])  # but for the refused ones and the few chains that do not reach around
        assert not np.any(exist[::17]) and np.mean(exist) > 0.8


def test_no_designs_give_no_numbers():
    assert batch(chain(), ("pitch",), ("k",))(np.empty((0, 1)))["k"].shape == (0,)
