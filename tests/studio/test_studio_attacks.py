"""The studio under attack: pages that send what no page sends, connections that never end, processes that are killed."""

import asyncio
import json
import os
import re
import signal
import socket
import sys
import time
from contextlib import closing, suppress
from pathlib import Path

import loops
import pytest
from places import EXAMPLES
from studio_client import fetched, health, page
from studio_server import below, started

from drivewright.studio.opening import packed

pytestmark = [pytest.mark.interface, pytest.mark.needs_studio]

TEXT = (EXAMPLES / "four_bar.toml").read_text(encoding="utf-8")
# The same command with less patience.
HASTY = """
import sys
from drivewright import cli
from drivewright.studio import access, app, connections

app.AWAY, connections.HEADER_SECONDS, access.BODY_SECONDS, connections.MOST = 2.0, 1.0, 1.0, 60
sys.exit(cli.main())
"""


# The same command, which notes the processor time of all that happens between two beats of its loop, where that is much.
WATCHED = """
import asyncio, sys, tempfile, time
from pathlib import Path
from drivewright import cli
from drivewright.studio import app

class Watched(app.Tabs):
    def listen(self, sio):
        super().listen(sio)
        beat(open(Path(tempfile.gettempdir()) / "beats.txt", "a", buffering=1), time.process_time())

def beat(notes, last):
    now = time.process_time()
    if now - last > 0.01:
        print(now - last, file=notes)
    asyncio.get_running_loop().call_later(0.001, beat, notes, now)

app.Tabs = Watched
sys.exit(cli.main())
"""
PAUSE = 0.05  # seconds that one message may keep the loop


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    with started((tmp_path_factory.mktemp("attacked"), (sys.executable, "-c", WATCHED))) as (one,):
        loops.run(_warm(one.port))
        yield one


def longest_pause(server, attack):
    """(seconds) that the loop was kept by an attack, in the best of three: now and then other things happen between two beats."""
    notes, pauses = server.folder / "beats.txt", []
    while len(pauses) < 3 and min(pauses, default=1) > PAUSE:
        before = len(notes.read_text())
        loops.run(attack())
        pauses.append(max(map(float, notes.read_text()[before:].split()), default=0.0))
    return min(pauses)


async def _warm(port):
    async with page(port) as tab:
        await tab.until(lambda message: message["what"] == "result" and message["full"], 120)


@pytest.fixture
def hasty(tmp_path):
    with started((tmp_path, (sys.executable, "-c", HASTY))) as (one,):
        yield one


# -- one message ---------------------------------------------------------------------------------------------------------------

DOTTED = ".".join("a" * 100_000) + " = 1"
LARGE = {
    "a dotted key": {"what": "text", "toml": DOTTED},
    "a dotted key in an address": {"what": "hello", "shared": packed(DOTTED)},
    "a dotted key kept": {"what": "hello", "saved": DOTTED},
    "headers": {"what": "text", "toml": "\n".join(f"[a{n}.b.c]" for n in range(60_000))},
    "one deep header": {"what": "text", "toml": "[" + ".".join("a" * 200_000) + "]"},
    "arrays": {"what": "text", "toml": "a = " + "[" * 100_000},
    "a long array": {"what": "text", "toml": "a = [" + "1," * 450_000 + "]"},
    "a long text": {"what": "text", "toml": TEXT + f'title = "{"x" * 900_000}"'},
    "comments": {"what": "text", "toml": TEXT + "#" * 900_000},
    "a file": {"what": "open", "files": [{"name": "a.toml", "text": TEXT + "# x\n" * 200_000}]},
    "an address that unfolds": {"what": "hello", "shared": packed("x" * 50_000_000)},
    "a key": {"what": "set", "key": ".".join("a" * 400_000), "text": "1"},
    "a value": {"what": "set", "key": "drive.speed", "text": "1" * 900_000},
    "names": {"what": "load", "changes": {f"a{n}": "1" for n in range(60_000)}},
    "a study of many keys": {"what": "begin", "name": "study", "table": {"vary": [{"key": "drive.speed", "steps": 2}] * 30_000}},
    "a search of long texts": {
        "what": "begin",
        "name": "optimise",
        "table": {"unknowns": [{"key": "a." * 200_000, "lower": "1" * 400_000}]},
    },
    "a table of a search": {"what": "begin", "name": "study", "table": {f"a{n}": 1 for n in range(60_000)}},
    "lists": {"what": "load", "changes": [[]] * 250_000},
    "elements": {"what": "arrange", "list": "joints", "elements": [{"of": 0, "changes": {}}] * 30_000},
    "an element again and again": {"what": "arrange", "list": "joints", "elements": [{"of": 0, "changes": {}}] * 1_200},
    "what a handle moves": {"what": "drag", "changes": {f"a{n}": "1 mm" for n in range(60_000)}, "gesture": "g"},
    "a long text of a handle": {"what": "drag", "changes": {"drive.speed": "1" * 900_000}, "gesture": "g" * 90_000},
    "places": {"what": "construct", "tool": "body", "places": [[0, 0]] * 30_000, "near": 0.001},
    "a place of many parts": {"what": "construct", "tool": "pin", "places": [[0.0] * 60_000], "near": 0.001},
    "options": {"what": "job", "name": "fix", "options": {"check": "x" * 900_000}},
    "a list of analyses": {"what": "job", "name": "figures", "options": {"analyses": ["x" * 200] * 4_000}},
    "a table's name": {"what": "put", "table": "a." * 400_000},
    "deep parts": {"what": "arrange", "list": "joints", "elements": json.loads("[" * 900 + "]" * 900)},
    "a new element": {"what": "arrange", "list": "joints", "elements": [{"of": None, "changes": {".".join("a" * 200): "1" * 9_000}}] * 90},
}


