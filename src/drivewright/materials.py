"""Material cards: elasticity, density and strength by standard designation, each number with its source.

Room temperature, SI units.  A source is `recalled` where the number was written from general knowledge and not read in the
work that it names; check such numbers before they carry a design.  Your own material is one more `Material(...)`.
"""

from dataclasses import dataclass, fields
from typing import NamedTuple

from drivewright.errors import InputError, UnknownName

__all__ = [
    "Material",
    "Properties",
    "Source",
    "Strength",
    "given_strength",
    "material",
    "names",
    "no_strength_reason",
    "properties",
    "strength",
]


@dataclass(frozen=True)
class Source:
    """Where numbers come from; recalled: named from memory, not read."""

    text: str
    recalled: bool


@dataclass(frozen=True)
class Material:
    """One material in one condition.

    modulus E [Pa], poisson nu [-], density [kg/m^3], yield_strength [Pa]: lower limit of 0.2 % proof or yield stress, of a
    case-hardened steel that of the core; hertz_limit [Pa]: peak Hertz pressure endured for rolling without end, None where no
    number can be supported.
    """

    name: str
    condition: str
    modulus: float
    poisson: float
    density: float
    yield_strength: float
    hertz_limit: float | None
    sources: tuple[tuple[str, Source], ...]

    def source(self, quantity: str) -> Source:
        """Source of one number, e.g. source("modulus")."""
        known = dict(self.sources)
        if quantity not in known:
            raise UnknownName(f"quantity of {self.name} with a source", quantity, known)
        return known[quantity]


def material(name: str) -> Material:
    """The card of this name; raises UnknownName, with the nearest name, where there is none."""
    if name not in _CARDS:
        raise UnknownName("material", name, _CARDS)
    return _CARDS[name]


class Properties(NamedTuple):
    """Numbers of a material as a calculation takes them: modulus E [Pa], poisson nu [-], density [kg/m^3], yield_strength [Pa] or None."""

    modulus: float
    poisson: float
    density: float
    yield_strength: float | None


STEEL = Properties(206e9, 0.3, 7850.0, None)  # where neither a number nor a card is given


def properties(
    card: str | None = None,
    modulus: float | None = None,
    poisson: float | None = None,
    density: float | None = None,
    yield_strength: float | None = None,
) -> Properties:
    """The `Properties` that are given, the others those of a card by its name, without a card those of steel."""
    usual: Material | Properties = material(card) if card else STEEL
    given = {"modulus": modulus, "poisson": poisson, "density": density, "yield_strength": yield_strength}
    return Properties(**{key: getattr(usual, key) if value is None else value for key, value in given.items()})


def names() -> list[str]:
    """Names of all cards."""
    return sorted(_CARDS)


class Strength(NamedTuple):
    """Least tensile strength Rm and yield strength Re or Rp0.2 [Pa] of a bar of some diameter, with their source."""

    tensile: float
    yield_strength: float
    source: Source


def strength(card: str, diameter: float) -> Strength:
    """The `Strength` of a card for a bar of this diameter [m]: thicker bars are weaker.

    Raises UnknownName without such a card, InputError where the card has no tensile strength or the bar is thicker than specified.
    """
    reason = _no_tensile_strength(material(card).name, diameter)
    if reason:
        raise InputError(f"{reason}; give tensile_strength and yield_strength")
    steps, source = _STRENGTHS[card]
    tensile, yield_strength = next((tensile, limit) for largest, limit, tensile in steps if diameter <= largest * (1 + 1e-9))
    return Strength(tensile, yield_strength, source)


def no_strength_reason(card: str | None, diameter: float, tensile_strength: float | None, yield_strength: float | None) -> str | None:
    """Why a bar of this diameter [m] has no `given_strength`; None where it has."""
    if tensile_strength is None:
        return _no_tensile_strength(card, diameter) if card else "neither a material card nor a tensile strength is given"
    has_yield = yield_strength is not None or card is not None
    return None if has_yield else "a tensile strength is given, but neither a material card nor a yield strength"


