"""One table of a spec."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Self, TypeVar

from pydantic import BaseModel, ConfigDict, ValidationError

from drivewright.labels import label_of_key
from drivewright.spec.keys import set_key
from drivewright.spec.messages import translated
from drivewright.spec.writing import document

if TYPE_CHECKING:
    from pydantic.fields import FieldInfo

    class _Table:
        """pydantic's BaseModel as its users see it: it is made from keys as in a file, "9.5 mm" where the attribute is a float."""

        model_config: ClassVar[ConfigDict]
        model_fields: ClassVar[dict[str, FieldInfo]]
        model_fields_set: set[str]

        def __init__(self, **keys: Any) -> None: ...
        def model_copy(self, *, update: Mapping[str, Any] | None = None) -> Self: ...
        @classmethod
        def model_validate(cls, obj: Any, *, context: Any = None) -> Self: ...
        @classmethod
        def model_json_schema(cls, **settings: Any) -> dict[str, Any]: ...


class _Door(type(BaseModel)):
    """Turns the complaint about a table built in Python into ours.  (A nested table read from a file does not pass here.)"""

    def __call__(cls, **data):
        try:
            return super().__call__(**data)
        except ValidationError as error:
            raise translated(error, cls) from None


if not TYPE_CHECKING:

    class _Table(BaseModel, metaclass=_Door):
        """The base of all tables."""


SpecT = TypeVar("SpecT", bound="Spec")


class Spec(_Table):
    """One table of a spec: frozen, no unknown keys, units at the door."""

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        validate_default=True,
        allow_inf_nan=False,
        field_title_generator=lambda name, field: label_of_key(name, field.title),
    )

    def replace(self, changes: Mapping[str, Any] | None = None, /, **keys: Any) -> Self:
        """A copy with keys of this table changed, validated like the original: `replace(radius="8 mm")`.

        A dotted key changes what is inside, as `--set` does: `replace({"joints.A.clearance": "20 um"})`, elements of lists by name or
        number.  Values are as in a spec file.
        """
        tables = document(self)
        for key, value in {**(changes or {}), **keys}.items():
            set_key(tables, key, value)
        return validated(type(self), tables)


def validated(model: type[SpecT], tables: Mapping[str, Any], folder: str | Path = ".") -> SpecT:
    """A spec of a class from raw tables; paths are relative to `folder`.  SpecError names the key."""
    try:
        return model.model_validate(tables, context={"folder": str(folder)})
    except ValidationError as error:
        raise translated(error, model) from None
