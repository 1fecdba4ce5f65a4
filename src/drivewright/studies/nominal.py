"""The value that a key has where nothing varies: the spec's own, or what the drive takes from elsewhere, a catalogue or a card."""

from collections.abc import Mapping
from typing import Any

from drivewright import registry
from drivewright.errors import InputError
from drivewright.spec import MechanismSpec, value_at
from drivewright.spec.keys import key_by_name


def nominal_value(spec: MechanismSpec, key: str) -> Any:
    """Value [SI] at a key of a spec; of a key that is not given there, the one that is supplied, else None."""
    own = value_at(spec, key)
    return supplied_values(spec).get(key_by_name(spec, key)) if own is None else own


def supplied_values(spec: MechanismSpec) -> Mapping[str, float]:
    """{key: value in SI} of keys that the spec does not give and its kind of drive takes from elsewhere; {} of a spec that has faults,
    which a case without them may not share."""
    try:
        supplied = registry.mechanism(spec.mechanism).supplied
        return supplied(spec) if supplied else {}
    except InputError:
        return {}
