"""How far a study or a search is: what is said before it begins, the pace, and lines where there is no terminal."""

import math
import time
import tomllib

import numpy as np
import pytest
from places import EXAMPLES

from drivewright.cli import long_work, main
from drivewright.cli.long_work import Pace, duration, place_text, rate_text, words, worker_number
from drivewright.spec import from_document
from drivewright.studies.search.problem import prepare
from drivewright.studies.search.searching import METHODS, method_of, most_evaluations

pytestmark = pytest.mark.interface

CAM = (EXAMPLES / "disc_cam.toml").read_text()
SEARCH = """
[optimise]
population = {population}
generations = 3
unknowns = [
  {{ key = "follower.prime_radius", lower = "30 mm", upper = "80 mm" }},
  {{ key = "follower.roller_radius", lower = "5 mm", upper = "10 mm" }},
  {{ key = "load.mass", lower = "0.1 kg", upper = "0.2 kg" }},
]
objectives = [{{ value = "profile.perimeter" }}]
"""


def paced(*counts, total=41, workers=2, elsewhere=lambda: 0.0):
    """A pace after counts (time, done)."""
    times = iter([now for now, _ in counts])
    pace = Pace(elsewhere, lambda: next(times))
    pace.workers = workers
    for _, done in counts:
        pace.count(done, total)
    return pace


def test_the_first_one_is_shared_by_the_workers_where_the_rest_is_long():
    assert paced((0, 0)).left is None
    assert paced((0, 0), (1.0, 1)).left == pytest.approx(40 / 2)
    assert paced((0, 0), (1.0, 1), total=3).left == pytest.approx(2.0), "too little for a second process"


def test_later_ones_tell_the_pace_without_the_first():
    pace = paced((0, 0), (5.0, 1), (7.0, 9))
    assert pace.rate == pytest.approx(4.0) and pace.left == pytest.approx(32 / 4)
    assert words(pace, "cases", "2 not complete") == "9 of 41 cases, 4/s, about 8 s left, 2 not complete"


def test_only_the_last_half_minute_counts():
    pace = paced((0, 0), (1, 1), *((n, 10 * n) for n in range(2, 20)), *((n, 200 + n) for n in range(100, 140)), total=1000)
    assert pace.rate == pytest.approx(1.0, rel=0.05)


def test_compiling_is_no_pace():
    spent = iter([0.0, 8.0])
    assert paced((0, 0), (10.0, 1), elsewhere=lambda: next(spent)).rate == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("seconds", "text"),
    [(0.2, "1 s"), (25.4, "25 s"), (59.8, "1 min"), (200, "3 min 20 s"), (7800, "2 h 10 min"), (7200, "2 h"), (3599.9, "1 h")],
)
def test_durations_as_people_say_them(seconds, text):
    assert duration(seconds) == text


def test_rates_and_places():
    assert [rate_text(rate) for rate in (3.21, 1234.5, 0.07)] == ["3.2/s", "1234/s", "14 s each"]
    assert [place_text(1, None), place_text(4, None), place_text(1, "serial"), place_text(1, "tcp://a:1")] == [
        "in one process",
        "with 4 workers",
        "in one process",
        "on tcp://a:1",
    ]


@pytest.mark.parametrize("population", [8, 21, 40])
def test_as_many_evaluations_as_announced(population):
    """Counted while a search goes through all of its generations, whose designs never agree."""
    problem = prepare(from_document(tomllib.loads(CAM + SEARCH.format(population=population))))
    asked = []

    class Noise:
        def __call__(self, points):
            asked.append(len(points))
            return self.values(points)

        def values(self, points):
            return {name: np.array([math.sin(1e6 * sum(point)) for point in points]) for name in problem.names}

    METHODS[method_of(problem.search)](problem, problem.search, Noise())
    assert sum(asked) == most_evaluations(problem.search)


@pytest.fixture
def quickly(monkeypatch):
    """A line as soon as there is something to say, and every time taken as long."""
    monkeypatch.setattr(long_work, "EACH", 0.01)
    monkeypatch.setattr(long_work, "WORTH_WORDS", 0.0)


def test_without_a_terminal_lines_say_how_far_it_is(quickly, capsys):
    with long_work.counted("a.toml", "toy", "cases", 1, None) as step:
        for done in (3, 4):
            step(done, 9, "")
            time.sleep(0.05)
        step(9, 9, "")
    said = capsys.readouterr().err.splitlines()
    assert said[0] == "a.toml: 9 cases, 3 of them done before"
    assert any(line.startswith("a.toml: judged by the first, the rest takes about") and line.endswith("in one process") for line in said)
    assert any(line.startswith("a.toml: 4 of 9 cases, ") and "left" in line for line in said)


