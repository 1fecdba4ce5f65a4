"""Designations of rolling bearings as people write them: "6306", "6306-2RS1/C3", "7208 BEP", "SKF NU 207 ECP".

Makers add letters for seals, shields, cages, grease and precision, which change nothing here; the contact angle of an angular-contact
bearing and the clearance class are read, and what else stands there is kept as `unread`, so that a finding can name it.
"""

import difflib
import re
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from drivewright.bearings.boundary_dimensions import boundary_dimensions, known_series
from drivewright.bearings.inner_geometry import BearingType
from drivewright.errors import InputError, UnknownName

MAKERS = "SKF|FAG|INA|NSK|NTN|SNR|KOYO|NACHI|TIMKEN|NKE|FBJ|URB|ZKL"
FORMS: dict[BearingType, str] = {
    "cylindrical": r"(?P<ribs>NUP|NU|NJ|N)[ -]?(?P<series>10|2|3) ?(?P<code>\d\d)",
    "tapered": r"(?:HR[ -]?)?(?P<series>302|303|320|322) ?(?P<code>\d\d)",
    "deep-groove": r"(?P<series>618|619|160|60|62|63|64) ?(?P<code>\d\d)",
    "angular-contact": r"(?P<series>70|72|73) ?(?P<code>\d\d)",
}
ANGLES = {"A5": 25.0, "AC": 25.0, "A": 30.0, "B": 40.0, "C": 15.0, "E": 25.0}  # deg, by the suffix of angular-contact bearings
ANGLE_NAMES = {25.0: "AC", 30.0: "A", 40.0: "B", 15.0: "C"}
CLEARANCE = re.compile(r"C(?:[2-5](?!\d)|N\b)")
# Letters that change neither geometry nor ratings: seals and shields, snap ring, cage, precision; and of some types alone.
HARMLESS = r"2?RS[RHLD]?[12]?|2?RZ|2?Z|ZZE?|2?NSE?|LL[UBH]|DDU?|VV|NR?|TVP[23]?|TN[9H]|[PJMYFW]|PH|M[ABL]|J2|Q|P[456]A?|" + MAKERS
HARMLESS_OF: dict[str, str] = {"cylindrical": "EC?|ET", "angular-contact": "E|C[ABC]|D", "tapered": "X|A|R"}
REFUSED = (
    (r"(?:12|13|22|23)\d\d", "a self-aligning ball bearing: two rows of balls on a spherical raceway, which the model of one row does "
     "not have. Give its radial stiffness instead, and none against tilting"),
    (r"(?:32|33|52|53)\d\d", "a double-row angular-contact ball bearing. Take two of one row side by side, e.g. 7206B, mirrored"),
    (r"(?:42|43)\d\d", "a double-row deep-groove ball bearing. Take two of one row side by side, e.g. 6206"),
    (r"(?:213|222|223|230|231|232|240|241)\d\d", "a spherical roller bearing, whose two rows of barrels the model does not have. Give "
     "its radial stiffness instead, and none against tilting"),
    (r"(?:511|512|513|514|811|812|293|294)\d\d", "a thrust bearing, which carries no radial load. Give its stiffness along the axis"),
    (r"N(?:UP|U|J|N)?[ -]?(?:4|22|23|30)\d\d", "a cylindrical roller bearing of a series whose dimensions are not in the table. Give its "
     "inner geometry in a catalogue of your own, or its envelope and ratings"),
    (r"(?:313|323|329|330|331|332)\d\d", "a tapered roller bearing of a series whose dimensions are not in the table. Give its inner "
     "geometry in a catalogue of your own, or its envelope and ratings"),
)  # fmt: skip


class BasicDesignation(NamedTuple):
    """What a designation says: type and series ("62", "NU2", "302"), bore code ("06"), contact angle by suffix [deg] (0 where the type
    says it), clearance class ("C3", "" unless given), and the letters that were not read."""

    kind: BearingType
    series: str
    code: str
    angle: float = 0.0
    clearance: str = ""
    unread: str = ""

    @property
    def name(self) -> str:
        """The short name: "6306", "NU207E", "7208B", "30206"."""
        reinforced = "E" if self.kind == "cylindrical" and not self.series.endswith("10") else ""
        return f"{self.series}{self.code}{reinforced}{ANGLE_NAMES.get(self.angle, '')}"

    @property
    def dimension_series(self) -> str:
        """The series in the table of dimensions: that of cylindrical roller bearings without the letters."""
        return self.series.lstrip("NUJP")


