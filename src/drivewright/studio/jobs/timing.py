"""How long each analysis of a design takes once everything is compiled: what the time of a search or a study is estimated from."""

from typing import Any

from drivewright import runner
from drivewright.steps import detailed
from drivewright.studio.design import Design
from drivewright.studio.jobs.progress import Progress

LONG = 20.0  # seconds of a run, beyond which compiling matters little


def timing(design: Design, progress: Progress) -> dict[str, Any]:
    """{"timings": {analysis: seconds}} of the default analyses: the shorter of two runs, where the first one is short enough."""
    spec = design.spec_on_screen()
    with detailed(progress) as step:
        timings = dict(runner.run(spec, progress=step).timings)
        if sum(timings.values()) < LONG:
            again = runner.run(spec, progress=step).timings
            timings = {name: min(seconds, again.get(name, seconds)) for name, seconds in timings.items()}
    return {"timings": timings}
