"""Who may talk to the studio: hosts, origins, the token, counted bytes - for pages and websockets."""

import asyncio
import time

import loops
import pytest

from drivewright.studio import access, guesses
from drivewright.studio.access import COOKIE, FRAMES, LARGEST, AccessControl
from drivewright.studio.guesses import LONGEST, Guesses

pytestmark = pytest.mark.interface

OWN = (b"host", b"127.0.0.1:8123")
TOKEN = "a token of enough letters"
GIVEN = b"token=a%20token+of%20enough%20letters"


async def _inner(scope, receive, send):
    """Reads the whole body, then says how long it was."""
    if scope["type"] == "websocket":
        await send({"type": "websocket.accept"})
        return
    length, more = 0, True
    while more:
        message = await receive()
        length, more = length + len(message.get("body", b"")), message.get("more_body", False)
    await send({"type": "http.response.start", "status": 200, "headers": []})
    await send({"type": "http.response.body", "body": str(length).encode()})


def ask(*headers, token="", gate=None, path="/", query=b"", kind="http", chunks=(b"",), client=("192.0.2.1", 1), scheme="http"):
    """(first message, body) of the gate's answer."""
    said, waiting = [], [{"type": "http.request", "body": c, "more_body": n + 1 < len(chunks)} for n, c in enumerate(chunks)]

    async def receive():
        return waiting.pop(0) if kind == "http" else {"type": "websocket.connect"}

    async def send(message):
        said.append(message)

    scope = {"type": kind, "path": path, "query_string": query, "headers": list(headers), "client": client, "scheme": scheme}
    loops.run((gate or AccessControl(_inner, token))(scope, receive, send))
    return said


def status(*headers, **more):
    first = ask(*headers, **more)[0]
    return first.get("status", first["type"])


def grows_less(work, part, whole, times):
    """Whether the whole takes less than so many times the part's time: the least of several, on any machine."""

    def least(value, count):
        seconds = []
        for _ in range(count):
            since = time.perf_counter()
            work(value)
            seconds.append(time.perf_counter() - since)
        return min(seconds)

    return least(whole, 3) < times * least(part, 10)


# -- hosts and origins ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("host", [b"127.0.0.1:8123", b"localhost:8123", b"[::1]:8123", b"LOCALHOST", b"localhost:9000"])
def test_this_machines_own_names_pass(host):
    assert status((b"host", host)) == 200


STRANGE = [
    b"a@127.0.0.1:8123",
    b"evil.example@127.0.0.1:8123",
    b"a:b@localhost",
    b"127.0.0.1:8123@evil.example",
    b"127.0.0.1:8123/",
    b"127.0.0.1:8123#x",
    b"127.0.0.1:",
    b"127.0.0.1:x",
    b"127.0.0.1:70000",
    b"127.0.0.1:8123, evil.example",
    b" 127.0.0.1",
    b"127.0.0.1\t",
    b"127.0.0.1%00",
    b"::1",
    b"[::1",
    b"[x]",
    b"loc\xc3\xa4lhost",
]


@pytest.mark.parametrize(
    "host", [b"evil.example:8123", b"127.0.0.1.evil.example", b"", b"192.168.1.7:8123", b"localhost.", b"2130706433", b"0.0.0.0", *STRANGE]
)
def test_another_name_for_this_machine_is_refused(host):
    assert status((b"host", host)) == 421


@pytest.mark.parametrize("host", STRANGE)
def test_what_is_no_host_is_none_with_a_token_either(host):
    assert status((b"host", host), token=TOKEN, query=GIVEN) == 421


def test_no_host_at_all_is_refused():
    assert status() == 421


@pytest.mark.parametrize("name", [b"host", b"origin", b"content-length"])
@pytest.mark.parametrize("kind", ["http", "websocket"])
def test_what_is_there_twice_is_refused_even_where_both_say_the_same(name, kind):
    values = {b"host": b"127.0.0.1:8123", b"origin": b"http://127.0.0.1:8123", b"content-length": b"0"}
    twice = [(name, values[name]), (name.title(), values[name])]
    others = [OWN] if name != b"host" else []
    assert status(*others, *twice, kind=kind) == {"http": 400, "websocket": "websocket.close"}[kind]
    assert status(*others, twice[0], kind=kind) == {"http": 200, "websocket": "websocket.accept"}[kind]