class UnknownDesignation(UnknownName):
    """A bearing that neither a catalogue nor a designation of a known series names."""

    def __init__(self, name: str, known: Iterable[str], similar: Iterable[str]) -> None:
        first, *others = [*similar, ""]
        also = f" or {', '.join(others[:-1])}" if len(others) > 1 else ""
        hint = f" (did you mean {first!r}{also}?)" if first else ""
        InputError.__init__(self, f"no bearing is called {name!r}{hint}; known: {', '.join(sorted(known))}; by designation {series_text()}")


def series_text() -> str:
    """The known series in words."""
    texts = (f"{kind} {', '.join(series)}" for kind, series in known_series().items())
    return "; ".join(texts).replace("cylindrical ", "cylindrical NU, NJ, NUP, N ") + ", bores of 10 to 100 mm"


def parse_designation(text: str) -> BasicDesignation | None:
    """The `BasicDesignation` of a text; None where it is none of a known series and size.  InputError where the bearing is known and
    cannot be modelled, or its contact angle is not said."""
    plain = _plain(text)
    for kind, form in FORMS.items():
        found = re.match(rf"{form}(?!\d)", plain)
        if found and found["code"] in boundary_dimensions(kind, found["series"]):
            return _with_suffix(text, kind, found, plain[found.end() :])
    _refuse_known(text, plain)
    return None


def _plain(text):
    """In capitals, without a maker's name; 16 006 in one word, as the other series are."""
    return re.sub(rf"^(?:(?:{MAKERS})[ -]+)?(16 (?=0))?", lambda found: "16" if found[1] else "", " ".join(text.upper().split()))


def _with_suffix(text, kind, found, suffix):
    clearance = CLEARANCE.search(suffix)
    rest = suffix[: clearance.start()] + suffix[clearance.end() :] if clearance else suffix
    angle, rest = _angle(text, rest) if kind == "angular-contact" else (0.0, rest)
    if kind == "tapered" and re.match(r"[ -]*[BCD]", rest):
        raise InputError(
            f"bearing {text!r} is a tapered roller bearing of a steeper contact angle than {found['series']}{found['code']}, which the "
            'table does not have. Give its envelope with contact_angle, e.g. "20 deg", and its ratings'
        )
    series = found["ribs"] + found["series"] if kind == "cylindrical" else found["series"]
    letters = rf"(?:{HARMLESS}|{HARMLESS_OF.get(kind, HARMLESS)})+"
    unread = " ".join(part for part in re.split(r"[ ./-]+", rest) if part and not re.fullmatch(letters, part))
    return BasicDesignation(kind, series, found["code"], angle, clearance[0] if clearance else "", unread)


def _angle(text, suffix):
    found = re.match(rf"[ .-]*({'|'.join(ANGLES)})", suffix)
    if not found:
        raise InputError(
            f"bearing {text!r}: an angular-contact bearing needs the letters of its contact angle, which makers omit for different "
            "angles: C 15°, AC or E 25°, A 30°, B 40°, e.g. 7208B"
        )
    return ANGLES[found[1]], suffix[found.end() :]


def _refuse_known(text, plain):
    for form, reason in REFUSED:
        if re.match(rf"{form}(?!\d)", plain):
            raise InputError(f"bearing {text!r} is {reason}.")


def similar_designations(text: str, known: Iterable[str], most: int = 4) -> list[str]:
    """Up to `most` names like a text, the likest first: of its series those of the nearest bores, then by the letters."""
    plain = _plain(text)
    found = [name for kind, form in FORMS.items() for name in _same_series(kind, re.match(form, plain), plain)]
    pool = {name.upper(): name for name in (*known, *designations())}
    found += [pool[each] for each in difflib.get_close_matches(plain[:80], list(pool), n=most, cutoff=0.65)]
    return list(dict.fromkeys(found))[:most]


def _same_series(kind, found, plain):
    """The two known designations whose bores lie nearest."""
    if not found or plain[found.end() : found.end() + 1].isdigit():
        return []
    ribs = found["ribs"] if kind == "cylindrical" else ""
    codes = sorted(boundary_dimensions(kind, found["series"]), key=lambda code: (abs(int(code) - int(found["code"])), code))
    angle = 40.0 if kind == "angular-contact" else 0.0
    return [BasicDesignation(kind, ribs + found["series"], code, angle).name for code in codes[:2]]


def designations() -> Iterator[str]:
    """The short names of all bearings known by designation; of cylindrical ones the form NU, of angular-contact ones 15, 25 and 40 deg."""
    for kind, all_series in known_series().items():
        for series in all_series:
            for code in boundary_dimensions(kind, series):
                for angle in (15.0, 25.0, 40.0) if kind == "angular-contact" else (0.0,):
                    yield BasicDesignation(kind, f"NU{series}" if kind == "cylindrical" else series, code, angle).name
