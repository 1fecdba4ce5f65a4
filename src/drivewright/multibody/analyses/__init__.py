"""Analyses of a simulated mechanism: each takes a `SimulationModel`, and gives an `Answer`.

`simulation_model`    a mechanism with what is wanted of its run; the runs and records of it and of its twin without play.
`outputs`, `pins`, `joint_forces`, `energy`, `energy_audit`, `spectrum`, `oil_films`  of one run.
`turns`, `ensemble`   a run in numbers, turn by turn, and their statistics.
`actuation`, `motors`, `friction`  what drives and motors give; motor sizing; friction in ideal joints.
`repeated_turn`       one turn that stands for a run in which all are alike.
`poincare`, `lyapunov`, `bifurcation`  of motions that need not repeat themselves.
`impact_load`         over speed and clearance.
`rest`, `singular_positions`, `tolerances`, `wear`    equilibrium, singular positions, random dimensions, worn bearings.
`cycle_poses`, `animation`, `magnified_play`, `plots`  pictures.
"""