@pytest.mark.parametrize("kind", ["http", "websocket"])
def test_a_page_of_another_site_is_refused(kind):
    good = {"http": 200, "websocket": "websocket.accept"}[kind]
    assert status(OWN, (b"origin", b"http://127.0.0.1:8123"), kind=kind) == good
    assert status((b"host", b"LocalHost:8123"), (b"origin", b"http://localhost:8123"), kind=kind) == good
    assert status(OWN, (b"origin", b"https://127.0.0.1:8123"), kind=kind) == good  # behind a proxy with TLS
    assert status(OWN, kind=kind) == good  # programs send no origin
    for origin in (
        b"http://evil.example",
        b"http://127.0.0.1:9999",
        b"http://127.0.0.1",
        b"null",
        b"",
        b"http://127.0.0.1:8123.evil.example",
        b"http://evil.example@127.0.0.1:8123",
        b"http://127.0.0.1:8123/",
        b"http://127.0.0.1:8123 http://evil.example",
        b"file://127.0.0.1:8123",
        b"http://[",
    ):
        assert status(OWN, (b"origin", origin), kind=kind) == {"http": 403, "websocket": "websocket.close"}[kind]


def test_a_page_of_another_site_can_neither_frame_the_studio_nor_take_parts_of_it():
    for place in (b"script", b"image", b"iframe", b"frame", b"object", b"empty", b"websocket"):
        assert status(OWN, (b"sec-fetch-site", b"cross-site"), (b"sec-fetch-dest", place)) == 403
    assert status(OWN, (b"sec-fetch-site", b"cross-site"), (b"sec-fetch-dest", b"document")) == 200  # a link in a letter
    assert status(OWN, (b"sec-fetch-site", b"same-origin"), (b"sec-fetch-dest", b"script")) == 200


def test_another_site_can_not_have_the_page_fetched_in_advance():
    other = (b"sec-fetch-site", b"cross-site"), (b"sec-fetch-dest", b"document")
    assert status(OWN, *other) == 200 and status(OWN, *other, (b"sec-purpose", b"prefetch;prerender")) == 403
    assert status(OWN, (b"sec-fetch-site", b"none"), (b"sec-purpose", b"prefetch")) == 200


def _passed_on(*headers, client):
    """The scope that reaches the application."""
    scopes = []

    async def inner(scope, receive, send):
        scopes.append(scope)
        await _inner(scope, receive, send)

    assert status(OWN, *headers, gate=AccessControl(inner), client=client) == 200
    return scopes[0]


def test_a_proxy_of_this_machine_may_say_who_asks_and_how_and_nobody_else():
    told = (b"x-forwarded-for", b"198.51.100.1, 192.0.2.7"), (b"x-forwarded-proto", b"https")
    scope = _passed_on(*told, client=("127.0.0.1", 5))
    assert scope["client"][0] == "192.0.2.7" and scope["scheme"] == "https"
    scope = _passed_on(*told, client=("192.0.2.9", 5))
    assert scope["client"][0] == "192.0.2.9" and scope["scheme"] == "http"


def test_a_long_list_of_proxies_is_not_parsed_one_by_one():
    """Five seconds for 30,000 where each one is parsed from the left."""
    fifth, whole = (b"1," * count for count in (6_000, 30_000))
    assert grows_less(lambda value: _passed_on((b"x-forwarded-for", value), client=("127.0.0.1", 5)), fifth, whole, 15)


def test_frameworks_see_no_cookies():
    assert not [name for name, _ in _passed_on((b"Cookie", b"a=1"), client=("127.0.0.1", 5))["headers"] if name.lower() == b"cookie"]


def test_a_request_of_the_socket_does_not_wait_for_ever(monkeypatch):
    monkeypatch.setattr(access, "POLL_SECONDS", 0.1)

    async def waits(scope, receive, send):
        await asyncio.sleep(60)

    assert status(OWN, gate=AccessControl(waits), path="/_nicegui_ws/socket.io/") == 408


def test_a_websocket_learns_why():
    assert ask(OWN, (b"origin", b"http://evil.example"), kind="websocket") == [{"type": "websocket.close", "code": 4403}]


def test_nothing_is_served_beside_what_the_page_fetches():
    for path in ("/", "/healthz", "/favicon.ico", "/web/x.js", "/download/x", "/_nicegui/3/x", "/_nicegui_ws/socket.io/"):
        assert status(OWN, path=path) == 200
    for path in ("/docs", "/_nicegui", "/healthz/", "//", "/web", ""):
        assert status(OWN, path=path) == 404


# -- the token -----------------------------------------------------------------------------------------------------------------

OTHER = (b"host", b"workstation:8123")


def cookie_of(welcome):
    return dict(welcome["headers"])[b"set-cookie"].decode()


