"""Forces in all joints over the last turn, from the equations of every body in absolute coordinates: a second route to the motion."""

import numpy as np

from drivewright.mechanisms.linkage.analyse import ROWS, cycle_columns
from drivewright.mechanisms.linkage.build import run_of
from drivewright.multibody.observe import Observed, observe
from drivewright.multibody.reactions import reactions
from drivewright.numerics.signals import time_mean
from drivewright.result import Answer, Check, Column, Table, Value


def seen_last(model):
    """`Observed` over the last whole turn, or over the run, thinned to about ROWS; all stretches of the run that reach into it."""
    run = run_of(model)
    turns = np.floor(run.end[1] / model.period + 1e-9) if model.period else 0
    start = (turns - 1) * model.period if turns >= 1 else 0.0
    rows = [(stretch, np.flatnonzero(stretch.t >= start * (1 - 1e-12))) for stretch in run.stretches]
    thin = max(1, -(-sum(len(some) for _, some in rows) // ROWS))
    parts = [observe(stretch.system, stretch.t[some[::thin]], stretch.y[some[::thin]]) for stretch, some in rows if len(some)]
    return Observed(*(np.concatenate(each) for each in zip(*parts, strict=True)))


def forces(model, done):
    """Largest force of every joint in the last turn, the forces over it, and what Newton's and Euler's equations leave over."""
    seen = seen_last(model)
    t, found = seen.t, reactions(model.assembly, run_of(model).end[0], seen)
    values, checks, columns = {}, [], list(cycle_columns(model, t))
    for name, joint in found.joints.items():
        size = np.hypot(*joint.force.T)
        if name.endswith(" (link)"):  # the other end of a link without mass: the same force
            continue
        if name not in model.pins:  # of those the whole window is known
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
    return Answer(values, (Table("forces", "Forces in the joints over the last turn", tuple(columns)),), tuple(checks))
