"""External Geneva drives: a pin on a crank steps a wheel with radial slots, a disc on the crank locks it between the steps.

Frames: the crank turns counter-clockwise about O1, the wheel clockwise about O2, to the right of O1 at the centre distance C.  The crank
angle theta is 0 where the pin is nearest to O2; the angle of the wheel is positive the way it steps.

step       the wheel's angle over the crank's and its derivatives, the engaged angles
crank      motion of the crank over a turn: constant speed, or a motion law from rest to rest
shapes     outlines of wheel and locking disc, walls, undercut, slot length
locking    play in the dwell, clearance between disc and wheel while the wheel turns
clearance  entry of the pin into the slot, and its crossing from one side to the other, with clearance
forces     pin force, friction, Hertz pressure, torque at the crank, force on the wheel's bearing
"""
