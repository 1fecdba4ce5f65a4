"""Execution: what studies, searches and the studio compute with.

`evaluation` computes a batch of cases, the same here, in another process and on another machine; `batches` hands them out; `executors` are
the places that compute them; `workers` are processes that answer a server one call at a time.
"""
