"""Execution: what studies, searches and the studio compute with.

`evaluation` computes a batch of cases, the same here, in another process and on another machine; `batches` hands them out; `executors` are
the places that compute them; `workers` are processes that answer a server one call at a time.

case_reasons  why cases are not complete: their messages in groups that differ in numbers only
case_table    the table of cases: varied keys and values, with units and labels
dask_cluster  the workers of a Dask scheduler: one started on this machine, or one that is there already
keys          what a key of a spec takes: a quantity, a number, a whole number, a flag or a text
helper        a second process that helps this one with figures
outputs       what a study keeps of the answers of a case
"""
