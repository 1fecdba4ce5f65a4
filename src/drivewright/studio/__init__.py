"""The web studio: a spec as a form, the mechanism moving, its checks and plots, in the browser of the user's own machine.

access         who may talk to the studio, and how much: hosts, origins, a token, counted bytes
app            the studio's server: NiceGUI carries the messages, our own modules draw the page
computations   what is computed for one tab
connections    connections of the server: as many as it can hold, and none that keeps it waiting for a request
design         a design on its way through the studio
document       the design of one browser tab with its past and future, its locks, and every way to change it
drawing_words  words on the dimension drawings in another language than English
edited_design  the design of one tab: changed in worker processes, drawn and analysed, and shown to the page
editing        every change of a document, made in a worker process
error_text     messages for a page, in one line and without the folders of this machine
field_info     what a key of a spec is, read off its class
guesses        wrong tokens cost time
inbox          messages of one tab that wait for their turn
input_parsing  raw tables of a design
jobs           work that takes a while
kept_results   results of long runs, so that the figures and the solids of one design share one run
offers         what the page offers to begin with: kinds, presets, tools, worked examples
opening        where a design comes from: a file of this machine, a preset, the end of an address
outbox         messages of one tab to its page
page_policy    what a browser may do with our answers: a content security policy
part_lists     bought parts that a field may name
preview        what a worker process does with a design for the page
proposals      what the forms of a search and of a study propose, and the tables that they write
resources      what all tabs share
sample_values  what a new table or element of a list begins with
session        one tab of the browser
sliders        ranges and steps of sliders, in the unit that the box shows, and the short text of a number that a slider gave
source_text    the text of a spec as its author wrote it, with the differences entered
tab_jobs       the jobs of one tab
tabs           the open tabs, and the framework's socket between them and their sessions
translations   words of the page in another language than English
undo_history   a design with the steps before and after it
"""
