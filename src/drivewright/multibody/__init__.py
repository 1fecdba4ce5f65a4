"""Planar multibody systems: bodies, joints with and without clearance, forces and drives; kinematics, statics, dynamics."""
