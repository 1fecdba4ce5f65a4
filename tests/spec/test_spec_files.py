"""Spec files: what is read, what is refused and how it is said, and the effective spec that is written back."""

import tomllib

import pytest
from spec_cases import FULL, ToySpec, install

import drivewright as dw
from drivewright.errors import SpecError
from drivewright.mechanisms.cam.spec import CamSpec
from drivewright.spec import document, from_document, load

pytestmark = pytest.mark.interface


@pytest.fixture
def folder(monkeypatch, tmp_path):
    install(monkeypatch, tmp_path)
    (tmp_path / "lift.csv").write_text("angle [deg],lift [mm]\n0,0\n1,1\n")
    return tmp_path


def written(folder, content):
    path = folder / "spec.toml"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


def complaint(folder, content, changes=()):
    """(message without the file, key) of a spec that is refused."""
    path = written(folder, content)
    with pytest.raises(SpecError) as caught:
        load(path, changes)
    assert caught.value.file == str(path) and str(caught.value).startswith(f"{path}: ")
    return str(caught.value).removeprefix(f"{path}: "), caught.value.key


def test_every_kind_of_key_is_read(folder):
    spec = load(written(folder, FULL))
    assert (spec.length, spec.turns, spec.ratio, spec.mirrored, spec.weights) == (0.04, 4, 0.25, True, (3.0,))
    assert spec.tilt == pytest.approx(-0.5235987755982988, rel=1e-15) and spec.drive.speed == pytest.approx(12.566370614359172, rel=1e-15)
    assert spec.points == ((0.0, 0.5), (1.0, 0.25)) and spec.table == folder / "lift.csv" and spec.second is None
    assert spec.spring.rate == 7.0 and spec.spring.preload == 1.5
    assert [joint.name for joint in spec.joints] == ["crank", "rocker"] and spec.joints[0].at == (0.001, -0.002)
    assert spec.joints[1].clearance == pytest.approx(1e-4, rel=1e-15) and spec.optimise.settings[0].value == 2


def test_a_byte_order_mark_and_any_line_ends_are_fine(folder):
    plain = load(written(folder, FULL))
    assert load(written(folder, b"\xef\xbb\xbf" + FULL.encode())) == plain == load(written(folder, FULL.replace("\n", "\r\n")))


def test_dw_load_is_the_same_function(folder):
    assert dw.load(written(folder, FULL)) == load(folder / "spec.toml")


# -- round trips ---------------------------------------------------------------------------------------------------------------


def test_the_effective_spec_reads_back_equal_with_every_default_in_it(folder):
    spec = load(written(folder, FULL))
    tables = tomllib.loads(spec.to_toml())
    assert from_document(tables, folder="/nowhere") == spec and tables == document(spec)
    assert tables["spring"] == {"rate": 7.0, "preload": 1.5} and tables["joints"][1]["clearance"] == "0.1 mm"
    assert list(tables)[-1] == "optimise" and "second" not in tables


@pytest.mark.parametrize("title", ['say "hi"', "back\\slash", "line\nbreak", "tab\tbell\x07 del\x7f", "螺旋 é", "'''", ""])
def test_any_title_survives(title):
    spec = ToySpec(length="1 mm", title=title)
    assert from_document(tomllib.loads(spec.to_toml()), ToySpec) == spec


def test_an_empty_list_in_place_of_a_default_survives():
    spec = ToySpec(length="1 mm", weights=())
    assert from_document(tomllib.loads(spec.to_toml()), ToySpec).weights == ()


def test_the_written_spec_moves_to_another_machine_with_its_data(folder):
    (folder / "other").mkdir()
    (folder / "other" / "lift.csv").write_text("angle [deg],lift [mm]\n0,0\n5,5\n")
    spec = load(written(folder, FULL.replace("[drive]", 'second = "other/lift.csv"\n[drive]')))
    (folder / "run").mkdir()
    spec.write(folder / "run" / "spec.toml")
    for name in ("lift.csv", "other/lift.csv"):
        (folder / name).unlink()
    (folder / "run").rename(folder / "moved")
    moved = load(folder / "moved" / "spec.toml")
    assert moved.table.parent == moved.second.parent == folder / "moved" / "data" and moved.table != moved.second
    assert moved.table.read_text().endswith("1,1\n") and moved.second.read_text().endswith("5,5\n")
    assert document(moved) | {"table": 0, "second": 0} == document(spec) | {"table": 0, "second": 0}


def test_a_spec_is_written_over_itself(folder):
    load(written(folder, FULL)).write(folder / "spec.toml")
    again = load(folder / "spec.toml")
    again.write(folder / "spec.toml")
    assert load(folder / "spec.toml") == again and [path.name for path in (folder / "data").iterdir()] == ["lift.csv"]


