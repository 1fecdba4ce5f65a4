"""Forces in all joints over the last turn, from the equations of every body in absolute coordinates: a second route to the motion."""

import numpy as np

from drivewright.mechanisms.linkage.analyse import ROWS, cycle_columns
from drivewright.mechanisms.linkage.build import run_of
from drivewright.multibody.observe import joined, observe
from drivewright.multibody.reactions import reactions, unbounded_joints
from drivewright.multibody.simulate import clear_states
from drivewright.numerics.signals import time_mean
from drivewright.result import Answer, Check, Column, Table, Value


def seen_last(model):
    """`Observed` over the last whole turn, or over the run, thinned to about ROWS; the middles of folds left out."""
    run = run_of(model)
    turns = np.floor(run.end[1] / model.period + 1e-9) if model.period else 0
    start = (turns - 1) * model.period if turns >= 1 else 0.0
    return joined([observe(*states) for states in clear_states(run, start * (1 - 1e-12), ROWS)])


def forces(model, done):
    """Largest force of every joint in the last turn, the forces over it, and what Newton's and Euler's equations leave over."""
    seen = seen_last(model)
    t, found = seen.t, reactions(model.assembly, run_of(model).end[0], seen)
    unbounded = _unbounded(model, t[0])
    values, checks, columns = {}, [], list(cycle_columns(model, t))
    for name, joint in found.joints.items():
        size = np.hypot(*joint.force.T)
        if name.endswith(" (link)"):  # the other end of a link without mass: the same force
            continue
        if name not in model.pins and name not in unbounded:  # of pins with play the whole window is known
            values[f"joints.{name}.max_force"] = Value(float(size.max()), "N", f"largest force in joint {name!r} in the last turn")
        columns += [Column(f"{name}.force", "N", f"force in joint {name!r}", size),
                    Column(f"{name}.force_x", "N", f"force of joint {name!r} on its first body, x", joint.force[:, 0]),
                    Column(f"{name}.force_y", "N", f"force of joint {name!r} on its first body, y", joint.force[:, 1])]
    for name, tension in found.tensions.items():
        columns.append(Column(f"{name}.tension", "N", f"tension of the massless link of joint {name!r}; below 0 contact is lost", tension))
        share = time_mean(t, tension < -model.spec.limits.link_compression)
        values[f"joints.{name}.pushed_share"] = Value(share, "-", f"share of the last turn in which the link of joint {name!r} is pushed")
        checks.append(Check(f"contact.{name}", float(tension.min()), -model.spec.limits.link_compression, ">=", "N",
                            f"least tension of the massless link of joint {name!r}: a pin that is pushed has lost contact", (name,)))
    words = "what Newton's and Euler's equations of the bodies leave over, as a part of the largest force"
    values["forces.residual"] = Value(float(found.residual.max()), "-", words)
    return Answer(values, (Table("forces", "Forces in the joints over the last turn", tuple(columns)),), tuple(checks),
                  tuple(_fold_findings(model, unbounded)))


def _unbounded(model, start):
    """{joint: time of the singular position towards which its force grows without bound}, from a time on."""
    found = {}
    for passed in run_of(model).passages:
        if passed.time >= start:
            seen = observe(passed.system, np.array([passed.time]), passed.state[None])
            found |= dict.fromkeys(unbounded_joints(model.assembly, passed.system, seen), passed.time)
    return found


def _fold_findings(model, unbounded):
    if unbounded:
        names, time = ", ".join(map(repr, unbounded)), max(unbounded.values())
        yield (f"the force in joints {names} grows without bound towards the singular position at t = {time:.6g} s: links in line cannot "
               "carry a load across them. Its largest value does not exist; elastic links or play would bound it")
    elif run_of(model).passages:
        yield "joint forces in the middle of a singular position are limits of those beside it; they are left out of tables and extremes"
