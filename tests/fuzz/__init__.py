"""A fuzzer: presets and examples with faults put in, through the loader, a run of cheap analyses and the command line.

A case is made from its number alone: `python -m tests.fuzz 4711` shows case 4711 and what becomes of it, `python -m tests.fuzz 0 5000`
goes through many of them.

bases      the presets and examples that are damaged, and the analyses that cost little
values     what stands in place of a value: other types, units and magnitudes, odd texts
damage     tables and texts of specs with faults in them
files      data files with faults in them, and what is no file at all
cases      a `Case` of a number: its files, and how it enters the program
entries    a case run in this process, and what is wrong with the answer
worker     a process that runs one case after another, within limits of time and memory
pool       a few such processes, replaced when they die
"""
