"""Keys that contradict each other, refused by name, and keys without effect; what can be computed is left to the checks."""

from collections.abc import Iterator

import numpy as np

from drivewright._typing import Numbers
from drivewright.errors import SpecError
from drivewright.mechanisms.silent_chain.capacity_tables import Wear
from drivewright.mechanisms.silent_chain.sizing import SizedSpec
from drivewright.mechanisms.silent_chain.spec import PAIRS, Joint, Plate, signed_seat, size_of

USUAL = Plate()
FLATTEST = 1e9  # largest rolling radius over the pitch, which rounding would lose beside a larger one


def refuse_contradictions(spec: SizedSpec) -> None:
    """SpecError for the first two keys that contradict each other, or one that lacks another."""
    joint, plate = spec.joint, spec.plate
    _refuse_seat(joint, spec.pitch)
    if joint.kind != "revolute" and joint.rolling_radius is None:
        raise SpecError('is missing for a rolling joint; give it, or take kind = "revolute"', "joint.rolling_radius")
    if joint.rolling_radius is not None and np.any(joint.rolling_radius > FLATTEST * spec.pitch):
        raise SpecError(f"exceeds {FLATTEST:g} pitches, which is practically flat; choose a smaller one", "joint.rolling_radius")
    _refuse_phase(spec)
    if spec.wear is not None:
        _refuse_wear(spec.wear)
    _refuse_tensioners(spec)
    if spec.drive and spec.drive.preload is None and spec.driven.centre_distance is None:
        raise SpecError(
            "the position of the driven sprocket is undefined; give drive.preload, or a fixed driven.centre_distance without a preload",
            "drive.preload",
        )
    if spec.roller is not None:
        kind = joint.kind or "round-pin"
        if kind != "revolute":
            raise SpecError(
                f'a roller chain has revolute joints, but kind is {kind!r}; take kind = "revolute", or remove [roller]', "joint.kind"
            )
        if spec.roller.diameter is None:
            raise SpecError('is missing; give it, or the number of the chain, e.g. chain = "08B"', "roller.diameter")
        if spec.roller.diameter >= spec.pitch:
            raise SpecError(
                f"rollers of {1e3 * spec.roller.diameter:.4g} mm overlap at a pitch of {1e3 * spec.pitch:.4g} mm; choose a smaller "
                "diameter",
                "roller.diameter",
            )
        return
    if joint.kind in PAIRS and plate.apothem is None:
        raise SpecError("standard_apothem is defined for a joint of one radius only; give apothem instead", "plate.apothem")
    if (plate.apothem is None) == (plate.standard_apothem is None):
        how = "neither is" if plate.apothem is None else "both are"
        raise SpecError(f"give either apothem (from the pin) or standard_apothem (from the pitch line); {how} given", "plate.apothem")


def _refuse_seat(joint: Joint, pitch: Numbers) -> None:
    """The second rolling surface of a joint of two radii."""
    seat, own, key = joint.seat_radius, joint.rolling_radius, "joint.seat_radius"
    if joint.kind not in PAIRS or own is None:
        return
    if seat is None:
        raise SpecError(f"is missing: a joint of kind {joint.kind!r} has two rolling surfaces; give it in addition to rolling_radius", key)
    if seat == 0 or (joint.kind != "rolling-pair" and seat < 0):
        raise SpecError(f"must be above 0 for kind {joint.kind!r}, because the kind already determines whether the seat is hollow", key)
    if np.any(abs(seat) > FLATTEST * pitch):
        raise SpecError(f"exceeds {FLATTEST:g} pitches, which is practically flat; choose a smaller one", key)
    if 1 / own + 1 / signed_seat(joint) <= 0:
        raise SpecError(
            f"a hollow seat of radius {1e3 * abs(seat):.4g} mm is too narrow for a pin of radius {1e3 * own:.4g} mm; increase it", key
        )


def _refuse_phase(spec: SizedSpec) -> None:
    """Rows out of phase that cannot be."""
    size = size_of(spec)
    if spec.row_phase and size and size.rows > 1:
        raise SpecError(
            f"the rows of chain {size.name} share their pins and cannot be out of phase; take {size.number}-1 with rows = 2", "row_phase"
        )
    if spec.row_phase and (spec.rows or 1) != 2:
        raise SpecError(f"needs two rows, but rows = {spec.rows or 1}; give rows = 2, or row_phase = 0", "row_phase")


def _refuse_wear(given: Wear) -> None:
    ends = given.coefficient_range
    if given.coefficient is None and ends is None:
        raise SpecError("is missing and has no default; give it, or coefficient_range", "wear.coefficient")
    if ends is not None and not ends[0] <= (given.coefficients[0]) <= ends[1]:
        raise SpecError("must be [minimum, maximum], with the coefficient between them", "wear.coefficient_range")


def _refuse_tensioners(spec):
    """SpecError for a tensioner that lacks what moves it, and for a sprocket that cannot stand where it should."""
    for table, entry in _entries(spec):
        where = f"{table}.{entry.name}"
        if entry.force is None and (entry.direction is not None or entry.pivot is not None):
            raise SpecError("is missing for a tensioner with a direction or a pivot; give it, or remove both", f"{where}.force")
        if entry.force is not None and entry.direction is None:
            raise SpecError(
                "a tensioner needs both force and direction; give direction too (for a pivot the approximate direction of motion), or "
                "remove force for a fixed body",
                f"{where}.force",
            )
        if table == "sprockets" and entry.side == "outside" and spec.roller is None:
            raise SpecError(
                "a sprocket cannot mesh with the back of a silent chain; use a guide with side = 'outside' instead", f"{where}.side"
            )


def _entries(spec):
    """(table, entry) of all further sprockets and guides."""
    for table in ("sprockets", "guides"):
        for entry in getattr(spec, table):
            yield table, entry


def unused(spec: SizedSpec) -> Iterator[str]:
    """Findings for keys that have no effect here."""
    for table, entry in _entries(spec):
        given = [key for key in ("stiffness", "damping", "travel", "lever") if key in entry.model_fields_set]
        if entry.force is None and given:
            yield f"{table}.{entry.name}: {', '.join(given)} have no effect on a fixed body; give force and direction for a tensioner"
    if spec.drive and spec.drive.preload is not None and spec.driven.centre_distance is not None:
        yield ("drive.preload has no effect with a fixed centre distance, where chain length and tensioners determine the strand tension")
    if spec.roller:
        given = [key for key in ("apothem", "standard_apothem", "flank_angle") if np.any(getattr(spec.plate, key) != getattr(USUAL, key))]
        if given:
            yield f"plate.{', plate.'.join(given)} {'has' if len(given) == 1 else 'have'} no effect on a roller chain"
    if spec.joint.kind == "revolute" and spec.joint.rolling_radius is not None:
        yield "joint.rolling_radius has no effect on a revolute joint"
    if spec.joint.seat_radius is not None and spec.joint.kind not in PAIRS:
        yield (
            f"joint.seat_radius has no effect on a joint of kind {spec.joint.kind or 'round-pin'!r}, whose two surfaces have the same "
            "radius"
        )
    if spec.joint.kind != "revolute" and spec.joint.pin_diameter is not None:
        yield "joint.pin_diameter has no effect on a rolling joint, whose pins have the rolling radius"