def test_a_token_opens_once_by_address_and_then_by_cookie():
    gate = AccessControl(_inner, TOKEN)
    assert status(OTHER, gate=gate) == 401
    assert status(OTHER, gate=gate, query=b"token=abd") == 401
    welcome = ask(OTHER, gate=gate, query=GIVEN, client=("192.0.2.2", 1))[0]
    assert welcome["status"] == 303 and dict(welcome["headers"])[b"location"] == b"/"
    kept = (b"cookie", cookie_of(welcome).partition(";")[0].encode())
    assert TOKEN not in cookie_of(welcome)
    assert status(OTHER, kept, gate=gate) == 200
    assert status(OTHER, kept, gate=gate, query=GIVEN) == 200  # no second welcome
    assert status(OTHER, kept, gate=gate, kind="websocket") == "websocket.accept"
    for shown in ((), ((b"cookie", f"{COOKIE}={TOKEN}".encode()),), ((b"cookie", kept[1][:-1]),), ((b"cookie", b"\x00;;=;"),)):
        assert status(OTHER, *shown, gate=gate) == 401
        assert status(OTHER, *shown, gate=gate, kind="websocket") == "websocket.close"
    assert status(OTHER, gate=gate, kind="websocket", query=GIVEN) == "websocket.close"
    assert status(OTHER, kept, token=TOKEN) == 401  # the server has been started again


