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
MOST_OFFERS = 50
TABS_FILES = 200  # folders of files that pages sent; the oldest goes


class ServerResources:
    """Made once, in the running loop of the server; `close` leaves nothing behind."""

    def __init__(self) -> None:
        most = max(2, worker_count(None))
        self.quick, self.heavy = WorkerPool(most), WorkerPool(most)
        self._root: Path | None = None
        self._folders: list[str] = []
        self._offers: dict[str, tuple[str, bytes, float]] = {}

    def new_folder(self) -> tuple[str, Path]:
        """(token, path) of a folder for the files of a page."""
        if self._root is None:
            self._root = Path(tempfile.mkdtemp(prefix="drivewright-studio-")).resolve()
        token = secrets.token_urlsafe(16)
        self._folders.append(token)
        while len(self._folders) > TABS_FILES:
            shutil.rmtree(self._root / self._folders.pop(0), ignore_errors=True)
        (self._root / token).mkdir()
        return token, self._root / token

    def folder(self, token: str) -> Path | None:
        """The folder behind a token, None where it is none of ours."""
        return self._root / token if self._root is not None and token in self._folders else None

    def offer(self, name: str, data: bytes) -> str:
        """Address where a file can be fetched, once."""
        now = time.monotonic()
        self._offers = {token: offer for token, offer in self._offers.items() if now - offer[2] < KEPT}
        token = secrets.token_urlsafe(16)
        self._offers[token] = file_name(name), data, now
        while len(self._offers) > MOST_OFFERS:
            del self._offers[next(iter(self._offers))]
        return f"/download/{token}"

    def fetch(self, token: str) -> tuple[str, bytes] | None:
        """(name, data) of an offered file, None where there is none."""
        offer = self._offers.pop(token, None)
        return offer and offer[:2]

    def close(self) -> None:
        """Processes and files go."""
        self.quick.close()
        self.heavy.close()
        if self._root is not None:
            shutil.rmtree(self._root, ignore_errors=True)
