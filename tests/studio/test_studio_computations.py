"""What one tab computes: the newest drawing, analyses when the design rests, jobs - with workers that answer as the test says."""

import asyncio
from contextlib import asynccontextmanager
from types import SimpleNamespace

import loops
import pytest

from drivewright.errors import DoesNotAssemble, GeometryCheckFailed, SpecError
from drivewright.execution.workers import CallTimedOut, Cancellation, WorkerDied, WorkerFault
from drivewright.registry import Analysis
from drivewright.studio import computations, preview, tab_jobs
from drivewright.studio.computations import TabComputations
from drivewright.studio.tab_jobs import TabJobs

pytestmark = pytest.mark.interface

KIND = "toy"
ANALYSES = tuple(Analysis(name, None, name) for name in ("motion", "forces"))


class Call:
    """One call that a worker has taken; the test says how it ends."""

    def __init__(self, pool, function, arguments, on_message):
        self.pool, self.function, self.arguments, self.send = pool, function.__name__, arguments, on_message
        self.end, self.stopped, self.clearing = asyncio.get_running_loop().create_future(), None, None

    async def answer(self, value):
        self.end.set_result(value)
        await settled()

    async def fail(self, error):
        self.end.set_exception(error)
        await settled()


class Bench:
    """Stands for the resources, and holds all that the page has heard."""

    def __init__(self):
        self.said, self.calls, self.offered, self.busy = [], [], {}, 0
        self.quick, self.heavy, self.jobs = (self._pool(name) for name in ("quick", "heavy", "jobs"))
        about = self.said.append, lambda error: f"in words: {error}", self
        self.computing, self.working = TabComputations(*about), TabJobs(*about)

    def _pool(self, name):
        return SimpleNamespace(worker=lambda owner: self._worker(name, owner), crowded=False)

    @asynccontextmanager
    async def _worker(self, name, owner):
        assert owner is (self.working if name == "jobs" else self.computing)  # every tab has its share

        async def call(function, *arguments, on_message=lambda message: None, limit=None):
            made = Call(name, function, arguments, on_message)
            made.limit = limit
            self.calls.append(made)
            try:
                return await made.end
            except asyncio.CancelledError as cancelled:
                made.stopped = cancelled.args
                if made.clearing:
                    await made.clearing.wait()
                raise

        self.busy += 1
        try:
            yield SimpleNamespace(call=call)
        finally:
            self.busy -= 1

    def offer(self, name, data):
        self.offered[f"/download/{name}"] = data
        return f"/download/{name}"

    async def look(self, gen):
        made = SimpleNamespace(kind=KIND, gen=gen)
        self.computing.update(gen, made)
        await settled()
        return made

    def told(self, what):
        return [message for message in self.said if message["what"] == what]

    @property
    def asked(self):
        """[(pool, function, generation)] of all calls."""
        return [(call.pool, call.function, call.arguments[0].gen) for call in self.calls]


async def settled():
    for _ in range(20):
        await asyncio.sleep(0)


def found(*names, value=1.0, unit="deg", timings=None):
    """A result of the page with one check, value and plot of each name."""
    return {
        "checks": [{"name": name, "value": value} for name in names],
        "values": [{"name": name, "value": value} for name in names],
        "headline": [],
        "verdict": {"state": "good", "text": "all pass"},
        "fractions": dict.fromkeys(names, value),
        "plots": {"cycle": {"unit": unit, "value": value}, "plots": [{"name": name, "value": value} for name in names]},
        "timings": timings or {},
    }


@pytest.fixture
def bench(monkeypatch):
    monkeypatch.setattr(computations, "REST", 0)
    monkeypatch.setattr(computations, "PACE", 0)
    monkeypatch.setattr(computations, "SHARE", 0)
    monkeypatch.setattr(computations.registry, "mechanism", {KIND: SimpleNamespace(analyses=ANALYSES)}.__getitem__)
    return Bench()


def story(test):
    """A test that runs in a loop of its own."""

    def told(bench):
        async def tell():
            await test(bench)
            bench.computing.close()
            bench.working.cancel_all()
            await settled()
            assert bench.busy == 0  # no worker is kept

        loops.run(asyncio.wait_for(tell(), 10))

    return told


# -- the drawing ---------------------------------------------------------------------------------------------------------------


