"""The digest knows what a spec means, not how it was said."""

import copy
import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st
from spec_cases import FULL, ToySpec, install

from drivewright.spec import document, from_document

pytestmark = pytest.mark.interface


@pytest.fixture
def tables(monkeypatch, tmp_path):
    install(monkeypatch, tmp_path)
    (tmp_path / "lift.csv").write_text("angle [deg],lift [mm]\n0,0\n1,1\n")
    tables = tomllib.loads(FULL)
    tables["table"] = str(tmp_path / "lift.csv")
    return tables


def digest(tables):
    return from_document(tables).digest()


def reversed_keys(value):
    if isinstance(value, dict):
        return {key: reversed_keys(value[key]) for key in reversed(value)}
    return [reversed_keys(v) for v in value] if isinstance(value, list) else value


def test_units_key_order_title_and_spelled_out_defaults_do_not_matter(tables):
    same = reversed_keys(tables) | {
        "length": "4 cm",
        "tilt": "-0.5235987755982989 rad",
        "title": "another",
        "units": "inch",
        "weights": [3],
    }
    same["drive"] = {"sense": "backward", "speed": "120 rpm"}
    same["optimise"]["unknowns"][0] |= {"lower": "0.01 mm", "upper": "100 um"}
    same["optimise"]["requirements"][0]["at_least"] = "1800 arcmin"
    assert digest(same) == digest(tables) == digest(document(from_document(tables)))


def test_minus_zero_is_zero_and_one_way_to_write_it():
    plus, minus = (ToySpec(length="1 mm", tilt=tilt, weights=[zero]) for tilt, zero in (("0 deg", 0.0), ("-0 deg", -0.0)))
    assert plus.digest() == minus.digest() and plus.digest() != ToySpec(length="1 mm", weights=[1e-300]).digest()


def leaves(value, path=()):
    if isinstance(value, (dict, list)):
        for key, inner in value.items() if isinstance(value, dict) else enumerate(value):
            yield from leaves(inner, (*path, key))
    else:
        yield path, value


def changed(value):
    swaps = {"forward": "backward", "backward": "forward", "minimise": "maximise", "auto": "nsga2"}
    if isinstance(value, bool):
        return not value
    if isinstance(value, str):
        number, _, unit = value.partition(" ")
        return swaps[value] if value in swaps else f"{float(number) * 1.0000001!r} {unit}" if unit else value + "x"
    return value + 1 if isinstance(value, int) else value * 1.0000001 or 1e-9


def test_every_key_but_the_title_changes_it(tables):
    full = document(from_document(tables))
    names = [(path, value) for path, value in leaves(full) if path not in (("title",), ("units",), ("format",), ("mechanism",), ("table",))]
    found = {digest(full)}
    for path, value in names:
        other = copy.deepcopy(full)
        place = other
        for step in path[:-1]:
            place = place[step]
        place[path[-1]] = changed(value)
        found.add(digest(other))
    assert len(names) > 25 and len(found) == len(names) + 1


def test_leaving_something_out_or_in_changes_it(tables):
    found = {digest(tables)} | {
        digest({k: v for k, v in tables.items() if k != name}) for name in ("spring", "points", "table", "joints", "optimise")
    }
    assert len(found) == 6
    other = copy.deepcopy(tables)
    other["joints"].reverse()
    assert digest(other) not in found


def test_data_files_count_by_content_not_by_name(tables, tmp_path):
    before, text = digest(tables), (tmp_path / "lift.csv").read_text()
    (tmp_path / "copy.csv").write_text(text)
    assert digest(tables | {"table": str(tmp_path / "copy.csv")}) == before
    (tmp_path / "copy.csv").write_text(text + "2,0\n")
    assert digest(tables | {"table": str(tmp_path / "copy.csv")}) != before


@given(st.decimals(min_value="0.001", max_value="1999", allow_nan=False, places=6))
def test_a_length_has_one_digest_in_every_unit(number):
    texts = (f"{number:f} mm", f"{number / 10:f} cm", f"{number.scaleb(-3):f} m", f"{number.scaleb(3):f} um")
    assert len({ToySpec(length=text).digest() for text in texts}) == 1


def test_the_digest_is_sha256_in_hexadecimal_and_the_same_on_every_machine():
    assert ToySpec(length="40 mm").digest() == "5e5483cbdac9902506635905c268ef1ba85f805d23767260c1ba8b802c812b4d"
