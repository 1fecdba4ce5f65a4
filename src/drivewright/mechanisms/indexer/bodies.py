"""The bodies of an indexer whose size the spec gives, as solids."""

from drivewright.bearings import Entry
from drivewright.indexing import drivetrain, solid
from drivewright.indexing.pin_wheel import PinWheel
from drivewright.mechanisms.indexer.spec import IndexerSpec


def solid_parts(
    spec: IndexerSpec, crank: Entry | None, support: Entry | None, wheel: PinWheel, train: drivetrain.Drivetrain | None
) -> solid.Solids:
    """The bodies whose size the spec gives, with the catalogue entries of crank and support bearings.

    What it does not tell is as in the reduced model.
    """
    cam = shaft = None
    if crank and crank.outer_diameter:
        cam = solid.CamBody(spec.cam_width, crank.outer_diameter)
    if crank and crank.bore and spec.shafts:
        seat = support.width if support and support.width else 0.4 * min(spec.shafts.diameters)
        shaft = solid.ShaftBody(crank.bore, spec.cam_width, seat, 0.7 * spec.shafts.diameters[0])
    return solid.Solids(cam, shaft, solid.usual_wheel(wheel, train, spec.cam_width) if cam and train and train.shaft else None)
