"""What a shaft takes from elsewhere: material of a card, clearance and ratings of a rolling bearing."""

from drivewright import materials
from drivewright.mechanisms.shaft.build import rolling_bearing
from drivewright.mechanisms.shaft.refusals import is_rolling
from drivewright.mechanisms.shaft.spec import ShaftSpec

MATERIAL = {"youngs_modulus": "modulus", "poisson_ratio": "poisson", "density": "density", "yield_strength": "yield_strength"}
BEARING = ("radial_clearance", "dynamic_rating", "static_rating")


def supplied(spec: ShaftSpec) -> dict[str, float]:
    """{key: value in SI} of the keys of material and rolling bearings that the spec leaves out and that have a value all the same."""
    return _of_material(spec) | _of_bearings(spec)


def _of_material(spec: ShaftSpec) -> dict[str, float]:
    usual = materials.properties(spec.material.card)
    found = {key: getattr(usual, name) for key, name in MATERIAL.items() if getattr(spec.material, key) is None}
    return {f"material.{key}": value for key, value in found.items() if value is not None}


def _of_bearings(spec: ShaftSpec) -> dict[str, float]:
    pairs = [(bearing, rolling_bearing(spec, bearing)) for bearing in spec.bearings if is_rolling(bearing)]
    return {
        f"bearings.{bearing.name}.{key}": value
        for bearing, found in pairs
        for key in BEARING
        if getattr(bearing, key) is None and (value := getattr(found, key)) is not None
    }
