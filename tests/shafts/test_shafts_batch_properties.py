"""Batches of random shafts: what must hold for each of them, and a second route that shares nothing with the kernels."""

import numpy as np
import pytest

from drivewright._jit import plain
from drivewright.errors import InputError
from drivewright.shafts import batch
from drivewright.shafts.batch import flexibilities
from drivewright.shafts.batch_kernels import LANES
from drivewright.shafts.closed_form import flexibility
from drivewright.shafts.model import COWPER, EULER_BERNOULLI

pytestmark = pytest.mark.property

KINDS = [(s, b, m) for s in (1, 2, 3, 4, 5) for b in (2, 3, 4) for m in (1, 2, 3)]


def shafts(seed, count, sections, bearings, stations, rigid=0.2, cones=0.0, shear=COWPER):
    """Arguments of `flexibilities`: stepped, hollow shafts, bearings anywhere at least 2 % of the length apart."""
    rng = np.random.default_rng(seed)
    lengths = rng.uniform(0.02, 0.2, (count, sections))
    whole = lengths.sum(axis=1, keepdims=True)
    diameters = rng.uniform(0.015, 0.05, (count, sections))
    gaps = rng.exponential(size=(count, bearings + 1))
    supports = np.cumsum(gaps / gaps.sum(axis=1, keepdims=True) * (0.98 - 0.02 * bearings) + 0.02, axis=1)[:, :-1] * whole
    stiffness = 10 ** rng.uniform(6, 10, (count, bearings))
    stiffness[rng.random(stiffness.shape) < rigid] = np.inf
    return {
        "lengths": lengths,
        "diameters": diameters,
        "supports": supports,
        "radial_stiffness": stiffness,
        "stations": rng.uniform(0.0, 1.0, (count, stations)) * whole,
        "youngs_modulus": rng.uniform(70e9, 210e9, count),
        "poisson": rng.uniform(0.2, 0.35, count),
        "shear": shear,
        "bores": diameters * rng.uniform(0.0, 0.4, diameters.shape) * (rng.random((count, 1)) < 0.5),
        "end_diameters": diameters * np.where(rng.random(diameters.shape) < cones, rng.uniform(0.6, 1.6, diameters.shape), 1.0),
    }


def near(a, b, tolerance):
    """Entries agree, each against the two diagonals it stands between."""
    scale = np.sqrt(np.einsum("nii->ni", b))
    assert np.max(np.abs(a - b) / (scale[:, :, None] * scale[:, None, :])) < tolerance


def second_route(one):
    """Flexibility and reactions of one shaft as the least of the complementary energy, by quadrature and least squares.

    A state of stress is the vector of M sqrt(dx/EI), V sqrt(dx/kappa G A) and R/sqrt(k): the true one under a unit force is the shortest
    in equilibrium, and delta_ij is the product of two of them (virtual work).
    """
    ends = np.concatenate([[0.0], np.cumsum(one["lengths"])])
    places, nu = one["supports"], one["poisson"]
    cuts = np.unique(np.concatenate([ends, places, one["stations"]]))
    node, weight = np.polynomial.legendre.leggauss(20)
    half = 0.5 * np.diff(cuts)[:, None]
    x, dx = (half * (node + 1) + cuts[:-1, None]).ravel(), (half * weight).ravel()
    s = np.searchsorted(ends, x) - 1
    outer = one["diameters"][s] + (one["end_diameters"] - one["diameters"])[s] * (x - ends[s]) / one["lengths"][s]
    m = one["bores"][s] / outer
    bend = one["youngs_modulus"] * np.pi / 64 * outer**4 * (1 - m**4)
    kappa = 6 * (1 + nu) * (1 + m**2) ** 2 / ((7 + 6 * nu) * (1 + m**2) ** 2 + (20 + 12 * nu) * m**2)
    slide = kappa * one["youngs_modulus"] / (2 + 2 * nu) * np.pi / 4 * outer**2 * (1 - m**2)
    soft = np.zeros_like(x) if one["shear"] == EULER_BERNOULLI else np.sqrt(dx / slide)

    def state(place, reaction):
        own = np.zeros(len(places)) if reaction is None else reaction / np.sqrt(one["radial_stiffness"])
        return np.concatenate([np.maximum(x - place, 0) * np.sqrt(dx / bend), (x > place) * soft, own])

    held = np.array([state(place, unit) for place, unit in zip(places, np.eye(len(places)), strict=True)]).T
    balance = np.array([np.ones(len(places)), places])
    free = np.linalg.svd(balance)[2][2:].T
    columns, reactions = [], []
    for place in one["stations"]:
        carried = np.linalg.lstsq(balance, np.array([1.0, place]), rcond=None)[0]
        stress = held @ carried - state(place, None)
        if free.size:
            more = np.linalg.lstsq(held @ free, -stress, rcond=None)[0]
            stress, carried = stress + held @ free @ more, carried + free @ more
        columns.append(stress)
        reactions.append(carried)
    return np.array(columns) @ np.array(columns).T, np.array(reactions).T


