"""Many pin wheels at once in compiled code: the profile as a sampled envelope, its loop around the cam, contacts, play, pressure angles.

designs     many pin wheels whose motion laws may differ
loops       exposed segments of an envelope chained into the loop around the cam, compiled
pin_wheels  many pin wheels at once, for studies and the optimiser
sampled_wheel  a pin wheel with the sampled profile, for its contacts and stiffness
values      values of one design from its sampled envelope, compiled
"""

from drivewright.indexing.batch.designs import DesignValues, evaluate_designs
from drivewright.indexing.batch.pin_wheels import PinWheelValues, evaluate_pin_wheels
from drivewright.indexing.batch.sampled_wheel import SampledPinWheel, sampled

__all__ = ["DesignValues", "PinWheelValues", "SampledPinWheel", "evaluate_designs", "evaluate_pin_wheels", "sampled"]