def _with_points(number):
    """The four-bar, with a form of two more fields for each point."""
    points = ", ".join(f'P{n} = ["{n} mm", "1 mm"]' for n in range(number))
    return {"what": "text", "toml": TEXT.replace("points = { A", f"points = {{ {points}, A", 1)}


LARGE["a form"], LARGE["a form that is too large"] = _with_points(1200), _with_points(1700)


async def _answered(tab):
    """Three steps of somebody else."""
    for step in range(3):
        tab.heard.clear()
        await tab.say("set", key="drive.speed", text=f"{200 + step} rpm")
        await tab.until(lambda message: message["what"] == "values", 10)


@pytest.mark.parametrize("name", LARGE)
def test_no_message_keeps_the_server_from_answering_others(server, name):
    """A second tab keeps asking meanwhile."""

    async def attack():
        async with page(server.port) as tab, page(server.port) as other, health(server.port) as seconds:
            await asyncio.sleep(0.2)
            seconds.clear()
            tab.heard.clear()
            await tab.argue(json.dumps(LARGE[name]))
            await _answered(other)
            await tab.until(lambda message: message["what"] in ("refused", "design", "values"), 120)
            await tab.say("again")
            await tab.until(lambda message: message["what"] == "design", 120)
            assert max(seconds) < 2

    assert longest_pause(server, attack) < PAUSE
    assert "Traceback" not in server.said()