@pytest.mark.parametrize("shear", [COWPER, EULER_BERNOULLI])
@pytest.mark.parametrize(("sections", "bearings", "cones"), [(1, 2, 0.0), (3, 2, 0.5), (4, 3, 0.5), (3, 4, 0.0), (5, 5, 0.3)])
def test_the_unit_load_integral_says_the_same(sections, bearings, cones, shear):
    many = shafts(1, 6, sections, bearings, 3, cones=cones, shear=shear)
    delta, carried = flexibilities(**many, reactions=True)
    for n in range(6):
        one = {key: value[n] if np.ndim(value) else value for key, value in many.items()}
        expected, reactions = second_route(one)
        near(delta[n : n + 1], expected[None], 1e-9)
        assert np.allclose(carried[n], reactions, rtol=0, atol=1e-9 * np.abs(reactions).max())


@pytest.mark.parametrize("shear", [COWPER, EULER_BERNOULLI, 0.7])
def test_closed_form_and_sweep_agree(shear):
    """To rounding, for stations left of, between and right of the bearings; as the sections, and as numpy, state it."""
    many = shafts(2, 2000, 1, 2, 4, shear=shear)
    x, supports = many["stations"], many["supports"]
    for found in (x < supports[:, :1], (x > supports[:, :1]) & (x < supports[:, 1:]), x > supports[:, 1:]):
        assert np.count_nonzero(found) > 300
    delta, carried = flexibilities(**many, reactions=True)
    third = {"supports": np.hstack([supports, many["lengths"] / 2]), "radial_stiffness": np.pad(many["radial_stiffness"], ((0, 0), (0, 1)))}
    swept, swept_carried = flexibilities(**many | third, reactions=True)
    near(swept, delta, 1e-12)
    assert np.allclose(swept_carried, np.pad(carried, ((0, 0), (0, 1), (0, 0))), rtol=0, atol=1e-12 * np.abs(carried).max())
    d, b, nu = many["diameters"], many["bores"], many["poisson"][:, None]
    m2 = (b / d) ** 2
    kappa = shear or 6 * (1 + nu) * (1 + m2) ** 2 / ((7 + 6 * nu) * (1 + m2) ** 2 + (20 + 12 * nu) * m2)
    modulus = many["youngs_modulus"][:, None]
    slide = np.inf if shear < 0 else (kappa * modulus / (2 + 2 * nu) * np.pi / 4 * (d**2 - b**2))[:, 0]
    bend = (modulus * np.pi / 64 * (d**4 - b**4))[:, 0]
    near(flexibility(x, supports[:, ::-1], many["radial_stiffness"][:, ::-1], bend, slide), delta, 1e-13)


@pytest.mark.parametrize("bearings", [2, 3, 4])
def test_compliance_never_stiffens(bearings):
    """10 000 random shafts in all: symmetric, positive definite, and what softer bearings add is positive semidefinite."""
    rng = np.random.default_rng(3)
    seen = 0
    for number, (sections, count, stations) in enumerate(KINDS):
        if count != bearings:
            continue
        many = shafts(100 + number, 223, sections, bearings, stations, cones=0.1)
        stiff = flexibilities(**many)
        give = 1 / many["radial_stiffness"] + 10 ** rng.uniform(-11, -7, many["radial_stiffness"].shape)
        soft = flexibilities(**many | {"radial_stiffness": 1 / give})
        size = np.trace(soft, axis1=1, axis2=2)[:, None]
        assert np.array_equal(stiff, stiff.swapaxes(1, 2))
        assert np.all(np.linalg.eigvalsh(stiff) > -1e-13 * size)
        assert np.all(np.linalg.eigvalsh(soft) > 0)
        assert np.all(np.einsum("nii->ni", soft) > np.einsum("nii->ni", stiff) * (1 - 1e-13))
        assert np.all(np.linalg.eigvalsh(soft - stiff) > -1e-12 * size)
        seen += len(stiff)
    assert 3 * seen > 10_000


