"""What a run shows: signals over time, their statistics over whole teeth, and whether energy and momenta add up."""

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.chains.explicit.measure import BODY, PLATE, ROW
from drivewright.chains.model import ChainDrive
from drivewright.numerics.signals import order_spectrum, time_mean

LOSSES = ("drive", "torque", "slide damping", "turn damping", "friction", "guide damping", "joint damping", "contact damping")


class RunSettings(Protocol):
    """What the settings of both routes, explicit and implicit, have in common: see `Settings`."""

    @property
    def step(self) -> float:
        """Longest step [s]."""
        ...

    @property
    def settle(self) -> float:
        """What statistics leave out at the start [s]."""
        ...

    @property
    def samples_per_tooth(self) -> int:
        """Samples while the driver turns by one tooth."""
        ...

    @property
    def joints(self) -> tuple[int, ...]:
        """Joints whose tension is recorded."""
        ...

    @property
    def plate(self) -> int:
        """Plate whose place and forces are recorded."""
        ...

    @property
    def tolerance(self) -> float:
        """Energy drift [1/s] over the stored energy that fails a run."""
        ...


@dataclass(frozen=True)
class Motion:
    """A run: rows (m, ROW), bodies (m, sprockets and guides, BODY), tension (m, joints), plate (m, PLATE); columns by name, see below."""

    model: ChainDrive
    settings: RunSettings
    step: float
    every: int
    rows: Floats
    bodies: Floats
    tension: Floats
    plate: Floats

    def column(self, name: str) -> Floats:
        """A column of ROW, of the watched plate by its name in PLATE."""
        return self.rows[:, ROW.index(name)] if name in ROW else self.plate[:, PLATE.index(name)]

    def body(self, number: int, name: str) -> Floats:
        """A column of BODY of one sprocket, or guide behind them."""
        return self.bodies[:, number, BODY.index(name)]

    @property
    def t(self) -> Floats:
        """Time (m,)  [s]."""
        return self.rows[:, 0]

    @property
    def slide(self) -> int:
        """Number of the sprocket whose centre distance counts, see `ChainDrive.measured`."""
        return self.model.measured

    @cached_property
    def centre_distance(self) -> Floats:
        """Distance of the sliding sprocket from the driver (m,)  [m]."""
        return np.hypot(*(self._centre(self.slide) - self._centre(self.model.driver)))

    def _centre(self, number):
        body, q = self.model.sprockets[number], self.body(number, "q")
        centre = complex(*body.centre) + (body.slide.shift(complex(*body.centre), q) if body.slide else 0.0 * q)
        return np.array([np.real(centre), np.imag(centre)])

    def transmission_error(self, number: int) -> Floats:
        """Angle of a sprocket less that of the driver times the ratio of teeth, from the start (m,)  [rad]."""
        driver, teeth = self.model.driver, [s.tooth.teeth for s in self.model.sprockets]
        turned = [self.body(n, "psi") - self.body(n, "psi")[0] for n in (number, driver)]
        sense = -1.0 if self.model.sprockets[number].outside else 1.0
        return turned[0] - sense * turned[1] * teeth[driver] / teeth[number]

    # ------------------------------------------------------------------------------------------------------- statistics

    @property
    def per_tooth(self) -> int:
        """Samples per tooth of the driver."""
        return self.settings.samples_per_tooth

    @cached_property
    def steady(self) -> slice:
        """Samples after settling, from the first to the last of a whole number of teeth of the driver."""
        first = int(np.searchsorted(self.t, self.settings.settle - 1e-12))
        teeth = (len(self.t) - 1 - first) // self.per_tooth
        return slice(first, first + teeth * self.per_tooth + 1) if teeth > 0 else slice(first, len(self.t))

    @property
    def teeth(self) -> int:
        """Whole teeth of the driver in the steady part."""
        return (self.steady.stop - 1 - self.steady.start) // self.per_tooth

    @property
    def tooth_time(self) -> float:
        """Time in which the driver turns by one tooth at full speed  [s]."""
        return float(self.t[1] - self.t[0]) * self.per_tooth

    @property
    def revolutions(self) -> int:
        """Whole revolutions of the chain in the steady part."""
        return self.teeth // self.model.chain.count

    def windows(self, parts: int = 1) -> tuple[slice, ...]:
        """Rows (slices) of the revolutions of the chain in the steady part, each in so many equal parts of whole teeth.

        A steady part that holds no revolution is one window as a whole.  Teeth that are left over are in no part.
        """
        teeth, count = (self.model.chain.count if self.revolutions else self.teeth), max(1, self.revolutions)
        each, part = teeth * self.per_tooth, teeth // parts * self.per_tooth or teeth * self.per_tooth // parts
        starts = [self.steady.start + k * each + n * part for k in range(count) for n in range(parts)]
        return tuple(slice(first, first + part + 1) for first in starts)

    def mean(self, signal: Floats) -> float:
        """Mean of a signal (m,) over the steady part."""
        return time_mean(self.t[self.steady], signal[self.steady])

    def fluctuation(self, signal: Floats) -> float:
        """Largest less least value of a signal (m,) in the steady part."""
        return float(np.ptp(signal[self.steady]))

    def orders(self, signal: Floats, orders: ArrayLike = (1.0,)) -> Floats:
        """Amplitudes of a signal (m,) at multiples of the mesh frequency; multiples of 1/teeth."""
        t = self.t[self.steady]
        return order_spectrum(t, signal[self.steady], (t[-1] - t[0]) / self.teeth, orders)

    def spectrum(self, signal: Floats) -> tuple[Floats, Floats]:
        """(mesh orders, amplitudes) of a signal (m,) up to a third of the samples per tooth, in steps of 1/teeth."""
        return self.orders_in(self.steady, signal)

    def orders_in(self, rows: slice, signal: Floats) -> tuple[Floats, Floats]:
        """The same of some rows that span whole teeth."""
        teeth = (rows.stop - 1 - rows.start) // self.per_tooth
        orders = np.arange(1, teeth * self.per_tooth // 3 + 1) / teeth
        t = self.t[rows]
        return orders, order_spectrum(t, signal[rows], (t[-1] - t[0]) / teeth, orders)

    @property
    def mesh_order_amplitude(self) -> float:
        """Amplitude of the centre distance at the mesh frequency  [m]."""
        return float(self.orders(self.centre_distance)[0])

    def running_deviation(self, reference: float) -> float:
        """Mean centre distance less a reference, that of the ideal drive  [m]."""
        return self.mean(self.centre_distance) - reference

    # ----------------------------------------------------------------------------------------------------------- balance

    @cached_property
    def energy_gap(self) -> Floats:
        """Energy less all work since the start (m,)  [J]."""
        balance = self.column("kinetic") + self.column("potential") - sum(self.column(name) for name in LOSSES)
        return balance - balance[0]

    @property
    def energy_drift(self) -> float:
        """Largest gap over the largest stored energy and over the time of the run, a revolution of the chain at least  [1/s].

        Stored is what moves and what joints, flanks and guides are pressed with; the sprockets that are driven store nothing.
        """
        time = max(float(self.t[-1] - self.t[0]), self.model.chain.count * self.tooth_time)
        return float(np.max(np.abs(self.energy_gap)) / np.max(self.column("kinetic") + self.column("elastic")) / time)

    @property
    def momentum_residual(self) -> tuple[float, float]:
        """(momentum, angular momentum): largest gap to the impulse of all bodies on the chain, over the largest of a plate's times N."""
        x, y, turning = (
            self.column(a) - self.column(b)
            for a, b in (("momentum x", "impulse x"), ("momentum y", "impulse y"), ("angular momentum", "turning impulse"))
        )
        chain, sprocket = self.model.chain, self.model.sprockets[self.model.driver]
        speed = np.max(np.abs(self.body(self.model.driver, "w"))) * sprocket.tooth.teeth * chain.link.pitch / (2 * np.pi)
        momentum = chain.count * chain.mass * max(speed, 1e-300)
        arm = chain.count * chain.link.pitch
        return (float(max(np.ptp(x), np.ptp(y)) / momentum), float(np.ptp(turning) / (momentum * arm)))

    @property
    def advice(self) -> str:
        """What is wrong with the run; empty where nothing is."""
        if not np.all(np.isfinite(self.rows)):
            bad = int(np.argmin(np.all(np.isfinite(self.rows), axis=1)))
            return f"the motion diverges at t = {self.t[max(bad - 1, 0)]:.4g} s; shorten the step of {self.step:.3g} s"
        if self.energy_drift > self.settings.tolerance:
            return (
                f"the energy drifts by {self.energy_drift:.2g} of the stored energy per second, more than {self.settings.tolerance:.2g}; "
                f"shorten the step of {self.step:.3g} s"
            )
        return ""

    @property
    def outcome(self) -> str:
        """ "complete", or "partial" where something is wrong with the run."""
        return "partial" if self.advice else "complete"
