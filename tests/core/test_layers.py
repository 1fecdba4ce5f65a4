"""Who may import whom: downwards, and within a row to the right.  Reads every import, relative and local ones too."""

import ast

import pytest
from places import SOURCE

pytestmark = pytest.mark.interface

ROWS = [
    "__main__ cli studio",
    "reproduction validation studies notebook report view execution",
    "oracles mechanisms",
    "indexing chains cams gears multibody shafts bearings solids fatigue",
    "motion curves contact materials",
    "numerics",
    "testing runner spec registry claims result advice frames surface_fields dimensions construction motion_diagram scene cases",
    "units digits labels plugins _jit _typing errors stops steps atomic _garbage",
]
PLACE = {name: (row, column) for row, names in enumerate(ROWS) for column, name in enumerate(names.split())}
# runner reads the version for the provenance; __init__ has lazy names.
VERSION_READERS = {"result.py", "runner.py", "cli/app.py", "cli/doctor.py"}


def files():
    return sorted(SOURCE.rglob("*.py"))


def room(path):
    parts = path.relative_to(SOURCE).with_suffix("").parts
    return parts[0]


def imported(path):
    """Dotted names below drivewright that a file imports."""
    package = ("drivewright", *path.relative_to(SOURCE).with_suffix("").parts)
    package = package[:-1] if package[-1] != "__init__" else package[:-1]
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name.split(".")[0] == "drivewright")
        elif isinstance(node, ast.ImportFrom):
            base = ".".join(package[: len(package) - node.level + 1]) if node.level else ""
            module = ".".join(part for part in (base, node.module or "") if part)
            if module.split(".")[0] == "drivewright":
                yield from (f"{module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Call) and getattr(node.func, "attr", getattr(node.func, "id", "")) in ("import_module", "__import__"):
            yield from (a.value for a in node.args if isinstance(a, ast.Constant) and str(a.value).startswith("drivewright"))


def offence(path, name):
    """Why this import is not allowed, or None."""
    target = name.split(".")[1] if "." in name else ""
    here = room(path)
    if here == "__init__" or target == here:
        return None if here not in ("mechanisms", "oracles") else sibling(path, name)
    if target == "__version__" or target == "":
        return None if str(path.relative_to(SOURCE)) in VERSION_READERS else "imports the package itself"
    if target not in PLACE:
        return f"{target!r} has no place in the layers"
    if here == "oracles" and target == "mechanisms":
        return sibling(path, name)
    (row, column), (to_row, to_column) = PLACE[here], PLACE[target]
    if to_row > row or (to_row == row and to_column > column):
        return None
    return f"{here} may not import {target}"


def sibling(path, name):
    kind = path.relative_to(SOURCE).parts[1]
    other = name.split(".")[2] if len(name.split(".")) > 2 else kind
    return None if other in (kind, kind.removesuffix(".py"), "") else f"kinds may not import one another: {kind} -> {other}"


def test_every_room_has_a_place():
    assert {room(path) for path in files()} <= {*PLACE, "__init__"}


@pytest.mark.parametrize("path", files(), ids=lambda p: str(p.relative_to(SOURCE)))
def test_imports_go_downwards(path):
    assert [f"{name}: {why}" for name in imported(path) if (why := offence(path, name))] == []


def test_the_rule_can_fail(tmp_path):
    assert offence(SOURCE / "numerics" / "x.py", "drivewright.motion.laws")
    assert offence(SOURCE / "mechanisms" / "cam" / "x.py", "drivewright.mechanisms.seedling_pusher.spec")
    assert offence(SOURCE / "report" / "x.py", "drivewright.studies.optimisation")
    assert offence(SOURCE / "execution" / "x.py", "drivewright.studies.plan")
    assert offence(SOURCE / "oracles" / "cam" / "x.py", "drivewright.mechanisms.seedling_pusher.spec")
    assert offence(SOURCE / "oracles" / "cam" / "x.py", "drivewright.mechanisms.cam.spec") is None
    assert offence(SOURCE / "mechanisms" / "cam" / "x.py", "drivewright.oracles.cam")
    assert offence(SOURCE / "studies" / "x.py", "drivewright.report.html") is None


def test_only_the_jit_room_imports_numba():
    for path in files():
        names = {
            n.split(".")[0]
            for node in ast.walk(ast.parse(path.read_text()))
            if isinstance(node, (ast.Import, ast.ImportFrom))
            for n in ([a.name for a in node.names] if isinstance(node, ast.Import) else [node.module or ""])
        }
        assert "numba" not in names or path.parent == SOURCE / "_jit", path


@pytest.mark.parametrize(
    "path",
    [p for p in files() if room(p) in ("cli", "studio", "studies", "report", "view", "execution")],
    ids=lambda p: str(p.relative_to(SOURCE)),
)
def test_the_house_knows_no_kind_by_name(path):
    from drivewright import registry

    tree = ast.parse(path.read_text())
    strings = {n.value for n in ast.walk(tree) if isinstance(n, ast.Constant) and isinstance(n.value, str)}
    assert not strings & set(registry.kinds())
    assert not [name for name in imported(path) if name.startswith("drivewright.mechanisms")]
