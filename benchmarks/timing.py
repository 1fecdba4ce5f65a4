"""How a call is timed."""

import statistics
import time


def best(function, repeat=5):
    """(shortest, median) seconds of a call, after one warm-up."""
    function()
    times = []
    for _ in range(repeat):
        started = time.perf_counter()
        function()
        times.append(time.perf_counter() - started)
    return min(times), statistics.median(times)
