"""Results, scenes and drawings as figures.  matplotlib is imported only when something is drawn."""

from drivewright.view.figures import draw_panels, plot_table
from drivewright.view.sketches import draw_drawing, draw_scene, draw_thumbnail
from drivewright.view.style import svg

__all__ = ["draw_drawing", "draw_panels", "draw_scene", "draw_thumbnail", "plot_table", "svg"]
