"""The colours as eyes see them.

Contrast by the formula of WCAG 2; colour blindness by the matrices of Machado, Oliveira and Fernandes 2009 (recalled).
"""

from itertools import combinations

import numpy as np
import pytest

from drivewright.view.palette import ROLES, SERIES, THEMES, TRACES, colour, style_sheet

pytestmark = pytest.mark.analytical

SIGHT = {
    "protan": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "deutan": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "tritan": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
    "all": np.eye(3),
}
# Oklab (Ottosson 2020): linear RGB -> cone response -> cube root -> lightness and two opponent axes.
CONES = [[0.4122214708, 0.5363325363, 0.0514459929], [0.2119034982, 0.6806995451, 0.1073969566], [0.0883024619, 0.2817188376, 0.6299787005]]
OPPONENT = [
    [0.2104542553, 0.7936177850, -0.0040720468],
    [1.9779984951, -2.4285922050, 0.4505937099],
    [0.0259040371, 0.7827717662, -0.8086757660],
]


def linear(hex_colour):
    v = np.array([int(hex_colour[i : i + 2], 16) for i in (1, 3, 5)]) / 255
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


def contrast(a, b):
    low, high = sorted(linear(x) @ [0.2126, 0.7152, 0.0722] for x in (a, b))
    return (high + 0.05) / (low + 0.05)


def seen(hex_colour, sight):
    return np.array(OPPONENT) @ np.cbrt(np.array(CONES) @ np.clip(np.array(SIGHT[sight]) @ linear(hex_colour), 0, 1))


def test_the_formulas_on_known_colours():
    assert contrast("#000000", "#ffffff") == pytest.approx(21.0)
    assert seen("#ffffff", "all") == pytest.approx([1, 0, 0], abs=1e-4)
    red, green = (seen(c, "deutan") for c in ("#c04040", "#409040"))
    plain = np.linalg.norm(seen("#c04040", "all") - seen("#409040", "all"))
    assert np.linalg.norm(red - green) < 0.6 * plain


@pytest.mark.parametrize("theme", THEMES)
@pytest.mark.parametrize("sight", SIGHT)
def test_part_colours_stay_apart(theme, sight):
    least = min((np.linalg.norm(seen(colour(a, theme), sight) - seen(colour(b, theme), sight)), a, b) for a, b in combinations(SERIES, 2))
    assert least[0] > 0.09, least


@pytest.mark.parametrize("theme", THEMES)
def test_words_and_lines_can_be_read(theme):
    for ground in ("surface", "canvas", "page", "raised"):
        assert contrast(colour("ink", theme), colour(ground, theme)) > 10
        assert contrast(colour("muted", theme), colour(ground, theme)) > 4.5
    for state in ("good", "bad", "warn"):
        assert contrast(colour(state, theme), colour(f"{state}-soft", theme)) > 4.5
    for role in (*SERIES, "cursor", "accent", "ground"):
        assert contrast(colour(role, theme), colour("canvas", theme)) > 3
    assert contrast(colour("accent", theme), colour("surface", theme)) > 4.5


def test_series_and_traces_are_the_same_colours():
    assert set(SERIES) == set(TRACES) and set(SERIES) <= set(ROLES)
    assert colour("nobody's role") == colour("steel")


def test_the_style_sheet_has_every_role_in_both_themes():
    text = style_sheet()
    for role, (light, dark) in ROLES.items():
        assert text.count(f"--{role}: {light};") >= 1
        assert text.count(f"--{role}: {dark};") >= 2
