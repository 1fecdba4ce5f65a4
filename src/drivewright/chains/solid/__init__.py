"""Plates and pins of a chain's joint as solids in contact."""
