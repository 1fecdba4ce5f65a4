"""Profile, contacts, play and stress of roller-gear cams, barrel and globoidal."""

import numpy as np

from drivewright.indexing import roller_gear
from drivewright.indexing.motion import TURN
from drivewright.indexing.play import DIRECTIONS
from drivewright.indexing.values import contact_count_values
from drivewright.mechanisms.indexer.build import IndexerModel
from drivewright.mechanisms.indexer.geometry import play_answer, pressure_angle_check
from drivewright.result import Answer, Answers, Check, Table

STEPS = 181  # input angles over the turn
ALONG = 9  # places along a roller


def surface(model: IndexerModel, done: Answers) -> Answer:
    """Flanks of the cam over the turn, trimmed by every roller: points, curvature, pressure angle, undercut."""
    angle = np.linspace(0, TURN, STEPS) if model.spec.load.angle is None else model.angles
    flanks = roller_gear.compute_flanks(model.cam, angle, ALONG)
    values = roller_gear.flank_values(flanks)
    message = "share of the contact lines lost to undercut; take thinner rollers, a larger cam or a longer motion angle"
    undercut = Check("undercut", float(flanks.undercut), 0.0, "<=", "-", message, ("cam",), True, label="Undercut")
    message = "maximum pressure angle over all contact lines; enlarge the cam or the motion angle"
    checks = (undercut, *pressure_angle_check(model, values, message))
    return Answer(values, (roller_gear.flank_table(flanks),), checks, data=flanks)


def contact_map(model: IndexerModel, done: Answers) -> Answer:
    """Which rollers touch which flank at every input angle."""
    flanks = done["profile"].data
    table = roller_gear.contact_count_table(flanks)
    values = contact_count_values(table, "rollers", "with the cam")
    return Answer(values, (table,), arrays={"contact_map": roller_gear.contact_map_array(flanks)})


def free_play(model: IndexerModel, done: Answers) -> Answer:
    """Free rotation of the wheel in either direction."""
    flanks = done["profile"].data
    free = {name: roller_gear.find_turret_play(flanks, direction) for name, direction in DIRECTIONS.items()}
    return play_answer(model, flanks.theta, {name: np.where(np.isfinite(each), each, np.nan) for name, each in free.items()})


def stress(model: IndexerModel, done: Answers) -> tuple[Table, tuple[str, ...]]:
    """Forces and Hertz pressure of the rollers under the torque, and findings."""
    flanks = done["profile"].data
    loads = roller_gear.compute_roller_loads(flanks, model.torque, model.modulus)
    lost = np.isnan(loads.line_load)
    findings = (f"no roller carries the torque at {np.sum(lost)} of {len(lost)} input angles",) if lost.any() else ()
    return roller_gear.roller_force_table(flanks, loads), findings
