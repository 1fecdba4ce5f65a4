"""The web studio: a spec as a form, the mechanism moving, its checks and plots, in the browser of the user's own machine."""
