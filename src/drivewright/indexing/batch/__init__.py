"""Many pin wheels at once in compiled code: the profile as a sampled envelope, its loop around the cam, contacts, play, pressure angles."""

from drivewright.indexing.batch.pin_wheels import PinWheelValues, evaluate_pin_wheels

__all__ = ["PinWheelValues", "evaluate_pin_wheels"]
