"""Bytes on their way from a connection to the server's protocols."""

import asyncio

import loops
import pytest

from drivewright.studio.connections import SLICE, _Paced

pytestmark = [pytest.mark.interface, pytest.mark.needs_studio]


class Transport:
    """Notes whether it may read."""

    def __init__(self):
        self.reading, self.closing, self.name = True, False, "the transport's own"

    def pause_reading(self):
        self.reading = False

    def resume_reading(self):
        self.reading = True

    def is_closing(self):
        return self.closing


class Protocol:
    """Notes what it is handed."""

    def __init__(self, each=lambda: None):
        self.parts, self.each, self.said = [], each, []

    def data_received(self, data):
        self.parts.append(data)
        self.each()

    def __getattr__(self, name):
        return lambda *arguments: self.said.append(name)


def made():
    transport, protocol = Transport(), Protocol()
    return transport, protocol, _Paced(asyncio.get_running_loop(), transport, protocol)


async def _turns(count=1):
    for _ in range(count):
        await asyncio.sleep(0)


def test_bytes_are_handed_on_in_slices_and_others_have_their_turn_between():
    async def work():
        transport, protocol, paced = made()
        data = bytes(range(256)) * 100
        paced.data_received(data)
        assert protocol.parts == [data[:SLICE]] and not transport.reading
        await _turns()
        assert len(protocol.parts) == 2
        await _turns(10)
        assert b"".join(protocol.parts) == data and max(map(len, protocol.parts)) == SLICE and transport.reading
        paced.data_received(b"x")
        assert protocol.parts[-1] == b"x" and transport.reading

    loops.run(work())


@pytest.mark.parametrize(("stop", "go"), [("pause_reading", "resume_reading"), ("pause_writing", "resume_writing")])
def test_nothing_is_handed_on_while_it_would_be_too_much(stop, go):
    async def work():
        transport, protocol, paced = made()
        protocol.each = getattr(paced, stop)
        paced.data_received(b"x" * 3 * SLICE)
        await _turns(10)
        assert len(protocol.parts) == 1 and not transport.reading
        protocol.each = lambda: None
        getattr(paced, go)()
        await _turns(10)
        assert len(protocol.parts) == 3 and transport.reading
        getattr(paced, stop)()
        assert not transport.reading  # nor is more read, with nothing left to hand on

    loops.run(work())


def test_another_protocol_has_the_rest():
    async def work():
        transport, protocol, paced = made()
        other = Protocol()
        protocol.each = lambda: paced.set_protocol(other)
        paced.data_received(b"x" * 2 * SLICE)
        await _turns(3)
        assert len(protocol.parts) == len(other.parts) == 1 and paced.get_protocol() is other and paced.name == transport.name
        paced.eof_received()
        paced.connection_lost(None)
        assert other.said == ["eof_received", "connection_lost"]

    loops.run(work())


def test_nothing_follows_the_end():
    async def work():
        transport, protocol, paced = made()
        paced.data_received(b"x" * 3 * SLICE)
        transport.closing = True
        await _turns(5)
        assert len(protocol.parts) == 1

    loops.run(work())
