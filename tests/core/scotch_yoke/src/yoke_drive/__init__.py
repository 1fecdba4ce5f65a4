"""A Scotch yoke in four files: this one, the spec, the yoke, a preset."""

from pathlib import Path

from drivewright.registry import Analysis, Mechanism
from drivewright.result import Plot
from yoke_drive.spec import YokeSpec
from yoke_drive.yoke import build, claims, motion

mechanism = Mechanism(
    kind="scotch-yoke",
    summary="Scotch yoke",
    spec=YokeSpec,
    build=build,
    claims=claims,
    analyses=(Analysis("motion", motion, "the travel of the yoke"),),
    folder=Path(__file__).parent,
    plots=(Plot("travel", "The travel", "motion", "angle", ("travel", "rate")),),
    headline=("stroke", "max_speed"),
)
