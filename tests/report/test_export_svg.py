"""SVG drawings evaluated by a small path reader of our own."""

import re
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from export_cases import cam_area, drawing, lobed

from drivewright.report.svgout import path_data, write_svg
from drivewright.scene import Arc, Line, Outline, circle, polygon

pytestmark = pytest.mark.property

SVG = "{http://www.w3.org/2000/svg}"


def trace(data):
    """Points (complex, mm, y up) along a path of M, L, A (half turns at most), C and Z."""
    points = []
    for letter, rest in re.findall(r"([MLACZ])([^MLACZ]*)", data):
        n = [float(x) for x in rest.split()]
        if letter in "ML":
            points.append(complex(*n))
        elif letter == "C":
            p, t = np.array([points[-1], complex(*n[:2]), complex(*n[2:4]), complex(*n[4:])]), np.linspace(0, 1, 60)[1:]
            points += list((1 - t) ** 3 * p[0] + 3 * t * (1 - t) ** 2 * p[1] + 3 * t**2 * (1 - t) * p[2] + t**3 * p[3])
        elif letter == "A":
            radius, end = n[0], complex(*n[5:])
            chord = end - points[-1]
            side = 1j * np.sqrt(max(radius**2 - abs(chord) ** 2 / 4, 0.0)) * chord / abs(chord) * (1 if n[4] else -1)
            center = points[-1] + chord / 2 + side
            sense, arm = (1 if n[4] else -1), points[-1] - center
            turn = sense * (sense * np.angle((end - center) / arm) % (2 * np.pi))
            points += list(center + arm * np.exp(1j * turn * np.linspace(0, 1, 400)[1:]))
    return np.conj(points)


def area(z):
    return 0.5 * np.sum(np.imag(np.conj(z) * np.roll(z, -1)))


def test_page_is_in_millimetres_and_holds_every_layer(tmp_path):
    write_svg(drawing(), tmp_path / "c.svg", margin=3e-3)
    root = ElementTree.parse(tmp_path / "c.svg").getroot()
    box = [float(x) for x in root.get("viewBox").split()]
    assert root.get("width") == f"{box[2]:.4f}mm" and root.get("height") == f"{box[3]:.4f}mm"
    assert (box[0], box[2]) == pytest.approx((-48.0, 96.0), abs=1e-3)  # the axis is 90 mm long
    assert root.find(f"{SVG}title").text == "Main cam <1>"
    paths = {group.get("id"): [trace(path.get("d")) for path in group] for group in root.iter(f"{SVG}g")}
    assert list(paths) == ["profile", "hole", "base", "axis"]
    assert area(paths["profile"][0]) == pytest.approx(1e6 * cam_area(), rel=2e-5)
    assert np.mean([paths["hole"][0].real.max(), paths["hole"][0].real.min()]) == pytest.approx(2.0, abs=1e-3)
    assert np.mean([paths["hole"][0].imag.max(), paths["hole"][0].imag.min()]) == pytest.approx(-1.0, abs=1e-3)
    top = max(z.imag.max() for group in paths.values() for z in group)
    assert box[1] == pytest.approx(-top - 3.0, abs=1e-3)


def test_spline_becomes_beziers_within_the_tolerance():
    z = 1e-3 * trace(path_data(lobed(), "lobes", 1e-6))
    assert np.abs(np.abs(z) - 0.03 * (1 + 0.3 * np.cos(3 * np.angle(z)))).max() < 2e-6


def test_arcs_bend_to_their_own_side():
    for sweep in (np.pi, -np.pi):
        outline = Outline(
            (
                Arc((0.0, 0.0), 0.01, 0.0, sweep),
                Line((-0.01, 0.0), (-0.02, 0.03)),
                Line((-0.02, 0.03), (0.02, 0.03)),
                Line((0.02, 0.03), (0.01, 0.0)),
            )
        )
        assert abs(area(trace(path_data(outline, "bay")))) == pytest.approx(900 - np.sign(sweep) * 50 * np.pi, rel=1e-4)


def test_full_circle_and_open_line():
    assert path_data(circle((0.001, 0.002), 0.004), "ring") == "M5 -2 A4 4 0 0 0 -3 -2 A4 4 0 0 0 5 -2 Z"
    assert path_data(polygon([(0, 0), (0.0125, -0.001)], closed=False), "axis") == "M0 0 L12.5 1"
