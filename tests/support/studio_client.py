"""A page of the studio without a browser: opened, joined to its socket, and free to send whatever it likes."""

import asyncio
import json
import re
import time
import uuid
from contextlib import asynccontextmanager

ESCAPES = {"&#36;": "$", "&#96;": "`", "&gt;": ">", "&lt;": "<", "&amp;": "&"}


async def fetched(port, path="/", *lines, wait=30):
    """(status, body) of a request of its own connection."""
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    try:
        head = "\r\n".join([f"GET {path} HTTP/1.1", f"Host: 127.0.0.1:{port}", "Connection: close", *lines])
        writer.write(f"{head}\r\n\r\n".encode())
        answer = await asyncio.wait_for(reader.read(), wait)
    finally:
        writer.close()
    head, _, body = answer.partition(b"\r\n\r\n")
    return int(head.split()[1]), body


class Page:
    """One open page; `heard` are the messages of the studio."""

    def __init__(self, socket, ids):
        self.socket, self.ids, self.heard, self.news = socket, ids, [], asyncio.Event()

    async def send(self, frame, text=None):
        """A frame as it is."""
        await self.socket.send(frame, text=text)

    async def say(self, what, **more):
        """A message as the page sends it."""
        await self.argue(json.dumps({"what": what, **more}))

    async def argue(self, *arguments):
        """An event with any arguments."""
        await self.send("42" + json.dumps(["event", {**self.ids, "args": arguments}]))

    async def listen(self):
        """Note what is heard, until the socket closes."""
        async for frame in self.socket:
            if frame == "2":
                await self.socket.send("3")
            elif frame.startswith("42"):
                name, text = json.loads(frame[2:])
                if name == "studio":
                    message = json.loads(text)
                    self.heard.append((time.perf_counter(), message))
                    self.news.set()

    async def until(self, condition, seconds=60):
        """The first message, of those heard and still to come, for which the condition holds."""
        deadline, seen = time.monotonic() + seconds, 0
        while True:
            for _, message in self.heard[seen:]:
                seen += 1
                if condition(message):
                    return message
            self.news.clear()
            await asyncio.wait_for(self.news.wait(), deadline - time.monotonic())


@asynccontextmanager
async def page(port, hello=True, listening=True, **more):
    """An open page that has said hello."""
    import websockets

    status, body = await fetched(port)
    assert status == 200, body
    text = re.search(r"String.raw`(.*?)`", body.decode(), re.DOTALL)[1]
    for escape, letter in ESCAPES.items():
        text = text.replace(escape, letter)
    client = re.search(r"client_id\W+([0-9a-f-]{36})", body.decode())[1]
    number, listener = next(
        (int(n), event["listener_id"]) for n, part in json.loads(text).items() for event in part.get("events", ()) if event["type"] == "say"
    )
    query = f"client_id={client}&next_message_id=0&implicit_handshake=true&tab_id={uuid.uuid4()}&document_id={uuid.uuid4()}"
    address = f"ws://127.0.0.1:{port}/_nicegui_ws/socket.io/?EIO=4&transport=websocket&{query}"
    async with websockets.connect(address, max_size=None, ping_interval=None, close_timeout=1, **more) as socket:
        opened = Page(socket, {"id": number, "client_id": client, "listener_id": listener})
        await socket.recv()
        await socket.send("40")
        await socket.recv()
        ear = asyncio.create_task(opened.listen()) if listening else None
        try:
            if hello:
                while not opened.heard:  # the server hears nothing before the framework's own handshake
                    await opened.say("hello")
                    await asyncio.sleep(0.3)
            yield opened
        finally:
            if ear:
                ear.cancel()


@asynccontextmanager
async def health(port, pause=0.01):
    """Somebody else, who keeps asking whether the server is well: the list of seconds that each answer took."""
    seconds = []

    async def ask():
        while True:
            since = time.perf_counter()
            status, _ = await fetched(port, "/healthz")
            assert status == 200
            seconds.append(time.perf_counter() - since)
            await asyncio.sleep(pause)

    asking = asyncio.create_task(ask())
    try:
        yield seconds
        await asyncio.sleep(2 * pause)
        assert not asking.done() or asking.result()
    finally:
        asking.cancel()
