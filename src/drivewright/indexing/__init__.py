"""Indexing drives: profiles cut by the pins of a wheel, play, load sharing, torsional stiffness."""
