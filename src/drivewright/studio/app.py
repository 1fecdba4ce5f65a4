"""The studio's server: NiceGUI carries the messages, our own modules draw the page.

Everything that holds state lives in the `Session` of a tab; what tabs share is the `ServerResources`.
"""

import asyncio
import gc
import secrets
import socket
import webbrowser
from collections.abc import Callable
from contextlib import asynccontextmanager, suppress
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import quote

from drivewright import registry
from drivewright.errors import InputError, MissingExtra
from drivewright.report.dimension_drawings import drawing_files
from drivewright.report.html import MODULES, SOLID_MODULES
from drivewright.report.worked_examples import cards, preset_films, preset_pictures
from drivewright.studio import preview, translations
from drivewright.studio.access import LEAST_TOKEN, LOOPBACK, AccessControl
from drivewright.studio.design import Design
from drivewright.studio.drawing_words import drawing_in_words
from drivewright.studio.offers import offered
from drivewright.studio.page_policy import PagePolicy
from drivewright.studio.resources import ServerResources
from drivewright.studio.session import Session
from drivewright.studio.tabs import Tabs
from drivewright.view.palette import style_sheet

if TYPE_CHECKING:
    from fastapi import FastAPI

HERE = Path(__file__).parent
PLAYER = HERE.parent / "report"
SHARED = (*MODULES, *SOLID_MODULES, "player.css", "solid.css")  # with the report
TYPES = {".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml", ".webp": "image/webp"}
SAFE = {"X-Content-Type-Options": "nosniff", "Cache-Control": "no-cache"}
PORT = 8123
EVERY = ("0.0.0.0", "::")  # all addresses of this machine
LARGEST_MESSAGE = 2_000_000  # bytes of a message of a page
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
    if token and (len(token) < LEAST_TOKEN or not token.isascii() or not token.isprintable()):
        raise InputError(
            f"studio: --token has {len(token)} characters; it needs at least {LEAST_TOKEN} printable ASCII characters. "
            "Leave it out, and a new one is made"
        )
    listening = _listening(host, port)
    token = token or ("" if host in LOOPBACK else secrets.token_urlsafe(18))
    number, name_of_host = listening.getsockname()[1], socket.gethostname() if host in EVERY else f"[{host}]" if ":" in host else host
    address = f"http://{name_of_host}:{number}/{f'?token={quote(token)}' if token else ''}"
    app = application(start, name, lambda: _ready(address, browser, say))
    from drivewright.studio.connections import HEADERS, PatientProtocol

    config = uvicorn.Config(
        PagePolicy(AccessControl(app, token, number)),
        http=PatientProtocol,
        log_level="error",
        ws_max_size=LARGEST_MESSAGE,
        ws_max_queue=4,
        h11_max_incomplete_event_size=HEADERS,
        proxy_headers=False,  # AccessControl reads them: a long list of addresses took uvicorn seconds
        timeout_graceful_shutdown=1,
        ws_per_message_deflate=False,  # to this machine itself folding costs more time than it saves, and unfolding is work for nothing
    )
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

    started, tabs = [], Tabs()

    @asynccontextmanager
    async def lifespan(app):
        started.append(ServerResources())
        warming = asyncio.create_task(_warmed(started[-1]))
        tabs.listen(core.sio)
        ready()
        yield
        warming.cancel()
        started.pop().close()

    app = FastAPI(lifespan=lifespan, docs_url=None, redoc_url=None, openapi_url=None)

    @app.get("/healthz")
    async def healthz():
        return {"status": "ok"}

    @app.get("/web/{file}")
    async def web(file: str):
        served = _files().get(file)
        return Response(served[0], media_type=served[1], headers=SAFE) if served else Response(status_code=404)

    @app.get("/download/{token}")
    async def download(token: str):
        download_file = started[-1].fetch(token)
        if download_file is None:
            return Response("this file has been fetched already, or is too old: ask for it again\n", 404, media_type="text/plain")
        headers = SAFE | {"Content-Disposition": _attachment(download_file[0])}
        return Response(download_file[1], media_type="application/octet-stream", headers=headers)

    @ui.page("/", title="Drivewright studio", reconnect_timeout=AWAY)
    def page():
        if tabs.full:
            return Response(
                "more tabs than the studio can serve are open: close some, and reload in a minute\n", 503, media_type="text/plain"
            )
        return _page(started[-1], tabs, start, name)

    core.sio.eio.max_http_buffer_size = LARGEST_MESSAGE
    ui.run_with(
        app,
        title="Drivewright studio",
        favicon=HERE / "web" / "mark.svg",
        tailwind=False,
        show_welcome_message=False,
        reconnect_timeout=AWAY,
    )
    return app


