"""The chain drive of `chains.model` by the other route: energy, exact tangent, equilibrium and implicit motion."""
