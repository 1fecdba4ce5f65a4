"""The spec of a shaft: its tables, and their validation."""

from pydantic import model_validator

from drivewright.mechanisms.shaft.refusals import refuse_nonsense
from drivewright.mechanisms.shaft.tables import ShaftTables


class ShaftSpec(ShaftTables):
    """A shaft on bearings."""

    @model_validator(mode="after")
    def _has_a_meaning(self):
        refuse_nonsense(self)
        return self
