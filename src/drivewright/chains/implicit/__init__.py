"""The chain drive of `chains.dynamics.model` by the other route: energy, exact tangent, equilibrium and implicit motion."""