@pytest.fixture(scope="module", params=[(1, 2), (4, 2), (4, 3), (3, 4)], ids=str)
def many(request):
    return shafts(4, 300, *request.param, 3, cones=0.3)


def test_mirror(many):
    whole = many["lengths"].sum(axis=1, keepdims=True)
    mirrored = many | {name: whole - many[name] for name in ("supports", "stations")}
    mirrored |= {name: many[name][:, ::-1] for name in ("lengths", "bores")}
    mirrored |= {"diameters": many["end_diameters"][:, ::-1], "end_diameters": many["diameters"][:, ::-1]}
    delta, carried = flexibilities(**many, reactions=True)
    back, back_carried = flexibilities(**mirrored, reactions=True)
    near(back, delta, 1e-11)
    assert np.allclose(back_carried, carried, rtol=0, atol=1e-11 * np.abs(carried).max())


def test_order_of_bearings_and_stations_is_free(many):
    delta, carried = flexibilities(**many, reactions=True)
    bearings = carried.shape[1]
    b, m = np.roll(np.arange(bearings), 1), [2, 0, 1]
    turned = {name: many[name][:, b] for name in ("supports", "radial_stiffness")} | {"stations": many["stations"][:, m]}
    other, other_carried = flexibilities(**many | turned, reactions=True)
    near(other, delta[:, m][:, :, m], 1e-14)
    assert np.allclose(other_carried, carried[:, b][:, :, m], rtol=0, atol=1e-14 * np.abs(carried).max())


def test_scaling(many):
    """E and k times a: 1/a of the flexibility.  All lengths times a, E over a: the same flexibility (springs untouched)."""
    delta = flexibilities(**many)
    near(2.5 * flexibilities(**many | {name: 2.5 * many[name] for name in ("youngs_modulus", "radial_stiffness")}), delta, 1e-12)
    sizes = ("lengths", "diameters", "end_diameters", "bores", "supports", "stations")
    larger = {name: 1e3 * many[name] for name in sizes} | {"youngs_modulus": many["youngs_modulus"] / 1e3}
    near(flexibilities(**many | larger), delta, 1e-12)


def test_stiffnesses_share_the_flexibility(many):
    """The logarithmic sensitivities to all k together and to E sum to -1, none of the two being 0 or -1."""
    step = 1e-5

    def sensitivity(name):
        up, down = (flexibilities(**many | {name: many[name] * np.exp(sign * step)}) for sign in (1, -1))
        return np.einsum("nii->ni", up - down) / np.einsum("nii->ni", up + down) / step

    by_bearings, by_shaft = sensitivity("radial_stiffness"), sensitivity("youngs_modulus")
    assert np.allclose(by_bearings + by_shaft, -1, rtol=0, atol=1e-6)
    inside = (by_bearings < -1e-3) & (by_bearings > -0.999)
    assert inside.mean() > 0.3


def test_reactions_balance_the_force(many):
    delta, carried = flexibilities(**many, reactions=True)
    largest = np.abs(carried).max()
    assert np.allclose(carried.sum(axis=1), 1, rtol=0, atol=1e-11 * largest)
    assert np.allclose(np.einsum("nb,nbi->ni", many["supports"], carried), many["stations"], rtol=0, atol=1e-11 * largest)


def test_reaction_is_stiffness_times_deflection(many):
    """Betti: with stations at the bearings, what a spring carries is k delta."""
    stiffness = np.minimum(many["radial_stiffness"], 1e8)
    stations = np.hstack([many["stations"], many["supports"]])
    delta, carried = flexibilities(**many | {"stations": stations, "radial_stiffness": stiffness}, reactions=True)
    bearings = stiffness.shape[1]
    assert np.allclose(carried, stiffness[:, :, None] * delta[:, -bearings:], rtol=0, atol=1e-10 * np.abs(carried).max())