def _page(resources, tabs, start, name):
    """One tab: a session, and the one element that shows it."""
    from nicegui import ui

    ui.add_head_html(
        f"<style>{style_sheet()}</style>"
        + "".join(f'<link rel="stylesheet" href="/web/{file}">' for file in _files() if file.endswith(".css"))
    )
    client = ui.context.client
    session = Session(lambda message: tabs.send(client.id, message), resources, start, name)
    _element()().on("say", lambda: None)  # what it says goes to the session directly
    tabs.open(client.id, session)
    client.on_delete(lambda: tabs.close(client.id))


@cache
def _element():
    from nicegui.element import Element

    class Page(Element, component="web/page.js"):
        """The place of our own modules."""

    return Page


@cache
def _files():
    """Name -> (bytes, type) of what the page fetches: modules and styles of the studio and of the report's player, pictures of designs."""
    own = [path for path in sorted((HERE / "web").iterdir()) if path.suffix in TYPES]
    named = {path.name: path for path in [*(PLAYER / name for name in SHARED), *own]} | dict(_pictures())
    return {name: (path.read_bytes(), TYPES[path.suffix]) for name, path in named.items()} | dict(_translated_drawings())


def _translated_drawings():
    """(name, (bytes, type)) of the drawings of what keys measure, in the other language."""
    for kind in registry.kinds():
        for name, path in drawing_files(kind).items():
            drawn = drawing_in_words(kind, path.read_text(encoding="utf-8"))
            yield f"drawing.{name}.{translations.LANGUAGE}.svg", (drawn.encode(), TYPES[path.suffix])


def _pictures():
    """(name, path) of the pictures of presets and examples, and of the drawings of what keys measure."""
    for kind in registry.kinds():
        yield from ((f"preset.{kind}.{name}.webp", path) for name, path in preset_pictures(kind).items())
        yield from ((f"preset.{kind}.{name}.moving.webp", path) for name, path in preset_films(kind).items())
        yield from ((f"drawing.{name}.svg", path) for name, path in drawing_files(kind).items())
    for card in cards():
        yield from ((f"example.{path.name}", path) for path in (card.still, card.moving) if path and path.is_file())


async def _warmed(resources):
    """Load what the first message and the first drawing need, before they are needed, and exclude it from garbage collection."""

    async def warm(pool, function, *arguments):
        async with pool.worker() as worker:
            await worker.call(function, *arguments)

    def load():
        preview.warm(lambda message: None)
        for kind in (None, *registry.kinds()):
            translations.texts(kind)
        offered()
        _files()

    await asyncio.gather(
        asyncio.to_thread(load),
        warm(resources.quick, preview.warm),
        warm(resources.reading, preview.warm),
        warm(resources.heavy, preview.warm),
        return_exceptions=True,
    )
    await asyncio.gather(*(warm(resources.quick, preview.warm) for _ in range(2)), return_exceptions=True)  # the next one for other tabs
    gc.collect()
    gc.freeze()


def _attachment(name):
    """Content-Disposition for a name with any letters."""
    plain = name.encode("ascii", "replace").decode().replace("?", "_").replace('"', "_")
    return f"attachment; filename=\"{plain}\"; filename*=UTF-8''{quote(name)}"