@story
async def test_the_newest_design_wins(bench):
    for gen in (1, 2, 3, 4, 5, 6):
        await bench.look(gen)
    assert bench.asked == [("quick", "draw", 1)]
    await bench.calls[0].answer(None)
    assert bench.asked == [("quick", "draw", 1), ("quick", "draw", 6)]
    await bench.calls[1].answer(None)
    assert bench.asked[2:] == [("heavy", "analyse", 6)]
    assert bench.told("possible") == [], "nothing was impossible, so there is nothing to take back"


@story
async def test_a_scene_is_told_with_its_generation_as_it_comes(bench):
    await bench.look(7)
    bench.calls[0].send('{"scene": null}')
    assert bench.said == [{"what": "scene", "gen": 7, "json": '{"scene": null}'}]
    await bench.look(8)
    bench.calls[0].send("late")
    assert bench.said[1:] == [{"what": "scene", "gen": 7, "json": "late"}]


@story
async def test_a_look_after_the_end_of_a_drawing_begins_another(bench):
    for gen in (1, 2):
        await bench.look(gen)
        await bench.calls[-1].answer(None)
    assert [call for call in bench.asked if call[1] == "draw"] == [("quick", "draw", 1), ("quick", "draw", 2)]


@story
async def test_a_lost_worker_is_told_and_the_design_drawn_once_more(bench):
    await bench.look(1)
    await bench.calls[0].fail(WorkerDied("the process has gone"))
    assert bench.said == [{"what": "work", "state": "lost", "text": "in words: the process has gone"}]
    assert bench.asked == [("quick", "draw", 1)] * 2
    await bench.calls[1].answer(None)
    assert bench.asked[2:] == [("heavy", "analyse", 1)]


@story
async def test_but_not_for_ever(bench):
    await bench.look(1)
    await bench.calls[0].fail(WorkerDied("first"))
    await bench.calls[1].fail(WorkerDied("second"))
    assert [message["text"] for message in bench.said] == ["in words: first", "in words: second"]
    assert [call for call in bench.asked if call[1] == "draw"] == [("quick", "draw", 1)] * 2


@story
async def test_a_bug_is_told_in_one_line_and_the_next_design_is_drawn(bench):
    await bench.look(1)
    await bench.calls[0].fail(WorkerFault("Traceback (most recent call last):\n  File x\nKeyError: 'no such key'\n"))
    assert bench.said == [{"what": "work", "state": "lost", "text": "KeyError: 'no such key'"}]
    await bench.look(2)
    assert bench.asked[-1] == ("quick", "draw", 2)


@story
async def test_an_impossible_design_is_told_with_its_key(bench):
    await bench.look(3)
    await bench.calls[0].fail(SpecError("too long", key="bodies.coupler"))
    assert bench.said == [{"what": "impossible", "gen": 3, "key": "bodies.coupler", "message": "in words: bodies.coupler: too long"}]
    await bench.look(4)
    await bench.calls[-1].fail(DoesNotAssemble("the loop stays open"))
    assert bench.said[-1] == {"what": "impossible", "gen": 4, "key": "", "message": "in words: the loop stays open"}
    await bench.look(5)
    await bench.calls[-1].fail(SpecError("nowhere"))
    assert bench.said[-1]["key"] == ""


@story
async def test_the_first_design_with_a_solution_takes_the_complaint_back(bench):
    await bench.look(1)
    await bench.calls[0].fail(DoesNotAssemble("the loop stays open"))
    for gen in (2, 3):
        await bench.look(gen)
        await bench.calls[-1].answer(None)
    assert bench.told("possible") == [{"what": "possible", "gen": 2}]


@story
async def test_a_design_without_a_solution_is_not_analysed(bench):
    for gen, error in enumerate((WorkerDied("x"), SpecError("y"), WorkerFault("z"))):
        await bench.look(gen)
        await bench.calls[-1].fail(error)
        if isinstance(error, WorkerDied):
            await bench.calls[-1].fail(error)
    assert {function for _, function, _ in bench.asked} == {"draw"}


def test_a_drawing_that_takes_long_says_so_and_is_given_up_at_last(bench, monkeypatch):
    monkeypatch.setattr(computations, "SLOW", 0.05)
    monkeypatch.setattr(computations, "PATIENCE", 0.2)

    async def tell():
        await bench.look(1)
        await bench.look(2)
        await asyncio.sleep(0.1)
        assert [(message["state"], message["text"]) for message in bench.said] == [("analysing", "drawing")]
        assert bench.calls[0].stopped is None
        await asyncio.sleep(0.2)
        assert bench.calls[0].stopped == (Cancellation.NOW,) and bench.said[1] == {"what": "work", "state": "stopped", "text": ""}
        assert bench.asked[1:] == [("quick", "draw", 2)]  # and the newer one has its turn
        await bench.calls[1].answer(None)
        bench.said.clear()
        await asyncio.sleep(0.3)
        assert bench.said == []  # what is drawn in time says nothing
        bench.computing.close()
        await settled()

    loops.run(tell())


