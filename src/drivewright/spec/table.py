"""One table of a spec."""

from pydantic import BaseModel, ConfigDict, ValidationError

from drivewright.spec.messages import translated
from drivewright.spec.writing import document


class _Door(type(BaseModel)):
    """Turns the complaint about a table built in Python into ours.  (A nested table read from a file does not pass here.)"""

    def __call__(cls, **data):
        try:
            return super().__call__(**data)
        except ValidationError as error:
            raise translated(error, cls) from None


class Spec(BaseModel, metaclass=_Door):
    """One table of a spec: frozen, no unknown keys, units at the door."""

    model_config = ConfigDict(frozen=True, extra="forbid", validate_default=True, allow_inf_nan=False)

    def replace(self, **changes):
        """A copy with keys of this table changed; validated like the original."""
        return validated(type(self), {**document(self), **changes})


def validated(model, tables, folder="."):
    """A spec of a class from raw tables; paths are relative to `folder`.  SpecError names the key."""
    try:
        return model.model_validate(tables, context={"folder": str(folder)})
    except ValidationError as error:
        raise translated(error, model) from None
