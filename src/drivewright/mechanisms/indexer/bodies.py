"""The bodies of an indexer that its spec tells the size of, as solids."""

from typing import TYPE_CHECKING

from drivewright.indexing import solid

if TYPE_CHECKING:
    from drivewright.mechanisms.indexer.build import IndexerModel


def solid_parts(model: "IndexerModel") -> solid.Solids:
    """The bodies that the spec tells the size of; what it does not is as in the reduced model."""
    spec, entry = model.spec, model.crank_bearing
    cam = shaft = None
    if entry and entry.outer_diameter:
        cam = solid.CamBody(spec.cam_width, entry.outer_diameter)
    if entry and entry.bore and spec.shafts:
        seat = model.support_bearing.width if model.support_bearing and model.support_bearing.width else 0.4 * min(spec.shafts.diameters)
        shaft = solid.ShaftBody(entry.bore, spec.cam_width, seat, 0.7 * spec.shafts.diameters[0])
    wheel = solid.usual_wheel(model.wheel, model.train, spec.cam_width) if cam and model.train and model.train.shaft else None
    return solid.Solids(cam, shaft, wheel)