@pytest.mark.parametrize("stiffness", [0.0, 1e-6, 1e3, 1e8, np.inf])
def test_one_more_bearing(stiffness):
    """Between, left or right of the others, it takes away d_i d_j/(d + 1/k), where d is the flexibility at its place: nothing for k = 0."""
    many = shafts(5, 200, 3, 2, 3)
    place = many["lengths"].sum(axis=1) * np.random.default_rng(5).random(200)
    before = flexibilities(**many | {"stations": np.c_[many["stations"], place]})
    column, own = before[:, :3, 3:], before[:, 3:, 3:]
    factor = 1 / (own + 1 / stiffness) if stiffness else 0.0
    third = {
        "supports": np.insert(many["supports"], 1, place, axis=1),
        "radial_stiffness": np.insert(many["radial_stiffness"], 1, stiffness, axis=1),
    }
    after = flexibilities(**many | third)
    scale = np.sqrt(np.einsum("nii->ni", before[:, :3, :3]))
    miss = np.abs(after - before[:, :3, :3] + column * column.swapaxes(1, 2) * factor)
    assert np.max(miss / scale[:, :, None] / scale[:, None, :]) < 1e-11
    if stiffness < 1e-5:
        near(after, before[:, :3, :3], 1e-9)


def test_rigid_is_the_limit_of_stiff():
    many = shafts(6, 200, 3, 3, 2, rigid=0.0)
    rigid = flexibilities(**many | {"radial_stiffness": np.inf})
    for stiffness in (1e14, 1e15):
        stiff = flexibilities(**many | {"radial_stiffness": stiffness})
        gain = np.einsum("nii->ni", stiff - rigid)
        assert np.all(gain > -1e-13 * np.einsum("nii->ni", rigid)) and np.max(gain / np.einsum("nii->ni", rigid)) < 1e16 / stiffness


def test_shear_vanishes_as_one_over_its_stiffness():
    """What shear adds goes with 1/kappa exactly on two bearings, whose reactions do not depend on it."""
    many = shafts(7, 200, 3, 2, 2, cones=0.3, shear=EULER_BERNOULLI)
    without = flexibilities(**many)
    once, tenth = (flexibilities(**many | {"shear": kappa}) - without for kappa in (0.5, 5.0))
    near(without + 10 * tenth, without + once, 1e-12)
    near(flexibilities(**many | {"shear": 1e12}), without, 1e-10)
    assert np.median(np.einsum("nii->ni", once) / np.einsum("nii->ni", without)) > 1e-3


def test_short_pieces_cost_no_digits():
    """A shaft cut into slices down to a nanometre is the same shaft: no element matrix whose entries grow with 1/l^3."""
    many = shafts(8, 100, 3, 3, 3)
    thin = np.full((100, 1), 1e-9)
    lengths = np.hstack([many["lengths"][:, :1] - 2e-9, thin, thin, many["lengths"][:, 1:]])
    cut = {name: np.hstack([many[name][:, :1]] * 2 + [many[name]]) for name in ("diameters", "end_diameters", "bores")}
    near(flexibilities(**many | cut | {"lengths": lengths}), flexibilities(**many), 1e-12)


def test_cut_cones_are_the_same_cones():
    many = shafts(9, 100, 1, 3, 3, cones=1.0)
    middle = many["diameters"] + 0.3 * (many["end_diameters"] - many["diameters"])
    halves = {
        "lengths": many["lengths"] * [[0.3, 0.7]],
        "diameters": np.hstack([many["diameters"], middle]),
        "end_diameters": np.hstack([middle, many["end_diameters"]]),
    }
    near(flexibilities(**many | halves), flexibilities(**many), 1e-12)


def test_a_station_on_a_rigid_bearing_stays_exactly():
    """Also a rounding error beside it, where neither deflection nor reaction may go astray."""
    many = shafts(10, 100, 3, 3, 2, rigid=1.0)
    stations = np.hstack([many["supports"][:, 1:2], many["stations"]])
    delta, carried = flexibilities(**many | {"stations": stations}, reactions=True)
    assert np.all(delta[:, 0] == 0) and np.all(delta[:, 1:, 1:].diagonal(axis1=1, axis2=2) > 0)
    assert np.all(carried[:, :, 0] == [0, 1, 0])
    for beside in (np.inf, -np.inf):
        stations[:, 0] = np.nextafter(many["supports"][:, 1], beside)
        shifted, shifted_carried = flexibilities(**many | {"stations": stations}, reactions=True)
        assert np.allclose(shifted, delta, rtol=1e-12, atol=1e-20)
        assert np.allclose(shifted_carried, carried, rtol=0, atol=1e-12 * np.abs(carried).max())


