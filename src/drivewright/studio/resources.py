"""What all tabs share: the worker processes, the files that pages sent, and those that wait to be fetched."""

import secrets
import shutil
import tempfile
import time
from pathlib import Path

from drivewright.cases import worker_count
from drivewright.execution.workers import WorkerPool
from drivewright.report.folder import file_name

KEPT = 600.0  # seconds that a file waits to be fetched
MOST_OFFERS, MOST_BYTES = 50, 200_000_000  # of files that wait
RESULTS = "results"  # folder of the results that jobs keep
TABS_FILES = 200  # folders of files that pages sent; the oldest goes


class ServerResources:
    """Made once, in the running loop of the server; `close` leaves nothing behind.

    Each purpose has processes of its own, so that no job keeps a drawing waiting, and no tab has all of a kind.
    """

    def __init__(self) -> None:
        most = max(2, worker_count(None))
        self.reading = WorkerPool(2, share=1, memory=0.1)  # what pages send
        self.quick = WorkerPool(most, share=most - 1)  # drawings
        self.heavy = WorkerPool(most, share=most - 1, niceness=5)  # analyses
        self.jobs = WorkerPool(most, share=most - 1, niceness=10)
        self._root: Path | None = None
        self._folders: list[str] = []
        self._offers: dict[str, tuple[str, bytes, float]] = {}

    def new_folder(self) -> tuple[str, Path]:
        """(token, path) of a folder for the files of a page."""
        token, root = secrets.token_urlsafe(16), self._made_root()
        self._folders.append(token)
        while len(self._folders) > TABS_FILES:
            shutil.rmtree(root / self._folders.pop(0), ignore_errors=True)
        (root / token).mkdir()
        return token, root / token

    def results_folder(self) -> Path:
        """Where jobs leave results for each other; its name is no token."""
        folder = self._made_root() / RESULTS
        folder.mkdir(exist_ok=True)
        return folder

    def _made_root(self) -> Path:
        if self._root is None:
            self._root = Path(tempfile.mkdtemp(prefix="drivewright-studio-")).resolve()
        return self._root

    def drop_folder(self, token: str) -> None:
        """Take a folder away again."""
        if (folder := self.folder(token)) is not None:
            self._folders.remove(token)
            shutil.rmtree(folder, ignore_errors=True)

    def folder(self, token: str) -> Path | None:
        """The folder behind a token, None where it is none of ours."""
        return self._root / token if self._root is not None and token in self._folders else None

    def offer(self, name: str, data: bytes) -> str:
        """Address where a file can be fetched, once."""
        now = time.monotonic()
        self._offers = {token: offer for token, offer in self._offers.items() if now - offer[2] < KEPT}
        token = secrets.token_urlsafe(16)
        self._offers[token] = file_name(name), data, now
        while len(self._offers) > MOST_OFFERS or len(self._offers) > 1 and sum(len(each[1]) for each in self._offers.values()) > MOST_BYTES:
            del self._offers[next(iter(self._offers))]
        return f"/download/{token}"

    def fetch(self, token: str) -> tuple[str, bytes] | None:
        """(name, data) of an offered file, None where there is none."""
        offer = self._offers.pop(token, None)
        return offer and offer[:2]

    def close(self) -> None:
        """Processes and files go."""
        for pool in (self.reading, self.quick, self.heavy, self.jobs):
            pool.close()
        if self._root is not None:
            shutil.rmtree(self._root, ignore_errors=True)
