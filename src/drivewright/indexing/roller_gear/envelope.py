"""The flanks of a roller-gear cam: the envelope of a cylinder that the turret carries, seen from the turning cam.

A point c(u) of the roller's axis moves against the cam with v = omega_turret x c - omega_cam x (c - A), per radian of the cam.  In the
turret's frame turned by psi, with e1 = d x y across the roller in the plane of its axis and the turret's, and y along its path:
    v.y  = P = psi' rho - s sin(psi) g,        rho = R + u cos b  (radius),  g = h - u sin b  (depth below the cam's axis)
    v.e1 = Q = -s [cos b (C - rho cos psi) + sin b cos(psi) g],     s = hand_sign
The normal m = cos(a) e1 + sin(a) y touches where Phi(u, a, t) = m.v = Q cos a + P sin a = 0, at two opposite places: the flanks.  Flank
+1 pushes the turret forward (+phi), flank -1 backward.  The force on the roller is along -m, so tan(pressure angle) = |P/Q|; of the
globoidal cam rho phi'/(C - rho cos psi).

Curvature.  A point that is fixed to the cam has the gap rate -Phi and the second derivative of its gap by the angle
    G = -Phi_t + Phi_u (d.v) + Phi_a (t.v)/r,      t = dm/da,  v at the surface,
so that roller and cam part as (Phi_u du + Phi_a da)^2/(2 G): not along the contact line, and with the relative curvature
|grad Phi|^2/G across it, |grad Phi|^2 = Phi_u^2 + Phi_a^2/r^2.  G <= 0 is undercut, G = 0 the singular edge of the envelope.
The equations are derived here; the tests check them by finite differences of the surface.
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.indexing.roller_gear.design import RollerGear


class FlankContact(NamedTuple):
    """Contact of a roller with a flank at travel t and place u of the roller; arrays that broadcast, SI units, rates per radian of the cam.

    point, normal (..., 3): in the cam's frame, the normal out of the roller into the cam; angle a on the roller; psi of the roller;
    pressure_angle; arm [m]: a force F of the cam on the roller turns the turret with F arm, forward where positive; opening G [m];
    relative_curvature, cam_curvature [1/m] across the contact line, the latter positive where the cam is convex;
    line_slope: length of the contact line per du; rolling, sliding [m]: relative speed around and along the roller.
    """

    point: Floats
    normal: Floats
    angle: Floats
    psi: Floats
    pressure_angle: Floats
    arm: Floats
    opening: Floats
    relative_curvature: Floats
    cam_curvature: Floats
    line_slope: Floats
    rolling: Floats
    sliding: Floats


class _Rates(NamedTuple):
    """P, Q and their derivatives by u and by t, with what they were made of."""

    p: Floats
    q: Floats
    p_u: Floats
    q_u: Floats
    p_t: Floats
    q_t: Floats


def flank_contact(cam: RollerGear, travel: ArrayLike, u: ArrayLike, flank: ArrayLike, start: ArrayLike = 0.0) -> FlankContact:
    """Contact of roller `start` at travel t [rad], place u [m] and flank +1 or -1, broadcast against each other."""
    travel, u, flank, start = np.broadcast_arrays(*(np.asarray(each, float) for each in (travel, u, flank, start)))
    phi, speed, acceleration, _ = cam.motion(travel)
    psi = phi + cam.pin_pitch * (cam.phase + start)
    rates = _rates(cam, psi, speed, acceleration, u)
    size = np.hypot(rates.p, rates.q)
    cos_a, sin_a = -flank * cam.hand_sign * rates.p / size, -flank * np.abs(rates.q) / size
    point, normal = _in_cam(cam, travel, psi, u, cos_a, sin_a)
    rho = cam.pin_circle_radius + u * cam.cosine
    opening, around, gradient, rolling, sliding = _second_order(cam, psi, speed, u, rates, cos_a, sin_a)
    with np.errstate(divide="ignore"):
        relative = gradient / opening
    own = around**2 / (cam.roller_radius * gradient)  # curvature of the roller across the contact line
    return FlankContact(
        point,
        normal,
        np.arctan2(sin_a, cos_a),
        psi,
        np.arctan2(np.abs(rates.p), np.abs(rates.q)),
        -rho * sin_a,
        opening,
        relative,
        relative - own,
        np.sqrt(gradient) / np.abs(around),
        rolling,
        sliding,
    )


def _rates(cam: RollerGear, psi: Floats, speed: Floats, acceleration: Floats, u: Floats) -> _Rates:
    s, c = np.sin(psi), np.cos(psi)
    rho, depth = cam.pin_circle_radius + u * cam.cosine, cam.height - u * cam.sine
    return _Rates(
        p=speed * rho - cam.hand_sign * s * depth,
        q=-cam.hand_sign * (cam.cosine * (cam.centre_distance - rho * c) + cam.sine * c * depth),
        p_u=speed * cam.cosine + cam.hand_sign * s * cam.sine,
        q_u=cam.hand_sign * c,
        p_t=acceleration * rho - cam.hand_sign * c * speed * depth,
        q_t=-cam.hand_sign * s * speed * (cam.cosine * rho - cam.sine * depth),
    )


def _second_order(cam, psi, speed, u, rates, cos_a, sin_a):
    """G, Phi_a/r, |grad Phi|^2 and the relative velocity at the surface around and along the roller."""
    s, c = np.sin(psi), np.cos(psi)
    depth = cam.height - u * cam.sine
    phi_u = rates.q_u * cos_a + rates.p_u * sin_a
    phi_t = rates.q_t * cos_a + rates.p_t * sin_a
    phi_a = rates.p * cos_a - rates.q * sin_a
    r, rho = cam.roller_radius, cam.pin_circle_radius + u * cam.cosine
    # omega of the roller against the cam, in the turret's frame turned by psi: (-s sin psi, -s cos psi, psi')
    spin = -cam.hand_sign * s * cam.cosine + speed * cam.sine  # omega.d
    across = cam.hand_sign * s * cam.sine + speed * cam.cosine  # omega.e1
    rolling = phi_a - r * spin
    # of the axis, and from omega x r m, where m x d = cos(a) y - sin(a) e1
    axis = cam.hand_sign * (c * depth * cam.cosine - (cam.centre_distance - rho * c) * cam.sine)
    sliding = axis - r * (cam.hand_sign * c * cos_a + across * sin_a)
    around = phi_a / r
    return -phi_t + phi_u * sliding + around * rolling, around, phi_u**2 + around**2, rolling, sliding


def _in_cam(cam, travel, psi, u, cos_a, sin_a):
    """Contact point and normal in the cam's frame."""
    s, c = np.sin(psi), np.cos(psi)
    radial, tangential, axial = -cam.sine * cos_a, sin_a, cam.cosine * cos_a
    normal = np.stack([radial * c - tangential * s, radial * s + tangential * c, axial], axis=-1)
    rho = cam.pin_circle_radius + u * cam.cosine
    axis = np.stack([rho * c - cam.centre_distance, rho * s, u * cam.sine - cam.height], axis=-1)
    back = -cam.hand_sign * travel
    return rotate_about_y(axis + cam.roller_radius * normal, back), rotate_about_y(normal, back)


def rotate_about_y(vectors: ArrayLike, angle: ArrayLike) -> Floats:
    """Vectors (..., 3) turned by `angle` [rad] about y, by the right hand."""
    s, c = np.sin(angle), np.cos(angle)
    x, y, z = np.moveaxis(np.asarray(vectors, float), -1, 0)
    return np.stack(np.broadcast_arrays(x * c + z * s, y, z * c - x * s), axis=-1)