@story
async def test_a_person_ends_a_drawing_and_begins_it_again(bench):
    await bench.look(1)
    bench.computing.cancel()
    await settled()
    assert bench.calls[0].stopped == (Cancellation.NOW,) and bench.said == [{"what": "work", "state": "stopped", "text": ""}]
    assert len(bench.calls) == 1  # a drawing that was ended is not analysed
    bench.computing.analyse()
    await settled()
    assert bench.asked[1:] == [("quick", "draw", 1)]


@story
async def test_what_is_shown_is_outdated_by_a_newer_design_once(bench):
    await bench.look(1)
    assert bench.told("outdated") == []
    await bench.calls[0].answer(None)
    await bench.calls[1].answer(found("motion"))
    await bench.look(2)
    await bench.look(3)
    assert bench.told("outdated") == [{"what": "outdated"}]


# -- the analyses --------------------------------------------------------------------------------------------------------------


@story
async def test_analyses_tell_how_far_they_are_and_what_they_took(bench):
    await bench.look(1)
    await bench.calls[0].answer(None)
    bench.said.clear()
    place = {"what": "work", "state": "analysing", "text": "forces", "done": 1, "total": 2}
    for compiling in ("", "compiling kernels", ""):
        bench.calls[1].send((1, 2, "forces", compiling))
    assert bench.said == [place | {"compiling": ""}, place | {"compiling": "compiling kernels"}, place | {"compiling": ""}]
    del bench.said[1:]
    await bench.calls[1].answer(found("motion", "forces", timings={"motion": 0.001, "forces": 3.0}))
    assert bench.said[1:] == [
        {"what": "result", "gen": 1, "full": True, "result": found("motion", "forces", timings={"motion": 0.001, "forces": 3.0})},
        {"what": "work", "state": "idle", "text": ""},
    ]


async def too_slow(bench, *begun):
    """Analyses that take too long after some of them have begun."""
    for done, name in enumerate(begun):
        bench.calls[-1].send((done, 2, name, ""))
    await bench.calls[-1].fail(CallTimedOut("this took more than 120 s and was ended"))


@story
async def test_an_analysis_that_takes_too_long_is_named_and_the_others_keep_their_answers(bench):
    await bench.look(1)
    await bench.calls[0].answer(None)
    assert bench.calls[1].limit == computations.ANALYSIS
    await too_slow(bench, "motion", "forces")
    assert bench.calls[2].arguments[1] == ["motion"] and bench.calls[2].limit == computations.ANALYSIS
    await bench.calls[2].answer(found("motion", timings={"motion": 0.1}))
    assert bench.said[-2:] == [
        {"what": "result", "gen": 1, "full": False, "result": found("motion", timings={"motion": 0.1})},
        {"what": "work", "state": "over", "text": "forces", "seconds": computations.ANALYSIS},
    ]


@story
async def test_a_person_lets_it_run_longer_and_the_next_design_does_not(bench):
    await bench.look(1)
    await bench.calls[0].answer(None)
    await too_slow(bench, "motion")
    assert bench.said[-1]["state"] == "over" and len(bench.calls) == 2  # nothing was ready
    bench.computing.analyse(longer=True)
    await settled()
    await bench.calls[2].answer(None)
    assert bench.calls[3].function == "analyse" and bench.calls[3].limit == 10 * computations.ANALYSIS
    await bench.look(2)
    await bench.calls[-1].answer(None)
    assert bench.calls[-1].function == "analyse" and bench.calls[-1].limit == computations.ANALYSIS


@story
async def test_what_is_too_slow_even_without_its_last_is_told_once(bench):
    await bench.look(1)
    await bench.calls[0].answer(None)
    await too_slow(bench, "motion", "forces")
    await too_slow(bench, "motion")
    assert [message["state"] for message in bench.told("work")].count("over") == 1 and not bench.told("result")


