"""What the number of a roller chain gives to a spec: keys that are not given are filled, given keys take precedence and are reported."""

from collections.abc import Iterator
from typing import Any

from drivewright.chains.sizes import ChainSize
from drivewright.mechanisms.silent_chain.spec import Roller, SilentChainSpec, size_of
from drivewright.spec import Field, dimension_at, value_at
from drivewright.spec.designs import with_columns
from drivewright.units import Length

EQUAL = 1e-9  # relative: as the number says it


class SizedSpec(SilentChainSpec):
    """A spec whose pitch is known: given, or by the number of its chain."""

    pitch: Length = Field(gt=0, description="pitch of the straight chain")  # pyright: ignore[reportIncompatibleVariableOverride]


def sized(spec: SilentChainSpec) -> SizedSpec:
    """The spec with everything that the number of its chain gives.

    Numbers may be arrays, of many designs at once: nothing is validated again.
    """
    if isinstance(spec, SizedSpec):
        return spec
    tables = {name: getattr(spec, name) for name in SilentChainSpec.model_fields}
    full = SizedSpec.model_construct(_fields_set=set(spec.model_fields_set), **tables)
    if spec.chain is None:
        return full
    return with_columns(full.model_copy(update={"roller": full.roller or Roller()}), missing_values(spec))


def missing_values(spec: SilentChainSpec) -> dict[str, Any]:
    """{key: value in SI} that the number of the chain gives to keys which the spec leaves out."""
    size = size_of(spec)
    return {key: value for key, value in _given_by(size).items() if value_at(spec, key) is None} if size else {}


def supplied(spec: SilentChainSpec) -> dict[str, float]:
    """The numbers among them, for a study that varies about them."""
    return {key: float(value) for key, value in missing_values(spec).items() if not isinstance(value, str)}


def size_findings(spec: SilentChainSpec) -> Iterator[str]:
    """Keys given beside the number that say something else than it, and what its table does not have."""
    size = size_of(spec)
    if size is None:
        return
    for key, value in _given_by(size).items():
        own = value_at(spec, key)
        if own is not None and _differs(own, value):
            yield f"{key} = {_text(key, own)} of the spec is used instead of {_text(key, value)} of chain {size.name}"
    if size.bush_chain:
        yield f"chain {size.name} has no rollers: its bushes mesh, and roller.diameter is their diameter"


def _given_by(size: ChainSize) -> dict[str, Any]:
    found: dict[str, Any] = {
        "pitch": size.pitch,
        "rows": size.rows,
        "breaking_load": size.tensile_strength,
        "joint.kind": "revolute",
        "joint.pin_diameter": size.pin_diameter,
        "joint.contact_length": size.bush_length,
        "roller.diameter": size.roller_diameter,
        "roller.inner_width": size.inner_width,
        "plate.thickness": size.outer_plate,
        "plate.back": 0.5 * size.plate_height,
        "plate.link_mass": size.mass_per_length * size.pitch,
    }
    return found | ({"row_pitch": size.row_pitch} if size.rows > 1 else {})


def _differs(own: Any, value: Any) -> bool:
    return own != value if isinstance(value, str) else bool(abs(own - value) > EQUAL * abs(value))


def _text(key: str, value: Any) -> str:
    """A value as a spec file has it."""
    _, dimension = dimension_at(SilentChainSpec, key)
    return repr(value) if isinstance(value, str) else dimension.text(float(f"{value:.6g}")) if dimension else str(value)
