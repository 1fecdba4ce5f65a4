"""Tabs of the studio without a browser: websocket clients of one server, time to a new drawing and memory against their number."""

import asyncio
import statistics
import sys
import tempfile
import time
from contextlib import AsyncExitStack
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "tests" / "support"))  # the server and its clients are those of the tests
KEY, LENGTH = "bodies.crank.points.A.0", 41.0  # of the four-bar linkage [mm]
COUNTS, ROUNDS = (1, 2, 4, 8, 16, 32), 7


class Tab:
    """An open page; `draw` changes its design and waits for the new drawing."""

    def __init__(self, page):
        self.page, self.changes = page, 0

    def latest(self):
        """Number of the newest design that the tab has heard of."""
        return max((message["gen"] for _, message in self.page.heard if message.get("gen")), default=0)

    async def draw(self):
        """Time at which the drawing of another crank length has come."""
        before, self.changes = self.latest(), self.changes + 1
        await self.page.say("set", key=KEY, text=f"{LENGTH + 0.01 * self.changes:.2f} mm")
        await self.page.until(lambda message: message["what"] == "scene" and message["gen"] > before)
        return time.perf_counter()

    async def rest(self):
        """Waits until the newest design is fully analysed."""
        await self.page.until(lambda message: message["what"] == "result" and message["full"] and message["gen"] == self.latest(), 300)


async def slowest(tabs):
    """Median seconds until all of some tabs, which ask at once, have their drawing."""
    times = []
    for _ in range(ROUNDS):
        started = time.perf_counter()
        times.append(max(await asyncio.gather(*(tab.draw() for tab in tabs))) - started)
    return statistics.median(times)


def resident(pid):
    """(MB of the server, MB of its processes)."""
    import psutil

    server = psutil.Process(pid)
    return server.memory_info().rss / 1e6, sum(child.memory_info().rss for child in server.children(recursive=True)) / 1e6


def tabs():
    """Rows (tabs, seconds of one that asks, seconds until all that ask at once are served, MB of the server, MB of its processes)."""
    import studio_server

    with tempfile.TemporaryDirectory() as folder, studio_server.started((Path(folder), (sys.executable, "-m", "drivewright"))) as servers:
        return asyncio.run(_rows(servers[0]))


async def _rows(server):
    import studio_client

    rows, opened = [], []
    async with AsyncExitStack() as stack:
        for count in COUNTS:
            while len(opened) < count:
                opened.append(Tab(await stack.enter_async_context(studio_client.page(server.port))))
                await opened[-1].page.until(lambda message: message["what"] == "scene")
            for tab in opened:
                await tab.rest()
            alone = await slowest(opened[:1])
            together = await slowest(opened)
            for tab in opened:
                await tab.rest()
            rows.append((count, alone, together, *resident(server.process.pid)))
    return rows
