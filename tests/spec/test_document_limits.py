"""How much the text of a spec may hold: refused before it is parsed, at once and in little memory, and far from what people write."""

import os
import resource
import subprocess
import sys
import time
import tomllib

import pytest
from places import EXAMPLES, ROOT

from drivewright import registry
from drivewright.errors import SpecError
from drivewright.spec import change_key, load, parse_document, read_value
from drivewright.spec.document_limits import MAX_CHARACTERS, MAX_DEPTH, MAX_ITEMS, MAX_TABLES, refuse_oversized

pytestmark = pytest.mark.error

LARGE = 900_000  # characters, less than the limit
PATHS = [*EXAMPLES.rglob("*.toml"), *(path for kind in registry.kinds() for path in registry.mechanism(kind).presets().values())]


def repeated(text):
    return text * (LARGE // len(text))


PARSED = {  # what stays within the limits is parsed in little time, whatever it is made of
    "dots in a text": f'a = "{"." * LARGE}"',
    "dots in a comment": "#" + "." * LARGE,
    "escapes": f'a = "{repeated(chr(92) + "n")}"',
    "lines": f'a = """{repeated("x." + chr(10))}"""',
    "quotes inside lines": f'a = """{repeated(chr(34) * 2 + "x")}"""',
    "a literal": f"a = '{'.' * LARGE}'",
    "brackets in a literal": f"a = '{'[' * LARGE}'",
    "brackets in a text": f'a = "{"[" * LARGE}"',
    "brackets in a comment": "#" + "[" * LARGE,
    "literal lines": f"a = '''{repeated(chr(39) * 2 + '.' + chr(10))}'''",
    "comments": repeated("#\n"),
    "end of lines": "\n" * LARGE,
    "Windows' end of lines": repeated("\r\n"),
    "blanks": " " * LARGE,
    "a long key": f"{'a' * LARGE} = 1",
    "keys": "".join(f"k{n} = 1\n" for n in range(MAX_ITEMS - 1)),
    "keys of many parts": "".join(f"k{n}{'.a' * (MAX_DEPTH - 2)} = 1\n" for n in range(MAX_ITEMS // MAX_DEPTH)),
    "keys under a deep header": f"[{'a.' * (MAX_DEPTH - 3)}a]\n" + "".join(f"k{n} = 1\n" for n in range(MAX_ITEMS - MAX_DEPTH)),
    "headers": "".join(f"[k{n}.a.a.a.a]\n" for n in range(MAX_TABLES - 1)),
    "tables of a list": "[[a]]\n" * MAX_TABLES,
    "numbers": f"a = [{'1.5, ' * (MAX_ITEMS - 2)}]",
    "lists of lists": f"a = [{'[], ' * (MAX_ITEMS // 2 - 2)}]",
    "lists in lists": f"a = {'[' * (MAX_DEPTH - 1)}{']' * (MAX_DEPTH - 1)}",
    "tables in tables": f"a = {'{a = ' * (MAX_DEPTH - 1)}1{'}' * (MAX_DEPTH - 1)}",
    "a number in hexadecimal": f"a = 0x{'f' * LARGE}",
}
NOT_TOML = {
    "a text without its end": f'a = "{"." * LARGE}',
    "lines without their end": f'a = """{repeated("x" + chr(10))}',
    "lines whose quotes are escaped": f'a = """{repeated(chr(92) + chr(34) * 2)}',
    "backslashes": f'a = "{chr(92) * LARGE}',
    "short texts": repeated('"" '),
    "quotes": '"' * LARGE,
    "apostrophes": "'" * LARGE,
    "equals signs": "=" * LARGE,
    "a long number": f"a = {'1' * LARGE}",
    "NUL": "\0" * LARGE,
}
DOTTED = "a." * 20_000 + "a"
OVERSIZED = {
    "a dotted key": (f"\n{DOTTED} = 1", "line 2: nested too deeply"),
    "a longer one": (f"{DOTTED}.{DOTTED}.{DOTTED}.{DOTTED}.{DOTTED} = 1", "line 1: nested too deeply"),
    "a dotted key without a value": (DOTTED, "line 1: nested too deeply"),
    "in quotes": ('"a.b". ' * 20_000 + "a = 1", "line 1: nested too deeply"),
    "with blanks": ("a . " * 20_000 + "a = 1", "line 1: nested too deeply"),
    "of a table in braces": (f"b = 1\na = {{ b = 1.5, {DOTTED} = 1 }}", "line 2: nested too deeply"),
    "of a header": (f"[{DOTTED}]", "line 1: nested too deeply"),
    "of a header of a list": (f"[[{DOTTED}]]", "line 1: nested too deeply"),
    "half in the header": (f"[{'a.' * (MAX_DEPTH // 2)}a]\n{'a.' * (MAX_DEPTH // 2)}a = 1", "line 2: nested too deeply"),
    "after a comment": (f"# [ \" ''' {{\n{DOTTED} = 1", "line 2: nested too deeply"),
    "after texts": (f'a = "#"\nb = """\n" "" \\""" [\n"""""\nc = \'[{{\'\n{DOTTED} = 1', "line 6: nested too deeply"),
    "lists": (f"a = {'[' * 5000}", "line 1: nested too deeply"),
    "lists, closed": (f"a = [1,\n{'[' * 5000}{']' * 5000}]", "line 2: nested too deeply"),
    "tables": (f"a = {'{a = ' * 5000}", "line 1: nested too deeply"),
    "keys": ("a = 1\n" * 50_000, f"line {MAX_ITEMS + 1}: more than {MAX_ITEMS} values"),
    "entries": (f"a = [{'1,' * 50_000}]", f"line 1: more than {MAX_ITEMS} values"),
    "empty lists": (f"a = [{'[],' * 20_000}]", f"line 1: more than {MAX_ITEMS} values"),
    "lists around nothing": (
        "".join(f"k{n} = {'[' * 99}{']' * 99}\n" for n in range(300)),
        f"line {MAX_ITEMS // 100 + 1}: more than {MAX_ITEMS} values",
    ),
    "parts of keys": ("a.a.a.a.a = 1\n" * 20_000, f"line {MAX_ITEMS // 5 + 1}: more than {MAX_ITEMS} values"),
    "headers": ("[a]\n" * 5_000, f"line {MAX_TABLES + 1}: more than {MAX_TABLES} headers"),
    "lists of tables": ("[[a.b]]\nx = 1\n" * 5_000, f"line {2 * MAX_TABLES + 1}: more than {MAX_TABLES} headers"),
    "characters": ("#" * (MAX_CHARACTERS + 1), f"has more than {MAX_CHARACTERS} characters"),
}


@pytest.mark.parametrize("text", PARSED.values(), ids=PARSED)
def test_a_large_text_within_the_limits_is_parsed_at_once(text):
    started = time.process_time()
    assert parse_document(text) == tomllib.loads(text) and time.process_time() - started < 4.0  # twice, on any machine


@pytest.mark.parametrize("text", NOT_TOML.values(), ids=NOT_TOML)
def test_a_large_text_that_is_no_toml_is_refused_at_once(text):
    started = time.process_time()
    with pytest.raises(SpecError, match="is not valid TOML") as caught:
        parse_document(text)
    assert time.process_time() - started < 2.0 and len(str(caught.value)) < 300


@pytest.mark.parametrize(("text", "words"), OVERSIZED.values(), ids=OVERSIZED)
def test_what_is_more_than_a_spec_may_hold_is_refused_at_once_with_its_line(text, words):
    started = time.process_time()
    with pytest.raises(SpecError) as caught:
        parse_document(text)
    assert caught.value.message.startswith(words) and time.process_time() - started < 1.0 and "data file" in str(caught.value)


def test_the_key_that_is_nested_too_deeply_is_named_by_its_beginning():
    for text in (f"a = 1\n programme.{DOTTED} = 1", f"[programme.{DOTTED}]", f"programme.x = {'[' * 500}"):
        with pytest.raises(SpecError) as caught:
            parse_document(text)
        assert caught.value.key.startswith("programme.") and len(caught.value.key) <= 40


@pytest.mark.parametrize(
    "text",
    [
        'a = "a.b.c"\n' * 500,
        "a = 1.5\n" * 500,
        "a = [1.5, 2.5, 'x.y', 1979-05-27T07:32:00.999Z]\n" * 200,
        "a = '''" + "x.y\n" * 500 + "'''",
        "# a.b.c.d\n" * 500,
        "[a.b]\nc.d = 1\n" * 500,
        "a = {b.c = {d = 1.5}, e = 2.5}\n" * 500,
    ],
)
def test_dots_of_texts_comments_and_numbers_are_no_parts_of_a_key(text):
    refuse_oversized(text)


def entries(value):
    """How many values and tables there are below a value, with itself."""
    inside = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return 1 + sum(map(entries, inside))


@pytest.mark.parametrize("path", PATHS, ids=[path.name for path in PATHS])
def test_what_people_write_is_twenty_times_smaller(path):
    text = path.read_text(encoding="utf-8")
    headers = sum(line.startswith("[") for line in text.splitlines())
    assert (20 * len(text), 20 * entries(tomllib.loads(text)), 20 * headers) < (MAX_CHARACTERS, MAX_ITEMS, MAX_TABLES)


@pytest.mark.parametrize("text", [f"1\n{DOTTED} = 1", "[" * 5000, f"[{'1,' * 50_000}]", "...." * 100, "see 1.2.3.4" * 100])
def test_a_value_of_the_command_line_that_is_too_large_to_be_parsed_is_text(text):
    started = time.process_time()
    assert read_value(text) == text and time.process_time() - started < 1.0


def test_a_key_of_the_command_line_has_the_same_limits():
    with pytest.raises(SpecError, match="nested too deeply") as caught:
        change_key({}, f"{DOTTED}=1")
    assert len(str(caught.value)) < 400


def test_the_longest_key_of_the_command_line():
    tables = {}
    change_key(tables, f"{'a.' * (MAX_DEPTH - 1)}a=1")
    assert tables["a"]["a"]["a"]
    with pytest.raises(SpecError, match=f"has {MAX_DEPTH + 1} parts, nested too deeply; a key has at most {MAX_DEPTH}"):
        change_key({}, f"{'a.' * MAX_DEPTH}a=1")


def test_the_limits_are_those_of_the_conventions():
    said = f"{MAX_CHARACTERS:,} characters; {MAX_ITEMS:,} values and parts of keys; {MAX_TABLES:,} headers; {MAX_DEPTH} levels"
    assert said in (ROOT / "docs" / "conventions.md").read_text(encoding="utf-8")


def test_a_named_pipe_is_refused_and_that_of_a_command_is_read(tmp_path):
    os.mkfifo(tmp_path / "spec.toml")
    with pytest.raises(SpecError, match=r"spec.toml: is a named pipe; a spec is a TOML file$"):
        load(tmp_path / "spec.toml")
    reading, writing = os.pipe()
    os.write(writing, b'mechanism = "nothing"\n')
    os.close(writing)
    with pytest.raises(SpecError, match="no mechanism is called 'nothing'"):
        load(f"/dev/fd/{reading}")
    os.close(reading)


@pytest.mark.parametrize("tail", ["", "\n" + "#" * 10_000_000], ids=["alone", "in 10 MB"])
def test_the_command_line_refuses_a_long_key_in_little_time_and_memory(tmp_path, tail):
    (tmp_path / "spec.toml").write_text(f"{DOTTED} = 1{tail}", encoding="utf-8")
    limit = 500 * 2**20
    started = time.perf_counter()
    done = subprocess.run(
        [sys.executable, "-m", "drivewright", "run", "spec.toml"],
        cwd=tmp_path,
        env=os.environ | {"OPENBLAS_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_DATA, (limit, limit)),
        timeout=60,
    )
    assert done.returncode == 2 and done.stdout == "" and time.perf_counter() - started < 10.0
    assert done.stderr.startswith("drivewright: spec.toml: ") and done.stderr.count("\n") == 1
