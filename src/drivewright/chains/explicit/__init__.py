"""Dynamics of a chain drive: rigid plates, rolling joints, teeth, guides; descriptions, an explicit solver, and what a run shows.

advance     kernels of a run: loads, steps, and who may touch whom
assembly    where everything is at the start
batch       many runs: over speed, and over the scatter of manufacturing
bodies      kernels of what the chain touches beside involute teeth
ensemble    statistics of a running chain
failure     how a running chain fails, and until when a run can be believed
measure     the record of a run from its snapshots
motion      what a run shows
polygon     the loop as a polygon around sprockets and guides
run_in      running in: from the assembled drive to one that runs quietly, before the clock starts
signals     what tells how evenly a drive runs
simulate    run a chain drive: settings in, `Motion` out
snapshots   snapshots of a run: what the kernel copies out at a sample, for `measure` to make sense of
stability   how long an explicit step may be, and whether seated plates touch at all
state       the drive as arrays: what the kernels read and write
statistics  what an ensemble of runs says in numbers
step        kernels of the explicit step
tables      tables of the running chain
turning     the drive with rigid links at many angles of its driver
"""
