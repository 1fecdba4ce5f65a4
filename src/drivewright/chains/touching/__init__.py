"""Contact geometry of a chain with sprockets, rollers and guides: pure functions of numbers, for the explicit and the implicit run.

flank   a plate's straight flank on the involute of a tooth
guide   a plate's back or belly, a straight line of a pitch, on the convex arc of a guide
roller  a roller in the gap of a roller chain's sprocket
seats   which tooth or gap of a sprocket a plate may sit on
"""