def given_strength(card: str | None, diameter: float, tensile_strength: float | None, yield_strength: float | None) -> Strength:
    """The strengths [Pa] that are given, the others those of a card for a bar of this diameter [m].

    Raises InputError where `no_strength_reason` has one.
    """
    reason = no_strength_reason(card, diameter, tensile_strength, yield_strength)
    if reason:
        raise InputError(f"{reason}; give tensile_strength and yield_strength")
    if tensile_strength is None:
        usual = strength(str(card), diameter)
        return usual if yield_strength is None else usual._replace(yield_strength=yield_strength)
    if yield_strength is None:
        return Strength(tensile_strength, material(str(card)).yield_strength, material(str(card)).source("yield_strength"))
    return Strength(tensile_strength, yield_strength, Source("given by the design", recalled=False))


def _no_tensile_strength(card, diameter):
    if card not in _STRENGTHS:
        return f"the card of {material(card).name} has no tensile strength"
    largest = _STRENGTHS[card][0][-1][0]
    if diameter <= largest * (1 + 1e-9):
        return None
    return f"{card}, {material(card).condition}: specified up to {largest * 1e3:g} mm, the shaft has {diameter * 1e3:.4g} mm"


_QUANTITIES = tuple(field.name for field in fields(Material) if field.name not in ("name", "condition", "sources"))


def _card(name, condition, *values):
    """A card from (number, source) pairs in the order of the fields; a lone None is a number that is not given."""
    numbers = {quantity: value and value[0] for quantity, value in zip(_QUANTITIES, values, strict=True)}
    sources = tuple((quantity, value[1]) for quantity, value in zip(_QUANTITIES, values, strict=True) if value)
    return Material(name, condition, **numbers, sources=sources)


def _recalled(text):
    return Source(f"recalled: {text}", recalled=True)


_STEEL = _recalled("usual design values of structural and engineering steels")
_E_STEEL, _NU_STEEL, _RHO_STEEL = (210e9, _STEEL), (0.3, _STEEL), (7850.0, _STEEL)
_SAARSTAHL = Source("Saarstahl, specification sheets of C45E and 42CrMo4 (after EN 10083), minimum for this diameter", recalled=False)
_SHEETS = Source("Saarstahl, specification sheets of C35, C45 and 42CrMo4 (after EN 10083), minimum for this diameter", recalled=False)
_READLE = Source("readle.co.uk, Steel grades to Eurocodes: EN 10025-2, table 7, minimum for this thickness", recalled=False)
_LUCEFIN = Source("Lucefin Group, technical card 16MnCr5, rev. 2018: test blank of 30 mm, core hardened, for reference", recalled=False)
_ZARETSKY = Source(
    "E. V. Zaretsky, In search of a fatigue limit: a critique of ISO 281:2007, Tribology & Lubrication Technology 2010, quoting "
    "ISO 281 for 52100 steel in clean mineral oil; the author himself doubts that there is a limit",
    recalled=False,
)
_DUCTILE = Source("sn-castiron.nl, Cast iron (EN-GJS), table after DIN EN 1563", recalled=False)
_ACETAL = Source("apacinfrastructure.com.au, Material specifications, acetal unreinforced; creeps and softens with heat", recalled=False)
_EN_10083_3 = _recalled("EN 10083-3, minimum for this diameter")
_EN_10025 = _recalled("EN 10025-2, minimum up to 16 mm")
_EN_10025_ALL = _recalled("EN 10025-2, minimum for this thickness")
_EN_10088 = _recalled("EN 10088-3, minimum of bars")
_EN_1561 = _recalled("EN 1561, informative values; 0.1 % proof stress")
_EN_1982 = _recalled("EN 1982, sand cast; handbooks of copper alloys")
_EN_755 = _recalled("EN 755-2, extruded bars; handbooks of aluminium alloys")
_ISO_6336 = _recalled("ISO 6336-5, contact stress number of case-hardened gear flanks, quality MQ")
_BEARING = _recalled("handbooks of rolling bearings; lower end of the values given for the hardened state")
_IRON = _recalled("handbooks of cast iron")

