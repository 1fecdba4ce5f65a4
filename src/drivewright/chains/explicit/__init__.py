"""Dynamics of a chain drive: rigid plates, rolling joints, teeth, guides; descriptions, an explicit solver, and what a run shows."""
