"""The folding four-bar by automatic differentiation of its Lagrangian: run as a script, JSON in, JSON out.

In: [{"bar": the fields of FourBar, "speed": omega, "states": [{"crank", "alphas", "rates"}, ...]}, ...]; out: for each bar and
state the links' accelerations.
Positions only are stated, with the rocker's sine from the quadratic of the paper as corrected; T, V and Rayleigh's function
follow, and Lagrange's equation is solved for the accelerations of the links that have a length.
"""

import json
import sys
from types import SimpleNamespace

import jax
import jax.numpy as jnp

jax.config.update("jax_enable_x64", True)


def configuration(bar, crank, alphas):
    """(x2, y2, x3, y3, x4, y4, theta3, theta4) of the three bodies."""
    l1, l2, l3, l4 = bar.lengths
    r = jnp.array(bar.clearances)
    rx, ry = r * jnp.cos(alphas), r * jnp.sin(alphas)
    a = l1 - l2 * jnp.cos(crank) - jnp.sum(rx)
    b = l2 * jnp.sin(crank) + jnp.sum(ry)
    d = b / a
    c = (a**2 + b**2 + l4**2 - l3**2) / (2 * a * l4)
    sine = (-c * d + bar.branch * jnp.sqrt(d**2 - c**2 + 1)) / (d**2 + 1)
    theta4 = jnp.arctan2(sine, c + d * sine)
    theta3 = jnp.arctan2(-b - l4 * jnp.sin(theta4), a - l4 * jnp.cos(theta4))
    s2, s3, s4 = bar.centroids
    return jnp.array(
        [
            rx[0] + s2 * jnp.cos(crank),
            ry[0] + s2 * jnp.sin(crank),
            rx[0] + l2 * jnp.cos(crank) + rx[1] + s3 * jnp.cos(theta3),
            ry[0] + l2 * jnp.sin(crank) + ry[1] + s3 * jnp.sin(theta3),
            l1 - rx[3] - s4 * jnp.cos(theta4),
            -ry[3] - s4 * jnp.sin(theta4),
            theta3,
            theta4,
        ]
    )


def accelerations(bar, speed, crank, alphas, rates):
    """d/dt dL/dq' - dL/dq + dR/dq' = 0 for q''."""
    m2, m3, m4 = bar.masses
    inertia = jnp.array([m2, m2, m3, m3, m4, m4, *bar.inertias])
    damping = jnp.array([bar.centroid_damping] * 6 + [bar.body_damping] * 2)

    def velocity(q, dq, angle):
        return jax.jvp(lambda q, angle: configuration(bar, angle, q), (q, angle), (dq, speed))[1]

    def lagrangian(q, dq, angle):
        height = configuration(bar, angle, q)[1:6:2]
        return 0.5 * jnp.sum(inertia * velocity(q, dq, angle) ** 2) - bar.gravity * jnp.sum(jnp.array(bar.masses) * height)

    def dissipation(q, dq, angle):
        return 0.5 * jnp.sum(damping * velocity(q, dq, angle) ** 2) + 0.5 * bar.link_damping * jnp.sum(dq**2)

    momentum = jax.grad(lagrangian, 1)
    at = (alphas, rates, crank)
    drift = jax.jvp(lambda q, angle: momentum(q, rates, angle), (alphas, crank), (rates, speed))[1]
    force = jax.grad(lagrangian, 0)(*at) - jax.grad(dissipation, 1)(*at) - drift
    active = jnp.array([k for k, r in enumerate(bar.clearances) if r > 0])
    mass = jax.jacfwd(momentum, 1)(*at)
    return jnp.zeros(4).at[active].set(jnp.linalg.solve(mass[jnp.ix_(active, active)], force[active]))


def answers(case):
    bar = SimpleNamespace(**case["bar"])
    solve = jax.jit(lambda crank, alphas, rates: accelerations(bar, case["speed"], crank, alphas, rates))
    return [solve(s["crank"], jnp.array(s["alphas"]), jnp.array(s["rates"])).tolist() for s in case["states"]]


if __name__ == "__main__":
    json.dump([answers(case) for case in json.load(sys.stdin)], sys.stdout)
