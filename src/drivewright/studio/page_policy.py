"""What a browser may do with our answers: a content security policy for the page, and headers that keep other sites out of all of them.

The page's own scripts and styles carry a nonce that is new for every answer; nothing else in a page is run.  `unsafe-eval` is there because
the framework compiles its templates in the browser.
"""

import re
import secrets

from drivewright.studio.access import Application, Receive, Scope, Send

PAGE = (
    "default-src 'none'; script-src 'self' 'nonce-{nonce}' 'unsafe-eval'; style-src 'self' 'nonce-{nonce}'; img-src 'self' data: blob:; "
    "font-src 'self' data:; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
ELSE = "default-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
HEADERS = (
    (b"x-frame-options", b"DENY"),
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
    (b"cross-origin-opener-policy", b"same-origin"),
    (b"cross-origin-resource-policy", b"same-origin"),
)
NAMES = frozenset(name for name, _ in HEADERS) | {b"content-security-policy"}
TAGS = re.compile(rb"<(script|style)(?=[\s>])")
HIDDEN = (b' style="display: none"', b" hidden")  # the framework's one attribute that a policy without unsafe-inline refuses


class PagePolicy:
    """Adds the headers to every answer, and the nonce to the page at "/"."""

    def __init__(self, app: Application) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One request."""
        if scope["type"] != "http":
            return await self.app(scope, receive, send)
        if scope["path"] != "/":
            return await self.app(scope, receive, _with_headers(send, ELSE))
        plain = [(name, value) for name, value in scope["headers"] if name.lower() not in (b"accept-encoding", b"accept")]
        return await self.app({**scope, "headers": [*plain, (b"accept", b"text/html")]}, receive, _Page(send).send)


def _with_headers(send, policy):
    """`send` that adds the headers to the begin of an answer."""

    async def sending(message):
        if message["type"] == "http.response.start":
            kept = [(name, value) for name, value in message.get("headers", ()) if name.lower() not in NAMES]
            message = {**message, "headers": [*kept, *HEADERS, (b"content-security-policy", policy.encode())]}
        await send(message)

    return sending


class _Page:
    """Holds the page back until it is whole, and puts the nonce in."""

    def __init__(self, send):
        self._nonce = secrets.token_urlsafe(16)
        self._send, self._start, self._body = _with_headers(send, PAGE.format(nonce=self._nonce)), None, b""

    async def send(self, message):
        """One message of the application."""
        if message["type"] == "http.response.start":
            self._start = message
            return
        self._body += message.get("body", b"")
        if message.get("more_body") or self._start is None:
            return
        body = TAGS.sub(rb'<\1 nonce="' + self._nonce.encode() + b'"', self._body).replace(*HIDDEN)
        kept = [(name, value) for name, value in self._start.get("headers", ()) if name.lower() != b"content-length"]
        await self._send({**self._start, "headers": [*kept, (b"content-length", str(len(body)).encode())]})
        await self._send({"type": "http.response.body", "body": body})
