"""Messages to people: errors, findings, help texts, lines on the terminal, read off the sources and judged by the rules of this project.

A message names what its reader wrote or can write - keys, values, options, parameters of a public function - and nothing else of the
program.  Errors that only a programmer meets, with a traceback (`messages.OF_PROGRAMMERS`), are not judged.
"""

import ast
import re
from functools import cache

import pytest
from messages import HOLE, all_messages, messages_in
from places import SOURCE

pytestmark = pytest.mark.interface

PYTHON = re.compile(
    r"\b(None|True|False|NoneType|dict|ndarray|callable|kwargs?|tuples?|namedtuple|NamedTuple|str|bool|isinstance|lambda|docstring)\b"
)
UNITS = re.compile(rf"(?<=[\d{HOLE}]) ?(deg|degC|um|N m|kg m\^2|m\^[23]|mm\^[23]|m/s\^2|um/kN)(?![\w\]\"'])|\b[mc]?m\^[23]\b")
SNAKE = re.compile(r"(?<![\w./{<-])[a-z][a-z0-9]*(?:_[a-z0-9]+)+(?![\w/(]|\.toml)")
CAMEL = re.compile(r"\b[A-Z][a-z]+(?:[A-Z][a-z]+)+\b")
MODULES = re.compile(r"\bdrivewright(?:\.[a-z_]+)+\b")
PROPER = {"NumPy", "SciPy", "OpenCascade", "NiceGUI", "WebP", "LaTeX"}

# Words that engineers do not use in this sense, and what they would write.
PRIVATE = {
    r"mend\b": "fix, repair",
    r"told\b": "stated, given",
    r"said\b": "stated, given",
    r"who\b": "which",
    r"anew\b": "again",
    r"to speak of": "(leave it out)",
    r"lets? go": "loses contact",
    r"shuts? up": "",
    r"bare number": "a number without a unit",
    r"odd\b(?! (number|teeth|\w* ?links))": "unexpected",
    r"what nothing holds": "positions without a holding contact",
    r"what is wanted": "an objective",
    r"(?<!^)wants?\b": "needs, takes, must be",  # "KEY: wants a length, got '3 kg'" is the form of a value of the wrong kind
    r"are wanted": "are required",
    r"is wanted": "is required",
    r"off the (ratio|shaft)": "outside",
    r"less ideal": "minus ideal",
    r"greatest less least": "peak-to-peak",
    r"the others\b": "the other ...",
    r"beyond all numbers": "overflows",
    r"make no sense": "are inconsistent",
    r"has gone away": "has stopped",
    r"not a word": "",
    r"stands? still": "does not move",
    r"falls? back": "decreases",
    r"gave up": "failed",
    r"greatest": "maximum",
    r"(?<!at )(?<!')least\b(?! one)": "minimum, smallest",
    r"lessen": "reduce",
    r"(goes|gone|go) on\b(?! (a|the))": "continue",
    r"there twice": "occurs twice",
    r"mend(s|ed)?\b": "fix, repair",
    r"endures?\b": "withstand",
    r"drowns?\b": "is below the rounding error",
    r"if you mean it": "to confirm",
    r"in the place of": "instead of",
    r"whoever\b": "",
    r"what becomes": "",
    r"speaks?\b": "",
    r"tells?\b(?! .* from)": "shows, states",
    r"makes? up for": "compensates",
    r"swap the two\?": "exchange them if they were swapped",
}
VERBS = re.compile(
    r"\b(is|are|was|were|has|have|had|must|can|cannot|need(s|ed)?|takes?|gives?|give|does|do|did|wants|lies?|runs?|ends?|starts?|fails?|"
    r"leaves?|holds?|exceeds?|meets?|differs?|belongs?|applies|stops?|reaches|touch(es)?|overlaps?|begins?|write|choose|use|add|"
    r"determines?|supports?|makes?|contains?|shows?|returns?|misses|covers?|needs|resists?|would|may|comes?|requires?|goes|sums?|"
    r"works?|falls?|occurs?|varies|replaces?|connects|names?|divides|elongates|lets|turns?|cut|cuts|crosses|sets?|brings|knows?|lack(s)?|"
    r"sent|died|took|fits|fit|jumps|rises|swings|lowers|moves|states|means?|drives|loads?|contradict|clash|cross|encloses|"
    r"called|change|breaks|disagree|stopped|made|overflows|gave|correct|missing|shrink|rise|reach|opens?|open|print|write|copy|keep|keeps|install|remain(s)?|name|pass|start|close|find|finds|carries|carry|sorts?)\b",
    re.IGNORECASE,
)
BARE = re.compile(r"^\W*(bad|invalid|wrong|illegal|incorrect|error|failed|failure)( \w+)?\W*$", re.IGNORECASE)


