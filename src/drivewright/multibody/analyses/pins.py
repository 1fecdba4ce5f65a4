"""Forces, impacts and orbits of pins with play."""

from collections.abc import Iterator

import numpy as np

from drivewright.multibody.analyses.ensemble import settled_check, statistics, unsettled
from drivewright.multibody.analyses.simulation_model import SimulationModel, cycle_columns, last_turn, run_of
from drivewright.multibody.forces.contact import AMBROSIO, COULOMB
from drivewright.multibody.observe import PIN_FIELDS
from drivewright.result import Answer, Check, Column, Table, Value

FULL = 0.9  # of the coefficient stated: with less a finding says so


def pins(model: SimulationModel) -> Answer:
    """Largest force and penetration, impacts and contact share of every pin with play; orbit and force over the last turn."""
    turn, limits = last_turn(model), model.limits
    values, tables, checks = {}, [_impact_table(model, run_of(model))], []
    for number, name in enumerate(model.pins):
        numbers = _pin_values(model, name)
        values |= {f"joints.{name}.{key}": value for key, value in numbers.items()}
        tables.append(_pin_table(model, turn, number, name))
        for limit, key in (
            (limits.joint_force, "force"),
            (limits.penetration or model.assembly.system.contacts[number].clearance, "penetration"),
        ):
            if limit:
                checks.append(Check.of(numbers[f"max_{key}"], f"{key}.{name}", limit, "<=", f"largest {key} in joint {name!r}", (name,)))
    settled = settled_check("settled.joints", values.values(), "Settled statistics of the joints")
    return Answer(values, tuple(tables), (*checks, settled), (*unsettled(values), *_smoothed_friction(model)))


def _smoothed_friction(model) -> Iterator[str]:
    """A finding on each pin that slides so slowly that the smoothing of its law about standstill takes a good part of its friction."""
    for name, contact in zip(model.pins, model.assembly.system.contacts, strict=True):
        found = statistics(model).members[0].whole[f"{name}.coefficient"]
        if contact.law in (COULOMB, AMBROSIO) and found < FULL * contact.friction:
            yield (
                f"joint {name!r} slides so slowly that its friction is that of a coefficient of {found:.2g}, not {contact.friction:.3g}: "
                f"the law is smoothed up to friction_speed = {1e3 * contact.slip_speed:.3g} mm/s, which is not small beside its sliding "
                'speed. Give a smaller friction_speed, or friction_law = "lugre"'
            )


def _pin_values(model, name):
    """{key: Value} of one pin with play."""
    run_statistics = statistics(model)
    numbers = {
        "max_force": Value.of(run_statistics.of_run(f"{name}.force"), "N", f"largest force in joint {name!r}"),
        "max_penetration": Value.of(run_statistics.of_run(f"{name}.depth"), "m", f"largest penetration in joint {name!r}"),
        "impacts_per_turn": Value.of(run_statistics.mean(f"{name}.hits"), "-", f"impacts of joint {name!r}"),
        "contact_share": Value.of(run_statistics.mean(f"{name}.touching"), "-", f"share of the time in which joint {name!r} touches"),
        "friction_power": Value.of(run_statistics.mean(f"{name}.lost"), "W", f"mean power lost by friction in joint {name!r}"),
    }
    return numbers if model.period else {key: value for key, value in numbers.items() if key != "impacts_per_turn"}


def _impact_table(model, run):
    t, pin, speed = run.impacts.T
    return Table(
        "impacts",
        "Impacts",
        (
            Column("time", "s", "time of the impact", t),
            Column("joint", "-", "joint", np.array(model.pins)[pin.astype(int)]),
            Column("speed", "m/s", "speed of approach", speed),
        ),
    )


def _pin_table(model, record, number, name):
    pin = dict(zip(PIN_FIELDS, np.moveaxis(record.pins[:, number], 1, 0), strict=True))
    clearance = model.assembly.system.contacts[number].clearance
    away = clearance + pin["depth"]  # distance of the centres
    return Table(
        f"pin.{name}",
        f"Joint {name!r} over the last turn" if model.period else f"Joint {name!r}",
        (
            *cycle_columns(model, record.t),
            Column("x", "m", "journal's centre from the bearing's, x", -away * pin["nx"]),
            Column("y", "m", "journal's centre from the bearing's, y", -away * pin["ny"]),
            Column("depth", "m", "penetration, below 0 in flight", pin["depth"]),
            Column("force", "N", "force between journal and bearing", np.hypot(pin["fx"], pin["fy"])),
            Column("force_x", "N", "force on the journal's body, x", -pin["fx"]),
            Column("force_y", "N", "force on the journal's body, y", -pin["fy"]),
            Column("slip", "m/s", "sliding speed", pin["slip"]),
            Column("contact", "-", "1 in contact, 0 in flight", (pin["depth"] > 0).astype(float)),
        ),
    )