def test_two_stations_at_one_place_move_alike():
    many = shafts(11, 50, 2, 3, 2)
    many["stations"][:, 1] = many["stations"][:, 0]
    delta = flexibilities(**many)
    assert np.allclose(delta, delta[:, :1, :1], rtol=1e-15, atol=0)


def test_two_springs_at_one_place_are_one():
    many = shafts(12, 50, 2, 3, 2, rigid=0.0)
    many["supports"][:, 1] = many["supports"][:, 0]
    joined = {
        "supports": many["supports"][:, 1:],
        "radial_stiffness": np.c_[many["radial_stiffness"][:, :2].sum(axis=1), many["radial_stiffness"][:, 2]],
    }
    near(flexibilities(**many), flexibilities(**many | joined), 1e-13)


def test_shared_arguments_are_the_repeated_ones():
    many = shafts(13, 40, 3, 3, 2)
    for name, value in many.items():
        one = value[:1] if np.ndim(value) else value
        shared = {**many, name: one}
        repeated = {**many, name: np.repeat(one, 40, axis=0) if np.ndim(value) else np.full(40, value)}
        assert np.array_equal(flexibilities(**shared), flexibilities(**repeated), equal_nan=True), name
    number = {**many, "diameters": 0.03, "end_diameters": None, "bores": 0.01, "radial_stiffness": 1e8}
    table = {
        **many,
        "diameters": np.full((1, 3), 0.03),
        "end_diameters": None,
        "bores": np.full((40, 3), 0.01),
        "radial_stiffness": np.full((40, 1), 1e8),
    }
    assert np.array_equal(flexibilities(**number), flexibilities(**table))
    view = {**many, "lengths": np.broadcast_to(many["lengths"][:1], (40, 3)), "stations": np.asfortranarray(many["stations"])}
    assert np.array_equal(flexibilities(**view), flexibilities(**many | {"lengths": many["lengths"][:1]}))


@pytest.mark.skipif(not hasattr(batch.fill_flexibilities, "signatures"), reason="numba is switched off")
def test_one_compiled_version_serves_every_shape():
    batch.warm_batch()
    many = shafts(13, 4, 2, 3, 2)
    frozen = {name: np.broadcast_to(value, value.shape) if np.ndim(value) else value for name, value in many.items()}
    flexibilities(**frozen | {"stations": [[0, 0]], "poisson": np.float32(0.3)}, reactions=True)
    assert len(batch.fill_flexibilities.signatures) == 1


def test_nothing_to_do():
    many = shafts(14, 1, 2, 3, 2)
    assert flexibilities(**many | {"stations": np.zeros((0, 2))}).shape == (0, 2, 2)


@pytest.mark.parametrize("kind", [(1, 2), (4, 3)])
def test_threads_and_chunks_change_no_digit(kind, monkeypatch):
    many = shafts(15, 500, *kind, 2, cones=0.3)
    whole = flexibilities(**many, reactions=True, workers=1)
    monkeypatch.setattr(batch, "CHUNK", 300)
    done = []
    parts = flexibilities(**many, reactions=True, workers=3, progress=lambda *args: done.append(args))
    assert len(done) > 10
    assert all(np.array_equal(a, b) for a, b in zip(whole, parts, strict=True))


def test_interrupted_it_returns_nothing(monkeypatch):
    def stop(done, total, what):
        raise KeyboardInterrupt

    monkeypatch.setattr(batch, "CHUNK", 100)
    with pytest.raises(KeyboardInterrupt):
        flexibilities(**shafts(16, 100, 2, 2, 2), progress=stop)


@pytest.mark.parametrize("kind", [(1, 2), (3, 4)])
def test_uncompiled_the_same(kind, monkeypatch):
    many = shafts(17, 5, *kind, 2, cones=0.5 * (kind[0] > 1))
    compiled = flexibilities(**many, reactions=True)
    monkeypatch.setattr(batch, "fill_flexibilities", plain(batch.fill_flexibilities))
    for a, b in zip(compiled, flexibilities(**many, reactions=True), strict=True):
        assert np.allclose(a, b, rtol=1e-13, atol=1e-14 * np.abs(a).max())


