"""The Chinese of the studio: every key has a label, every text of a scene, a plot, a check and the page itself a translation."""

import json
import re
import shutil
import subprocess
import tomllib
from pathlib import Path

import pytest

import drivewright
from drivewright import registry, runner
from drivewright.errors import InputError
from drivewright.report.content import content
from drivewright.spec import load
from drivewright.spec.fields import containers_of, has_user_keys, table_of
from drivewright.studio import translations
from drivewright.studio.field_info import field_infos
from drivewright.studio.form import form, group_hint, values
from drivewright.studio.jobs.design_keys import label
from drivewright.studio.opening import opened
from drivewright.view.panels import drawable, known_plots, panels
from drivewright.view.text import sentence

pytestmark = pytest.mark.interface

SOURCE = Path(drivewright.__file__).parent
WEB = SOURCE / "studio" / "web"
EXAMPLES = SOURCE.parents[1] / "examples"
KINDS = [kind for kind in registry.kinds() if (registry.mechanism(kind).folder / "zh.toml").is_file()]
CHINESE = re.compile(r"[\u4e00-\u9fff]")
SAME = {"* · *", "*（*）", "*／*", "LuGre", "Ambrósio", "Kelvin-Voigt"}  # texts that are the same in both languages
# units, symbols and names inside Chinese texts; r/min, L10rh, Lnmh, C0/Fr
LATIN = {"mm", "kN", "MPa", "Hz", "arcmin", "min", "rh", "Lnmh", "Fr", "von", "Mises", "Hy", "Vo", "max", "ds", "cos"}
OURS = {"cam", "geneva", "indexer", "linkage", "seedling-pusher", "shaft", "silent-chain"}


def keys(model, path=""):
    """("fields" or "tables", dotted key with * for names and numbers) of everything below a table class."""
    for name, field in model.model_fields.items():
        key, inner = path + name, table_of(field.annotation)
        yield ("tables" if inner else "fields"), key
        if inner:
            yield from keys(inner, key + ".*" * len(containers_of(field.annotation)) + ".")


def meanings(model, told):
    """What the form says of each key and each table below a table class: {text}."""
    told.add(" ".join((model.__doc__ or "").split()) if not told else "")
    for info in field_infos(model).values():
        told.add(" ".join(group_hint(info).split()) if info.table or info.kind == "names" else info.hint)
        if info.table:
            meanings(info.table, told)
    return told - {""}


def in_node(body, data):
    """What a piece of JavaScript prints as JSON, with `createWords` and `data` at hand."""
    node = shutil.which("node")
    if node is None:
        pytest.skip("node is not installed: words.js cannot run")
    script = f"""
        import {{ readFileSync }} from "node:fs";
        import {{ createWords }} from {json.dumps((WEB / "words.js").as_uri())};
        const data = JSON.parse(readFileSync(0, "utf8"));
        {body}
    """
    command = [node, "--input-type=module", "-e", script]
    found = subprocess.run(command, input=json.dumps(data), capture_output=True, encoding="utf-8", timeout=60)
    assert found.returncode == 0, found.stderr
    return json.loads(found.stdout)


def translated(asked):
    """What words.js makes of [(kind, texts)]: a list of lists."""
    own = translations.texts(None)
    data = [
        {"state": {"lang": "zh", "words": own, "design": {"words": translations.texts(kind)}}, "texts": list(texts)}
        for kind, texts in asked
    ]
    return in_node("console.log(JSON.stringify(data.map(({state, texts}) => texts.map(text => createWords({state})(text)))));", data)


def names(model, given):
    """Names that the user of a spec has chosen."""
    for name, field in model.model_fields.items():
        value = getattr(given, name)
        if name == "name" and value:
            yield value
        elif has_user_keys(field.annotation):
            yield from value
        entries = value.values() if has_user_keys(field.annotation) else value if isinstance(value, tuple) else [value]
        if inner := table_of(field.annotation):
            for entry in entries:
                if entry is not None:
                    yield from names(inner, entry)


def texts_of(spec):
    """Every English text that a design puts on the screen."""
    mechanism = registry.mechanism(spec.mechanism)
    scene, result = mechanism.scene(mechanism.build(spec)), runner.run(spec)
    said = content(result)
    found = {spec.title, mechanism.summary, scene.cycle_label, *(label for _, label in scene.marks)}
    found |= {each.label for each in (*scene.bodies, *scene.frames, *scene.traces)}
    found |= {check[part] for check in said["checks"] for part in ("label", "message")} | {value["meaning"] for value in said["headline"]}
    found |= {sentence(drawing.title) for drawing in mechanism.drawings(mechanism.build(spec))}
    for plot in drawable(result, known_plots(result).values()):
        found.add(plot.title)
        for panel in panels(result, plot):
            found |= {panel.title, panel.x.label, *(s.label for s in panel.series), *(text for _, text in (*panel.limits, *panel.rings))}
    return found - {""}