@story
async def test_while_others_wait_a_drawing_comes_alone(bench):
    await bench.look(1)
    await bench.calls[0].answer(None)
    await bench.calls[1].answer(found("motion", "forces", timings={"motion": 0.001, "forces": 0.002}))
    bench.quick.crowded = True
    await bench.look(2)
    assert bench.calls[-1].function == "draw" and list(bench.calls[-1].arguments[1]) == []
    bench.quick.crowded = False
    await bench.look(3)
    await bench.calls[-1].answer(None)
    assert list(bench.calls[-1].arguments[1]) == ["motion", "forces"]


@story
async def test_while_a_person_builds_a_drawing_comes_alone(bench):
    """What is built is not assembled yet: nothing is computed of it, however quick that is."""
    bench.computing._seconds = {"motion": 0.001}
    bench.computing.building = True
    await bench.look(1)
    assert (bench.calls[0].arguments[1], bench.calls[0].arguments[2]) == ([], True)
    await bench.calls[0].answer(None)
    bench.computing.building = False
    await bench.look(2)
    drawing = next(call for call in bench.calls if call.function == "draw" and call.arguments[0].gen == 2)
    assert (drawing.arguments[1], drawing.arguments[2]) == (["motion"], False)


@story
async def test_what_a_hand_moves_is_drawn_quickly_and_drawn_in_full_when_it_rests(bench):
    computations.registry.mechanism(KIND).quick_scene = object()
    for gen in (1, 2):
        bench.computing.update(gen, SimpleNamespace(kind=KIND, gen=gen), moving=True)
        await settled()
        assert bench.calls[-1].function == "draw" and bench.calls[-1].arguments[3] is True
        await bench.calls[-1].answer(None)
    assert bench.asked[-1] == ("quick", "draw", 2) and bench.calls[-1].arguments[3] is False
    await bench.calls[-1].answer(None)
    assert bench.asked[-1] == ("heavy", "analyse", 2)
    await bench.look(3)
    assert bench.calls[-1].arguments[3] is False


async def moved(bench, gen):
    """The drawing of a design that a hand moves, drawn."""
    bench.computing.update(gen, SimpleNamespace(kind=KIND, gen=gen), moving=True)
    await settled()
    drawing = bench.calls[-1]
    await drawing.answer(None)
    return drawing


@story
async def test_analyses_of_what_a_hand_moves_run_beside_its_drawings(bench):
    bench.computing._seconds = {"motion": 0.001, "forces": 0.002}
    computations.registry.mechanism(KIND).quick_scene = None

    def rounds():
        return [call for call in bench.calls if call.function == "glance"]

    assert list((await moved(bench, 1)).arguments[1]) == []
    (beside,) = rounds()
    assert (beside.pool, beside.arguments[0].gen, list(beside.arguments[1])) == ("heavy", 1, ["motion", "forces"])
    for gen in (2, 3):
        await moved(bench, gen)
    assert rounds() == [beside], "one round at a time"
    await beside.answer(found("motion", "forces"))
    assert bench.told("result") == [{"what": "result", "gen": 1, "full": False, "result": found("motion", "forces")}]
    await moved(bench, 4)
    assert [call.arguments[0].gen for call in rounds()] == [1, 4]


@story
async def test_analyses_beside_a_drawing_that_fail_say_nothing(bench):
    """The drawing does, or the analyses of the design at rest."""
    bench.computing._seconds = {"motion": 0.001}
    computations.registry.mechanism(KIND).quick_scene = None
    await moved(bench, 1)
    before = list(bench.said)
    await next(call for call in bench.calls if call.function == "glance").fail(DoesNotAssemble("the loop stays open"))
    assert bench.said == before and bench.computing._glance_task is None


def test_after_analyses_beside_a_drawing_the_processor_belongs_to_others(bench, monkeypatch):
    """For so many times as long as they took: here for ever, and also after a round that failed."""
    monkeypatch.setattr(computations, "SHARE", 1e12)

    async def rounds(ends):
        bench.computing._seconds = {"motion": 0.001}
        computations.registry.mechanism(KIND).quick_scene = None
        for gen in (1, 2):
            await moved(bench, gen)
            if gen == 1:
                await ends(next(call for call in bench.calls if call.function == "glance"))
        return [call.arguments[0].gen for call in bench.calls if call.function == "glance"]

    assert loops.run(rounds(lambda call: call.answer(found("motion")))) == [1]
    bench.calls.clear()
    bench.computing._quick_from = -1e9
    assert loops.run(rounds(lambda call: call.fail(DoesNotAssemble("open")))) == [1]