def test_a_spec_without_data_is_written_alone(tmp_path):
    spec = ToySpec(length="1 mm")
    spec.write(tmp_path / "spec.toml")
    assert [path.name for path in tmp_path.iterdir()] == ["spec.toml"] and (tmp_path / "spec.toml").read_text() == spec.to_toml()


def test_replace_validates_and_leaves_the_original(folder):
    spec = load(written(folder, FULL))
    other = spec.replace(length="50 mm", drive=spec.drive.replace(sense="forward"))
    assert (other.length, other.drive.sense, other.drive.speed) == (0.05, "forward", spec.drive.speed) and spec.length == 0.04
    assert other.replace(length="40 mm", drive=spec.drive) == spec and spec.replace(spring=None).spring is None
    with pytest.raises(SpecError, match="^length: must be less than 2000 mm, got 3000 mm$"):
        spec.replace(length="3 m")
    with pytest.raises(SpecError, match="^lenght: unknown key .did you mean 'length'"):
        spec.replace(lenght="3 m")


def test_a_spec_is_frozen_and_can_be_a_key(folder):
    spec = load(written(folder, FULL))
    with pytest.raises(ValueError, match="frozen"):
        spec.length = 1.0
    assert {spec: 1}[load(written(folder, FULL))] == 1


def test_a_table_built_in_python_complains_like_a_file():
    with pytest.raises(SpecError, match='^length: unit missing: a length, e.g. "1.2 mm"$') as caught:
        ToySpec(length=1.2)
    assert caught.value.key == "length" and caught.value.file is None
    with pytest.raises(SpecError, match="^joints.0.clearance: wants a length, got '1 kg' .mass"):
        ToySpec(length="1 mm", joints=[{"name": "a", "clearance": "1 kg"}])


# -- files that are no spec ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("content", "wanted"),
    [
        (b"", "mechanism: is missing; one of cam, geneva, indexer, linkage, seedling-pusher, shaft, silent-chain, toy"),
        (b"# nothing\n", "mechanism: is missing; one of cam, geneva, indexer, linkage, seedling-pusher, shaft, silent-chain, toy"),
        (
            b'mechansim = "toy"',
            "mechanism: is missing (did you mean 'mechansim'?); "
            "one of cam, geneva, indexer, linkage, seedling-pusher, shaft, silent-chain, toy",
        ),
        (
            b'mechanism = "seeding-pusher"',
            "mechanism: no mechanism is called 'seeding-pusher' (did you mean 'seedling-pusher'?); "
            "known: cam, geneva, indexer, linkage, seed",
        ),
        (
            b"mechanism = 3",
            "mechanism: must be a text, got 3; one of cam, geneva, indexer, linkage, seedling-pusher, shaft, silent-chain, toy",
        ),
        (
            b'mechanism = ["toy"]',
            "mechanism: must be a text, got ['toy']; one of cam, geneva, indexer, linkage, seedling-pusher, shaft, silent-chain, toy",
        ),
        (b'title = "\xe9"', "is not text in UTF-8 (byte 9 is 0xe9); save it as UTF-8"),
        (FULL.encode("utf-16"), "is not text in UTF-8 (byte 0 is 0xff); save it as UTF-8"),
        (bytes(range(256)), "is not text in UTF-8 (byte 128 is 0x80); save it as UTF-8"),
        (b"\x00\x01\x02", "is not valid TOML: Invalid statement (at line 1, column 1)"),
        (
            b"length = 40 mm",
            "is not valid TOML: Expected newline or end of document after a statement (at line 1, column 13): length = 40 mm; "
            'a quantity is text in quotes: length = "40 mm"',
        ),
        (b'a = 1\nlength = "4 mm"\nlength = "5 mm"', 'is not valid TOML: the key is there twice (at line 3, column 16): length = "5 mm"'),
        (b"[drive]\n[spring]\n[drive]", "is not valid TOML: Cannot declare ('drive',) twice (at line 3, column 7): [drive]"),
        (b"a = [1, 2", "is not valid TOML: Unclosed array (at end of document)"),
        (b"a = " + b"[" * 5000, "a: line 1: nested too deeply: a key has more than 120 parts"),
        (b"a = " + b"9" * 5000, "is not valid TOML: a number has more than 4300 digits"),
    ],
)
def test_a_file_that_is_no_spec_is_refused_in_one_line(folder, monkeypatch, content, wanted):
    message, _ = complaint(folder, content)
    assert message.startswith(wanted) and "\n" not in message


