"""The base class of all tables of a spec."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Self, TypeVar

from pydantic import BaseModel, ConfigDict, ValidationError

from drivewright.labels import label_of_key
from drivewright.spec.error_messages import spec_error_of
from drivewright.spec.keys import set_key
from drivewright.spec.serialisation import document

if TYPE_CHECKING:
    from pydantic.fields import FieldInfo

    class _Table:
        """pydantic's BaseModel as its users see it: built from keys as in a file, "9.5 mm" where the attribute is a float."""

        model_config: ClassVar[ConfigDict]
        model_fields: ClassVar[dict[str, FieldInfo]]
        model_fields_set: set[str]
        __pydantic_decorators__: ClassVar[Any]

        def __init__(self, **keys: Any) -> None: ...
        @classmethod
        def model_construct(cls, _fields_set: set[str] | None = None, **values: Any) -> Self: ...
        def model_copy(self, *, update: Mapping[str, Any] | None = None) -> Self: ...
        @classmethod
        def model_validate(cls, obj: Any, *, context: Any = None) -> Self: ...
        @classmethod
        def model_json_schema(cls, **settings: Any) -> dict[str, Any]: ...


class _SpecMeta(type(BaseModel)):
    """Turns the error of a table built in Python into a `SpecError`.  (A nested table read from a file does not pass through it.)"""

    def __call__(cls, **data: Any) -> Any:
        try:
            return super().__call__(**data)._made_from(data)
        except ValidationError as error:
            raise spec_error_of(error, cls) from None


if not TYPE_CHECKING:

    class _Table(BaseModel, metaclass=_SpecMeta):
        """The base of all tables."""


SpecT = TypeVar("SpecT", bound="Spec")


class Spec(_Table):
    """One table of a spec: frozen, no unknown keys, quantities with units converted to SI."""

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        validate_default=True,
        allow_inf_nan=False,
        field_title_generator=lambda name, field: label_of_key(name, field.title),
    )

    def _made_from(self, tables: Mapping[str, Any]) -> Self:
        """The spec itself, after validation of raw tables; what it keeps of them besides its fields is up to its kind."""
        return self

    def replace(self, changes: Mapping[str, Any] | None = None, /, **keys: Any) -> Self:
        """A copy with keys of this table changed, validated like the original: `replace(radius="8 mm")`.

        A dotted key changes what is inside, as `--set` does: `replace({"joints.A.clearance": "20 um"})`, elements of lists by name or
        number.  Values are as in a spec file.
        """
        tables = document(self)
        for key, value in {**(changes or {}), **keys}.items():
            set_key(tables, key, value)
        return validate_tables(type(self), tables)


def validate_tables(model: type[SpecT], tables: Mapping[str, Any], folder: str | Path = ".") -> SpecT:
    """A spec of a class from raw tables; paths are relative to `folder`.  SpecError names the key."""
    try:
        return model.model_validate(tables, context={"folder": str(folder)})._made_from(tables)
    except ValidationError as error:
        raise spec_error_of(error, model) from None