def test_a_sweep_says_how_many_cases_there_are(tmp_path, capsys):
    (tmp_path / "cam.toml").write_text(CAM)
    arguments = ["sweep", str(tmp_path / "cam.toml"), "--vary", "follower.prime_radius=40 mm,41 mm", "--out", str(tmp_path / "S")]
    for kept in ("", ", 2 of them done before"):
        with pytest.raises(SystemExit):
            main([*arguments, "--no-figures", "--on", "serial"])
        said = capsys.readouterr().err
        assert ("cam.toml: 2 cases\n" in said) == (not kept)


def test_a_search_says_how_many_evaluations_there_are(tmp_path, capsys):
    (tmp_path / "cam.toml").write_text(CAM + SEARCH.format(population=8))
    with pytest.raises(SystemExit):
        main(["optimise", str(tmp_path / "cam.toml"), "--out", str(tmp_path / "O"), "--on", "serial"])
    assert "cam.toml: up to 64 evaluations in 3 generations by differential evolution" in capsys.readouterr().err


def test_counts_of_the_last_half_minute_are_kept_and_no_fewer_than_three():
    """One count a minute: the rate is still that of the last two."""
    pace = paced((0, 0), (60, 1), (120, 3), (180, 7))
    assert pace.rate == pytest.approx(4 / 60)


def test_nothing_done_since_is_no_pace():
    assert paced((0, 0), (1, 0)).rate is None and paced((0, 4), (1, 4)).left is None


def test_only_the_first_one_is_alone():
    """Three counts and more: the pace is that of all workers together."""
    assert paced((0, 0), (10, 1), (20, 2), total=42, workers=4).left == pytest.approx(400)
    assert paced((0, 0), (10, 1), total=41, workers=4).left == pytest.approx(100)


def test_workers_that_are_asked_for_share_even_what_is_short():
    pace = Pace(clock=iter([0.0, 1.0]).__next__)
    pace.workers, pace.at_once = 2, True
    pace.count(0, 3)
    pace.count(1, 3)
    assert pace.left == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("rate", "text"), [(0.5, "0.5/s"), (0.49, "2 s each"), (0.01, "1 min 40 s each"), (99.4, "99/s"), (100.4, "100/s"), (999.0, "999/s")]
)
def test_rates_on_both_sides_of_a_limit(rate, text):
    assert rate_text(rate) == text


def test_nothing_is_left_when_all_are_done():
    assert words(paced((0, 0), (1, 1), (2, 41)), "cases") == "41 of 41 cases, 40/s"
    assert words(paced((0, 0), (1, 1), (3, 41)), "cases") == "41 of 41 cases, 20/s"


def test_as_many_workers_as_there_is_work(monkeypatch):
    monkeypatch.setattr("drivewright.cases.worker_count", lambda workers: workers or 8)
    monkeypatch.setattr("drivewright.execution.processes.most_processes", lambda: 6)
    numbers = [worker_number(*asked) for asked in ((None, None, 3), (4, None, 99), (None, None, 99), (2, None, 0), (None, "local:5", 99))]
    assert numbers == [3, 4, 6, 1, 5] and worker_number(8, "tcp://a:1", 99) == 1


class Said:
    """Keeps what is noted."""

    def __init__(self):
        self.notes = []

    def note(self, text):
        self.notes.append(text)

    def show(self, what):
        pass


@pytest.mark.parametrize(
    ("seconds", "workers", "said"),
    [
        (10.0, 4, ["9 cases", "judged by the first, the rest takes about 20 s with 4 workers"]),
        (10.0, 1, ["9 cases", "judged by the first, the rest takes about 1 min 20 s in one process"]),
        (0.1, 4, ["9 cases"]),
    ],
)
def test_how_long_the_rest_takes_is_said_where_it_is_long(seconds, workers, said, monkeypatch):
    """One of nine done, eight are left; 0.8 s are not worth a word."""
    monkeypatch.setattr(long_work, "worker_number", lambda asked, on, limit: min(workers, limit))
    teller = Said()
    step = long_work._Steps(teller, Pace(clock=iter([0.0, seconds]).__next__), "cases", workers, None, "")
    step(0, 9, "")
    step(1, 9, "")
    assert teller.notes == said


def test_cases_that_are_done_before_need_no_worker(monkeypatch):
    """Seven of nine are there: two workers have something to do."""
    monkeypatch.setattr(long_work, "worker_number", lambda asked, on, limit: min(8, limit))
    pace = Pace(clock=iter([0.0]).__next__)
    long_work._Steps(Said(), pace, "cases", None, None, "")(7, 9, "")
    assert pace.workers == 2


def test_the_bar_is_as_long_as_what_is_done(capsys):
    pace = paced((0, 0), (1, 10))
    bar = long_work._Bar("a.toml", "cases", pace, str)
    bar.show("")
    (task,) = bar.bar.tasks
    bar.close()
    assert (task.completed, task.total) == (10, 41)
