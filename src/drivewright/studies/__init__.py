"""Studies: many cases of one spec, from one core to a cluster.

`sweep` computes, `open_study` reads what is there; `varying` says what varies; `answers` says what came out; `optimise` searches.
"""
