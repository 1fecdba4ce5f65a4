"""Initial value problems y' = f(t, y): one loop with step control, dense output and event location, and a choice of methods.

`system`    what a system states: its rate, events, switches, Jacobian.
`loop`      `integrate`: batches of steps, samples, limits; the trajectory.
`advancing` the compiled loop over the steps of a batch.
`together`  many problems side by side, in the lanes of vectors.
`locating`  events within a step.
`method`    what a method states; `methods` holds one file each.

`dense_output` the polynomial over a step, from its coefficients.
"""

from drivewright.numerics.ode.loop import Event, EventCrossing, Trajectory, integrate
from drivewright.numerics.ode.method import Method
from drivewright.numerics.ode.methods import METHODS
from drivewright.numerics.ode.system import Functions, events, jacobian, rate, switch

__all__ = ["METHODS", "Event", "EventCrossing", "Functions", "Method", "Trajectory", "events", "integrate", "jacobian", "rate", "switch"]
