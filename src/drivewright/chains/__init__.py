"""Chains: joints, meshing, closure, dynamics, stress."""
