"""Two rows side by side whose teeth are out of phase: transmission error, mesh excitation, sharing of the load."""

from collections.abc import Iterator

import numpy as np

from drivewright.chains import masses
from drivewright.chains.closure import Phased, mesh_order, phased
from drivewright.chains.closure.tables import phased_table
from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.result import Table, Value

ORDERS = (1, 2)


def phased_rows(model: ChainModel) -> tuple[dict[str, Value], tuple[Table, ...], tuple[str, ...]]:
    """(values, tables, findings) of both rows together; nothing where rows are in phase."""
    if not model.spec.row_phase:
        return {}, (), ()
    both = phased(model.closure, model.spec.row_phase)
    values = {
        "phased.centre_distance.fluctuation": Value(
            both.fluctuation,
            "m",
            "peak-to-peak centre distance of both rows together over one tooth",
            label="Centre distance, peak-to-peak, both rows",
        ),
        "phased.transmission_error": Value(
            both.transmission_ripple,
            "rad",
            "peak-to-peak transmission error of both rows together over one tooth",
            label="Transmission error, both rows",
        ),
        **dict(_orders(both)),
    }
    shared, findings = _load_sharing(model, both)
    return values | shared, (phased_table(both),), findings


def _orders(both: Phased) -> Iterator[tuple[str, Value]]:
    """Amplitudes of the transmission error at the meshing of one row and its harmonic, of both rows and of one alone."""
    for order in ORDERS:
        words = f"amplitude of the transmission error at mesh order {order}"
        for name, signal, of in (("", both.transmission_error, "both rows"), ("single_", both.single_error, "one row")):
            amplitude, label = mesh_order(both.driver_angle, signal, order), f"Transmission error, order {order}, {of}"
            yield f"phased.{name}order_{order}", Value(amplitude, "rad", f"{words}, {of}", label=label)


def _load_sharing(model: ChainModel, both: Phased) -> tuple[dict[str, Value], tuple[str, ...]]:
    """By how much a strand of one row pulls more than that of the other: strands as springs, a row off its place by half the gap."""
    if model.spec.drive is None:
        return {}, ()
    strand = masses.strand_stiffness(masses.joint_stiffness(model.spec.contact.stiffness), model.closure.free_plates)
    arm = 0.5 * model.spec.pitch / np.sin(np.pi / model.teeth[1])
    off = 0.5 * np.maximum(np.abs(both.distance_gap + arm * both.angle_gap), np.abs(both.distance_gap - arm * both.angle_gap))
    more = strand * float(np.max(off))
    mean = 0.25 * (model.strands.tight + model.strands.slack)
    values = {
        "phased.force_difference": Value(
            more, "N", "largest tension of a strand of one row above the mean of both rows", label="Force difference between the rows"
        ),
        "phased.load_share": Value(
            0.5 + 0.5 * more / mean,
            "-",
            "largest share of one row in the load, for strands at their mean tension",
            label="Load share of a row",
        ),
    }
    slack = more > 0.5 * model.strands.slack
    lost = (
        "the slack strand of one row loses its tension at times, and the load shares of the rigid rows do not hold then: increase the "
        "preload"
    )
    return values, ((lost,) if slack else ())
