"""A search for the best design: the `problem` in numbers, ways of `searching`, the `evaluator` of designs, their `history`."""