def untranslated(paths):
    """(file, English, what words.js makes of it) of each text in which English is left over."""
    specs = [(path, load(path)) for path in paths]
    asked = [(spec.mechanism, sorted(texts_of(spec))) for _, spec in specs]
    left = []
    for (path, spec), (_, texts), found in zip(specs, asked, translated(asked), strict=True):
        own = {part for name in names(type(spec), spec) for part in re.findall("[A-Za-z]{2,}", name)}
        left += [
            (path.name, english, text)
            for english, text in zip(texts, found, strict=True)
            if set(re.findall("[A-Za-z]{2,}", text)) - own - LATIN
        ]
    return left


def literals(source):
    """The texts of t(...) calls of a module; `${...}` of a template counts as *."""
    for call in re.finditer(r"(?<![\w.$])t\(", source):
        depth, at = 1, call.end()
        while depth:
            quoted = re.compile(r"\"(?:[^\"\\]|\\.)*\"|'(?:[^'\\]|\\.)*'|`(?:[^`\\]|\\.)*`").match(source, at)
            if quoted and depth == 1 and not re.search(r"[=!]==?\s*$", source[:at]):
                yield re.sub(r"\$\{[^}]*\}", "*", quoted[0][1:-1]).replace('\\"', '"').replace("\\'", "'")
            depth += 0 if quoted else {"(": 1, ")": -1}.get(source[at], 0)
            at = quoted.end() if quoted else at + 1


# -- labels of the form ----------------------------------------------------------------------------------------------------------


def test_all_our_kinds_are_translated():
    assert set(KINDS) == OURS


@pytest.mark.parametrize("part", ["fields", "tables"])
@pytest.mark.parametrize("kind", KINDS)
def test_every_key_has_a_label_and_every_label_a_key(kind, part):
    wanted = {key for which, key in keys(registry.mechanism(kind).spec) if which == part}
    assert len(wanted) > 5 and set(getattr(translations, part)(kind)) == wanted


@pytest.mark.parametrize("kind", KINDS)
def test_every_meaning_is_chinese_and_no_other_is_kept(kind):
    wanted, kept = meanings(registry.mechanism(kind).spec, set()), translations.hints(kind)
    assert len(wanted) > 80 and set(kept) == wanted
    assert [text for text in kept.values() if not CHINESE.search(text)] == []
    shared = set(tomllib.loads((SOURCE / "studio" / "zh.toml").read_text(encoding="utf-8"))["hints"])
    assert not shared & set(registry.mechanism(kind).translations("zh")["hints"])


def test_the_meanings_that_a_form_shows_are_translated_by_the_page():
    shown = form(opened(registry.mechanism("linkage").presets()["default"]))
    asked = sorted({each["hint"] for group in shown["groups"] for each in (group, *group["fields"])} - {""})
    state = {"lang": "zh", "words": translations.texts(None), "design": {"words": translations.texts("linkage")}}
    body = "const t = createWords({state: data.state}); console.log(JSON.stringify(data.asked.map(text => t(text))));"
    told = in_node(body, {"state": {**state, "hints": translations.hints("linkage")}, "asked": asked})
    assert len(asked) > 60 and told == [translations.hints("linkage")[text] for text in asked]


@pytest.mark.parametrize("kind", KINDS)
def test_every_preset_has_a_name_and_names_no_other(kind):
    mechanism = registry.mechanism(kind)
    assert set(mechanism.translations("zh")["presets"]) == set(mechanism.presets())


@pytest.mark.parametrize("kind", [None, *KINDS])
def test_values_are_chinese_and_keep_the_parts_that_vary(kind):
    patterns = translations.texts(kind) | ({} if kind is None else translations.hints(kind))
    labels = {} if kind is None else {**translations.fields(kind), **translations.tables(kind)}
    assert [text for text in (*patterns.values(), *labels.values()) if not CHINESE.search(text) and text not in SAME] == []
    assert [english for english, text in patterns.items() if english.count("*") != text.count("*")] == []
    assert [text for text in labels.values() if len(text) > 16] == []


def test_a_kind_without_translations_has_those_that_all_share(tmp_path):
    bare = registry.Mechanism("toy", "a toy", object, None, (), tmp_path)
    assert bare.translations("zh") == {}
    (tmp_path / "zh.toml").write_text("[fields", encoding="utf-8")
    with pytest.raises(InputError, match=r"'toy': zh\.toml cannot be read: .*repair the package"):
        bare.translations("zh")


def test_kinds_are_introduced_before_a_design_is_open():
    said = translations.texts(None)
    for kind in KINDS:
        assert CHINESE.search(said[registry.mechanism(kind).summary]) and CHINESE.search(said[kind.replace("-", " ")])
    assert "design a" in said and "Area of the cam profile" not in said


def test_every_title_of_the_menu_is_chinese_whatever_is_open():
    book = translations.texts(None)
    titles = [title for kind in OURS for title in translations.preset_titles(kind).values()]
    assert len(titles) > 20 and [title for title in titles if not CHINESE.search(book.get(title, ""))] == []


@pytest.mark.parametrize("kind", KINDS)
def test_every_analysis_has_a_name_and_a_meaning(kind):
    analyses = registry.mechanism(kind).analyses
    asked = [text for each in analyses for text in (each.name, each.meaning)]
    assert [(english, text) for english, text in zip(asked, translated([(kind, asked)])[0], strict=True) if not CHINESE.search(text)] == []


