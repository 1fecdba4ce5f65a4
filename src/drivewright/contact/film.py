"""The force of an oil film on the journal of a plain bearing, in closed form, for kernels.

Journal centre minus bearing centre is the eccentricity (ex, ey) [m], below the radial clearance c; (vx, vy) its rate [m/s].  Both in
axes that do not turn.  `spin` [rad/s] is the sum of the absolute angular velocities of journal and bearing: the journal's own
where the bearing stands still.  Only  w e/2 - v_t  drags oil into the wedge: at half-speed whirl it is 0.
viscosity mu [Pa s], length L [m], radius R [m].  Both films carry pressure and no tension (half-Sommerfeld or Gumbel condition).
The forces grow beyond all bounds at |e| = c; the caller keeps |e|/c below 1 (they are finite to 0.9999 and beyond).
`contact.reynolds` solves the same film numerically for a finite length.
"""

import numpy as np

from drivewright._jit import kernel


@kernel
def line_of_centres(ex: float, ey: float, vx: float, vy: float, spin: float, clearance: float) -> tuple[float, float, float, float, float]:
    """Direction (nx, ny), eccentricity ratio eps, wedge  eps w/2 - v_t/c  and squeeze  eps' = v_n/c  [1/s]."""
    size = np.hypot(ex, ey)
    nx, ny = (ex / size, ey / size) if size > 0.0 else (1.0, 0.0)
    along, across = vx * nx + vy * ny, vy * nx - vx * ny
    return nx, ny, size / clearance, (0.5 * spin * size - across) / clearance, along / clearance


@kernel
def long_bearing(
    ex: float, ey: float, vx: float, vy: float, spin: float, viscosity: float, length: float, radius: float, clearance: float
) -> tuple[float, float]:
    """(Fx, Fy) [N] on the journal of a bearing much longer than wide: Pinkus & Sternlicht (1961), recalled.

    With  P = mu L R^3/c^2,  wedge a = eps (w - 2 g')/2,  squeeze b = eps',  s = sqrt((1 - eps^2) (a^2 + b^2)):
        F_r = -6 P (4 s eps + (2 + eps^2) pi b) f/((2 + eps^2) (1 - eps^2)^1.5),   F_t = 12 pi P a f/((2 + eps^2) sqrt(1 - eps^2))
        f = (s + 3 b eps)/(s + 1.5 b eps) where b > 0,   s/(s + 1.5 |b| eps) where b <= 0.
    The book's k is s/(eps |b|); in this form nothing is divided by eps or b.  Where b < 0 the radial part is often printed with the
    sign that would drive the journal on; this one is continuous through b = 0 and always takes energy out.
    Against Reynolds' equation for endless length it is exact for b = 0 and for eps -> 0; the approach is at most 13 % off; the force
    of a pure retreat is 4 % too large at eps = 0.1, 2.4 times at 0.5 and 11 times at 0.8, where it is a tenth of the approach's.
    """
    nx, ny, eps, wedge, squeeze = line_of_centres(ex, ey, vx, vy, spin, clearance)
    rest, wide = 1.0 - eps * eps, 2.0 + eps * eps
    flow = np.sqrt(rest * (wedge * wedge + squeeze * squeeze))
    if flow == 0.0:
        return 0.0, 0.0
    approach, retreat = max(squeeze, 0.0) * eps, max(-squeeze, 0.0) * eps
    share = (flow + 3.0 * approach) / (flow + 1.5 * (approach + retreat))
    scale = 6.0 * viscosity * length * radius**3 / clearance**2 * share / (wide * rest * np.sqrt(rest))
    radial = -scale * (4.0 * flow * eps + wide * np.pi * squeeze)
    tangential = scale * 2.0 * np.pi * rest * wedge
    return radial * nx - tangential * ny, radial * ny + tangential * nx


@kernel
def short_bearing(
    ex: float, ey: float, vx: float, vy: float, spin: float, viscosity: float, length: float, radius: float, clearance: float
) -> tuple[float, float]:
    """(Fx, Fy) [N] on the journal of a bearing much shorter than wide: Ocvirk (1952), recalled; squeeze included.

    Pressure along the line at the angle x from the line of centres:  mu L^3/c^2 (b cos x - a sin x)/(1 - eps cos x)^3 with wedge a and
    squeeze b as in `long_bearing`: positive over the half turn about x0 = atan2(-a, b).  Its moments over that half are integrated in
    closed form by Sommerfeld's substitution  1 - eps cos x = (1 - eps^2)/(1 + eps cos y).
    """
    nx, ny, eps, wedge, squeeze = line_of_centres(ex, ey, vx, vy, spin, clearance)
    middle = np.arctan2(-wedge, squeeze)
    cc1, cs1, ss1 = _moments(middle - 0.5 * np.pi, eps)
    cc2, cs2, ss2 = _moments(middle + 0.5 * np.pi, eps)
    scale = viscosity * radius * length**3 / clearance**2
    radial = -scale * (squeeze * (cc2 - cc1) - wedge * (cs2 - cs1))
    tangential = -scale * (squeeze * (cs2 - cs1) - wedge * (ss2 - ss1))
    return radial * nx - tangential * ny, radial * ny + tangential * nx


@kernel
def journal_friction(
    ex: float, ey: float, fx: float, fy: float, slip: float, viscosity: float, length: float, radius: float, clearance: float
) -> float:
    """Torque [N m] with which the film brakes the journal about its centre, and drives the bearing about that same point.

    2 pi mu L R^3 w/(c sqrt(1 - eps^2)) + (e x F)/2, w = `slip` [rad/s] of the journal against the bearing, F = (fx, fy) [N] the film's
    force on the journal: shear of the drag, as of a full film, and of the pressure, whose integral along the film is exact for any
    pressure that vanishes at the film's ends (Sommerfeld; recalled, verified against the wall's shear of `reynolds`).
    """
    eps = np.hypot(ex, ey) / clearance
    drag = 2.0 * np.pi * viscosity * length * radius**3 * slip / (clearance * np.sqrt(1.0 - eps * eps))
    return drag + 0.5 * (ex * fy - ey * fx)


@kernel
def _moments(x: float, eps: float) -> tuple[float, float, float]:
    """Antiderivatives of (cos^2 x, cos x sin x, sin^2 x)/(1 - eps cos x)^3, continuous for |x| < 2 pi."""
    rest = 1.0 - eps * eps
    y = 2.0 * np.arctan2(np.sqrt(1.0 + eps) * np.sin(0.5 * x), np.sqrt(1.0 - eps) * np.cos(0.5 * x))
    sine, cosine = np.sin(y), np.cos(y)
    both = 0.5 * (y + sine * cosine)
    cc = (eps * eps * y + 2.0 * eps * sine + both) / (rest * rest * np.sqrt(rest))
    cs = (0.5 * sine * sine - eps * cosine) / (rest * rest)
    return cc, cs, (y - both) / (rest * np.sqrt(rest))