def test_of_drawings_in_quick_succession_only_some_come_with_analyses(bench, monkeypatch):
    monkeypatch.setattr(computations, "PACE", 0.3)

    async def tell():
        bench.computing._seconds = {"motion": 0.001, "forces": 0.002}
        for gen in (1, 2, 3):
            await bench.look(gen)
            yield list(bench.calls[-1].arguments[1])
            await bench.calls[-1].answer(found("motion", "forces") if gen == 1 else None)
        await asyncio.sleep(0.35)
        await bench.look(4)
        yield list(bench.calls[-1].arguments[1])

    async def collected():
        return [names async for names in tell()]

    assert loops.run(collected()) == [["motion", "forces"], [], [], ["motion", "forces"]]


def test_a_design_is_analysed_when_it_has_rested_only(bench, monkeypatch):
    monkeypatch.setattr(computations, "REST", 0.05)

    async def tell():
        for gen in (1, 2):
            await bench.look(gen)
            await bench.calls[-1].answer(None)
        assert bench.asked == [("quick", "draw", 1), ("quick", "draw", 2)]
        await asyncio.sleep(0.2)
        assert bench.asked[2:] == [("heavy", "analyse", 2)]  # and none of the first
        assert not bench.told("work")  # which had not begun, so that it was not stopped either

    loops.run(tell())


@story
async def test_a_newer_look_ends_the_analyses_which_may_clear_up(bench):
    await bench.look(1)
    await bench.calls[0].answer(None)
    assert bench.asked[-1] == ("heavy", "analyse", 1)
    await bench.look(2)
    assert bench.calls[1].stopped is not None and Cancellation.NOW not in bench.calls[1].stopped
    assert bench.told("work") == [{"what": "work", "state": "drawing", "text": ""}]
    await bench.calls[2].answer(None)
    assert bench.asked[2:] == [("quick", "draw", 2), ("heavy", "analyse", 2)]
    assert not bench.told("result")


@story
async def test_older_analyses_that_end_late_say_nothing(bench):
    await bench.look(1)
    await bench.calls[0].answer(None)
    bench.calls[1].clearing = asyncio.Event()  # it compiles, and hears nothing
    await bench.look(2)
    await bench.calls[2].answer(None)
    await bench.calls[3].answer(found("motion"))
    bench.calls[1].clearing.set()
    await settled()
    assert bench.said[-1] == {"what": "work", "state": "idle", "text": ""}


@story
async def test_a_person_ends_the_analyses_at_once(bench):
    bench.computing.cancel()  # nothing yet
    await bench.look(1)
    await bench.calls[0].answer(None)
    bench.computing.cancel()
    await settled()
    assert bench.calls[1].stopped == (Cancellation.NOW,)
    assert bench.told("work") == [{"what": "work", "state": "stopped", "text": ""}]
    bench.computing.cancel()
    await settled()
    assert len(bench.told("work")) == 1
    bench.computing.analyse()
    bench.computing.analyse()
    await settled()
    assert bench.asked[2:] == [("quick", "draw", 1)]  # once more from the beginning, and one is enough


@story
async def test_any_number_of_newer_looks_is_one_request_to_stop(bench):
    await bench.look(1)
    await bench.calls[0].answer(None)
    bench.calls[1].clearing = asyncio.Event()  # a second cancellation would not let it clear up
    for gen in (2, 3, 4):
        await bench.look(gen)
    assert bench.busy == 2
    bench.calls[1].clearing.set()
    await settled()
    assert bench.busy == 1


@story
async def test_analyses_asked_for_while_it_is_drawn_wait_for_the_drawing(bench):
    await bench.look(1)
    bench.computing.analyse()
    await settled()
    assert bench.asked == [("quick", "draw", 1)]


@story
async def test_no_result_of_an_older_design_after_a_newer_one(bench):
    await bench.look(1)
    await bench.calls[0].answer(None)
    bench.calls[1].end.set_result(found("motion", timings={"motion": 0.001}))  # just arrived, and not yet seen
    await bench.look(2)
    assert bench.told("result") == []
    await bench.calls[2].answer(None)
    await bench.calls[3].answer(found("motion", value=2.0, timings={"motion": 0.001}))
    assert [(message["gen"], message["result"]["checks"][0]["value"]) for message in bench.told("result")] == [(2, 2.0)]


@story
async def test_an_answer_of_an_older_design_is_not_the_full_result_of_the_newest(bench):
    """Nor is it what a later design is compared with."""
    bench.computing.update(2, SimpleNamespace(kind=KIND, gen=2))
    bench.computing._show(1, found("motion"))
    assert [(message["gen"], message["full"]) for message in bench.told("result")] == [(1, False)]
    bench.computing._show(2, found("motion"))
    assert bench.told("result")[-1]["full"] is True