@pytest.mark.parametrize("kind", KINDS)
def test_keys_that_a_search_may_vary_are_named_in_chinese(kind):
    path = registry.mechanism(kind).presets()["default"]
    design, spec = opened(path), load(path)
    asked = [label(design.tables, key) for key, field in values(form(design)).items() if not field.get("parts") and field["kind"] != "list"]
    own = {part for name in names(type(spec), spec) for part in re.findall("[A-Za-z]{2,}", name)} | LATIN | {"kxx", "kyy", "kxy", "kyx"}
    told = translated([(kind, asked)])[0]
    left = [(english, text) for english, text in zip(asked, told, strict=True) if set(re.findall("[A-Za-z]{2,}", text)) - own]
    assert len(asked) > 30 and [pair for pair in left if not re.search("c[xy][xy]|eC", pair[1])] == []


@pytest.mark.parametrize("kind", KINDS)
def test_what_a_run_leaves_out_is_told_in_chinese(kind):
    found = runner.run(load(registry.mechanism(kind).presets()["default"])).findings
    told = translated([(kind, found)])[0]
    assert [text for text in told if not CHINESE.search(text)] == []


# -- words.js ----------------------------------------------------------------------------------------------------------------------


def test_texts_with_parts_that_vary():
    own = {"* · *": "* · *", "* of *": "第*个，共*个", "Undo": "撤销"}
    kind = {"Path of *": "*的轨迹", "Path of the *": "该*之轨迹", "crank": "曲柄", "Undo": "退回"}
    state = {"lang": "zh", "words": own, "design": {"words": kind}}
    pairs = [
        ("Undo", "退回"),
        ("undo", "退回"),
        ("Crank", "曲柄"),
        ("path of crank", "曲柄的轨迹"),
        ("Path of knife", "knife的轨迹"),
        ("Path of the crank", "该曲柄之轨迹"),
        ("Path of Path of crank", "曲柄的轨迹的轨迹"),
        ("Path of crank · 12.5 mm", "曲柄 · 12.5 mm的轨迹"),
        ("nothing known", "nothing known"),
        ("Width of crank", "Width of crank"),
        ("", ""),
        (["* of *", 3, 10], "第3个，共10个"),
        (["absent * or *", 1, "*"], "absent 1 or *"),
        ("7 of 12", "第7个，共12个"),
        ("1,200.5 of 3", "第1,200.5个，共3个"),
    ]
    found = in_node(
        """
        const {state, asked} = data, t = createWords({state});
        const all = () => asked.map(text => t(...[text].flat()));
        const found = [all(), all()];
        state.design = {words: {Undo: "重来"}};
        found.push([t("Undo"), t("Crank")]);
        state.design = null;
        found.push([t("Undo")]);
        state.lang = "en";
        found.push([t("Undo"), t("* of *", 3, 10)]);
        console.log(JSON.stringify(found));
    """,
        {"state": state, "asked": [text for text, _ in pairs]},
    )
    first = [text for _, text in pairs]
    assert found == [first, first, ["重来", "Crank"], ["撤销"], ["Undo", "3 of 10"]]


@pytest.mark.parametrize("kind", KINDS)
def test_the_default_design_leaves_no_english(kind):
    assert untranslated([registry.mechanism(kind).presets()["default"]]) == []


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_presets_and_examples_leave_no_english(kind):
    examples = [path for path in sorted(EXAMPLES.glob("*.toml")) if load(path).mechanism == kind]
    paths = [*registry.mechanism(kind).presets().values(), *examples]
    assert len(paths) > 3 and untranslated(paths) == []


# -- the page itself ---------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("module", sorted(path.name for path in WEB.glob("*.js")))
def test_every_text_of_the_page_is_translated(module):
    said = translations.texts(None)
    found = set(literals((WEB / module).read_text(encoding="utf-8"))) - {""}
    assert sorted(text for text in found if text not in said and re.search("[A-Za-z]{2}", text)) == []


@pytest.mark.parametrize("kind", KINDS)
def test_no_kind_changes_what_the_page_says(kind):
    own, found = translations.texts(None), translations.texts(kind)
    page = {text for path in WEB.glob("*.js") for text in literals(path.read_text(encoding="utf-8"))}
    assert {text: found[text] for text in page & set(own) if found[text] != own[text]} == {}


def test_every_text_of_the_player_is_translated():
    block = re.search(r"const TEXT = \{(.*?)\};", (SOURCE / "report" / "controls.js").read_text(encoding="utf-8"), re.DOTALL)[1]
    found = re.findall(r':\s*"([^"]+)"', block)
    assert len(found) > 5 and [text for text in found if text not in translations.texts(None)] == []


def test_the_search_for_texts_finds_them():
    source = 'x(t("one"), t(a === "no" ? \'two\' : `three ${n} b`), set("not"), fill(t("four (4)"), y), fit("five"))'
    assert list(literals(source)) == ["one", "two", "three * b", "four (4)"]
