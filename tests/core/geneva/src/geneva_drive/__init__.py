"""A Geneva wheel in four files: this one, the spec, the wheel, a preset."""

from pathlib import Path

from drivewright.registry import Analysis, Mechanism
from drivewright.result import Plot
from geneva_drive.spec import GenevaSpec
from geneva_drive.wheel import build, claims, motion

mechanism = Mechanism(
    kind="geneva",
    summary="external Geneva wheel",
    spec=GenevaSpec,
    build=build,
    claims=claims,
    analyses=(Analysis("motion", motion, "the step of the wheel"),),
    folder=Path(__file__).parent,
    plots=(Plot("step", "The step", "motion", "angle", ("wheel", "rate")),),
    headline=("step", "max_speed"),
)