SURROGATE = "\\ud800"
ODD = [
    "",
    "null",
    "nonsense",
    "{",
    "[]",
    '"set"',
    "NaN",
    "1e999",
    "[" * 100_000,
    '{"what": "set", "key": "title", "text": "SURROGATE"}',
    '{"what": "text", "toml": "SURROGATE"}',
    '{"what": "text", "toml": "# SURROGATE"}',
    '{"what": "hello", "saved": "SURROGATE"}',
    '{"what": "hello", "shared": "d=SURROGATE"}',
    '{"what": "open", "files": [{"name": "SURROGATE.toml", "text": "x"}]}',
    '{"what": "load", "changes": {"SURROGATE": "1"}}',
    '{"what": "job", "name": "SURROGATE"}',
    '{"what": "fresh", "kind": "SURROGATE"}',
    '{"SURROGATE": 1, "what": "undo"}',
    '{"what": "set", "key": "drive.speed", "text": 1e400}',
    '{"what": "drop", "list": "joints", "index": NaN}',
    '{"what": "drop", "list": "joints", "index": -1}',
    '{"what": "drop", "list": "joints", "index": ' + "9" * 400 + "}",
    '{"what": "drop", "list": "joints", "index": [1]}',
    '{"what": "drop", "list": {}, "index": 0}',
    '{"what": "lock", "key": null, "on": "x"}',
    '{"what": "propose", "name": "SURROGATE"}',
    '{"what": "begin", "name": "study", "table": {"points": "/etc/passwd"}}',
    '{"what": "begin", "name": "study", "table": {"vary": [{"key": "SURROGATE"}]}}',
    '{"what": "begin", "name": "study", "table": {"vary": [{"key": "drive.speed", "steps": "' + "9" * 5000 + '"}]}}',
    '{"what": "begin", "name": "optimise", "table": {"unknowns": [[[]]]}}',
    '{"what": "begin", "name": "optimise", "table": null}',
    '{"what": "job", "name": "fix", "options": {"check": {}, "seconds": 1e9}}',
    '{"what": "construct"}',
    '{"what": "construct", "tool": "SURROGATE", "places": [[0, 0]], "near": 0.001}',
    '{"what": "construct", "tool": "pin", "places": "abc", "near": 0.001}',
    '{"what": "construct", "tool": "pin", "places": [[1e999, 0]], "near": 0.001}',
    '{"what": "construct", "tool": "pin", "places": [[0, 0, 0]], "near": 0.001}',
    '{"what": "construct", "tool": "pin", "places": [[0, 0]], "near": -1}',
    '{"what": "construct", "tool": "pin", "places": [[0, 0]], "near": {}}',
    '{"what": "construct", "tool": "__class__", "places": [[0, 0]], "near": 0.001}',
    '{"what": "construct", "tool": "body", "places": [' + ", ".join("[0, 0]" for _ in range(2000)) + '], "near": 0.001}',
    '{"what": "construct", "tool": "drive", "places": [[1e999, 0]], "near": 0.001}',
    '{"what": "construct", "tool": "drive", "places": [[0, 0], [0, 0]], "near": 1e5}',
    '{"what": "construct", "tool": "drive", "places": [[0, 0]], "near": 5e-324}',
    '{"what": "sketch"}',
    '{"what": "sketch", "on": [1], "more": 2}',
    '{"what": "source", "text": "x"}',
    '{"what": "text", "toml": 3}',
    '{"what": "text"}',
    '{"what": "text", "toml": "", "toml ": ""}',
    '{"what": "load", "changes": [["a"]]}',
    '{"what": "open", "files": "abc"}',
    '{"what": "open", "files": [{"name": null, "text": null}]}',
    '{"what": "open", "files": [{"name": "a\\u0000.toml", "text": "x"}]}',
    '{"what": "hello", "files": ["x"], "saved": "x"}',
    '{"what": "hello", "files": "../..", "saved": "x = 1"}',
    '{"what": "job", "name": ["study"], "options": {}}',
    '{"what": "job", "name": "figures", "options": [1]}',
    '{"what": "job", "name": "export", "options": {"format": {"a": []}}}',
    '{"what": "export", "format": "\\u0000"}',
    '{"what": "reference", "preset": "../../x"}',
    '{"what": "pin", "gen": [{}]}',
    '{"what": "preset", "name": {"a": 1}}',
    '{"what": "fresh", "kind": 7, "preset": []}',
    '{"what": "cancel"}',
    '{"what": "cancel", "name": ["look"]}',
    '{"what": "analyse", "longer": {"x": 1}}',
    '{"what": "read", "text": "x"}',
    '{"what": "__init__"}',
    '{"what": {"a": 1}}',
    '{"what": "arrange"}',
    '{"what": "arrange", "list": "joints", "elements": 3}',
    '{"what": "arrange", "list": "joints", "elements": [3]}',
    '{"what": "arrange", "list": "joints", "elements": [{"of": 0}]}',
    '{"what": "arrange", "list": "joints", "elements": [{"of": -1, "changes": {}}]}',
    '{"what": "arrange", "list": "joints", "elements": [{"of": [0], "changes": {}}]}',
    '{"what": "arrange", "list": "joints", "elements": [{"of": 0.5, "changes": {}}]}',
    '{"what": "arrange", "list": "joints", "elements": [{"of": true, "changes": []}]}',
    '{"what": "arrange", "list": "joints", "elements": [{"of": 0, "changes": {"name": ""}}]}',
    '{"what": "arrange", "list": "joints", "elements": [{"of": null, "changes": {"SURROGATE": "1"}}]}',
    '{"what": "arrange", "list": "drive", "elements": []}',
    '{"what": "arrange", "list": "bodies", "elements": []}',
    '{"what": "arrange", "list": {"a": 1}, "elements": []}',
    '{"what": "drag", "changes": {"a.b": "1"}, "gesture": {"a": 1}}',
    '{"what": "revert", "gesture": [1]}',
    '{"what": "revert", "gesture": "of nobody"}',
    '{"what": "drag", "changes": {"drive.speed": "NaN rpm"}, "gesture": "g"}',
    '{"what": "drag", "changes": {"drive.speed": "1e999 rpm"}, "gesture": "g"}',
    '{"what": "drag", "changes": {"drive.speed": NaN}, "gesture": "g"}',
    '{"what": "drag", "changes": {"__class__": "1 mm"}, "gesture": "g"}',
    '{"what": "drag", "changes": {"../../x": "1"}, "gesture": "g"}',
    '{"what": "drag", "changes": {"": "1 mm"}, "gesture": ""}',
    '{"what": "drag", "changes": {"SURROGATE": "1 mm"}, "gesture": "SURROGATE"}',
    '{"what": "put", "table": "__class__"}',
    '{"what": "put", "table": "mechanism"}',
    '{"what": "put", "table": "bodies.<img src=x onerror=alert(1)>"}',
    '{"what": "put", "table": ["bodies"]}',
    '{"what": "take", "table": "mechanism"}',
    '{"what": "take", "table": "bodies"}',
    '{"what": "take", "table": {"a": 1}}',
    '{"what": "add", "list": "__class__"}',
    '{"what": "propose", "options": {}}',
    '{"what": "begin", "name": "study", "table": {"method": "__import__(\'os\').system(\'id\')"}}',
    '{"what": "begin", "name": "study", "table": {"vary": [{"key": "drive.speed", "values": ["/etc/passwd", "../../x"]}]}}',
    '{"what": "begin", "name": "study", "table": {"vary": [{"key": "drive.speed", "lower": "NaN rpm", "upper": "9 rpm", "steps": 2}]}}',
    '{"what": "begin", "name": "study", "table": {"vary": [{"key": "drive.speed", "lower": "1 rpm", "upper": "2 rpm", "steps": 2000000}]}}',
    '{"what": "begin", "name": "study", "table": {"samples": 9007199254740992, "method": "random"}}',
    '{"what": "begin", "name": "study", "table": {"__class__": 1}}',
    '{"what": "begin", "name": "study", "table": {"vary": [{"key": "drive.speed", "as_written": 1}]}}',
    '{"what": "begin", "name": "optimise", "table": {"objectives": [{"value": "().__class__.__mro__", "goal": "minimise"}]}}',
    '{"what": "begin", "name": "optimise", "table": {"unknowns": [{"key": "drive.speed", "lower": "1 rpm", "upper": "2 rpm"}], '
    '"objectives": [{"value": "x", "goal": "minimise"}], "requirements": [{"value": "x", "at_least": "__import__(\'os\')"}]}}',
    '{"what": "begin", "name": "optimise", "table": {"method": "../../x", "population": -1, "generations": 1e300}}',
    '{"what": "begin", "name": "__class__", "table": {}}',
    '{"what": "begin", "name": "study", "table": {}, "options": {"folder": "/tmp/x"}}',
    '{"what": "job", "name": "fix"}',
    '{"what": "job", "name": "fix", "options": {"check": "__class__"}}',
    '{"what": "job", "name": "fix", "options": {"check": "SURROGATE"}}',
    '{"what": "job", "name": "fix", "options": {"check": {}, "longer": []}}',
    '{"what": "job", "name": "reach"}',
    '{"what": "job", "name": "reach", "options": {"value": "__class__", "target": "1"}}',
    '{"what": "job", "name": "reach", "options": {"value": "SURROGATE", "target": "1e999 mm"}}',
    '{"what": "job", "name": "reach", "options": {"value": {}, "target": [], "seconds": 1e9}}',
    '{"what": "job", "name": "timing", "options": {"check": "x"}}',
    '{"what": "job", "name": "figures", "options": {"analyses": [{}]}}',
    '{"what": "job", "name": "figures", "options": {"analyses": ["../../x"]}}',
    '{"what": "job", "name": "figures", "options": {"theme": "<script>"}}',
    '{"what": "construct", "tool": "body", "places": [[NaN, 0], [0, 1]], "near": 0.001}',
    '{"what": "construct", "tool": "body", "places": [[1e300, 0], [0, 1]], "near": 0.001}',
    '{"what": "construct", "tool": "body", "places": [["0", true], [[], {}]], "near": 0.001}',
    '{"what": "construct", "tool": "slide", "places": [[0, 0], [0, 0]], "near": 1e5}',
    '{"what": "construct", "tool": "pin", "places": [[0, 0]], "near": 5e-324}',
    '{"what": "job", "name": "report", "options": {"solids": "yes"}}',
    '{"what": "job", "name": "report", "options": {"language": "../../zh"}}',
    '{"what": "job", "name": "report", "options": {"language": ["zh"], "folder": "/tmp"}}',
    '{"what": "names"}',
    '{"what": "hints", "kind": "../cam"}',
    '{"what": "hints", "language": ["zh"]}',
    '{"what": "names", "list": "__class__"}',
    '{"what": "names", "list": "SURROGATE"}',
    '{"what": "names", "list": ["bearings"]}',
    '{"what": "pick", "key": "bearings.A.bearing"}',
    '{"what": "pick", "key": "__class__.bearing", "text": "6306"}',
    '{"what": "pick", "key": "title", "text": "SURROGATE"}',
    '{"what": "pick", "key": {"a": 1}, "text": "6306"}',
]
ODD = [odd.replace("SURROGATE", SURROGATE) for odd in ODD]
FRAMES = [
    "",
    "4",
    "42",
    "42{",
    "42[",
    "42[]",
    '42["event"]',
    '42["event",null]',
    '42["event",[]]',
    '42["event",{"client_id":["x"],"args":["{}"]}]',
    '42["event",{"client_id":{},"args":["{}"]}]',
    '42["event",{"client_id":"ID","args":null}]',
    '42["event",{"client_id":"ID","args":[null]}]',
    '42["event",{"client_id":"ID","args":[{"what":"undo"}]}]',
    '42["event",{"client_id":"ID","args":{"0":"x"}}]',
    '42["event",{"client_id":"ID","args":["{}"]},1,2,3]',
    '42["event",{"client_id":"ID","args":["\\ud800"]}]',
    '42["handshake"]',
    '42["handshake",{}]',
    '42["handshake",{"client_id":[]}]',
    '42["ack",{"client_id":"ID"}]',
    '42["ack",{"client_id":"ID","next_message_id":"x"}]',
    '42["log",{"client_id":"ID","level":"error","message":"Traceback (most recent call last)"}]',
    '42["log",{"client_id":"ID","level":["x"]}]',
    '42["javascript_response",{"client_id":"ID"}]',
    '42["connect"]',
    '42["disconnect"]',
    '42["no such thing",1]',
    "42[1,2]",
    "42[null]",
    "42" + "[" * 40_000,
    '42/elsewhere,["event"]',
    "40/elsewhere",
    "43[]",
    "43999[1]",
    "44",
    "47",
    "4nonsense",
    b"4\xff",
    "9",
    "x",
    "3",
    "3probe",
    "5",
    "6",
]


