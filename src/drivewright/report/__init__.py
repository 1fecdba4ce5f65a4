"""Reports and files of a run: pages, PDF, drawings, CAD files, tables.

advice           what to change for a check that fails, in words
cad              STEP and STL files of parts, in millimetres; the bytes depend on the parts alone
comparison       several results of one kind side by side: their values, and how far they are apart
comparison_page  the page of a comparison
computed         how a result was computed: for the full report
content          what a report says, as plain text in plain dictionaries
dimension_drawings  what the keys of a kind measure, drawn from its presets
dxf              DXF drawings of flat parts
export           manufacturing files of a design: everything that `drivewright export` can write
features         lines and arcs of a packed scene that can be measured
folder           the run folder
gallery          the gallery of the worked examples: a page of its own, or one of the documentation
form             in which form a report is wanted: how much it says, and in which language
gcode            G-code (ISO 6983) that mills a flat part out of a plate
html             the self-contained report page
index            a gallery page over several run folders
letterhead       company, author, logo and templates of a report
localised        a figure with its words in another language
moving           a folder that is replaced as a whole
names            names of files that no file system minds
numbering        the figures of a report: their order, their numbers, and which of them shows a check
optimised        the outcome of an optimisation beside its evaluations
pack             a scene and the linked plots as JSON for the browser
pack_plots       all plots of a result as JSON, for a page that offers a choice
paper_figures    figures for paper: two in a row where they fit
pdf              the report as a PDF: the same content as the page, typeset by Typst
programme        a motion programme as JSON for a page that edits it
records          what a report wants of a study and of a search
renames          renames that the standard library does not have
solids           an assembly as triangles for a viewer, and how its parts move
study            the report of a study beside its cases
svgout           SVG drawings of flat parts in true millimetres, for laser cutters and plots
tabular          tables as CSV and Excel files in the units people read, with the unit of every column in its header
thumbnails       the pictures that stand for a design: its scene, still and moving, or a plot of its run
worked_examples  the worked examples: their specs, what each answers, and the pictures that stand for them
value_groups     the values of a report under the analyses that computed them
words            English texts of a report in another language
"""
