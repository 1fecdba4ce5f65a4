"""Gradient and Hessian of a drive's energy against differences of it, and exact properties of both."""

import numpy as np
import pytest
from chain_implicit_models import small, with_guides, with_rollers
from test_chain_implicit_ring import dense

from drivewright.chains.implicit.energy import assemble
from drivewright.chains.implicit.parts import assembled, at_rest, compile_model
from drivewright.chains.implicit.touch import find_candidates

pytestmark = pytest.mark.analytical

MODELS = {
    "teeth": (lambda: small(gravity=(3.0, -9.81), torque=0.4), 1.5e-4),
    "guides": (lambda: with_guides(small()), 1e-5),
    "rollers": (with_rollers, 4e-5),
}


def shaken(model, amount, seed=0):
    """Parts and a state off the assembly by `amount` [m] and a hundred times that in angle."""
    rng, parts, state = np.random.default_rng(seed), compile_model(model), assembled(model)
    find_candidates(parts, state)
    plates = state.plates + amount * rng.normal(size=state.plates.shape) * [1, 1, 100]
    return parts, at_rest(plates, state.bodies + amount * rng.normal(size=state.bodies.shape) * [1, 20])


def columns(parts):
    return np.column_stack([parts.bodies["slide_column"], parts.bodies["turn_column"]])


def gradient(parts):
    """Of the plates, then of what is free of the bodies in the order of the border."""
    free = columns(parts) >= 0
    return np.append(parts.field.plates, parts.field.bodies[free])


def moved(parts, state, number, by):
    """Energy and gradient with one unknown moved."""
    plates, bodies = state.plates.copy(), state.bodies.copy()
    if number < plates.size:
        plates.ravel()[number] += by
    else:
        bodies[tuple(np.argwhere(columns(parts) == number - plates.size)[0])] += by
    return assemble(parts, at_rest(plates, bodies), 0.0), gradient(parts)


@pytest.mark.parametrize("kind", MODELS)
def test_derivatives_are_those_of_the_energy(kind):
    make, amount = MODELS[kind]
    parts, state = shaken(make(), amount)
    assemble(parts, state, 0.0)
    pairs = parts.pairs[: parts.size[0]].copy()
    assert np.sum(pairs["right"] > 0) > 1
    assert np.sum(pairs["left"] > 0) > 1 or kind == "guides"
    slope, bend = gradient(parts), dense(parts.field.ring)
    by_energy, by_slope, h = np.empty_like(slope), np.empty_like(bend), 1e-8
    for k in range(len(slope)):
        (up, up_slope), (down, down_slope) = (moved(parts, state, k, step) for step in (h, -h))
        by_energy[k], by_slope[k] = (up - down) / (2 * h), (up_slope - down_slope) / (2 * h)
    assert slope == pytest.approx(by_energy, abs=1e-7 * np.max(np.abs(slope)))
    size = np.sqrt(np.diag(bend))  # entries of places and of angles differ by the square of a length
    assert bend / np.outer(size, size) == pytest.approx(by_slope / np.outer(size, size), abs=1e-6)


@pytest.mark.parametrize("kind", MODELS)
def test_dampers_take_what_the_tangent_says(kind):
    """With all dampers linear the gradient is f(q) + C v: two rates differ by C, which is the tangent at gain 1 less that at 0."""
    make, amount = MODELS[kind]
    parts, state = shaken(make(), amount)
    parts.bodies["damping"], parts.bodies["slide_damping"], parts.bodies["turn_damping"] = 0.1, 7.0, 0.3
    parts.bodies["friction"] = 0.0
    rng = np.random.default_rng(8)
    moving = state._replace(plate_rates=1e-3 * rng.normal(size=state.plates.shape), body_rates=1e-3 * rng.normal(size=state.bodies.shape))
    free = columns(parts) >= 0
    moving.body_rates[~free] = 0.0
    assemble(parts, state, 0.0)
    rest, stiff = gradient(parts), dense(parts.field.ring)
    assemble(parts, state, 1.0)
    damping = dense(parts.field.ring) - stiff
    assemble(parts, moving, 0.0)
    rates = np.append(moving.plate_rates, moving.body_rates[free])
    force = gradient(parts) - rest
    assert np.max(np.abs(force)) > 1e-4
    assert force == pytest.approx(damping @ rates, abs=1e-5 * np.max(np.abs(force)))
    assert rates @ force == pytest.approx(np.sum(parts.field.powers[[0, 1, 2, 3, 5]]), rel=1e-5)


def test_inner_forces_have_no_resultant_and_no_moment():
    """Moved or turned as a whole, sprockets on the chain, no energy changes: forces on plates and bodies balance."""
    parts, state = shaken(small(), 1.5e-4, seed=2)
    assemble(parts, state, 0.0)
    force, loads, x = parts.field.plates, parts.field.loads, state.plates
    centre = np.column_stack([parts.bodies["x0"] + state.bodies[:, 0] * parts.bodies["ux"], parts.bodies["y0"]])
    size = np.sum(np.abs(force[:, :2]))
    assert np.sum(force[:, :2], axis=0) == pytest.approx(np.sum(loads[:, :2], axis=0), abs=1e-12 * size)
    turning = np.sum(force[:, 2] + x[:, 0] * force[:, 1] - x[:, 1] * force[:, 0])
    moment = np.sum(loads[:, 2] + centre[:, 0] * loads[:, 1] - centre[:, 1] * loads[:, 0])
    assert turning == pytest.approx(moment, abs=1e-12 * size)