def test_odd_arguments_are_answered_in_one_line_and_the_session_lives(server):
    async def attack():
        async with page(server.port) as tab:
            for odd in ODD:
                tab.heard.clear()
                await tab.argue(odd)
                await tab.say("again")
                await tab.until(lambda message: message["what"] == "design", 60)
                for _, message in tab.heard:
                    if message["what"] == "refused":
                        assert message["message"] and "\n" not in message["message"] and len(message["message"]) < 400, (odd, message)
            await tab.say("set", key="drive.speed", text="151 rpm")
            await tab.until(lambda message: message["what"] == "scene")

    loops.run(attack())
    assert "Traceback" not in server.said() and server.said().count("\n") == 1


ROWS = "[" + ", ".join(f'["{n / 100} deg", "1 mm"]' for n in range(36_000)) + "]"
POINTS = {  # texts of the points of a cam's first segment
    "points": [
        "[",
        "[[]]",
        "[[0, 0]]",
        "[[0, 0], [1]]",
        "[[0, 0], [0.5, 1e999], [1, 1]]",
        '[["0", "0"], [{}, []], [1, 1]]',
        "[[0, 0], [0, 0], [1, 1]]",
    ],
    "rows": [
        "x",
        "[[]]",
        '[["0 deg"]]',
        '[["0 deg", "0 kg"]]',
        '[["0 deg", "NaN mm"]]',
        '[["0 deg", "/etc/passwd"]]',
        "[" * 900,
        ROWS,
        f'"{SURROGATE}"',
    ],
    "file": ["/etc/passwd", "../../x", "\0"],
}


@pytest.mark.parametrize("key", POINTS)
def test_odd_points_of_a_motion_are_answered_briefly(server, key):
    """Of a spline, of a table in the spec and of one in a file, as a drag, as a text and in another list."""

    async def attack():
        async with page(server.port) as tab:
            await tab.say("fresh", kind="cam")
            await tab.until(lambda message: message["what"] == "design" and message["kind"] == "cam", 60)
            law, answers = "spline" if key == "points" else "table", []
            for text in POINTS[key]:
                tab.heard.clear()
                changes = {"law": law, "rise": "20 mm" if key == "points" else "", key: text}
                await tab.say("arrange", list="programme", elements=[{"of": 0, "changes": changes}, {"of": 1, "changes": {}}])
                await tab.say("drag", changes={f"programme.0.{key}": text}, gesture="g")
                await tab.say("set", key=f"programme.0.{key}", text=text)
                await tab.say("again")
                await tab.until(lambda message: message["what"] == "design", 120)
                refused = [message["message"] for _, message in tab.heard if message["what"] == "refused"]
                answers += refused
                assert all(len(each) < 1500 and each.count("\n") <= 6 and "root:" not in each for each in refused), refused
            tab.heard.clear()
            await tab.say("set", key="drive.speed", text="151 rpm")
            await tab.until(lambda message: message["what"] in ("values", "design"), 60)
            assert len(answers) > len(POINTS[key])  # some make a spec, and their drawing says what is wrong

    loops.run(attack())
    assert "Traceback" not in server.said()


