"""python -m tests.fuzz NUMBER [HOW MANY] [WORKERS]: one case in full, or a line for each that goes wrong."""

import sys
import time
from collections import Counter
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[1] / "support")]

from .cases import case_of  # noqa: E402
from .pool import answers  # noqa: E402


def show(number: int) -> bool:
    """One case with its files, what it printed and what is wrong; whether nothing is."""
    case = case_of(number)
    print(f"case {number}: {case.base}, {case.entry} {case.arguments}")
    for name, content in case.files.items():
        print(f"--- {ascii(name)}\n{content.decode('utf-8', 'backslashreplace')[:6000] if isinstance(content, bytes) else content}")
    answer = next(answers([number]))
    print(f"--- exit code {answer['code']}, {answer['seconds']} s\n{ascii(answer['out'][:2000])}")
    print(f"{answer['err'][:4000]}\n--- wrong: {answer['wrong']}")
    return not answer["wrong"]


def go_through(first: int, count: int, workers: int) -> bool:
    """Many cases, with a line for each that goes wrong and the sums at the end; whether none does."""
    codes, wrong, started, slowest = Counter(), 0, time.perf_counter(), (0.0, -1)
    for answer in answers(range(first, first + count), workers):
        codes[answer["code"]] += 1
        slowest = max(slowest, (answer["seconds"] or 0.0, answer["number"]))
        if answer["wrong"]:
            wrong += 1
            print(f"{answer['number']} {case_of(answer['number']).entry}: {ascii(answer['wrong'])[:600]}", flush=True)
    print(f"{count} cases in {time.perf_counter() - started:.0f} s, exit codes {dict(codes)}, {wrong} wrong, slowest {slowest}")
    return not wrong


if __name__ == "__main__":
    given = [int(argument) for argument in sys.argv[1:]]
    sys.exit(not (show(given[0]) if len(given) == 1 else go_through(given[0], given[1], *(given[2:] or [2]))))
