"""Access to the studio and its limits: hosts, origins, a token, counted bytes.  Plain ASGI, for pages and websockets alike."""

import asyncio
import hmac
import re
import secrets
import time
from collections.abc import Awaitable, Callable, MutableMapping
from contextlib import suppress
from ipaddress import ip_address, ip_network
from typing import Any, TypeAlias
from urllib.parse import parse_qs

from drivewright.studio.guesses import Guesses

Scope: TypeAlias = MutableMapping[str, Any]
Receive: TypeAlias = Callable[[], Awaitable[MutableMapping[str, Any]]]
Send: TypeAlias = Callable[[MutableMapping[str, Any]], Awaitable[None]]
Application: TypeAlias = Callable[[Scope, Receive, Send], Awaitable[None]]  # of ASGI
LARGEST = 100_000  # bytes of a request's body: large texts come over the websocket
BODY_SECONDS = 30.0  # in which it has to arrive
POLL_SECONDS = 60.0  # that a request of the socket without a websocket may take; the framework waits for ever after an odd one
FRAMES = 200  # messages that one websocket may send in a second; more of them wait
COOKIE = "drivewright-studio"
LEAST_TOKEN = 16  # characters
LOOPBACK = ("127.0.0.1", "localhost", "::1")
OPEN = ("/healthz",)
SOCKET = "/_nicegui_ws/"
SERVED = ("/web/", "/download/", "/_nicegui/", SOCKET)
PAGES = ("/", "/healthz", "/favicon.ico")
HOST = re.compile(r"(\[[0-9a-f:.]+\]|[0-9a-z._-]+)(?::([0-9]{1,5}))?", re.IGNORECASE)
KINDS, BINARY = "0123456", ("45", "46")  # how messages of the socket begin, and those with binary data, of which the page sends none
LONGEST_ADDRESS = 64  # characters
LONG, LOOSE = 50_000, 2_000  # characters of a message that is looked at, and of what it may have outside of texts
TEXT = re.compile(r'"[^"\\]*+(?:\\.[^"\\]*+)*+("?)')  # of JSON; without the last quotation mark to the end, so that nothing is read twice
TOO_LARGE, TOO_SLOW = (413, "more than the studio takes"), (408, "the rest of this request did not arrive in time")


class AccessControl:
    """Refuses what does not come from the studio's own page.

    There is one Host header and at most one Origin.  On this machine only (`token` empty) the Host must be one of this machine's own
    names, so that no other name that somebody points here gets through.  Elsewhere a token is wanted, as `?token=` once; from then on a
    cookie with a secret of its own is, so that only the address can be guessed at, which `Guesses` slows down.  An Origin must be the host
    itself: a page of another site can neither post nor open a websocket.  Bodies are counted and timed as they arrive.
    """

    def __init__(self, app: Application, token: str = "", port: int | str = "") -> None:
        self.app, self.token, self.cookie = app, token, f"{COOKIE}-{port}" if port else COOKIE  # cookies know no ports
        self._secret, self._guesses = secrets.token_urlsafe(32), Guesses()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One request, or one websocket."""
        if scope["type"] not in ("http", "websocket"):
            return await self.app(scope, receive, send)
        headers = [(name.decode("latin-1").lower(), value.decode("latin-1")) for name, value in scope["headers"]]
        scope = {**scope, **_before_proxy(scope, dict(headers))}
        if status := _malformed(headers) or self._refused(scope, dict(headers)):
            return await _refuse(scope, receive, send, *status)
        if self.token and scope["path"] not in OPEN and not self._has_cookie(dict(headers)):
            return await self._enter(scope, receive, send)
        if scope["path"] not in PAGES and not scope["path"].startswith(SERVED):
            return await _refuse(scope, receive, send, 404, "there is nothing here")
        counted = _Counted(receive, send, any(name in ("content-length", "transfer-encoding") for name, _ in headers))
        try:
            async with asyncio.timeout(POLL_SECONDS if scope["type"] == "http" and scope["path"].startswith(SOCKET) else None):
                await self.app(_without_cookies(scope), counted.receive, counted.send)
        except TimeoutError:
            counted.refuse(TOO_SLOW)
        except Exception:  # frameworks wrap what `receive` raises, or swallow it and answer something else
            if not (counted.refused or counted.gone):
                raise
        return await _refuse(scope, receive, send, *counted.refused) if counted.refused else None

    def _refused(self, scope, headers):
        """(status, words) where this may not pass, else None."""
        host = HOST.fullmatch(headers.get("host", ""))
        if host is None or int(host[2] or 0) > 65535 or not self.token and host[1].lower().strip("[]") not in LOOPBACK:
            return 421, "the studio answers to this machine's own names only"
        origin = headers.get("origin")
        if origin is not None and origin.lower() not in (f"{scheme}://{host[0].lower()}" for scheme in ("http", "https")):
            return 403, "this page belongs to another site"
        shown = headers.get("sec-fetch-dest", "document") == "document" and "sec-purpose" not in headers  # or fetched in advance
        if headers.get("sec-fetch-site") == "cross-site" and not shown:
            return 403, "this page belongs to another site"
        length = headers.get("content-length", "0")
        if not (length.isascii() and length.isdecimal()) or len(length) > 18 or int(length) > LARGEST:
            return TOO_LARGE
        return None

    async def _enter(self, scope, receive, send):
        """The door where a token is wanted: right ones in the address are welcome, wrong ones wait the longer the more there were."""
        given = parse_qs(scope.get("query_string", b"").decode("latin-1")).get("token", [""])[0]
        if scope["type"] == "websocket" or not given:
            return await _refuse(scope, receive, send, 401, "a token is wanted: open the address that the command printed")
        if (seconds := self._guesses.next(_peer(scope))) is None:
            return await _refuse(scope, receive, send, 429, "too many wrong tokens came from there; try again in a minute")
        await asyncio.sleep(seconds)
        if hmac.compare_digest(given.encode("utf-8", "replace"), self.token.encode()):
            self._guesses.right(_peer(scope))
            return await self._welcome(scope, send)
        return await _refuse(scope, receive, send, 401, "this is not the token: open the address that the command printed")

    def _has_cookie(self, headers):
        """Whether our cookie is there.  Python's own reader of cookies takes ten seconds for 64 kB of backslashes."""
        pairs = (pair.strip().partition("=") for pair in headers.get("cookie", "").split(";"))
        given = "".join(value for name, _, value in pairs if name == self.cookie)
        return hmac.compare_digest(given.encode("utf-8", "replace"), self._secret.encode())

    async def _welcome(self, scope, send):
        """To the same page without the token in its address, which stays in the browser's history."""
        secure = "; Secure" if scope.get("scheme") == "https" else ""
        cookie = f"{self.cookie}={self._secret}; HttpOnly; SameSite=Strict; Path=/{secure}"
        headers = [(b"location", b"/"), (b"set-cookie", cookie.encode()), (b"content-length", b"0"), (b"referrer-policy", b"no-referrer")]
        await send({"type": "http.response.start", "status": 303, "headers": headers})
        await send({"type": "http.response.body", "body": b""})


