"""A process that runs one case after another, within limits of time and memory: a number on stdin, a line of JSON on stdout.

A case that goes beyond its time ends the process: a compiled loop hears nothing but a signal that kills.
"""

import json
import os
import resource
import signal
import sys
from pathlib import Path

SECONDS = 60  # of the processor, for a case; the clock may take twice as long
MEMORY = 4 * 2**30  # addresses of the process


def main() -> None:
    """Cases from stdin until it ends."""
    sys.path[:0] = [str(Path(__file__).parents[1] / "support")]
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # what a library prints is no answer
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    from .cases import case_of
    from .entries import answer_of, warm

    for line in sys.stdin:
        number = int(line)
        warm(number)
        case = case_of(number)
        with _Limited():
            answer = answer_of(case)
        answers.write(json.dumps({"number": number, **answer._asdict()}) + "\n")
        answers.flush()


class _Limited:
    """The limits of time of one case, by signals whose default is to end the process."""

    def __enter__(self):
        used = resource.getrusage(resource.RUSAGE_SELF)
        limit = int(used.ru_utime + used.ru_stime) + 1 + SECONDS
        resource.setrlimit(resource.RLIMIT_CPU, (limit, resource.getrlimit(resource.RLIMIT_CPU)[1]))
        signal.alarm(2 * SECONDS)

    def __exit__(self, *_):
        signal.alarm(0)
        resource.setrlimit(resource.RLIMIT_CPU, (resource.getrlimit(resource.RLIMIT_CPU)[1],) * 2)


if __name__ == "__main__":
    main()
