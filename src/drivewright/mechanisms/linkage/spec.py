"""The spec of a linkage: its tables, and their validation."""

from pydantic import model_validator

from drivewright.mechanisms.linkage.refusals import refuse_nonsense
from drivewright.mechanisms.linkage.tables import LinkageTables


class LinkageSpec(LinkageTables):
    """A planar linkage with ideal joints or joints with play."""

    @model_validator(mode="after")
    def _has_a_meaning(self):
        refuse_nonsense(self)
        return self