@pytest.mark.parametrize("shear", [COWPER, 0.9, EULER_BERNOULLI])
def test_neighbours_in_a_batch_do_not_matter(shear):
    """Uniform, stepped, turned round and impossible shafts in any order, over several blocks of the kernel and a part of one."""
    count = 2 * LANES + 7
    many, rng = shafts(18, count, 2, 2, 3, shear=shear), np.random.default_rng(18)
    uniform, turned, wrong = rng.random((3, count)) < [[0.6], [0.5], [0.1]]
    for name in ("diameters", "bores"):
        many[name][uniform] = many[name][uniform, :1]
    many["end_diameters"][uniform] = many["diameters"][uniform]
    for name in ("supports", "radial_stiffness"):
        many[name][turned] = many[name][turned, ::-1]
    many["diameters"][wrong, 0] = -1.0
    assert all(0 < each[:LANES].sum() < LANES for each in (uniform, turned, wrong))
    delta, carried = flexibilities(**many, reactions=True)
    np.testing.assert_array_equal(np.isnan(delta).all(axis=(1, 2)), wrong)
    np.testing.assert_array_equal(np.isnan(carried).any(axis=(1, 2)), wrong)
    for n in range(count):
        one = {name: value[n : n + 1] if np.ndim(value) else value for name, value in many.items()}
        alone = flexibilities(**one, reactions=True)
        np.testing.assert_allclose(delta[n], alone[0][0], rtol=1e-12)
        np.testing.assert_allclose(carried[n], alone[1][0], rtol=1e-12)
    rows = uniform & ~wrong
    d, b, nu = many["diameters"][rows, 0], many["bores"][rows, 0], many["poisson"][rows]
    modulus, m2 = many["youngs_modulus"][rows], (b / d) ** 2
    cowper = 6 * (1 + nu) * (1 + m2) ** 2 / ((7 + 6 * nu) * (1 + m2) ** 2 + (20 + 12 * nu) * m2)
    kappa = np.inf if shear == EULER_BERNOULLI else cowper if shear == COWPER else shear
    bending, slide = modulus * np.pi / 64 * (d**4 - b**4), kappa * modulus / (2 + 2 * nu) * np.pi / 4 * (d**2 - b**2)
    near(delta[rows], flexibility(many["stations"][rows], many["supports"][rows], many["radial_stiffness"][rows], bending, slide), 1e-13)


@pytest.mark.parametrize("name", ["diameters", "end_diameters", "bores"])
def test_a_shaft_that_differs_in_its_middle_alone_is_not_uniform(name):
    many = shafts(20, 5, 3, 2, 2)
    for each in ("diameters", "bores"):
        many[each][:] = many[each][:, :1]
    many["end_diameters"] = many["diameters"].copy()
    many[name][:, 1] *= 0.9
    many["bores"][:, 1] += 1e-3 * (name == "bores")
    third = {"supports": np.c_[many["supports"], many["lengths"][:, 0]], "radial_stiffness": np.c_[many["radial_stiffness"], np.zeros(5)]}
    near(flexibilities(**many), flexibilities(**many | third), 1e-12)


@pytest.mark.parametrize("name", ["lengths", "diameters", "bores", "supports", "radial_stiffness", "stations", "youngs_modulus", "poisson"])
def test_what_all_designs_share_is_given_once(name):
    """One number, or one row, for all is the same as a row for each: a column is read in steps of no, one and several numbers."""
    many = shafts(19, LANES + 3, 1, 2, 2)
    many[name] = many[name][:1]
    full = many | {name: np.repeat(many[name], LANES + 3, axis=0)}
    if name in ("diameters", "bores"):
        many["end_diameters"] = full["end_diameters"] = full["diameters"]
    np.testing.assert_allclose(flexibilities(**many), flexibilities(**full), rtol=1e-13)


IMPOSSIBLE = {
    "a length of 0": ("lengths", 0, 0.0),
    "a length that is no number": ("lengths", 1, np.nan),
    "a diameter of 0": ("diameters", 0, 0.0),
    "a cone to nothing": ("end_diameters", 1, -0.01),
    "a bore as wide as the shaft": ("bores", 0, 0.03),
    "a bore below 0": ("bores", 0, -1e-3),
    "a support off the left end": ("supports", 0, -1e-3),
    "a support off the right end": ("supports", 1, 0.3001),
    "a station off the shaft": ("stations", 1, 0.31),
    "an endless station": ("stations", 0, np.inf),
    "a stiffness below 0": ("radial_stiffness", 1, -1.0),
    "no modulus": ("youngs_modulus", 0, 0.0),
    "a negative modulus": ("youngs_modulus", 0, -206e9),
    "nu of rubber and more": ("poisson", 0, 0.5),
    "nu of -1": ("poisson", 0, -1.0),
    "no kappa": ("shear", 0, np.nan),
}