@story
async def test_analyses_that_find_the_design_impossible_come_to_rest(bench):
    await bench.look(1)
    await bench.calls[0].answer(None)
    await bench.calls[1].fail(SpecError("no film", key="oil"))
    assert bench.said[-2:] == [
        {"what": "impossible", "gen": 1, "key": "oil", "message": "in words: oil: no film"},
        {"what": "work", "state": "idle", "text": ""},
    ]


@pytest.mark.parametrize(
    ("error", "text"), [(WorkerDied("gone"), "in words: gone"), (WorkerFault("Traceback\nValueError: x"), "ValueError: x")]
)
def test_analyses_that_end_badly_are_told(bench, error, text):
    @story
    async def tell(bench):
        await bench.look(1)
        await bench.calls[0].answer(None)
        await bench.calls[1].fail(error)
        assert bench.said[-1] == {"what": "work", "state": "lost", "text": text}
        assert len(bench.calls) == 2

    tell(bench)


# -- what goes with every drawing ----------------------------------------------------------------------------------------------


@story
async def test_quick_analyses_go_with_the_drawing_and_renew_what_is_shown(bench):
    await bench.look(1)
    assert bench.calls[0].arguments[1] == []  # nobody knows yet what they take
    await bench.calls[0].answer(None)
    whole = found("motion", "forces")
    await bench.calls[1].answer({**whole, "timings": {"motion": 0.001, "forces": 3.0}})
    await bench.look(2)
    assert bench.calls[2].arguments[1] == ["motion"]
    await bench.calls[2].answer(found("motion", value=2.0))
    shown = bench.told("result")[-1]
    assert (shown["gen"], shown["full"]) == (2, False)
    assert shown["result"]["checks"] == [{"name": "motion", "value": 2.0}, {"name": "forces", "value": 1.0, "stale": True}]
    await bench.look(3)
    await bench.calls[-1].answer(found("motion", value=3.0))
    assert [check["value"] for check in bench.told("result")[-1]["result"]["checks"]] == [3.0, 1.0]
    renewed = found("motion", "forces", value=3.0, timings={"motion": 0.001, "forces": 3.0})
    await bench.calls[-1].answer(renewed)
    assert bench.told("result")[-1] == {"what": "result", "gen": 3, "full": True, "result": renewed}
    assert whole == found("motion", "forces")  # nobody wrote into what was shown


@story
async def test_the_first_quick_result_is_shown_as_it_is(bench):
    bench.computing._seconds = {"motion": 0.02, "forces": 1e-4}
    await bench.look(1)
    assert bench.calls[0].arguments[1] == ["forces"]  # both together are over the budget
    await bench.calls[0].answer(found("forces"))
    assert bench.told("result") == [{"what": "result", "gen": 1, "full": False, "result": found("forces")}]


@story
async def test_another_design_has_nothing_of_the_one_before(bench):
    bench.computing._seconds = {"motion": 0.001}
    await bench.look(1)
    await bench.calls[0].answer(found("motion"))
    await bench.calls[1].answer(found("motion", "forces", timings={"motion": 0.001}))
    bench.computing.reset(2)
    await bench.look(2)
    await bench.calls[-1].answer(found("motion", value=2.0))
    assert bench.told("result")[-1]["result"] == found("motion", value=2.0)


@story
async def test_a_drawing_of_the_design_before_leaves_nothing_in_the_next_one(bench):
    bench.computing._seconds = {"motion": 0.001}
    await bench.look(1)
    bench.computing.reset(2)
    await bench.look(2)
    await bench.calls[0].answer(found("motion", "forces"))
    await bench.calls[1].answer(found("motion", value=2.0))
    assert bench.told("result")[-1]["result"] == found("motion", value=2.0)


# -- another design to compare with --------------------------------------------------------------------------------------------


@story
async def test_a_reference_is_drawn_and_analysed(bench):
    bench.computing.compare_with("quick-return", SimpleNamespace(kind=KIND, gen="other"))
    await settled()
    assert bench.asked == [("heavy", "draw", "other")] and bench.calls[0].arguments[1] == ()
    bench.calls[0].send('{"scene": 1}')
    await bench.calls[0].answer(None)
    assert bench.asked[1:] == [("heavy", "analyse", "other")] and bench.said == []
    await bench.calls[1].answer(found("motion", timings={"motion": 9.0}))
    assert bench.said == [
        {"what": "reference", "title": "quick-return", "json": '{"scene": 1}', "result": found("motion", timings={"motion": 9.0})}
    ]


