"""Spec -> model: the mechanism as stated and its ideal twin, assembled, with the requirements on its run."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from drivewright.errors import DoesNotAssemble
from drivewright.mechanisms.linkage.advice import assumed_friction
from drivewright.mechanisms.linkage.describe import describe, joint_friction, motor_name, output_marker
from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.multibody.analyses.simulation_model import Output, RunLimits, SimulationModel
from drivewright.multibody.assembly import assemble
from drivewright.multibody.simulate import Settings, kernels_of_run, unassembled
from drivewright.multibody.tolerance import kernel_of_samples


@dataclass(frozen=True, eq=False, kw_only=True)
class LinkageModel(SimulationModel):
    """The mechanism of a spec, ready to run."""

    spec: LinkageSpec

    @property
    def findings(self) -> tuple[str, ...]:
        """Of the assembly, what is assumed for friction in ideal joints, and bodies without a drawing."""
        from drivewright.mechanisms.linkage.plates import plate_findings

        return (*self.assembly.findings, *assumed_friction(self.spec), *plate_findings(self.spec))


def build(spec: LinkageSpec) -> LinkageModel:
    """The `LinkageModel` of a LinkageSpec."""
    try:
        whole = describe(spec)
        assembly = assemble(whole)
        ideal = assemble(describe(spec, ideal=True)) if any(joint.play for joint in whole.joints) else assembly
    except DoesNotAssemble as error:
        raise DoesNotAssemble(f"linkage: {error}") from None
    run, limits = spec.simulate, spec.limits
    return LinkageModel(
        spec=spec,
        assembly=assembly,
        ideal=ideal,
        outputs=tuple(_output(spec, output) for output in spec.outputs),
        settings=_settings(spec),
        duration=spec.duration or spec.period,
        period=spec.period,
        drive_speed=spec.drive_speed,
        window_start=spec.start_of_window if run else 0.0,
        samples_per_turn=run.samples_per_turn if run else 720,
        ensemble=run.ensemble if run else 1,
        seed=run.seed if run else 1,
        limits=RunLimits(
            limits.impact_load_coefficient,
            limits.joint_force,
            limits.penetration,
            limits.drive_torque,
            limits.link_compression,
            limits.energy_error,
        ),
        motors={motor_name(spec, drive): drive.joint for drive in spec.all_drives.values() if drive.motor},
        grips={joint.name: joint.friction for joint in spec.joints if joint.kind == "rolling" and joint_friction(joint)},
    )


def compile_ahead(spec: LinkageSpec) -> list[Callable[[], object]]:
    """What compiles the kernels that a run of this spec comes to last."""
    model = describe(spec)
    system, has_play = unassembled(model), any(joint.play for joint in model.joints)
    tolerances = [kernel_of_samples(system)] if spec.tolerances else []
    return [*kernels_of_run(system, _settings(spec) if has_play else None), *tolerances]


def _output(spec, output):
    return Output(output.name, output.body, output.point, output_marker(spec, output), _path_axis(spec, output))


def _path_axis(spec, output):
    """Direction in which a point's path is seen: the axis of a prismatic joint to the ground on its body, else the world's x."""
    for joint in spec.joints:
        first, second = (text.split(".")[0] for text in joint.connects)
        if joint.kind == "prismatic" and first == output.body and second == "ground":
            x, y = np.array(joint.axis) / np.hypot(*joint.axis)
            return float(x), float(y)
    return 1.0, 0.0


def _settings(spec):
    """Of the integrator."""
    run = spec.simulate
    if run is None:
        return Settings(per_step=2)
    tolerances, limits = (run.relative_tolerance, run.absolute_tolerance), (None, run.min_step, run.max_steps)
    return Settings(*tolerances, *limits, run.method, 2, run.singular, run.samples_per_turn)
