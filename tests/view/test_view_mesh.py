"""Surfaces seen from the side: nearest on top, coloured by the displacement, the shape before dashed, small files, not in the player."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib import colormaps
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import PolyCollection
from sample_designs import four_bar_result, four_bar_scene

from drivewright.report.pack import pack_plots
from drivewright.result import Column, Plot, Table
from drivewright.scene import Part, Turned
from drivewright.solids import facets
from drivewright.view import draw_panels, svg
from drivewright.view.meshes import colour_range, facing, silhouette
from drivewright.view.panels import panels

pytestmark = pytest.mark.interface

PLOT = Plot(
    "solid", "Deformed solid under 500 N", "solid", "z", ("y", "x", "size"), equal=True, style="mesh", reference=("rest_z", "rest_y")
)
TAIL = ((0.03, 0.02, 0.02001, 0.0), (0.03, 0.02001, 0.02, 0.0)) * 2 + ((0.03, 0.02, 0.02, 0.0),)  # all but straight, in five rings
RINGS = ((0.05, 0.03, 0.03, 0.0), *TAIL)


def surface(tolerance=2e-5, bend=0.3):
    """A stepped shaft along z that droops by bend z^2 [m], of which the hundredth is its displacement."""
    points, corners = facets.surface_triangles(Part("s", (Turned((0.0, 0.0), 0.0, RINGS),)), tolerance)
    z, y, x = points[corners.ravel()].T
    return Table(
        "solid",
        "Solid",
        tuple(
            Column(name, "m", meaning, data)
            for name, meaning, data in (
                ("z", "position along the shaft", z),
                ("y", "height", y - bend * z**2),
                ("x", "depth", -x),
                ("size", "displacement, drawn 100 times as large", 0.01 * bend * z**2),
                ("rest_z", "position", z),
                ("rest_y", "height", y),
            )
        ),
    )


RESULT = replace(four_bar_result(), tables={"solid": surface()})


def test_the_panel_holds_up_depth_and_colour_in_their_units():
    (panel,) = panels(RESULT, PLOT)
    up, depth, size, right_before, up_before = panel.series
    assert (panel.style, panel.equal, panel.x.unit, up.unit, size.unit) == ("mesh", True, "mm", "mm", "µm")
    assert panel.x.data.max() == pytest.approx(200) and size.data.max() == pytest.approx(0.01 * 0.3 * 0.2**2 * 1e6)
    assert depth.data.max() == pytest.approx(15) and right_before.dashed and up_before.data.max() == pytest.approx(15)


def test_the_figure_is_to_scale_labelled_and_small():
    figure = draw_panels(panels(RESULT, PLOT))
    FigureCanvasAgg(figure).draw()
    axis, bar = figure.axes
    (x0, y0), (x1, y1) = axis.transData.transform([(0.0, 0.0), (10.0, 10.0)])
    assert x1 - x0 == pytest.approx(y1 - y0)
    assert axis.get_xlabel() == "Position along the shaft [mm]" and axis.get_ylabel() == "Height [mm]"
    assert bar.get_xlabel() == "Displacement, drawn 100 times as large [µm]" and figure.get_suptitle() == PLOT.title
    dashed = np.concatenate([line.get_xydata() for line in axis.lines])
    assert [*dashed.min(axis=0), *dashed.max(axis=0)] == pytest.approx([0, -15, 200, 15], abs=0.05)
    text = svg(figure)
    assert "<image" in text and len(text) < 300_000


def test_only_what_faces_the_viewer_is_painted_and_colours_follow_the_displacement():
    (drawn,) = (c for c in draw_panels(panels(RESULT, PLOT)).axes[0].collections if isinstance(c, PolyCollection))
    triangles = np.array([path.vertices[:3] for path in drawn.get_paths()])
    assert 0 < len(triangles) < len(RESULT.tables["solid"].columns[0].data) / 3 / 1.8
    green = drawn.get_facecolors()[:, 1]  # viridis: green rises with the value
    far, near = triangles[:, :, 0].min(axis=1) > 169, triangles[:, :, 0].max(axis=1) < 81
    assert green[far].min() > green[near].max()


def test_light_comes_from_above():
    table = surface(bend=0.0)
    even = replace(table, columns=tuple(c._replace(data=np.full_like(c.data, 1e-6)) if c.name == "size" else c for c in table.columns))
    drawn, *_ = draw_panels(panels(replace(RESULT, tables={"solid": even}), PLOT)).axes[0].collections
    height = np.array([path.vertices[:3, 1].mean() for path in drawn.get_paths()])
    green = drawn.get_facecolors()[:, 1]
    assert green[height > 5].min() > green[height < -5].max()


def test_the_nearest_comes_last_and_the_back_is_left_out():
    near = [[0, 0, 2.0], [1, 0, 2], [0, 1, 2]]
    far = [[0, 0, 1.0], [1, 0, 1], [0, 1, 1]]
    back = [near[0], near[2], near[1]]
    seen, order, bright = facing(np.array([near, far, back]))
    assert seen.tolist() == [True, True, False] and order.tolist() == [1, 0]
    tilted = [[0, 0, 0.0], [1, 0, 0], [0, 1, -1]]  # leans back: looks up, into the light
    assert facing(np.array([tilted]))[2] > bright[0]


def test_the_side_towards_the_viewer_is_at_low_x():
    # z to the right and y up: x points away from the viewer
    square = Table(
        "solid",
        "S",
        tuple(
            Column(name, "m", name, np.array(data, float))
            for name, data in (("z", [0, 1, 0] * 2), ("y", [0, 0, 1] * 2), ("x", [5] * 3 + [-5] * 3), ("size", [1e-6] * 3 + [2e-6] * 3))
        ),
    )
    figure = draw_panels(panels(replace(RESULT, tables={"solid": square}), PLOT._replace(reference=())))
    (drawn,) = figure.axes[0].collections
    assert drawn.get_facecolors()[-1, 1] > drawn.get_facecolors()[0, 1]


def test_colours_from_0_or_over_so_many_powers_of_ten():
    assert colour_range(np.array([2.0, 5.0, np.nan]), False) == (0.0, 5.0)
    assert colour_range(np.array([np.nan, np.inf]), False) == (0.0, 1.0)
    assert colour_range(np.array([1e3, 1e5, np.inf, 0.0]), True) == (1e3, 1e5)
    assert colour_range(np.array([1e3, 1e30]), True) == (1e3, 1e9)
    assert colour_range(np.array([np.inf]), True) == (0.1, 1.0)


def test_what_lasts_longer_than_the_scale_has_the_colour_of_its_end():
    """Four triangles in a row with lives of 1, 1000, 1e9 and without end: the last two look alike, and the bar says that more is beyond."""
    x = np.concatenate([np.array([0, 1, 0.0]) + n for n in range(4)])
    columns = (
        Column("z", "m", "right", x),
        Column("y", "m", "up", np.array([0, 0, 1.0] * 4)),
        Column("x", "m", "depth", np.zeros(12)),
        Column("size", "-", "life", np.repeat([1.0, 1e3, 1e9, np.inf], 3)),
    )
    plot = PLOT._replace(reference=(), log=True)
    figure = draw_panels(panels(replace(RESULT, tables={"solid": Table("solid", "S", columns)}), plot))
    (drawn,) = figure.axes[0].collections
    first, middle, late, endless = drawn.get_facecolors()
    assert late == pytest.approx(endless)
    assert first[1] < middle[1] < late[1]
    assert middle[:3] == pytest.approx(np.array(colormaps["viridis"](0.5)[:3]) * middle[1] / colormaps["viridis"](0.5)[1], rel=0.02)
    assert figure.axes[1].get_xscale() == "log"
    assert figure.axes[1].get_xlim() == pytest.approx((1.0, 1e6))


def test_silhouette_of_two_steps_has_their_corners():
    table = surface(bend=0.0)
    (ring,) = silhouette(table["z"].data, table["y"].data)
    for corner in ((0, 0.015), (0.05, 0.015), (0.05, 0.01), (0.2, 0.01), (0.2, -0.01), (0.05, -0.01), (0.05, -0.015), (0, -0.015)):
        assert np.hypot(*(ring - corner).T).min() < 5e-5
    assert len(ring) <= 12


def test_the_player_leaves_surfaces_out():
    scene, motion = four_bar_scene(), four_bar_result().tables["motion"]
    led = replace(surface(), columns=(motion.columns[0], *surface().columns))
    result = replace(RESULT, tables={"motion": motion, "solid": led})
    line = Plot("l", "L", "motion", motion.columns[0].name, (motion.columns[1].name,))
    packed = pack_plots(result, scene, (line, PLOT._replace(x=motion.columns[0].name)))
    assert len(packed["panels"]) == 1 and packed["panels"][0]["style"] == "line"