_CARDS = {
    card.name: card
    for card in (
        _card("S355J2", "hot rolled, up to 16 mm", _E_STEEL, _NU_STEEL, _RHO_STEEL, (355e6, _EN_10025), None),
        _card("E295", "hot rolled, up to 16 mm", _E_STEEL, _NU_STEEL, _RHO_STEEL, (295e6, _EN_10025), None),
        _card("E335", "hot rolled, up to 16 mm", _E_STEEL, _NU_STEEL, _RHO_STEEL, (335e6, _EN_10025), None),
        _card("C35", "quenched and tempered, 16 to 40 mm", _E_STEEL, _NU_STEEL, _RHO_STEEL, (380e6, _SHEETS), None),
        _card("C45+N", "normalised, 16 to 100 mm", _E_STEEL, _NU_STEEL, _RHO_STEEL, (305e6, _SHEETS), None),
        _card("C45", "quenched and tempered, 16 to 40 mm", _E_STEEL, _NU_STEEL, _RHO_STEEL, (430e6, _SAARSTAHL), None),
        _card("42CrMo4", "quenched and tempered, 40 to 100 mm", _E_STEEL, _NU_STEEL, _RHO_STEEL, (650e6, _SAARSTAHL), None),
        _card("34CrNiMo6", "quenched and tempered, 40 to 100 mm", _E_STEEL, _NU_STEEL, _RHO_STEEL, (800e6, _EN_10083_3), None),
        _card("16MnCr5", "case hardened, core of 30 mm", _E_STEEL, _NU_STEEL, _RHO_STEEL, (490e6, _LUCEFIN), (1500e6, _ISO_6336)),
        _card("100Cr6", "hardened, 58 to 62 HRC", _E_STEEL, _NU_STEEL, (7810.0, _BEARING), (1700e6, _BEARING), (1500e6, _ZARETSKY)),
        _card("X5CrNi18-10", "solution annealed", (200e9, _EN_10088), (0.3, _STEEL), (7900.0, _EN_10088), (190e6, _EN_10088), None),
        _card("EN-GJL-250", "as cast", (110e9, _EN_1561), (0.26, _EN_1561), (7200.0, _EN_1561), (165e6, _EN_1561), None),
        _card("EN-GJS-600-3", "as cast", (175e9, _DUCTILE), (0.28, _DUCTILE), (7200.0, _IRON), (370e6, _DUCTILE), None),
        _card("CuSn12-C", "sand cast", (95e9, _EN_1982), (0.34, _EN_1982), (8600.0, _EN_1982), (140e6, _EN_1982), None),
        _card("EN AW-6082", "T6, extruded", (70e9, _EN_755), (0.33, _EN_755), (2700.0, _EN_755), (250e6, _EN_755), None),
        _card("POM", "unreinforced, 23 degC, short load", (2.82e9, _ACETAL), (0.363, _ACETAL), (1410.0, _ACETAL), (59.3e6, _ACETAL), None),
    )
}


def _steps(source, *rows):
    """((largest diameter [m], yield strength [Pa], tensile strength [Pa]), ...) from mm and MPa, with their source."""
    return tuple((largest * 1e-3, limit * 1e6, tensile * 1e6) for largest, limit, tensile in rows), source


# Minima by diameter; the yield strength of a card is the one of its condition.
_STRENGTHS = {
    "S355J2": _steps(_READLE, (16, 355, 470), (40, 345, 470), (63, 335, 470), (80, 325, 470), (100, 315, 470), (150, 295, 450)),
    "E295": _steps(_EN_10025_ALL, (16, 295, 470), (40, 285, 470), (63, 275, 470), (80, 265, 470), (100, 255, 470), (150, 245, 450)),
    "E335": _steps(_EN_10025_ALL, (16, 335, 570), (40, 325, 570), (63, 315, 570), (80, 305, 570), (100, 295, 570), (150, 275, 550)),
    "C35": _steps(_SHEETS, (16, 430, 630), (40, 380, 600), (100, 320, 550)),
    "C45": _steps(_SHEETS, (16, 490, 700), (40, 430, 650), (100, 370, 630)),
    "C45+N": _steps(_SHEETS, (16, 340, 620), (100, 305, 580), (250, 275, 560)),
    "42CrMo4": _steps(_SHEETS, (16, 900, 1100), (40, 750, 1000), (100, 650, 900), (160, 550, 800), (250, 500, 750)),
    "34CrNiMo6": _steps(_EN_10083_3, (16, 1000, 1200), (40, 900, 1100), (100, 800, 1000), (160, 700, 900), (250, 600, 800)),
    "16MnCr5": _steps(_LUCEFIN, (11, 735, 1030), (30, 490, 740), (63, 440, 640)),
}