@pytest.mark.parametrize("swept", [False, True])
@pytest.mark.parametrize("why", IMPOSSIBLE)
def test_an_impossible_design_is_a_row_of_nan(why, swept):
    good = {
        "lengths": [0.1, 0.2],
        "diameters": [0.03, 0.03],
        "end_diameters": [0.03, 0.03 + 0.01 * swept],
        "bores": [0.0, 0.0],
        "supports": [0.02, 0.28, 0.28 - 0.1 * swept],
        "radial_stiffness": [1e8, 1e8, 1e8],
        "stations": [0.0, 0.3],
        "youngs_modulus": 206e9,
        "poisson": 0.3,
        "shear": 0.9,
    }
    if not swept:
        good |= {"supports": good["supports"][:2], "radial_stiffness": [1e8, 1e8]}
    rows = {name: np.repeat(np.atleast_2d(value), 3, axis=0) for name, value in good.items()}
    name, entry, value = IMPOSSIBLE[why]
    rows[name][1, entry] = value
    for delta in flexibilities(**rows, reactions=True):
        assert np.all(np.isnan(delta[1])) and np.all(np.isfinite(delta[[0, 2]]))


@pytest.mark.parametrize(
    ("supports", "stiffness"),
    [
        ([0.1], [1e8]),
        ([0.1, 0.1], [1e8, 2e8]),
        ([0.1, 0.1], [np.inf, np.inf]),
        ([0.1, 0.2], [1e8, 0.0]),
        ([0.1, 0.2], [0.0, np.inf]),
        ([0.1, 0.2, 0.2], [0.0, 1e8, 2e8]),
        ([0.1, 0.15, 0.2], [0.0, 1e8, 0.0]),
        ([0.1, 0.1, 0.2], [np.inf, np.inf, 1e8]),
    ],
)
@pytest.mark.parametrize("steps", [0.0, 0.01])
def test_what_does_not_stand_is_nan(supports, stiffness, steps):
    delta = flexibilities([0.1, 0.2], [0.03, 0.03 + steps], supports, stiffness, [0.0, 0.1, 0.15, 0.3], 206e9, 0.3)
    assert np.all(np.isnan(delta))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"diameters": [0.02, 0.03]}, ["diameters has 2 entries", "lengths has 3", "single number"]),
        ({"radial_stiffness": [1e8, 1e8, 1e8]}, ["radial_stiffness has 3 entries", "supports has 2"]),
        ({"poisson": np.full(7, 0.3)}, ["disagree", "poisson 7", "lengths 5"]),
        ({"stations": np.zeros((5, 1, 2))}, ["stations must have the shape (designs, entries)", "(5, 1, 2)"]),
        ({"youngs_modulus": np.zeros((5, 2))}, ["youngs_modulus must have the shape (designs,)", "(5, 2)"]),
        ({"supports": [["a", "b"]]}, ["supports must be numbers", "'a'"]),
        ({"stations": [[0.1], [0.1, 0.2]]}, ["stations must be numbers, one row per design"]),
        ({"workers": 0}, ["workers", "0"]),
    ],
)
def test_shapes_that_do_not_fit_are_refused(change, words):
    many = shafts(18, 5, 3, 2, 2) | {"end_diameters": None, "bores": 0.0}
    with pytest.raises(InputError) as told:
        flexibilities(**many | change)
    assert [word for word in words if word not in str(told.value)] == []


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"supports": (0.1, 0.1)}, ["two bearings", "0 stand at one place"]),
        ({"supports": (0.1, 0.2, 0.3)}, ["supports", "must be 2", "(3,)"]),
        ({"radial_stiffness": 1e8}, ["radial_stiffness", "must be 2", "()"]),
        ({"radial_stiffness": (1e8, -3.0)}, ["radial_stiffness", "-3", "not above 0"]),
        ({"bending_stiffness": [0.0]}, ["bending_stiffness", "not above 0"]),
        ({"shear_stiffness": np.nan}, ["shear_stiffness", "nan"]),
    ],
)
def test_the_closed_form_refuses(change, words):
    good = {"stations": (0.0, 0.3), "supports": (0.1, 0.2), "radial_stiffness": (1e8, 1e8), "bending_stiffness": 1e3}
    with pytest.raises(InputError) as told:
        flexibility(**good | change)
    assert [word for word in words if word not in str(told.value)] == []
