"""Connections of the server: as many as it can hold, none that keeps it waiting for a request, none that keeps its loop."""

import asyncio
from typing import Any

from uvicorn.protocols.http.h11_impl import H11Protocol

MOST = 800  # connections at once; a tab has one that stays, and up to six while it loads
HEADER_SECONDS = 10.0  # in which the headers of a request have to arrive
HEADERS = 32_768  # bytes of the headers of a request: cookies of other programs on this machine come along
SLICE = 4_096  # bytes that a protocol is handed at once: tiny frames and chunks, six bytes each, take it 5 ms


class _Paced(asyncio.Protocol):
    """Between a transport and a protocol of uvicorn, for each of them the other.

    It hands bytes on in slices, so that thousands of tiny frames do not keep the loop, and none while the peer does not read its answers.
    """

    def __init__(self, loop: asyncio.AbstractEventLoop, transport: Any, protocol: Any) -> None:
        self._loop, self._transport, self._protocol = loop, transport, protocol
        self._rest, self._scheduled = bytearray(), False
        self._paused, self._full = False, False  # by the protocol, by a peer that does not read

    def __getattr__(self, name: str) -> Any:
        return getattr(self._transport, name)

    # -- for the transport -----------------------------------------------------------------------------------------------------

    def data_received(self, data: bytes) -> None:
        """Some bytes have come."""
        self._rest += data
        if not self._scheduled:
            self._hand_on()

    def pause_writing(self) -> None:
        """The peer does not read."""
        self._full = True
        self._protocol.pause_writing()
        self._settle()

    def resume_writing(self) -> None:
        """The peer reads again."""
        self._full = False
        self._protocol.resume_writing()
        self._settle()

    def eof_received(self) -> bool | None:
        """The peer sends no more."""
        return self._protocol.eof_received()

    def connection_lost(self, exc: Exception | None) -> None:
        """The connection has gone."""
        self._rest.clear()
        self._protocol.connection_lost(exc)

    # -- for the protocol ------------------------------------------------------------------------------------------------------

    def pause_reading(self) -> None:
        """No more bytes for now."""
        self._paused = True
        self._settle()

    def resume_reading(self) -> None:
        """More bytes."""
        self._paused = False
        self._settle()

    def set_protocol(self, protocol: Any) -> None:
        """Another protocol takes over."""
        self._protocol = protocol

    def get_protocol(self) -> Any:
        """The protocol that has the bytes."""
        return self._protocol

    def _hand_on(self) -> None:
        self._scheduled = False
        if self._transport.is_closing():
            self._rest.clear()
        if self._rest and not (self._paused or self._full):
            part = bytes(self._rest[:SLICE])
            del self._rest[:SLICE]
            self._protocol.data_received(part)
        self._settle()

    def _settle(self) -> None:
        held = self._paused or self._full
        if self._rest and not held and not self._scheduled:
            self._scheduled = True
            self._loop.call_soon(self._hand_on)
        if self._rest or held:
            self._transport.pause_reading()
        else:
            self._transport.resume_reading()


class PatientProtocol(H11Protocol):
    """HTTP of uvicorn that neither waits for ever for the end of a request's headers nor accepts connections without end.

    Its parser, h11, takes exactly one Host.
    """

    _deadline: asyncio.TimerHandle | None = None

    def connection_made(self, transport: Any) -> None:
        """A connection has come."""
        if len(self.connections) >= MOST:
            transport.abort()
            self.transport = transport
            return
        paced: Any = _Paced(self.loop, transport, self)
        transport.set_protocol(paced)
        super().connection_made(paced)
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
