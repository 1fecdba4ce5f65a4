"""Who may talk to the studio: hosts, origins, the token, counted bytes - for pages and websockets."""

import loops
import pytest

from drivewright.studio.access import COOKIE, LARGEST, AccessControl

pytestmark = pytest.mark.interface

OWN = (b"host", b"127.0.0.1:8123")


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


def ask(*headers, token="", path="/", query=b"", kind="http", chunks=(b"",)):
    """(first message, body) of the gate's answer."""
    said, waiting = [], [{"type": "http.request", "body": c, "more_body": n + 1 < len(chunks)} for n, c in enumerate(chunks)]

    async def receive():
        return waiting.pop(0) if kind == "http" else {"type": "websocket.connect"}

    async def send(message):
        said.append(message)

    scope = {"type": kind, "path": path, "query_string": query, "headers": list(headers)}
    loops.run(AccessControl(_inner, token)(scope, receive, send))
    return said


def status(*headers, **more):
    first = ask(*headers, **more)[0]
    return first.get("status", first["type"])


@pytest.mark.parametrize("host", [b"127.0.0.1:8123", b"localhost:8123", b"[::1]:8123", b"LOCALHOST"])
def test_this_machines_own_names_pass(host):
    assert status((b"host", host)) == 200


@pytest.mark.parametrize("host", [b"evil.example:8123", b"127.0.0.1.evil.example", b"", b"192.168.1.7:8123", b"[::1", b"[x]"])
def test_another_name_for_this_machine_is_refused(host):
    assert status((b"host", host)) == 421


def test_no_host_at_all_is_refused():
    assert status() == 421


@pytest.mark.parametrize("kind", ["http", "websocket"])
def test_a_page_of_another_site_is_refused(kind):
    good = {"http": 200, "websocket": "websocket.accept"}[kind]
    assert status(OWN, (b"origin", b"http://127.0.0.1:8123"), kind=kind) == good
    assert status((b"host", b"LocalHost:8123"), (b"origin", b"http://localhost:8123"), kind=kind) == good
    assert status(OWN, kind=kind) == good  # programs send no origin
    for origin in (b"http://evil.example", b"http://127.0.0.1:9999", b"null", b"http://127.0.0.1:8123.evil.example", b"http://["):
        assert status(OWN, (b"origin", origin), kind=kind) == {"http": 403, "websocket": "websocket.close"}[kind]


def test_a_token_opens_once_by_address_and_then_by_cookie():
    other = (b"host", b"workstation:8123")
    assert status(other, token="abc") == 401
    assert status(other, token="abc", query=b"token=abd") == 401
    welcome = ask(other, token="abc", query=b"token=abc")[0]
    assert welcome["status"] == 303 and dict(welcome["headers"])[b"location"] == b"/"
    cookie = dict(welcome["headers"])[b"set-cookie"].decode()
    assert "HttpOnly" in cookie and "SameSite=Strict" in cookie
    kept = (b"cookie", cookie.partition(";")[0].encode())
    assert status(other, kept, token="abc") == 200
    assert status(other, kept, token="abc", query=b"token=abc") == 200  # no second welcome
    assert status(other, kept, token="abc", kind="websocket") == "websocket.accept"
    assert status(other, token="abc", kind="websocket") == "websocket.close"
    assert status(other, token="abc", kind="websocket", query=b"token=abc") == "websocket.close"
    assert status(other, (b"cookie", f"{COOKIE}=abd".encode()), token="abc") == 401
    assert status(other, (b"cookie", b"\x00;;=;"), token="abc") == 401


def test_health_needs_no_token():
    assert status((b"host", b"workstation"), token="abc", path="/healthz") == 200
    assert status((b"host", b"workstation"), token="abc", path="/healthz/other") == 401


def test_bodies_are_counted_whatever_their_length_header_says():
    assert ask(OWN, chunks=[b"x" * LARGEST])[1]["body"] == str(LARGEST).encode()
    assert status(OWN, chunks=[b"x" * (LARGEST // 2)] * 3) == 413
    assert status(OWN, (b"content-length", b"10"), chunks=[b"x" * LARGEST, b"x"]) == 413
    assert status(OWN, (b"content-length", str(LARGEST + 1).encode())) == 413
    assert status(OWN, (b"content-length", b"-1")) == 413
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
        loops.run(AccessControl(begins)({"type": "http", "path": "/", "query_string": b"", "headers": [OWN]}, receive, send))
    assert said == ["http.response.start"]


def test_a_websocket_learns_why():
    assert ask(OWN, (b"origin", b"http://evil.example"), kind="websocket") == [{"type": "websocket.close", "code": 4403}]