def test_a_missing_file_says_how_to_make_one(tmp_path):
    with pytest.raises(
        SpecError,
        match=r"nope.toml: there is no such file; .*`drivewright new KIND nope.toml` writes a spec "
        r".kinds: cam, geneva, indexer, linkage, seedling-pusher, shaft, silent-chain.$",
    ):
        load(tmp_path / "nope.toml")


def test_a_folder_a_name_too_long_and_an_endless_file_are_refused(tmp_path):
    for path, reason in (
        (tmp_path, "is a folder"),
        ("x" * 5000, "cannot be read: File name too long"),
        ("x\0y", "cannot be read"),
        ("/dev/zero", "has more than 1000000 characters"),
    ):
        with pytest.raises(SpecError, match=reason) as caught:
            load(path)
        assert caught.value.file == str(path)


# -- keys that are wrong -------------------------------------------------------------------------------------------------------

BASE = 'mechanism = "toy"\nlength = "40 mm"\n'


@pytest.mark.parametrize(
    ("text", "key", "wanted"),
    [
        (
            "lenth = 1",
            "lenth",
            "unknown key (did you mean 'length'?); known here: format, mechanism, title, units, optimise, study, report, length,",
        ),
        ("DRIVE = {}", "DRIVE", "unknown key (did you mean 'drive'?)"),
        ("zzz = 1", "zzz", "unknown key; known here: format,"),
        ('"" = 1', '""', "unknown key; known here: format,"),
        ('"a.b\\n" = 1', '"a.b\\n"', "unknown key; known here: format,"),
        ("drive.sped = 1", "drive.sped", "unknown key (did you mean 'speed'?); known here: speed, sense"),
        ("drive.float = 1", "drive.float", "unknown key; known here: speed, sense"),
        ("joints = [{name = 'a', x = 1}]", "joints.0.x", "unknown key; known here: name, clearance, at"),
        ("joints = [{}]", "joints.0.name", 'is missing (name); e.g. "crank"'),
        ("spring = {}", "spring.rate", "is missing (rate); e.g. 2.0"),
        ("spring = 3", "spring", "must be a table, got 3"),
        ("spring = []", "spring", "must be a table, got []"),
        ("joints = 'a'", "joints", "must be a list [...], got 'a'"),
        ("joints = [1]", "joints.0", "must be a table, got 1"),
        ("tilt = '2 rad'", "tilt", "must be at most 1 rad, got 2 rad"),
        ("tilt = '-90 deg'", "tilt", "must be at least -1 rad, got -90 deg"),
        ("tilt = '30 mm'", "tilt", "wants an angle, got '30 mm' (length)"),
        ("tilt = 30", "tilt", 'unit missing: an angle, e.g. "30 deg"'),
        ("tilt = nan", "tilt", "nan is not finite"),
        ("tilt = 1979-05-27", "tilt", "wants an angle, got 1979-05-27"),
        ("tilt = {a = 1}", "tilt", "wants an angle, got {'a': 1}"),
        ("drive.speed = '0 rpm'", "drive.speed", "must be greater than 0 rpm, got 0 rpm"),
        (
            "drive.speed = '8 1/s'",
            "drive.speed",
            "wants an angular speed, got '8 1/s' (frequency); a frequency counts events: write rev/s, rpm or rad/s",
        ),
        ("drive.sense = 'foreward'", "drive.sense", "must be one of \"forward\", \"backward\", got 'foreward' (did you mean 'forward'?)"),
        ("drive.sense = 1", "drive.sense", 'must be one of "forward", "backward", got 1'),
        ("turns = 0", "turns", "must be at least 1, got 0"),
        ("turns = 3.0", "turns", "must be a whole number, got 3.0"),
        ("turns = 2.5", "turns", "must be a whole number, got 2.5"),
        ("turns = true", "turns", "must be a whole number, got true"),
        ("turns = '3'", "turns", "must be a whole number, got '3'"),
        ("turns = 1" + 400 * "0", "turns", "must be at most 9, got 1000"),
        ("ratio = nan", "ratio", "must be a finite number, got nan"),
        ("ratio = -inf", "ratio", "must be a finite number, got -inf"),
        ("ratio = '0.5'", "ratio", "must be a number, got '0.5'"),
        ("ratio = true", "ratio", "must be a number, got true"),
        ("ratio = 1.5", "ratio", "must be at most 1, got 1.5"),
        ("ratio = 1" + 400 * "0", "ratio", "must be a number, got 1000"),
        ("mirrored = 1", "mirrored", "must be true or false, got 1"),
        ("mirrored = 'true'", "mirrored", "must be true or false, got 'true'"),
        ("title = 3", "title", "must be a text in quotes, got 3"),
        (f"title = '{'x' * 401}'", "title", "must have at most 400 characters, got 401"),
        ("weights = [1, 'a']", "weights.1", "must be a number, got 'a'"),
        ("weights = [1, 2, 3, 4, 5]", "weights", "must have at most 4 entries, got 5"),
        ("points = [[1, 2], [1]]", "points.1.1", "is missing (points)"),
        ("points = [[1, 2], [1, nan]]", "points.1.1", "must be a finite number, got nan"),
        ("joints = [{name = 'a', at = ['1 mm', 'inf mm']}]", "joints.0.at.1", "'inf mm' is not finite; write e.g. \"9.5 mm\""),
        ("format = 2", "format", "must be at most 1, got 2"),
        ("format = true", "format", "must be a whole number, got true"),
        ("optimise = {}", "optimise.unknowns", "is missing (parameters to vary)"),
        ("optimise = {unknowns = []}", "optimise.unknowns", "must have at least 1 entries, got 0"),
        (
            "optimise = {unknowns = [{key = 'a', lower = true}]}",
            "optimise.unknowns.0.lower",
            'wants a finite number, or a quantity such as "9.5 mm", got true',
        ),
        ("optimise = {unknowns = [{key = 'a', lower = '1 zz'}]}", "optimise.unknowns.0.lower", "'zz' is no unit known here"),
        (
            "optimise = {settings = [{key = 'a', value = [1]}]}",
            "optimise.settings.0.value",
            "wants a finite number, a quantity, a text or true/false, got [1]",
        ),
        ("table = 3", "table", "wants the path of a file, got 3"),
        ("table = ''", "table", "wants the path of a file, got ''"),
        ('table = "a\\u0000"', "table", "wants the path of a file, got 'a\\x00'"),
        ("table = 'gone.csv'", "table", "there is no file '{folder}/gone.csv'; a path is relative to the spec"),
        ("table = '.'", "table", "there is no file '{folder}'; a path is relative to the spec"),
        (f"table = '{'x' * 5000}'", "table", "'xxx"),
    ],
)
def test_a_wrong_key_is_named_with_what_would_be_right(folder, text, key, wanted):
    message, named = complaint(folder, BASE + text)
    assert named == key and message.startswith(f"{key}: {wanted.replace('{folder}', str(folder))}")
    assert len(message.splitlines()[0]) < 400


