"""Fatigue of a material: strain-life card, the uniform material law for when only the tensile strength is known, lives as text."""

import math
import re
from typing import NamedTuple

from pydantic import model_validator

from drivewright.errors import InputError, SpecError, UnknownName
from drivewright.spec import Flag, Number, Spec, Text
from drivewright.spec.fields import Field
from drivewright.units import SI, Pressure, to_si


class StrainLife(Spec):
    """Strain amplitude over life of smooth specimens, fully reversed: e_a = sf'/E (2N)^b + ef' (2N)^c  (Basquin, Coffin, Manson)."""

    youngs_modulus: Pressure = Field(gt=0, description="Young's modulus E", examples=["206 GPa"])
    poisson_ratio: Number = Field(0.3, ge=0, lt=0.5, description="Poisson's ratio of elastic strain")
    plastic_poisson_ratio: Number = Field(0.5, ge=0, le=0.5, description="Poisson's ratio of plastic strain")
    fatigue_strength: Pressure = Field(gt=0, description="fatigue strength coefficient sf'", examples=["1470 MPa"])
    fatigue_strength_exponent: Number = Field(lt=0, description="fatigue strength exponent b", examples=[-0.087])
    fatigue_ductility: Number = Field(gt=0, description="fatigue ductility coefficient ef'", examples=[0.46])
    fatigue_ductility_exponent: Number = Field(lt=0, description="fatigue ductility exponent c", examples=[-0.58])
    cyclic_strength: Pressure | None = Field(
        None, gt=0, description="cyclic strength coefficient K'; sf'/ef'^n' unless given", examples=["1650 MPa"]
    )
    cyclic_hardening_exponent: Number | None = Field(
        None, gt=0, lt=1, description="cyclic hardening exponent n'; b/c unless given", examples=[0.15]
    )
    yield_strength: Pressure | None = Field(None, gt=0, description="cyclic yield stress; K' 0.002^n' unless given", examples=["835 MPa"])
    longest_life: Number = Field(1e9, gt=0, description="longest life that the numbers are believed for; beyond it they are extrapolated")
    estimated: Flag = Field(False, description="whether the numbers come from a rule instead of tests")
    source: Text = Field("", description="where the numbers come from")

    @model_validator(mode="after")
    def _falls_faster_when_plastic(self):
        b, c = self.fatigue_strength_exponent, self.fatigue_ductility_exponent
        if not c < b:
            raise SpecError(
                f"{c:g} must lie below fatigue_strength_exponent, which is {b:g}: plastic strain falls faster with life than "
                "elastic strain; exchange them if they were swapped",
                key="fatigue_ductility_exponent",
            )
        return self

    @property
    def hardening_exponent(self) -> float:
        """n' as given, else b/c, which makes the cyclic curve agree with the strain-life curve."""
        given = self.cyclic_hardening_exponent
        return self.fatigue_strength_exponent / self.fatigue_ductility_exponent if given is None else given

    @property
    def strength_coefficient(self) -> float:
        """K' [Pa] as given, else sf'/ef'^n'."""
        given = self.cyclic_strength
        return self.fatigue_strength / self.fatigue_ductility**self.hardening_exponent if given is None else given

    @property
    def cyclic_yield(self) -> float:
        """Stress [Pa] from which on yielding is reckoned with: as given, else that of 0.2 % plastic strain on the cyclic curve."""
        return self.strength_coefficient * 0.002**self.hardening_exponent if self.yield_strength is None else self.yield_strength


class _Rule(NamedTuple):
    """sf'/Rm, b, ef' at full ductility, c, K'/Rm, n'."""

    strength: float
    b: float
    ductility: float
    c: float
    cyclic: float
    n: float


_RULES = {"steel": _Rule(1.5, -0.087, 0.59, -0.58, 1.65, 0.15), "aluminium-titanium": _Rule(1.67, -0.095, 0.35, -0.69, 1.61, 0.11)}


def uniform_material_law(
    tensile_strength: str | float,
    youngs_modulus: str | float,
    poisson_ratio: float = 0.3,
    family: str = "steel",
    yield_strength: str | float | None = None,
) -> StrainLife:
    """A `StrainLife` estimated from the tensile strength Rm alone, `family` "steel" or "aluminium-titanium".

    Unalloyed and low-alloy steel: sf' = 1.5 Rm, b = -0.087, ef' = 0.59 psi, c = -0.58, K' = 1.65 Rm, n' = 0.15, with
    psi = min(1, 1.375 - 125 Rm/E); aluminium and titanium alloys: 1.67 Rm, -0.095, 0.35, -0.69, 1.61 Rm, 0.11.
    Quantities are texts with a unit or SI floats.  Raises InputError where psi is not above 0, UnknownName for another family.
    Baumel and Seeger, Materials Data for Cyclic Loading, Supplement 1 (1990); recalled.
    """
    if family not in _RULES:
        raise UnknownName("family of the uniform material law", family, _RULES)
    rule = _RULES[family]
    strength, modulus = _positive("tensile_strength", tensile_strength), _positive("youngs_modulus", youngs_modulus)
    ductility = min(1.0, 1.375 - 125 * strength / modulus) if family == "steel" else 1.0
    if not ductility > 0:
        raise InputError(
            f"uniform_material_law: a tensile strength of {strength / 1e6:.6g} MPa is {strength / modulus:.4g} of Young's modulus; from "
            "0.011 on the law leaves no ductility. Check the units, or bring a card from tests."
        )
    return StrainLife(
        youngs_modulus=SI(modulus),
        poisson_ratio=poisson_ratio,
        fatigue_strength=SI(rule.strength * strength),
        fatigue_strength_exponent=rule.b,
        fatigue_ductility=rule.ductility * ductility,
        fatigue_ductility_exponent=rule.c,
        cyclic_strength=SI(rule.cyclic * strength),
        cyclic_hardening_exponent=rule.n,
        yield_strength=None if yield_strength is None else SI(_positive("yield_strength", yield_strength)),
        estimated=True,
        source=f"recalled: uniform material law of Baumel and Seeger (1990), {family}, Rm = {strength / 1e6:.6g} MPa",
    )


def _positive(name, value):
    stress = to_si(value, "pressure") if isinstance(value, str) else float(value)
    if not 0 < stress < math.inf:
        raise InputError(f'uniform_material_law: {name} must be above 0 and finite, got {value}; write e.g. "980 MPa".')
    return stress


def life_text(life: float, material: StrainLife) -> str:
    """A life as people may read it: "3.2e5", ">1e9 (extrapolated)" beyond the card's `longest_life`, "unlimited" without damage."""
    if math.isnan(life) or life < 0:
        raise InputError(f"life_text: a life is a number from 0 on, got {life}.")
    if life == math.inf:
        return "unlimited"
    return _short(life) if life <= material.longest_life else f">{_short(material.longest_life)} (extrapolated)"


def _short(number):
    return re.sub(r"e\+?(-?)0*", r"e\1", f"{number:.3g}")
