"""The JSON schema of a kind's spec files, read off the fields."""

from typing import Any

from pydantic.json_schema import GenerateJsonSchema

from drivewright import registry
from drivewright.spec.serialisation import to_plain


def schema(kind: str) -> dict[str, Any]:
    """JSON schema of a kind's spec files, for editors and forms."""
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        **registry.mechanism(kind).spec.model_json_schema(schema_generator=_Schema),
        "title": f"Drivewright {kind}",
    }


class _Schema(GenerateJsonSchema):
    """Defaults as they stand in a file: quantities as text, not in SI."""

    def encode_default(self, dft: Any) -> Any:
        return to_plain(dft)
