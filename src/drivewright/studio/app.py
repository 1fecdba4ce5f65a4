"""The studio's server: NiceGUI carries the messages, our own modules draw the page.

Everything that holds state lives in the `Session` of a tab; what tabs share is the `ServerResources`.
"""

import asyncio
import secrets
import socket
import webbrowser
from collections.abc import Callable
from contextlib import asynccontextmanager, suppress
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from drivewright.errors import InputError, MissingExtra
from drivewright.report.html import MODULES
from drivewright.studio import preview
from drivewright.studio.access import LOOPBACK, AccessControl
from drivewright.studio.design import Design
from drivewright.studio.resources import ServerResources
from drivewright.studio.session import Session
from drivewright.view.palette import style_sheet

if TYPE_CHECKING:
    from fastapi import FastAPI

HERE = Path(__file__).parent
PLAYER = HERE.parent / "report"
SHARED = (*MODULES, "player.css")  # with the report
TYPES = {".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml"}
SAFE = {"X-Content-Type-Options": "nosniff", "Cache-Control": "no-cache"}
PORT = 8123
EVERY = ("0.0.0.0", "::")  # all addresses of this machine
AWAY = 30.0  # seconds without a sign of life after which a tab counts as closed; also paces the signs of life


def serve(
    start: Design,
    name: str = "",
    host: str = "127.0.0.1",
    port: int | None = None,
    token: str = "",
    browser: bool = True,
    say: Callable[[str], object] = print,
) -> None:
    """Serve until Ctrl-C.  InputError where the port is taken, or a host that others can reach has no token.

    `start` is the design that a new page shows; `say(text)` tells the person at the terminal the address.
    """
    try:
        import nicegui  # noqa: F401
        import uvicorn
    except ImportError as error:
        raise MissingExtra("drivewright studio", "studio", error) from None
    listening = _listening(host, port)
    token = "" if host in LOOPBACK else token or secrets.token_urlsafe(18)
    number, name_of_host = listening.getsockname()[1], socket.gethostname() if host in EVERY else f"[{host}]" if ":" in host else host
    address = f"http://{name_of_host}:{number}/{f'?token={token}' if token else ''}"
    app = application(start, name, lambda: _ready(address, browser, say))
    config = uvicorn.Config(
        AccessControl(app, token, number),
        log_level="warning",
        ws_max_size=4_000_000,
        timeout_graceful_shutdown=1,
        ws_per_message_deflate=bool(token),
    )  # to this machine itself folding costs more time than it saves
    with suppress(KeyboardInterrupt):
        uvicorn.Server(config).run(sockets=[listening])


def _listening(host: str, port: int | None) -> socket.socket:
    """A socket at the port; without one the next that is free."""
    for number in [port] if port is not None else range(PORT, PORT + 20):
        with suppress(OSError, OverflowError):
            family = socket.AF_INET6 if ":" in host else socket.AF_INET
            listener = socket.socket(family)
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                listener.bind((host, number))
                listener.listen()
                return listener
            except BaseException:
                listener.close()
                raise
    at = f"port {port}" if port is not None else f"ports {PORT} to {PORT + 19}"
    raise InputError(f"studio: {host}, {at}: cannot listen there (taken, or not allowed); choose another --port, or --host of this machine")


def _ready(address, browser, say):
    say(f"Drivewright studio: {address}  (Ctrl-C ends it)")
    if browser:
        with suppress(webbrowser.Error):
            webbrowser.open(address)


def application(start: Design, name: str = "", ready: Callable[[], object] = lambda: None) -> "FastAPI":
    """The ASGI application: the page, the modules, downloads, /healthz.  `ready()` is called when it has begun."""
    from fastapi import FastAPI, Response
    from nicegui import core, ui

    started = []

    @asynccontextmanager
    async def lifespan(app):
        started.append(ServerResources())
        warming = asyncio.create_task(_warmed(started[-1]))
        ready()
        yield
        warming.cancel()
        started.pop().close()

    app = FastAPI(lifespan=lifespan, docs_url=None, redoc_url=None, openapi_url=None)

    @app.get("/healthz")
    def healthz():
        return {"status": "ok"}

    @app.get("/web/{file}")
    def web(file: str):
        served = _files().get(file)
        return Response(served[0], media_type=served[1], headers=SAFE) if served else Response(status_code=404)

    @app.get("/download/{token}")
    def download(token: str):
        download_file = started[-1].fetch(token)
        if download_file is None:
            return Response("this file has been fetched already, or is too old: ask for it again\n", 404, media_type="text/plain")
        headers = SAFE | {"Content-Disposition": _attachment(download_file[0])}
        return Response(download_file[1], media_type="application/octet-stream", headers=headers)

    @ui.page("/", title="Drivewright studio", reconnect_timeout=AWAY)
    def page():
        _page(started[-1], start, name)

    core.sio.eio.max_http_buffer_size = 4_000_000
    ui.run_with(
        app,
        title="Drivewright studio",
        favicon=HERE / "web" / "mark.svg",
        tailwind=False,
        show_welcome_message=False,
        reconnect_timeout=AWAY,
    )
    return app


def _page(resources, start, name):
    """One tab: a session, and the one element that shows it."""
    from nicegui import background_tasks, core, ui

    ui.add_head_html(
        f"<style>{style_sheet()}</style>"
        + "".join(f'<link rel="stylesheet" href="/web/{file}">' for file in _files() if file.endswith(".css"))
    )
    client = ui.context.client

    def send(message):
        background_tasks.create(core.sio.emit("studio", message, room=client.id))

    session = Session(send, resources, start, name)
    _element()().on("say", lambda event: session.receive(event.args))
    client.on_delete(session.close)


@cache
def _element():
    from nicegui.element import Element

    class Page(Element, component="web/page.js"):
        """The place of our own modules."""

    return Page


@cache
def _files():
    """Name -> (bytes, type) of what the page fetches: the modules and styles of the studio and of the report's player."""
    own = [path for path in sorted((HERE / "web").iterdir()) if path.suffix in TYPES]
    return {path.name: (path.read_bytes(), TYPES[path.suffix]) for path in [*(PLAYER / name for name in SHARED), *own]}


async def _warmed(resources):
    """Load what the first drawing needs, before it is asked for."""

    async def warm(pool):
        async with pool.worker() as worker:
            await worker.call(preview.warm)

    await asyncio.gather(warm(resources.quick), warm(resources.heavy), return_exceptions=True)


def _attachment(name):
    """Content-Disposition for a name with any letters."""
    from urllib.parse import quote

    plain = name.encode("ascii", "replace").decode().replace("?", "_").replace('"', "_")
    return f"attachment; filename=\"{plain}\"; filename*=UTF-8''{quote(name)}"
