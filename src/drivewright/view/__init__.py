"""Results, scenes and drawings as figures.  matplotlib is imported only when something is drawn.

axis_names     what a y axis is called that several lines share
cards          cards for notebooks: a figure, tables and notes as one piece of HTML
coincident     curves of several designs that lie upon each other: where they do, and which are the same
dimensions     lines of measure: what the keys of a spec measure, named beside the drawing
histograms     how often a sample takes which values, with its mean, its tails and its limits
lines          which columns of a table are lines of a plot, with what each is compared with and the intervals of its values
maps           a quantity over two others as coloured cells, each about its own point of the grid
markers        sparse markers that tell the lines of one panel apart without their colours
merged_scenes  several scenes as one: the bodies of each design in its own colour
meshes         a closed triangle surface seen from the side
motion         poses (x, y, angle) seen by an observer, and between two frames of a cycle
moving         moving pictures: a scene over its cycle as images of one size, and an endless WebP of them
outlines       outlines as polylines with no more points than a picture needs
overlays       a plot of several designs in one picture: a panel for each quantity, in it a curve for each design
palette        colours by role, once, for the figures, the report's style sheet and the player
panels         a plot as plain data: which columns share a panel, in which unit, over which range
powers         powers of ten along a logarithmic axis
ranked         what matters most: lying bars, the longest on top
rounds         a quantity round a circle: what each place around a bearing carries
solid_picture  solids in an oblique view, hidden surfaces removed
sketches       scenes and drawings as figures, to scale
style          the look of every figure: fonts, lines, spacing
text           numbers and units as people read them: '48.183°', '26.469 mm', '2.4670×10⁻⁶ m'
"""

from drivewright.view.figures import draw_panels, plot_table
from drivewright.view.sketches import draw_drawing, draw_overlaid, draw_scene, draw_thumbnail
from drivewright.view.solid_picture import draw_solids
from drivewright.view.style import svg

__all__ = ["draw_drawing", "draw_overlaid", "draw_panels", "draw_scene", "draw_solids", "draw_thumbnail", "plot_table", "svg"]
