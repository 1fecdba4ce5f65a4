"""Plates and pins of a chain's joint as elastic solids in contact (extra `fe`).

assumptions  what plate and pins bear where a drawing leaves clearance, seat or load open
fields       stress, pressure and life on plate and pins, for a viewer
history      stress and life through a history of loads
joint        a straight joint of two links: how the pins share their force along their rolling contact
meshes       meshes of a plate and of its pins with named faces
pitch        a plate with both its own pins, condensed for any load
tables       tables for figures
"""