@pytest.mark.parametrize(
    ("error", "message"),
    [
        (DoesNotAssemble("open loop"), {"what": "refused", "key": "", "text": "", "message": "in words: open loop"}),
        (WorkerFault("Traceback\nKeyError: 1"), {"what": "work", "state": "lost", "text": "KeyError: 1"}),
    ],
)
def test_a_reference_that_is_none(bench, error, message):
    @story
    async def tell(bench):
        bench.computing.compare_with("x", SimpleNamespace(kind=KIND, gen="other"))
        await settled()
        await bench.calls[0].fail(error)
        assert bench.said == [message]

    tell(bench)


def numbered(value):
    numbers = {"values": {"lift": (value, "m", None, None, "Stroke")}, "checks": {}}
    return {**found("motion"), "numbers": numbers}


async def analysed(bench, gen, value):
    await bench.look(gen)
    await bench.calls[-1].answer(None)
    await asyncio.sleep(0.01)
    await bench.calls[-1].answer(numbered(value))


@story
async def test_what_follows_is_told_apart_from_the_pinned_design(bench):
    await analysed(bench, 1, 20e-3)
    assert "differences" not in bench.told("result")[-1]["result"]
    bench.computing.pin(1)
    await analysed(bench, 2, 25e-3)
    assert bench.told("result")[-1]["result"]["differences"]["values"] == {"lift": "+5\u00a0mm (+25\u00a0%)"}
    bench.computing.pin(None)
    await analysed(bench, 3, 26e-3)
    assert "differences" not in bench.told("result")[-1]["result"]
    bench.computing.pin(1)  # it is no longer the newest full result
    await analysed(bench, 4, 27e-3)
    assert "differences" not in bench.told("result")[-1]["result"]


@story
async def test_what_is_shown_is_told_apart_from_a_preset_at_once(bench):
    await analysed(bench, 1, 20e-3)
    bench.computing.compare_with("other", SimpleNamespace(kind=KIND, gen="other"))
    await settled()
    bench.calls[-1].send("{}")
    await bench.calls[-1].answer(None)
    await bench.calls[-1].answer(numbered(10e-3))
    assert bench.told("differences")[-1]["differences"]["values"] == {"lift": "+10\u00a0mm (+100\u00a0%)"}
    bench.computing.reset(2)
    await analysed(bench, 2, 20e-3)
    assert "differences" not in bench.told("result")[-1]["result"]


@story
async def test_the_last_reference_counts(bench):
    for gen in (1, 2):
        bench.computing.compare_with(str(gen), SimpleNamespace(kind=KIND, gen=gen))
        await settled()
    assert bench.calls[0].stopped == (Cancellation.NOW,) and bench.calls[1].stopped is None


# -- jobs ----------------------------------------------------------------------------------------------------------------------


async def begun(bench, name="study", gen=4, **options):
    bench.working.begin(name, gen, SimpleNamespace(kind=KIND, gen=gen), options)
    await settled()
    return bench.calls[-1]


def job(state, gen=4, name="study", **more):
    return {"what": "job", "name": name, "state": state, "gen": gen, **more}


@story
async def test_a_job_tells_its_way_with_the_generation_it_was_asked_for(bench):
    call = await begun(bench, points=3)
    await bench.look(5)
    assert call.pool == "jobs" and call.arguments[0] == "study" and call.arguments[1].gen == 4 and call.arguments[2] == {"points": 3}
    call.send((1, 3, "first", None))
    call.send((2, 3, "second", {"rows": 2}))
    await call.answer({"rows": 3})
    assert bench.told("job") == [
        job("running", done=0, total=0, text="", answer=None),
        job("running", done=1, total=3, text="first"),
        job("running", done=2, total=3, text="second", answer={"rows": 2}),
        job("done", text="", answer={"rows": 3}),
    ]


def test_in_its_process_a_job_is_called_by_its_name(monkeypatch):
    def toy(design, tell, points):
        tell(1, points)
        tell(2, points, "half", {"rows": 1})
        return design, points

    monkeypatch.setitem(tab_jobs.JOBS, "study", toy)
    news = []
    assert tab_jobs._work(news.append, "study", "design", {"points": 4}) == ("design", 4)
    assert news == [(1, 4, "", None), (2, 4, "half", {"rows": 1})]


