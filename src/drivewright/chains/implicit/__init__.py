"""The chain drive of `chains.model` by the other route: energy, exact tangent, equilibrium and implicit motion.

advance      kernels of the implicit motion
energy       energy of a drive, its gradient and its exact Hessian, compiled
equilibrium  a drive at rest at every angle of its driver
parts        what the implicit kernels read and write
relax        towards the least energy of a drive, compiled
ring         symmetric linear systems with the shape of a chain
simulate     run a chain drive with implicit steps
tables       tables of the loaded chain at rest
touch        how deep a plate presses into a tooth or a guide, with the first and second derivatives of the depth, compiled
"""
