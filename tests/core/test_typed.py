"""Typed at every door: public functions are annotated and described, fields say what they hold, kernels have a docstring.

`python tests/core/test_typed.py` prints the number of offences of every package, with names of packages after it their list.
"""

import ast
import sys
from collections import defaultdict

import pytest
from places import SOURCE

pytestmark = pytest.mark.interface

KERNELS = {"kernel", "inner", "outer"}
# Types that say nothing until they say of what.
BARE = {"tuple", "dict", "list", "set", "frozenset", "type", "Callable", "Mapping", "Sequence", "Iterable", "Iterator", "ndarray"}


def package_of(path):
    """The package or module below drivewright that a file belongs to; each kind of mechanism is one."""
    parts = path.relative_to(SOURCE).with_suffix("").parts
    return "/".join(parts[: 2 if parts[0] == "mechanisms" and len(parts) > 2 else 1])


FILES = defaultdict(list)
for _path in sorted(SOURCE.rglob("*.py")):
    FILES[package_of(_path)].append(_path)


def is_public(name):
    return not name.startswith("_")


def offences(package):
    """`file:line: what is missing` for every door of a package."""
    return [f"{path.relative_to(SOURCE)}:{line}: {text}" for path in FILES[package] for line, text in offences_of(path)]


def offences_of(path):
    """(line, text) for every door of a file; of a private one, of its kernels alone."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    public = all(is_public(part) or part.startswith("__") for part in path.relative_to(SOURCE).with_suffix("").parts)
    for function in ast.walk(tree):
        if isinstance(function, ast.FunctionDef) and decorators(function) & KERNELS and not ast.get_docstring(function):
            yield function.lineno, f"kernel {function.name} has no docstring"
    if public:
        yield from in_body(tree)


def in_body(node, prefix="", public=True):
    """The offences of a module or a class: of its public functions, and of the fields of all its classes."""
    for each in statements(node.body):
        if isinstance(each, ast.FunctionDef | ast.AsyncFunctionDef):
            if public and is_public(each.name):
                yield from ((each.lineno, f"{prefix}{each.name} {text}") for text in of_function(each, method=bool(prefix)))
        elif isinstance(each, ast.ClassDef):
            if is_plain_data(each):
                yield from of_fields(each, prefix)
            yield from in_body(each, f"{prefix}{each.name}.", public and is_public(each.name))


def statements(body):
    """The statements of a body, those under `if` and `try` included."""
    for each in body:
        if isinstance(each, ast.If | ast.Try):
            yield from statements([*each.body, *each.orelse, *getattr(each, "finalbody", ())])
        else:
            yield each


def decorators(node):
    """Last names of the decorators: "kernel", "dataclass", "overload"."""
    return {name_of(each.func if isinstance(each, ast.Call) else each) for each in node.decorator_list}


def name_of(node):
    return node.attr if isinstance(node, ast.Attribute) else getattr(node, "id", "")


def of_function(function, method):
    """What a public function lacks."""
    arguments = function.args
    named = [*arguments.posonlyargs, *arguments.args][1 if method and "staticmethod" not in decorators(function) else 0 :]
    extra = [each for each in (arguments.vararg, arguments.kwarg) if each]
    untyped = [each.arg for each in (*named, *arguments.kwonlyargs, *extra) if each.annotation is None]
    if untyped:
        yield f"has no type for {', '.join(untyped)}"
    if function.returns is None:
        yield "has no type for what it returns"
    if not ast.get_docstring(function) and "overload" not in decorators(function):
        yield "has no docstring"


def is_plain_data(node):
    return "dataclass" in decorators(node) or any(name_of(base) == "NamedTuple" for base in node.bases)


def of_fields(node, prefix):
    """Fields of a dataclass or a NamedTuple whose type says too little."""
    for each in node.body:
        if isinstance(each, ast.AnnAssign) and (bare := bare_type(each.annotation)):
            yield each.lineno, f"{prefix}{node.name}.{each.target.id} is a bare {bare}"


def bare_type(annotation):
    """The first type in an annotation that does not say of what, or Any for the whole of it; None where all is said."""
    if isinstance(annotation, ast.Constant) and isinstance(annotation.value, str):
        annotation = ast.parse(annotation.value, mode="eval").body
    if name_of(annotation) == "Any":
        return "Any"
    parametrised = {id(each.value) for each in ast.walk(annotation) if isinstance(each, ast.Subscript)}
    return next((name_of(each) for each in ast.walk(annotation) if name_of(each) in BARE and id(each) not in parametrised), None)


@pytest.mark.parametrize("package", sorted(FILES))
def test_every_door_of_a_package_is_typed(package):
    assert offences(package) == []


SAMPLE = '''
"""A module."""
if True:
    def bare(a, *rest, b: int, **more): pass
def whole(a: int, *, b: "tuple[int, ...]" = ()) -> None:
    """Is whole."""
    def nested(a): pass
def _private(a): pass
@kernel
def _undescribed(a): pass
class Data(NamedTuple):
    table: dict[str, Any]
    sides: "tuple | None"
    anything: Any
    law: Callable
    pairs: list[tuple]
    array: np.ndarray
    def area(self): pass
class _Hidden:
    def area(self): pass
class Keys(Spec):
    free: tuple
    @staticmethod
    def area(side) -> float:
        """Area."""
'''
EXPECTED = [
    "kernel _undescribed has no docstring",
    "bare has no type for a, rest, more",
    "bare has no type for what it returns",
    "bare has no docstring",
    "Data.sides is a bare tuple",
    "Data.anything is a bare Any",
    "Data.law is a bare Callable",
    "Data.pairs is a bare tuple",
    "Data.array is a bare ndarray",
    "Data.area has no type for what it returns",
    "Data.area has no docstring",
    "Keys.area has no type for side",
]


def test_the_test_sees_what_is_missing(tmp_path, monkeypatch):
    monkeypatch.setattr(sys.modules[__name__], "SOURCE", tmp_path)
    path = tmp_path / "module.py"
    path.write_text(SAMPLE)
    assert [text for _, text in offences_of(path)] == EXPECTED


if __name__ == "__main__":
    for _package in sys.argv[1:]:
        print("\n".join(offences(_package)))
    if not sys.argv[1:]:
        for _package in FILES:
            print(f"{len(offences(_package)):5d}  {_package}")