@pytest.mark.parametrize(
    ("error", "text"),
    [
        (SpecError("no such value", key="values.x"), "in words: values.x: no such value"),
        (WorkerDied("gone"), "in words: gone"),
        (WorkerFault("Traceback\n  File\nKeyError: 'x'"), "KeyError: 'x'"),
    ],
)
def test_a_job_that_fails_says_why(bench, error, text):
    @story
    async def tell(bench):
        await (await begun(bench)).fail(error)
        assert bench.said[-1] == job("failed", text=text)
        assert len(bench.calls) == 1

    tell(bench)


@story
async def test_an_export_that_is_refused_for_its_geometry_can_be_asked_for_all_the_same(bench):
    await (await begun(bench)).fail(GeometryCheckFailed("undercut"))
    assert bench.said[-1] == job("failed", text="in words: undercut", overridable=True)


@story
async def test_a_job_is_cancelled_at_once_and_others_are_not(bench):
    study, solid = await begun(bench), await begun(bench, "solid")
    bench.working.cancel("study")
    bench.working.cancel("nothing")
    await settled()
    assert study.stopped == (Cancellation.NOW,) and solid.stopped is None
    assert bench.said[-1] == job("cancelled", text="")
    await solid.answer(1)
    bench.working.cancel("solid")  # too late: it is done
    await settled()
    assert bench.said[-1] == job("done", name="solid", text="", answer=1)


@story
async def test_a_job_of_the_same_name_takes_the_place_of_the_one_under_way(bench):
    first = await begun(bench)
    second = await begun(bench, gen=9)
    assert first.stopped == (Cancellation.NOW,) and second.stopped is None
    await second.answer("new")
    assert bench.said[-1] == job("done", gen=9, text="", answer="new")
    third = await begun(bench, gen=10)
    assert third is not second


@story
async def test_the_end_of_the_replaced_job_leaves_the_new_one_in_its_place(bench):
    first = await begun(bench)
    first.clearing = asyncio.Event()
    second = await begun(bench, gen=9)
    first.clearing.set()
    await settled()
    bench.working.cancel("study")  # reaches the new one
    await settled()
    assert second.stopped == (Cancellation.NOW,)


@story
async def test_a_replaced_job_says_nothing_after_the_new_one_has_begun(bench):
    first = await begun(bench)
    first.clearing = asyncio.Event()  # it takes a while until its process has stopped
    await begun(bench, gen=9)
    first.clearing.set()
    await settled()
    assert bench.told("job")[-1] == job("running", gen=9, done=0, total=0, text="", answer=None)


@story
async def test_files_become_addresses(bench):
    call = await begun(bench, "export")
    await call.answer({"files": [{"name": "cam.dxf", "data": b"0"}, {"name": "cam.svg", "data": b"1"}], "remarks": ["x"]})
    assert bench.said[-1]["answer"] == {
        "remarks": ["x"],
        "files": [{"name": "cam.dxf", "url": "/download/cam.dxf"}, {"name": "cam.svg", "url": "/download/cam.svg"}],
    }
    assert bench.offered == {"/download/cam.dxf": b"0", "/download/cam.svg": b"1"}


@pytest.mark.parametrize("answer", [None, [1, 2], "files", {"rows": []}])
def test_other_answers_stay_as_they_are(bench, answer):
    assert bench.working._downloaded(answer) is answer


# -- the end -------------------------------------------------------------------------------------------------------------------


@story
async def test_a_tab_that_closes_ends_all_that_is_under_way(bench):
    before = asyncio.all_tasks()
    await bench.look(1)
    await bench.calls[0].answer(None)
    study = await begun(bench)
    analysing = bench.calls[1]
    assert analysing.function == preview.analyse.__name__
    await bench.look(2)
    drawing = bench.calls[-1]
    bench.computing.compare_with("x", SimpleNamespace(kind=KIND, gen="other"))
    await settled()
    bench.computing.close()
    bench.working.cancel_all()
    await settled()
    assert None not in [call.stopped for call in (analysing, study, drawing, bench.calls[-1])]
    assert asyncio.all_tasks() == before


def test_closing_before_anything_was_looked_at(bench):
    bench.computing.close()


@story
async def test_another_drive_ends_the_comparison_and_keeps_the_drawing(bench):
    bench.computing.compare_with("x", SimpleNamespace(kind=KIND, gen="other"))
    await settled()
    await bench.look(1)
    bench.computing.reset(2)
    await settled()
    assert bench.calls[0].stopped == (Cancellation.NOW,) and bench.calls[1].stopped is None
