"""Who may talk to the studio, and how much: hosts, origins, a token, counted bytes.  Plain ASGI, for pages and websockets alike."""

import hmac
from collections.abc import Awaitable, Callable, MutableMapping
from contextlib import suppress
from http.cookies import CookieError, SimpleCookie
from typing import Any, TypeAlias
from urllib.parse import parse_qs, urlsplit

Scope: TypeAlias = MutableMapping[str, Any]
Receive: TypeAlias = Callable[[], Awaitable[MutableMapping[str, Any]]]
Send: TypeAlias = Callable[[MutableMapping[str, Any]], Awaitable[None]]
Application: TypeAlias = Callable[[Scope, Receive, Send], Awaitable[None]]  # of ASGI
LARGEST = 4_000_000  # bytes of a request's body
COOKIE = "drivewright-studio"
LOOPBACK = ("127.0.0.1", "localhost", "::1")
OPEN = ("/healthz",)


class AccessControl:
    """Refuses what does not come from the studio's own page.

    On this machine only (`token` empty) the Host header must be one of this machine's own names, so that no other name that somebody
    points here gets through.  Elsewhere a token is wanted, as `?token=` once and as a cookie from then on.  An Origin header must be the
    host itself: a page of another site can neither post nor open a websocket.  Bodies are counted as they arrive.
    """

    def __init__(self, app: Application, token: str = "", port: int | str = "") -> None:
        self.app, self.token, self.cookie = app, token, f"{COOKIE}-{port}" if port else COOKIE  # cookies know no ports

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One request, or one websocket."""
        if scope["type"] not in ("http", "websocket"):
            return await self.app(scope, receive, send)
        headers = {name.decode("latin-1").lower(): value.decode("latin-1") for name, value in scope["headers"]}
        if status := self._refused(scope, headers):
            return await _refuse(scope, receive, send, *status)
        if scope["type"] == "http" and self._shown(scope) and not self._has_cookie(headers):
            return await self._welcome(scope, send)
        counted = _Counted(receive, send)
        try:
            await self.app(scope, counted.receive, counted.send)
        except Exception:  # frameworks wrap what `receive` raises, or swallow it and answer something else
            if not counted.refused:
                raise
        return await _refuse(scope, receive, send, 413, "more than the studio takes") if counted.refused else None

    def _refused(self, scope, headers):
        """(status, words) where this may not pass, else None."""
        host = headers.get("host", "")
        if not self.token and _name(host) not in LOOPBACK:
            return 421, "the studio answers to this machine's own names only"
        origin = headers.get("origin")
        if origin is not None and _place(origin) != host.lower():
            return 403, "this page belongs to another site"
        length = headers.get("content-length", "0")
        if not length.isdecimal() or int(length) > LARGEST:
            return 413, "more than the studio takes"
        if self.token and scope["path"] not in OPEN and not (self._has_cookie(headers) or (scope["type"] == "http" and self._shown(scope))):
            return 401, "a token is wanted: open the address that the command printed"
        return None

    def _shown(self, scope):
        """Whether the address carries the token."""
        given = parse_qs(scope.get("query_string", b"").decode("latin-1")).get("token", [""])[0]
        return bool(self.token) and hmac.compare_digest(given.encode(), self.token.encode())

    def _has_cookie(self, headers):
        try:
            cookie = SimpleCookie(headers.get("cookie", "")).get(self.cookie)
        except CookieError:
            return False
        return bool(self.token) and cookie is not None and hmac.compare_digest(cookie.value.encode(), self.token.encode())

    async def _welcome(self, scope, send):
        """To the same page without the token in its address, which stays in the browser's history."""
        cookie = f"{self.cookie}={self.token}; HttpOnly; SameSite=Strict; Path=/"
        headers = [(b"location", b"/"), (b"set-cookie", cookie.encode()), (b"content-length", b"0")]
        await send({"type": "http.response.start", "status": 303, "headers": headers})
        await send({"type": "http.response.body", "body": b""})


class _TooLarge(Exception):
    """The body has grown over the limit."""


class _Counted:
    """`receive` and `send` of one request; the bytes of its body are counted, whatever its headers promise."""

    def __init__(self, receive, send):
        self._receive, self._send, self._bytes, self._begun, self.refused = receive, send, 0, False, False

    async def receive(self):
        """The next message."""
        message = await self._receive()
        if message["type"] == "http.request":
            self._bytes += len(message.get("body", b""))
            if self._bytes > LARGEST:
                self.refused = not self._begun
                raise _TooLarge
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


def _name(host):
    """The name in a Host header, without its port."""
    with suppress(ValueError):  # a bracket that does not close
        return urlsplit(f"//{host}").hostname or ""
    return ""


def _place(origin):
    """Host and port of an Origin header."""
    with suppress(ValueError):
        return urlsplit(origin).netloc.lower()
    return ""
