"""What an editor must know of a script: read by the type checker alone, never run."""

from typing import assert_type

import pyarrow
from matplotlib.figure import Figure

import drivewright as dw
from drivewright.mechanisms.cam.build import CamModel
from drivewright.mechanisms.linkage.build import LinkageModel
from drivewright.registry import Analysis, Mechanism
from drivewright.result import Answer, Answers, Check, Value

cam = dw.Cam(follower={"motion": "translating", "prime_radius": "40 mm"}, programme=[])
assert_type(cam.follower.offset, float)
assert_type(cam.replace(title="another"), dw.Cam)
assert_type(dw.build(cam), CamModel)
assert_type(dw.build(dw.Linkage(bodies={})), LinkageModel)

result = dw.run(cam, only=("motion",))
assert_type(result, dw.Result[dw.Cam])
assert_type(result.spec.follower.offset, float)
assert_type(result["max_pressure_angle"], float)
assert_type(result.values["lift"], Value)
assert_type(result.check("undercut"), Check)
assert_type(result.check("undercut").ok, bool)
assert_type(result.table("motion"), pyarrow.Table)
assert_type(result.plot("lift"), Figure)


def lift(model: CamModel, done: Answers) -> Answer:
    """An analysis of one's own."""
    return Answer({"lift": Value(done["motion"].values["lift"].value, "m", "lift")})


assert_type(Analysis[dw.Cam, CamModel]("lift", lift, "the lift").answer(dw.build(cam), {}), Answer)


def summary(kind: Mechanism[dw.Cam, CamModel]) -> str:
    """A mechanism knows its spec and its model."""
    return kind.build(cam).spec.title