def test_all_complaints_come_at_once_unknown_keys_first(folder):
    message, key = complaint(folder, 'mechanism = "toy"\nlenght = "40 mm"\ntilt = 3\nratio = "x"')
    assert key == "lenght" and message.splitlines()[1:] == [
        '  length: is missing (length); e.g. "40 mm"',
        '  tilt: unit missing: an angle, e.g. "3 deg"',
        "  ratio: must be a number, got 'x'",
    ]
    message, _ = complaint(folder, BASE + "\n".join(f"x{n} = 1" for n in range(20)))
    assert len(message.splitlines()) == 7 and message.splitlines()[-1] == "  ... and 14 more" and message.count("known here") == 1


@pytest.mark.parametrize("place", ["title", "drive", "drive.sense", "tilt", "joints", "weights", "new", "table", "optimise"])
def test_deep_nesting_is_refused_without_a_traceback(folder, place):
    steps = place + "." + ".".join(["a"] * 3000)
    message, key = complaint(folder, f'mechanism = "toy"\n{steps} = 1')
    assert key and len(message) < 1000
    complaint(folder, f'mechanism = "toy"\n{place} = {"[" * 150}{"]" * 150}')


def test_a_data_file_that_vanishes_is_named(folder):
    spec = load(written(folder, FULL))
    (folder / "lift.csv").unlink()
    with pytest.raises(SpecError, match="lift.csv' cannot be read: No such file"):
        spec.digest()


def test_a_loop_of_links_is_no_file(folder):
    (folder / "loop").symlink_to(folder / "loop")
    message, key = complaint(folder, BASE + "table = 'loop'")
    assert key == "table" and ("cannot be a file" in message or "there is no file" in message)


@pytest.mark.error
def test_a_list_whose_only_entry_is_wrong_is_not_too_short_besides(tmp_path):
    """The entry is told alone; a list without entries is."""
    document = {"mechanism": "cam", "follower": {"roller_radius": "8 mm", "prime_radius": "40 mm"}}
    with pytest.raises(SpecError) as wrong:
        from_document({**document, "programme": [{"angle": 180, "law": "dwell"}]}, CamSpec, folder=tmp_path)
    assert str(wrong.value) == 'programme.0.angle: unit missing: an angle, e.g. "180 deg"'
    with pytest.raises(SpecError, match="^programme: must have at least 1 entries, got 0$"):
        from_document({**document, "programme": []}, CamSpec, folder=tmp_path)