@pytest.mark.parametrize(
    ("begin", "part"), [('a="', "\\"), (f"{COOKIE}=", '"\\"'), ("", "a=1;"), ("", ";"), ("", "= "), ("", f"{COOKIE}=x;")]
)
def test_no_cookie_keeps_the_loop(begin, part):
    """Python's SimpleCookie takes ten seconds for the first of these: a hundred times as long for ten times the text."""

    def refuse(value):
        assert status(OTHER, (b"cookie", f'{value}"'.encode()), token=TOKEN) == 401

    tenth, whole = (begin + part * (length // len(part)) for length in (6_400, 64_000))
    assert grows_less(refuse, tenth, whole, 40)


def test_the_cookie_stays_with_the_browser_and_goes_over_tls_only_where_there_is_tls():
    plain, folded = (cookie_of(ask(OTHER, token=TOKEN, query=GIVEN, scheme=scheme)[0]).split("; ") for scheme in ("http", "https"))
    assert set(plain[1:]) == {"HttpOnly", "SameSite=Strict", "Path=/"}
    assert set(folded[1:]) == {"HttpOnly", "SameSite=Strict", "Path=/", "Secure"}


def test_health_needs_no_token():
    assert status((b"host", b"workstation"), token=TOKEN, path="/healthz") == 200
    assert status((b"host", b"workstation"), token=TOKEN, path="/healthz/other") == 401


@pytest.fixture
def clock(monkeypatch):
    """A time that passes as the test says, and while somebody sleeps."""
    now = [1000.0]

    async def sleep(seconds):
        now[0] += seconds

    monkeypatch.setattr(guesses.time, "monotonic", lambda: now[0])
    monkeypatch.setattr(access.asyncio, "sleep", sleep)
    return now


def test_wrong_tokens_cost_more_and_more_time_and_less_again_later(clock):
    known = Guesses()
    waits = []
    for _ in range(9):
        waits.append(known.next("a"))
        clock[0] += waits[-1] or 0.0
    assert waits[0] == 0 and waits[1] == pytest.approx(0.25) and waits[3] == pytest.approx(1, rel=0.1)
    assert all(later > before for before, later in zip(waits, waits[1:], strict=False)) and waits[-1] <= LONGEST
    assert known.next("b") == 0  # of somebody else
    clock[0] += 3600
    assert known.next("a") == 0


def test_many_connections_guess_no_faster_than_one(clock):
    known = Guesses()
    heard = [wait for wait in (known.next("a") for _ in range(10_000)) if wait is not None]
    assert len(heard) < 10 and len(set(heard)) == len(heard)
    tries = 0
    for _ in range(3600):
        clock[0] += 1
        tries += sum(known.next("a") is not None for _ in range(20))
    assert tries < 250  # of an hour


def test_the_right_token_ends_the_waiting(clock):
    known = Guesses()
    for _ in range(5):
        known.next("a")
    known.right("a")
    assert known.next("a") == 0


def test_what_is_remembered_of_guesses_is_bounded(clock, monkeypatch):
    monkeypatch.setattr(guesses, "MOST", 100)
    known = Guesses()
    for number in range(1000):
        known.next(str(number))
    assert len(known._by) == 100


def test_guesses_are_slowed_down_at_the_door_and_a_cookie_is_not(clock):
    gate = AccessControl(_inner, TOKEN)
    kept = (b"cookie", cookie_of(ask(OTHER, gate=gate, query=GIVEN)[0]).partition(";")[0].encode())
    since = clock[0]
    answers = [status(OTHER, gate=gate, query=b"token=%d" % number) for number in range(6)]
    assert answers == [401] * 6 and clock[0] - since > 5
    before = clock[0]
    assert status(OTHER, kept, gate=gate) == 200 and clock[0] == before
    assert status(OTHER, gate=gate, client=("192.0.2.9", 1), query=GIVEN) == 303 and clock[0] == before
    network = [status(OTHER, gate=gate, client=(f"2001:db8::{n}", 1), query=b"token=1") for n in range(20)]
    assert set(network) <= {401, 429} and clock[0] > before + 60  # one network of IPv6 is one guesser
    status(OTHER, gate=gate, client=("x" * 60_000, 1), query=b"token=1")  # as a header of a proxy may say
    assert max(map(len, gate._guesses._by)) < 100


# -- how much ------------------------------------------------------------------------------------------------------------------

CHUNKED = (b"transfer-encoding", b"chunked")


def test_bodies_are_counted_whatever_their_length_header_says():
    assert ask(OWN, CHUNKED, chunks=[b"x" * LARGEST])[1]["body"] == str(LARGEST).encode()
    assert status(OWN, CHUNKED, chunks=[b"x" * (LARGEST // 2)] * 3) == 413
    assert status(OWN, (b"content-length", b"10"), chunks=[b"x" * LARGEST, b"x"]) == 413
    assert status(OWN, (b"content-length", str(LARGEST + 1).encode())) == 413
    for odd in (b"-1", b"+1", b"1e3", b" ", b"\xb2", b"9" * 5000):
        assert status(OWN, (b"content-length", odd)) == 413
    assert status(OWN, (b"content-length", str(LARGEST).encode())) == 200


def test_an_answer_that_has_begun_is_broken_off():
    said, waiting = [], [{"type": "http.request", "body": b"x" * LARGEST, "more_body": True}, {"type": "http.request", "body": b"x"}]

    async def begins(scope, receive, send):
        await send({"type": "http.response.start", "status": 200, "headers": []})
        while True:
            await receive()

    async def receive():
        return waiting.pop(0)

    async def send(message):
        said.append(message["type"])

    with pytest.raises(Exception, match="^$"):
        loops.run(AccessControl(begins)({"type": "http", "path": "/", "query_string": b"", "headers": [OWN, CHUNKED]}, receive, send))
    assert said == ["http.response.start"]


def test_a_body_that_does_not_arrive_is_waited_for_a_while_only(monkeypatch):
    monkeypatch.setattr(access, "BODY_SECONDS", 0.3)
    said = []

    async def receive():
        await asyncio.sleep(0.1)  # one byte after another
        return {"type": "http.request", "body": b"x", "more_body": True}

    async def send(message):
        said.append(message)

    since = time.monotonic()
    scope = {"type": "http", "path": "/", "query_string": b"", "headers": [OWN, (b"content-length", b"50")]}
    loops.run(AccessControl(_inner)(scope, receive, send))
    assert said[0]["status"] == 408 and time.monotonic() - since < 2


def heard(*texts, **more):
    """Messages that reach the application from a websocket that sends texts at once."""
    waiting, got = [*texts], []

    async def receive():
        if not waiting:
            return {"type": "websocket.disconnect", "code": 1000}
        text = waiting.pop(0)
        return {"type": "websocket.receive", **({"bytes": text} if isinstance(text, bytes) else {"text": text})}

    async def inner(scope, receive, send):
        while True:
            message = await receive()
            got.append(message.get("text", message["type"]))
            if message["type"] == "websocket.disconnect":
                return

    loops.run(AccessControl(inner)({"type": "websocket", "path": "/_nicegui_ws/socket.io/", "headers": [OWN]}, receive, None))
    return got


@pytest.mark.parametrize("text", [b"4", b"", "451-[]", '461-["x"]', "b4AAAA"])
def test_a_websocket_sends_no_binary_data(text):
    assert heard("2", text, "3") == ["2", "websocket.disconnect"]


def test_a_long_message_is_one_long_text():
    text = '42["event",{"args":["' + 'a = 1, [b], \\"c\\", ' * 50_000 + '"]}]'
    assert heard(text) == [text, "websocket.disconnect"]
    for many in ('42["event",[' + "[]," * 300_000 + "0]]", '42["event",[' + '"",' * 300_000 + "0]]", '42["event","' + "x" * 100_000):
        assert heard(many) == ["websocket.disconnect"]


@pytest.mark.parametrize("begin", ['42["event",', '42["event",1'])
@pytest.mark.parametrize("part", ['""', '"",', '\\"', '"\\', '\\\\"', '"\n', '"\\\n', "[", "\\u0022"])
def test_a_long_message_is_looked_at_in_no_time(begin, part):
    """Texts in JSON that never end were once looked for from each of their quotation marks on: a hundred times for ten times the text."""
    tenth, whole = (begin + part * (length // len(part)) for length in (200_000, 2_000_000))
    assert grows_less(heard, tenth, whole, 40)


def test_a_flood_of_messages_waits_in_its_own_connection():
    texts = ["2"] * (FRAMES * 2 + 10)
    since = time.monotonic()
    got = heard(*texts)
    assert len(got) == len(texts) + 1 and time.monotonic() - since > 1.5
