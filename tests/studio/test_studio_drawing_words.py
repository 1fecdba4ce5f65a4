"""Drawings of what the keys measure, in Chinese: every word of them, each within the picture, values and lines as they were."""

import re
from xml.etree import ElementTree

import pytest

from drivewright import registry
from drivewright.report.dimension_drawings import drawing_files
from drivewright.studio.app import _files
from drivewright.studio.drawing_words import TEXT, drawing_in_words, key_in_words

pytestmark = pytest.mark.interface

DRAWINGS = [(kind, name, path) for kind in registry.kinds() for name, path in drawing_files(kind).items()]
CHINESE = re.compile(r"[\u4e00-\u9fff]")
VALUE = re.compile(r"(\d+ × )?[-−]?[\d.]+(\s[a-zµ]+|°)")
NAMED = {"ground.points.O4.0"}  # of which nothing but the name of a point and an axis is left


def exact(text):
    return {"crank": "曲柄", "front": "前"}.get(text, text)


@pytest.mark.parametrize(("kind", "name", "path"), DRAWINGS, ids=[name for _, name, _ in DRAWINGS])
def test_every_word_is_chinese_and_within_the_picture(kind, name, path):
    english = path.read_text(encoding="utf-8")
    chinese = drawing_in_words(kind, english)
    root = ElementTree.fromstring(chinese)
    assert root.get("{http://www.w3.org/XML/1998/namespace}lang") == "zh"
    pairs = [(old[2], new) for old, new in zip(TEXT.finditer(english), TEXT.finditer(chinese), strict=True)]
    assert len(pairs) > 4 and sum(bool(VALUE.fullmatch(old)) for old, _ in pairs) == len(pairs) // 2
    width = float(root.get("viewBox").split()[2])
    for old, new in pairs:
        assert new[2] == old if VALUE.fullmatch(old) else old in NAMED or CHINESE.search(new[2]), old
        x, size = (float(re.search(pattern, new[1])[1]) for pattern in (r' x="([\d.]+)"', r"font(?:-size)?: (?:[a-z]+ )?([\d.]+)px"))
        needed = sum(size * (1.0 if ord(letter) > 0x2E80 else 0.65) for letter in new[2])
        assert needed < (x if "text-anchor: end" in new[1] else width - x), new[2]
    assert TEXT.sub("", chinese).replace(' xml:lang="zh"', "", 1) == TEXT.sub("", english)


@pytest.mark.parametrize(
    ("kind", "key", "wanted"),
    [
        ("cam", "follower.prime_radius", "理论基圆半径"),
        ("cam", "programme.0.rise", "运动循环 1 · 升程"),
        ("linkage", "bodies.crank.points.A.1", "曲柄 · A · y"),
        ("linkage", "bodies.crank.centroid.0", "曲柄 · 质心 · x"),
        ("shaft", "bearings.A.geometry.ball_diameter", "A · 球径"),
        ("indexer", "shafts.diameters.1", "各段直径 · 前"),
    ],
)
def test_a_key_is_named_as_in_the_form(kind, key, wanted):
    assert key_in_words(kind, key, exact) == wanted


def test_each_drawing_is_served_in_both_languages():
    for _, name, path in DRAWINGS:
        assert _files()[f"drawing.{name}.svg"][0] == path.read_bytes() != _files()[f"drawing.{name}.zh.svg"][0]
