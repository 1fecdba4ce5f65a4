"""Connections of the server: as many as it can hold, and none that keeps it waiting for a request."""

import asyncio
from typing import Any

from uvicorn.protocols.http.h11_impl import H11Protocol

MOST = 800  # connections at once; a tab has one that stays, and up to six while it loads
HEADER_SECONDS = 10.0  # in which the headers of a request have to arrive


class PatientProtocol(H11Protocol):
    """HTTP of uvicorn that neither waits for ever for the end of a request's headers nor accepts connections without end.

    Its parser, h11, takes headers of 64 kB together at most, and exactly one Host.
    """

    _deadline: asyncio.TimerHandle | None = None

    def connection_made(self, transport: Any) -> None:
        """A connection has come."""
        if len(self.connections) >= MOST:
            transport.abort()
            self.transport = transport
            return
        super().connection_made(transport)
        self._deadline = self.loop.call_later(HEADER_SECONDS, transport.abort)

    def data_received(self, data: bytes) -> None:
        """Some bytes of a request: from the first of them on the headers have their time, afterwards the application counts."""
        if self._deadline is None and self._between_requests():
            self._deadline = self.loop.call_later(HEADER_SECONDS, self.transport.abort)
        super().data_received(data)
        if not self._between_requests() or self.transport.get_protocol() is not self:  # the request is whole, or it is a websocket now
            self._stop_clock()

    def connection_lost(self, exc: Exception | None) -> None:
        """The connection has gone."""
        self._stop_clock()
        if self.flow is not None:
            super().connection_lost(exc)

    def _between_requests(self) -> bool:
        return self.cycle is None or self.cycle.response_complete

    def _stop_clock(self) -> None:
        if self._deadline is not None:
            self._deadline.cancel()
            self._deadline = None
