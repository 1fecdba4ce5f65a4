"""A quantity that is a length, or the word for a rule that gives it."""

from dataclasses import dataclass
from typing import Any, ClassVar

from drivewright.errors import UnitError, brief
from drivewright.units import BY_NAME, Dimension


@dataclass(frozen=True)
class LengthOrRule(Dimension):
    """A length [m], or one of the `rules`, by its word."""

    rules: tuple[str, ...] = ()
    plain: ClassVar[bool] = True

    def parse(self, value: Any) -> float | str:
        """As `Dimension.parse`, of the wider kind."""
        if value in self.rules:
            return value
        if isinstance(value, str) and not any(sign.isdigit() for sign in value):
            raise UnitError(f"wants {self.described}, got {brief(value)}")
        return BY_NAME["length"].parse(value)

    def text(self, value: float | str) -> str:
        """The word of a rule, or a length as of `Dimension.text`."""
        return value if isinstance(value, str) else BY_NAME["length"].text(value)

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        examples = [*self.rules[:1], "0.27 mm"]
        return {"type": "string", "examples": examples, "x-dimension": "length", "x-unit": "mm", "x-si-unit": "m"}


def length_or_rule(*rules: str) -> LengthOrRule:
    """The field type of a length, or of one of the rules."""
    *others, last = (f'"{rule}"' for rule in rules)
    return LengthOrRule(f"{', '.join(['length', *others])} or {last}", "m", "mm", rules=rules)
