"""Contact geometry of a chain with sprockets, rollers and guides: pure functions of numbers, for the explicit and the implicit run."""