def _malformed(headers):
    """(status, words) where headers that name the place are there twice."""
    names = [name for name, _ in headers]
    if any(names.count(name) > 1 for name in ("host", "origin", "content-length")):
        return 400, "this request names its host, its origin or its length twice"
    return None


def _before_proxy(scope, headers):
    """{client, scheme} as a proxy of this machine tells them: the last address is its own word, those before it anybody's."""
    told = {}
    if (scope.get("client") or ("",))[0] in LOOPBACK:
        if address := headers.get("x-forwarded-for", "").rpartition(",")[2].strip():
            told["client"] = (address, 0)
        if headers.get("x-forwarded-proto", "").strip().lower() == "https" and scope["type"] == "http":
            told["scheme"] = "https"
    return told


def _without_cookies(scope):
    """For the frameworks, which need none, and take seconds to read hostile ones."""
    return {**scope, "headers": [(name, value) for name, value in scope["headers"] if name.lower() != b"cookie"]}


def _is_loose(text):
    """Whether a message has more than LOOSE texts, or characters outside of them, or a text that does not end."""
    loose, end = 0, 0
    for match in TEXT.finditer(text):
        loose, end = loose + 1 + match.start() - end, match.end()
        if loose > LOOSE or not match[1]:
            return True
    return loose + len(text) - end > LOOSE


def _peer(scope):
    """Where a request comes from: an address, or the network of an IPv6 address; cut, as a proxy may say anything."""
    address = (scope.get("client") or ("",))[0][:LONGEST_ADDRESS]
    with suppress(ValueError):
        return str(ip_network((address, 64), strict=False)) if ip_address(address).version == 6 else address
    return address


class _Refused(Exception):
    """The body has grown over the limit, or does not arrive."""


class _Counted:
    """`receive` and `send` of a request or a websocket: a body is counted and timed, messages are slowed down where there are many."""

    def __init__(self, receive, send, has_body):
        self._receive, self._send, self._bytes, self._begun = receive, send, 0, False
        self.refused, self.gone = None, False  # the answer instead; whether the peer has left
        self._until = time.monotonic() + BODY_SECONDS if has_body else None  # None when there is no body to wait for any more
        self._second, self._frames = 0.0, 0

    async def receive(self):
        """The next message."""
        message = await self._next()
        self.gone = message["type"] == "http.disconnect"
        if self._until is None:
            return await self._paced(message)
        self._bytes += len(message.get("body", b""))
        if self._bytes > LARGEST:
            raise self.refuse(TOO_LARGE)
        if not message.get("more_body"):
            self._until = None
        return message

    async def _next(self):
        if self._until is None:
            return await self._receive()
        try:
            return await asyncio.wait_for(self._receive(), self._until - time.monotonic())
        except TimeoutError:
            raise self.refuse(TOO_SLOW) from None

    def refuse(self, status):
        """No answer of the application: (status, words) instead, unless one has begun."""
        self.refused = None if self._begun else status
        return _Refused()

    async def _paced(self, message):
        """Messages of a websocket are text, and not more in a second than a hand can cause: the rest waits in the sender's own buffers.

        A large one is large for one long text in it: a million brackets would take the server's loop too long to read.
        """
        if message["type"] != "websocket.receive":
            return message
        text = message.get("text")
        if not text or text[0] not in KINDS or text.startswith(BINARY) or len(text) > LONG and _is_loose(text):
            return {"type": "websocket.disconnect", "code": 1003}
        now = time.monotonic()
        if now - self._second >= 1:
            self._second, self._frames = now, 0
        self._frames += 1
        if self._frames > FRAMES:
            await asyncio.sleep(self._second + 1 - now)
        return message

    async def send(self, message):
        """Hand on, and remember that an answer has begun; nothing where the body was refused."""
        if not self.refused:
            self._begun = True
            await self._send(message)


async def _refuse(scope, receive, send, status, words):
    """Say no: with a status, or by not accepting the websocket."""
    if scope["type"] == "websocket":
        await receive()
        await send({"type": "websocket.close", "code": 4000 + status})
        return
    body = f"{words}\n".encode()
    headers = [(b"content-type", b"text/plain; charset=utf-8"), (b"content-length", str(len(body)).encode())]
    await send({"type": "http.response.start", "status": status, "headers": headers})
    await send({"type": "http.response.body", "body": body})