def test_what_must_be_refused_is(server):
    """Of the odd ones, those that ask for something: each has its line."""

    async def attack():
        async with page(server.port) as tab:
            for odd in ODD[:3] + [each for each in ODD if SURROGATE in each] + ODD[19:24]:
                tab.heard.clear()
                await tab.argue(odd)
                message = await tab.until(lambda message: message["what"] == "refused", 10)
                assert message["message"] and "\n" not in message["message"], odd

    loops.run(attack())


def test_frames_that_nobody_can_read_end_no_more_than_their_connection(server):
    async def attack():
        for frame in FRAMES:
            async with page(server.port, hello=False) as tab:
                with suppress(Exception):  # the server may close this connection
                    await tab.send(frame if isinstance(frame, bytes) else frame.replace("ID", tab.ids["client_id"]), text=True)
                    await asyncio.sleep(0.02)
        async with page(server.port) as tab:
            await tab.until(lambda message: message["what"] == "scene")

    loops.run(attack())
    assert "Traceback" not in server.said() and server.said().count("\n") == 1


LONG_FRAMES = {"texts": '"",', "texts that never end": '\\"', "backslashes": '"\\', "brackets": "[", "nothing but quotation marks": '"'}


@pytest.mark.parametrize("name", LONG_FRAMES)
def test_no_frame_keeps_the_server_from_answering_others(server, name):
    async def attack():
        async with page(server.port, hello=False) as tab:
            with suppress(Exception):  # the server may close this connection
                await tab.send('42["event",' + LONG_FRAMES[name] * (1_900_000 // len(LONG_FRAMES[name])))
            await asyncio.sleep(0.5)

    assert longest_pause(server, attack) < PAUSE


def test_a_socket_speaks_for_its_own_page_only(server):
    async def attack():
        async with page(server.port) as victim, page(server.port, hello=False) as other:
            victim.heard.clear()
            other.ids = victim.ids
            await other.say("set", key="drive.speed", text="151 rpm")
            await asyncio.sleep(0.5)
            return [message["what"] for _, message in victim.heard if message["what"] in ("values", "refused")]

    assert loops.run(attack()) == []


def test_a_flood_of_messages_is_answered_with_the_newest(server):
    async def attack():
        async with page(server.port) as tab:
            for step in range(400):
                await tab.say("set", key="drive.speed", text=f"{100 + step} rpm", gesture="one drag")
            await tab.until(lambda message: message["what"] == "values" and 'speed = "499 rpm"' in message.get("toml", ""), 60)
            answers = [message for _, message in tab.heard if message["what"] == "values"]
            await tab.say("undo")
            back = await tab.until(lambda message: message["what"] == "values" and not message["undo"])
            assert 'speed = "499 rpm"' not in back["toml"]  # one drag is one step
            return len(answers)

    assert loops.run(attack()) < 400


def test_a_thousand_messages_at_once_are_answered_and_the_tab_goes_on(server):
    """Of all kinds, together; those that do not fit into the queue are refused, one line each."""
    kinds = [
        {"what": "drag", "changes": {"bodies.crank.points.A.0": "45 mm"}, "gesture": "g"},
        {"what": "undo"},
        {"what": "revert", "gesture": "g"},
        {"what": "redo"},
        {"what": "construct", "tool": "body", "places": [[0, 0], [0.1, 0.1]], "near": 0.001},
        {"what": "sketch", "on": True},
        {"what": "propose"},
        {"what": "source"},
        {"what": "job", "name": "fix", "options": {"check": "none"}},
        {"what": "cancel", "name": "fix"},
        {"what": "sketch", "on": False},
    ]

    async def attack():
        async with page(server.port) as tab, page(server.port) as other:
            await tab.until(lambda message: message["what"] == "scene")
            tab.heard.clear()
            for number in range(1000):
                await tab.argue(json.dumps(kinds[number % len(kinds)]))
            await _answered(other)
            await tab.until(lambda message: message["what"] == "refused", 120)
            while True:  # until there is room again
                tab.heard.clear()
                await tab.say("again")
                answer = await tab.until(lambda message: message["what"] in ("design", "refused"), 120)
                if answer["what"] == "design":
                    return
                await asyncio.sleep(0.2)

    assert longest_pause(server, attack) < PAUSE
    assert "Traceback" not in server.said()


def test_a_drag_that_is_undone_on_the_way_leaves_the_first_design(server):
    async def attack():
        async with page(server.port) as tab:
            first = await tab.until(lambda message: message["what"] == "design")
            for number in range(30):
                await tab.say("drag", changes={"bodies.crank.points.A.0": f"{41 + number / 10} mm"}, gesture="g")
                if number % 5 == 4:
                    await tab.say("undo")
            await tab.say("revert", gesture="g")
            await tab.say("revert", gesture="of nobody")
            for _ in range(30):
                await tab.say("undo")
            tab.heard.clear()
            await tab.say("again")
            last = await tab.until(lambda message: message["what"] == "design" and not message["undo"])
            assert last["toml"] == first["toml"] and not last["changed"]

    loops.run(attack())


@pytest.mark.slow
def test_a_search_for_a_change_gives_way_to_the_next_and_ends_with_its_tab(server):
    async def running(tab):
        return await tab.until(lambda message: message["what"] == "job" and message["name"] == "fix" and message["state"] == "running")

    async def attack():
        async with page(server.port) as tab:
            await tab.until(lambda message: message["what"] == "scene")
            for check in ("of none", "none either"):
                await tab.say("job", name="fix", options={"check": check})
            ended = await tab.until(lambda message: message["what"] == "job" and message["state"] == "failed")
            assert "none either" in ended["text"] and "\n" not in ended["text"]
            states = [message["state"] for _, message in tab.heard if message["what"] == "job"]
            assert states.count("failed") == 1
            await tab.say("job", name="fix", options={"check": "of none"})
            await tab.say("job", name="figures", options={})
            await running(tab)
        async with page(server.port) as other:  # the one before has gone in the middle
            await _answered(other)

    loops.run(attack())
    assert "Traceback" not in server.said()


# -- connections ---------------------------------------------------------------------------------------------------------------


def dripping(port, head, drops, pause=0.1, most=6.0):
    """(seconds until the server gives up a client that sends one byte after another, what it said)."""
    since = time.monotonic()
    with closing(socket.create_connection(("127.0.0.1", port), timeout=10)) as connection:
        connection.sendall(head.encode())
        connection.settimeout(pause)
        for letter in drops:
            try:
                connection.sendall(letter.encode())
                return time.monotonic() - since, connection.recv(4096)
            except TimeoutError:
                assert time.monotonic() - since < most
            except OSError:
                break
        return time.monotonic() - since, b""


def test_slow_clients_are_given_up(hasty):
    host = f"Host: 127.0.0.1:{hasty.port}\r\n"
    seconds, answer = dripping(hasty.port, "", f"GET / HTTP/1.1\r\n{host}X: {'y' * 500}")
    assert 0.8 < seconds < 3 and answer == b""
    path = "/_nicegui_ws/socket.io/?EIO=4&transport=polling"
    (number,) = re.findall(rb'"sid":"([^"]+)"', loops.run(fetched(hasty.port, path))[1])  # of a connection, so that somebody reads the body
    seconds, answer = dripping(hasty.port, f"POST {path}&sid={number.decode()} HTTP/1.1\r\n{host}Content-Length: 500\r\n\r\n", "x" * 500)
    assert 0.8 < seconds < 3 and answer.split()[1] == b"408"
    with closing(socket.create_connection(("127.0.0.1", hasty.port), timeout=5)) as connection:
        connection.sendall(f"GET /healthz HTTP/1.1\r\n{host}\r\n".encode())
        answer = b""
        while not answer.endswith(b"}"):
            answer += connection.recv(4096)
        connection.sendall(b"GET /heal")  # a second request that never ends
        since = time.monotonic()
        with suppress(ConnectionResetError):
            assert connection.recv(4096) == b""
        assert time.monotonic() - since < 3
    assert "Traceback" not in hasty.said()


def test_connections_that_say_nothing_leave_room_for_others(hasty):
    idle = [socket.create_connection(("127.0.0.1", hasty.port), timeout=5) for _ in range(200)]
    try:
        time.sleep(0.2)
        assert len(list(Path(f"/proc/{hasty.process.pid}/fd").iterdir())) < 200 if Path("/proc").exists() else True
        time.sleep(1.5)
        assert loops.run(fetched(hasty.port, "/healthz"))[0] == 200
    finally:
        for connection in idle:
            connection.close()


HOSTILE = [
    b"\x00\xff" * 1000,
    b"GET / HTTP/1.1\r\nHost: x\r\nHost: y\r\n\r\n",
    b"GET / HTTP/9.9\r\n\r\n",
    b"GET http://evil.example/ HTTP/1.1\r\nHost: evil.example\r\n\r\n",
    b"GET //evil.example/%00 HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n",
    b"GET /%ff%fe HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n",
    b"GET /" + b"a" * 100_000 + b" HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n",
    b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n" + b"X: y\r\n" * 20_000 + b"\r\n",
    b"POST / HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 5\r\nContent-Length: 6\r\n\r\nhello",
    b"POST / HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 5\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n",
    b"POST / HTTP/1.1\r\nHost: 127.0.0.1\r\nTransfer-Encoding: chunked\r\n\r\nfffffffffffffff\r\n",
    b"POST /_nicegui_ws/socket.io/?EIO=4&transport=polling&sid=x HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 3\r\n\r\n\xff\xff\xff",
    b"GET /?token=%ed%a0%80 HTTP/1.1\r\nHost: 127.0.0.1\r\nCookie: drivewright-studio=\xed\xa0\x80\r\n\r\n",
    b"OPTIONS * HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n",
    b"CONNECT 127.0.0.1:22 HTTP/1.1\r\nHost: 127.0.0.1:22\r\n\r\n",
]


@pytest.mark.parametrize("number", range(len(HOSTILE)))
def test_hostile_requests_leave_the_server_well(server, number):
    with closing(socket.create_connection(("127.0.0.1", server.port), timeout=5)) as connection, suppress(OSError):
        connection.sendall(HOSTILE[number])
        answer = connection.recv(65536)
        assert not answer or int(answer.split()[1]) in (200, 400, 403, 404, 405, 413, 421, 431)
        assert b"Traceback" not in answer
    assert loops.run(fetched(server.port, "/healthz"))[0] == 200
    assert "Traceback" not in server.said()


def test_a_page_that_takes_nothing_costs_little_and_stops_nobody(server):
    def memory():
        return int(Path(f"/proc/{server.process.pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")

    async def attack():
        async with page(server.port, hello=False, listening=False, max_queue=1) as deaf, page(server.port) as tab:
            await deaf.say("hello")
            before = memory()
            for step in range(150):
                await deaf.say("again")  # each has an answer of some 200 kB
                await deaf.say("set", key="drive.speed", text=f"{100 + step} rpm")
                await asyncio.sleep(0.01)
            await tab.say("set", key="drive.speed", text="77 rpm")
            await tab.until(lambda message: message["what"] == "values" and 'speed = "77 rpm"' in message["toml"], 60)
            return memory() - before

    if Path("/proc/self/statm").exists():
        assert loops.run(attack()) < 150e6


FLOODS = {"empty fragments": b"\x00\x80\0\0\0\0", "pings": b"\x89\xfd\0\0\0\0" + b"x" * 125, "tiny messages": b"\x81\x81\0\0\0\x003"}


@pytest.mark.parametrize("name", FLOODS)
def test_a_flood_of_tiny_frames_keeps_nobody_waiting_and_no_memory(server, name):
    """From somebody who reads no answer."""

    def memory():
        return int(Path(f"/proc/{server.process.pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")

    def flood():
        path = "/_nicegui_ws/socket.io/?EIO=4&transport=websocket"
        upgrade = "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ=="
        with closing(socket.create_connection(("127.0.0.1", server.port), timeout=0.5)) as connection, suppress(OSError):
            connection.sendall(f"GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\n{upgrade}\r\n\r\n".encode())
            assert b"101" in connection.recv(4096)
            connection.sendall(b"\x01\x81\0\0\0\x004" if name == "empty fragments" else b"")
            connection.sendall(FLOODS[name] * (5_000_000 // len(FLOODS[name])))

    async def attack():
        await asyncio.wait_for(asyncio.to_thread(flood), 60)

    before = memory()
    assert longest_pause(server, attack) < PAUSE
    assert memory() - before < 30e6
    assert "Traceback" not in server.said()


def test_a_request_that_its_sender_gives_up_is_no_fault_of_ours(server):
    path = "/_nicegui_ws/socket.io/?EIO=4&transport=polling"
    (number,) = re.findall(rb'"sid":"([^"]+)"', loops.run(fetched(server.port, path))[1])
    body = "0" * 1000
    with closing(socket.create_connection(("127.0.0.1", server.port), timeout=5)) as connection:
        head = f"POST {path}&sid={number.decode()} HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\nContent-Length: {len(body)}\r\n\r\n"
        connection.sendall((head + body).encode())
        time.sleep(0.2)
    for _ in range(20):
        with closing(socket.create_connection(("127.0.0.1", server.port), timeout=5)) as connection:
            connection.sendall(f"POST {path} HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\nContent-Length: 5\r\n\r\n".encode())
    assert loops.run(fetched(server.port, "/healthz"))[0] == 200
    assert "Traceback" not in server.said()


def test_a_socket_that_gives_no_sign_of_life_is_closed(hasty):
    async def attack():
        async with page(hasty.port, listening=False, hello=False) as deaf:
            await deaf.say("hello")
            since = time.monotonic()
            with suppress(Exception):
                while True:
                    await asyncio.wait_for(deaf.socket.recv(), 30)  # and never an answer to a ping
            return time.monotonic() - since

    assert loops.run(attack()) < 15
    assert "Traceback" not in hasty.said()


# -- the token -----------------------------------------------------------------------------------------------------------------

TOKEN = "open-sesame-and-more"


@pytest.fixture
def guarded(tmp_path):
    with started((tmp_path, (sys.executable, "-m", "drivewright"), "--token", TOKEN)) as (one,):
        yield one


@pytest.mark.slow
def test_a_token_is_guessed_at_slowly_from_one_connection_or_many(guarded):
    async def guess(token):
        return (await fetched(guarded.port, f"/?token={token}"))[0]

    async def attack():
        since = time.monotonic()
        assert [await guess(f"wrong{number}") for number in range(4)] == [401] * 4
        one_by_one = time.monotonic() - since
        at_once = await asyncio.wait_for(asyncio.gather(*(guess(number) for number in range(100))), 60)
        async with health(guarded.port) as seconds:
            await asyncio.sleep(0.3)
        return one_by_one, at_once, max(seconds)

    one_by_one, at_once, pause = loops.run(attack())
    assert 1.3 < one_by_one < 5  # 0, 0.25, 0.5 and 1 s, a little less as they are forgotten
    assert at_once.count(429) > 90 and set(at_once) == {401, 429} and pause < 1


def test_a_cookie_of_backslashes_keeps_nobody_waiting(guarded):
    cookie = 'Cookie: a="' + "\\" * 30_000 + '"'
    since = time.monotonic()
    assert loops.run(fetched(guarded.port, "/", cookie))[0] == 401
    assert time.monotonic() - since < 2  # Python's own reader takes some


def test_without_the_token_there_is_nothing(guarded):
    upgrade = ("Upgrade: websocket", "Sec-WebSocket-Version: 13", "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==")
    for path in ("/", "/web/main.js", "/download/x", "/_nicegui_ws/socket.io/?EIO=4&transport=polling", "/nothing"):
        for lines in ((), (f"Cookie: drivewright-studio-{guarded.port}={TOKEN}",), ("Origin: http://evil.example",)):
            assert loops.run(fetched(guarded.port, path, *lines))[0] in (401, 403)
    socket_path = f"/_nicegui_ws/socket.io/?EIO=4&transport=websocket&token={TOKEN}"
    head = "\r\n".join([f"GET {socket_path} HTTP/1.1", f"Host: 127.0.0.1:{guarded.port}", "Connection: Upgrade", *upgrade])
    with closing(socket.create_connection(("127.0.0.1", guarded.port), timeout=5)) as connection:
        connection.sendall(f"{head}\r\n\r\n".encode())
        assert connection.recv(4096).split()[1] == b"403"


# -- many tabs -----------------------------------------------------------------------------------------------------------------


def _measured(process):
    status = Path(f"/proc/{process.pid}/status").read_text()
    numbers = {line.split(":")[0]: int(line.split()[1]) for line in status.splitlines() if line.startswith(("VmRSS", "Threads"))}
    return {**numbers, "files": len(list(Path(f"/proc/{process.pid}/fd").iterdir())), "processes": len(below(process.pid))}


TABS = """
import asyncio, gc, sys
from drivewright import cli
from drivewright.studio import app

app.AWAY = 2.0
class Counting(app.Tabs):
    def listen(self, sio):
        super().listen(sio)
        count()

def count():
    gc.collect()
    kinds = [type(each).__name__ for each in gc.get_objects()]
    print("open", *(kinds.count(name) for name in ("Session", "TabComputations", "Client")), file=sys.stderr, flush=True)
    asyncio.get_running_loop().call_later(2.0, count)

app.Tabs = Counting
sys.exit(cli.main())
"""


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="reads sizes in /proc")
def test_two_hundred_tabs_give_back_what_they_took(tmp_path):
    async def crowd(port):
        async def one():
            async with page(port) as tab:
                await tab.until(lambda message: message["what"] == "scene", 300)

        await asyncio.gather(*(one() for _ in range(200)))

    with started((tmp_path, (sys.executable, "-c", TABS))) as (server,):
        loops.run(_warm(server.port))
        after = []
        for _ in range(3):
            loops.run(crowd(server.port))
            deadline = time.monotonic() + 60
            while not server.said().endswith("open 0 0 0\n"):  # sessions, their computations, and the framework's clients
                assert time.monotonic() < deadline, server.said()[-200:]
                time.sleep(0.1)
            after.append(_measured(server.process))
    print(after)
    assert after[-1]["files"] <= after[0]["files"] + 5 and after[-1]["Threads"] <= after[0]["Threads"] + 5
    assert after[-1]["processes"] <= after[0]["processes"] and after[-1]["processes"] < 16
    assert after[-1]["VmRSS"] - after[0]["VmRSS"] < 40_000  # kB: a round of two hundred tabs takes next to none along


@pytest.mark.slow
def test_twenty_clients_that_move_sliders_are_answered_soon(tmp_path):
    """Fifty steps a second each, as a hand at a slider makes them; seconds from a step to the drawing that has it."""

    async def moving(port, number, ready, begin):
        async with page(port) as tab:
            await tab.until(lambda message: message["what"] == "result" and message["full"], 300)
            ready.append(number)
            await begin.wait()
            tab.heard.clear()
            sent = {}
            for step in range(400):
                text = f"{100 + number + step / 4:g} rpm"
                sent[text] = time.perf_counter()
                await tab.say("set", key="drive.speed", text=text, gesture="drag")
                await asyncio.sleep(0.02)
            await asyncio.sleep(2)
            return list(_waits(sent, tab.heard))

    async def crowd(port):
        ready, begin = [], asyncio.Event()
        clients = [asyncio.create_task(moving(port, number, ready, begin)) for number in range(20)]
        while len(ready) < 20:
            await asyncio.sleep(0.1)
        begin.set()
        return sorted(seconds for waits in await asyncio.gather(*clients) for seconds in waits)

    with started((tmp_path, (sys.executable, "-m", "drivewright"))) as (server,):
        waits = loops.run(crowd(server.port))
    print(f"{len(waits)} steps, median {waits[len(waits) // 2]:.3f} s, 95 % {waits[len(waits) * 95 // 100]:.3f} s")
    assert len(waits) > 7000 and waits[len(waits) // 2] < 1.5


def _waits(sent, heard):
    """Seconds of each step until a drawing of it, or of a newer one, came."""
    waiting, gens = dict(sent), []
    for when, message in heard:
        if message["what"] == "values" and "drive.speed" in message["fields"]:
            text = message["fields"]["drive.speed"]["text"]
            steps = list(waiting)
            if text in steps:
                gens.append((message["gen"], [waiting.pop(step) for step in steps[: steps.index(text) + 1]]))
        if message["what"] == "scene":
            while gens and gens[0][0] <= message["gen"]:
                yield from (when - since for since in gens.pop(0)[1])


# -- processes -----------------------------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="finds processes in /proc")
def test_processes_killed_at_every_phase_cost_a_line_and_no_tab(tmp_path):
    """All computing processes of the server are killed, at twenty moments between a step and its analyses."""

    async def attack(process, port):
        async with page(port) as tab:
            await tab.until(lambda message: message["what"] == "result" and message["full"], 120)
            for number in range(20):
                speed = f"{150 + number} rpm"
                tab.heard.clear()
                await tab.say("set", key="drive.speed", text=speed)
                if number % 3 == 0:
                    await tab.say("job", name="sensitivity", options={})
                await asyncio.sleep(number * 0.03)
                for pid in below(process.pid) - {process.pid}:
                    if b"spawn_main" in Path(f"/proc/{pid}/cmdline").read_bytes():
                        with suppress(ProcessLookupError):
                            os.kill(pid, signal.SIGKILL)
                await tab.say("again")
                design = await tab.until(lambda message: message["what"] == "design", 60)
                if f'speed = "{speed}"' not in design["toml"]:  # its change was lost: which the page was told
                    assert any(message["what"] == "refused" for _, message in tab.heard)
                await tab.until(lambda message, gen=design["gen"]: message["what"] == "scene" and message["gen"] == gen, 60)
                if number % 3 == 0:
                    await tab.until(lambda message: message["what"] == "job" and message["state"] in ("failed", "done"), 120)
            tab.heard.clear()
            await tab.say("analyse")
            await tab.until(lambda message: message["what"] == "result" and message["full"], 120)

    with started((tmp_path, (sys.executable, "-m", "drivewright"))) as (server,):
        loops.run(attack(server.process, server.port))
        assert "Traceback" not in server.said()


@pytest.mark.slow
def test_a_long_job_of_one_tab_leaves_the_others_their_drawings_analyses_and_jobs(server):
    async def attack():
        async with page(server.port) as greedy, page(server.port) as other:
            for tab in (greedy, other):
                await tab.until(lambda message: message["what"] == "result" and message["full"], 120)
            for name in ("sensitivity", "study", "figures", "report"):
                await greedy.say("job", name=name, options={})
            await asyncio.sleep(0.5)
            other.heard.clear()
            since = time.monotonic()
            await other.say("set", key="drive.speed", text="99 rpm")
            await other.say("job", name="save", options={})
            await other.until(lambda message: message["what"] == "scene", 10)
            await other.until(lambda message: message["what"] == "job" and message["name"] == "save" and message["state"] == "done", 30)
            await other.until(lambda message: message["what"] == "result" and message["full"], 60)
            return time.monotonic() - since

    assert loops.run(attack()) < 60
