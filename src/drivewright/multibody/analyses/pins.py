"""Forces, impacts and orbits of pins with play."""

from collections.abc import Iterator

import numpy as np

from drivewright.labels import in_words
from drivewright.multibody.analyses.ensemble import settled_check, statistics, unsettled
from drivewright.multibody.analyses.simulation_model import SimulationModel, cycle_columns, last_turn, over_last_turn, run_of
from drivewright.multibody.forces.contact import AMBROSIO, COULOMB
from drivewright.multibody.observe import PIN_FIELDS
from drivewright.result import Answer, Check, Column, Table, Value

FULL = 0.9  # of the coefficient stated: below it there is a finding


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
                peak, remedy = numbers[f"max_{key}"], "reduce the speed or the clearance, or enlarge the bearing"
                words = f"{peak.meaning}; {remedy}"
                checks.append(Check.of(peak, f"{key}.{name}", limit, "<=", words, (name,), peak.label))
    settled = settled_check("settled.joints", values.values(), "Settled statistics of the joints")
    return Answer(values, tuple(tables), (*checks, settled), (*unsettled(values), *_smoothed_friction(model)))


def _smoothed_friction(model) -> Iterator[str]:
    """A finding on each pin that slides so slowly that the smoothing of its law about standstill takes a good part of its friction."""
    for name, contact in zip(model.pins, model.assembly.system.contacts, strict=True):
        found = statistics(model).members[0].whole[f"{name}.coefficient"]
        if contact.law in (COULOMB, AMBROSIO) and found < FULL * contact.friction:
            yield (
                f"joint {name!r} slides too slowly for its smoothed friction law: the mean coefficient of friction is {found:.2g}, not "
                f"{contact.friction:.3g}, because friction_speed = {1e3 * contact.slip_speed:.3g} mm/s is not small compared with the "
                'sliding speed. Give a smaller friction_speed, or friction_law = "lugre"'
            )


def _pin_values(model, name):
    """{key: Value} of one pin with play."""
    run_statistics, joint = statistics(model), f"joint {in_words(name)}"
    contact = f"share of the time in which journal and bearing of {joint} are in contact"
    lost = f"mean power lost to friction in {joint}"
    numbers = {
        "max_force": Value.of(run_statistics.of_run(f"{name}.force"), "N", f"peak force in {joint}"),
        "max_penetration": Value.of(run_statistics.of_run(f"{name}.depth"), "m", f"peak penetration in {joint}"),
        "impacts_per_turn": Value.of(run_statistics.mean(f"{name}.hits"), "-", f"impacts per turn in {joint}"),
        "contact_share": Value.of(run_statistics.mean(f"{name}.touching"), "-", contact, f"contact time share, {joint}"),
        "friction_power": Value.of(run_statistics.mean(f"{name}.lost"), "W", lost, f"mean friction power, {joint}"),
    }
    return numbers if model.period else {key: value for key, value in numbers.items() if key != "impacts_per_turn"}


def _impact_table(model, run):
    t, pin, speed = run.impacts.T
    return Table(
        "impacts",
        "Impacts",
        (
            Column("time", "s", "time of impact", t),
            Column("joint", "-", "joint", np.array(model.pins)[pin.astype(int)]),
            Column("speed", "m/s", "approach speed at impact", speed),
        ),
    )


def _pin_table(model, record, number, name):
    pin = dict(zip(PIN_FIELDS, np.moveaxis(record.pins[:, number], 1, 0), strict=True))
    clearance = model.assembly.system.contacts[number].clearance
    away = clearance + pin["depth"]  # distance of the centres
    return Table(
        f"pin.{name}",
        f"Joint {in_words(name)}{over_last_turn(model)}",
        (
            *cycle_columns(model, record.t),
            Column("x", "m", "journal centre relative to bearing, x", -away * pin["nx"], "journal position x"),
            Column("y", "m", "journal centre relative to bearing, y", -away * pin["ny"], "journal position y"),
            Column("depth", "m", "penetration of the journal into the bearing, negative in flight", pin["depth"], "penetration"),
            Column("force", "N", "force between journal and bearing", np.hypot(pin["fx"], pin["fy"]), "contact force"),
            Column("force_x", "N", "force on the journal, x", -pin["fx"], "force x on the journal"),
            Column("force_y", "N", "force on the journal, y", -pin["fy"], "force y on the journal"),
            Column("slip", "m/s", "sliding speed", pin["slip"]),
            Column("contact", "-", "1 in contact, 0 in flight", (pin["depth"] > 0).astype(float), "contact state"),
        ),
    )