@cache
def known_names() -> frozenset[str]:
    """What a reader may have written: parameters and fields of functions and classes, keys of specs, values, columns and options."""
    names: set[str] = set()
    for path in SOURCE.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.arg):
                names.add(node.arg)
            elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
                names.add(node.target.id)
            elif isinstance(node, ast.Constant) and isinstance(node.value, str) and re.fullmatch(r"[\w.]+", node.value):
                names.update(node.value.split("."))
    for path in SOURCE.rglob("*.pyi"):
        names.update(re.findall(r"\w+", path.read_text(encoding="utf-8")))
    return frozenset(names | public_names())


@cache
def public_names() -> frozenset[str]:
    """Names that a package offers in its `__all__` or in its table of lazy names."""
    names: set[str] = set()
    for path in SOURCE.rglob("__init__.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Assign | ast.AnnAssign) and node.value is not None:
                names.update(each.value for each in ast.walk(node.value) if isinstance(each, ast.Constant) and isinstance(each.value, str))
            elif isinstance(node, ast.alias):
                names.add(node.asname or node.name)
    return frozenset(word for name in names for word in re.split(r"\W+", name))


def faults(text: str, kind: str = "error") -> list[str]:
    """What is wrong with a message, in words."""
    plain = re.sub(r"`[^`]*`|\"[^\"]*\"|'[^']*'|\b\w+=(True|False)", HOLE, text)  # as a reader writes it
    plain = re.sub(r"^\w+: ", "", plain)  # the public function that was called
    found = [f"{word!r} is a word of Python" for word in PYTHON.findall(plain)]
    found += [f"the unit {match.group().strip()!r} is typed, not set" for match in UNITS.finditer(plain)]
    found += [f"{word!r} is no name that a reader knows" for word in SNAKE.findall(plain) if word not in known_names()]
    found += [f"{word!r} is a class of the program" for word in CAMEL.findall(plain) if word not in PROPER | public_names()]
    found += [f"{word!r} is a module" for word in MODULES.findall(plain)]
    found += [
        f"{match.group()!r}: write {better or 'something plain'}"
        for pattern, better in PRIVATE.items()
        for match in re.finditer(rf"\b{pattern}", plain, re.IGNORECASE)
    ]
    if kind == "error" and len(re.findall(r"[a-z]{2,}", text)) > 5 and not VERBS.search(text) and not text.endswith(f": {HOLE}"):
        found.append("has no verb")
    if BARE.match(text):
        found.append("says that something is wrong, and not what")
    return found


def test_messages_are_plain():
    bad = [f"{message}\n    {'; '.join(wrong)}" for message in all_messages() if (wrong := faults(message.text, message.kind))]
    assert not bad, f"{len(bad)} messages:\n" + "\n".join(bad)


def test_messages_are_found():
    kinds = [message.kind for message in all_messages()]
    assert kinds.count("error") > 900 and kinds.count("help") > 60 and kinds.count("finding") > 20 and "printed" in kinds


@pytest.mark.parametrize(
    "text",
    [
        "run: workers must be a whole number, or None",
        "the bore is 3 mm^2 too small; make it larger",
        f"the lever swings {HOLE} deg; reduce the rise",
        "the value of _inner_state is negative; give prime_radiuss",
        "build a SuperFollower instead",
        "mend the design",
        "a file wants its unit",
        "the greatest pressure is too high",
        "invalid value",
        "no contact between both bodies of this pair",
        "see drivewright.multibody.chart",
    ],
)
def test_what_is_not_plain_is_a_fault(text):
    assert faults(text)


@pytest.mark.parametrize(
    "text", ["wants a length, got '3 kg'", 'roller_radius = 5 mm must be smaller; at least 2 teeth are needed, e.g. "20 deg"', "is missing"]
)
def test_what_is_plain_is_none(text):
    assert faults(text) == []


def test_messages_are_read_wherever_they_stand():
    source = """
def _findings(run):
    yield f"{run} loses contact"
def refuse(x, out):
    out.findings.append("is slack")
    note("wrote it")
    option(help="folder to write")
    error = SpecError("is " + ("short" if x else "long") + f" by {x} mm")
    raise UnknownName("law", f"{'one of two' if x else 'three of them'}")
"""
    read = {(message.kind, message.text) for message in messages_in(source)}
    assert read == {
        ("finding", f"{HOLE} loses contact"),
        ("finding", "is slack"),
        ("printed", "wrote it"),
        ("help", "folder to write"),
        ("error", f"is short by {HOLE} mm"),
        ("error", f"is long by {HOLE} mm"),
        ("part", "law"),
    }
