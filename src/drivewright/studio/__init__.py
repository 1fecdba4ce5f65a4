"""The web studio: a spec as a form, the mechanism moving, its checks and plots, in the browser of the user's own machine.

access         who may talk to the studio, and how much: hosts, origins, a token, counted bytes
app            the studio's server: NiceGUI carries the messages, our own modules draw the page
computations   what is computed for one tab
design         a design on its way through the studio
document       the design of one browser tab with its past and future, its locks, and every way to change it
field_info     what a key of a spec is, read off its class
input_parsing  raw tables of a design
jobs           work that takes a while
preview        what a worker process does with a design for the page
resources      what all tabs share
sample_values  what a new table or element of a list begins with
session        one tab of the browser
sliders        ranges and steps of sliders, in the unit that the box shows, and the short text of a number that a slider gave
translations   words of the page in another language than English
"""
