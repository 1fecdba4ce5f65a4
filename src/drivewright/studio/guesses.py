"""Delay after wrong tokens: it grows with their number from one address, and decays over time."""

import time

FIRST = 0.25  # seconds that one wrong token costs; the next one twice that
LONGEST = 30.0  # seconds that an answer waits; who would wait longer is sent away unheard
FALLS = 20.0  # seconds in which one wrong token is forgotten
MOST = 10_000  # addresses that are remembered; those that have waited longest since go first


class Guesses:
    """Wrong tokens by the address that they came from."""

    def __init__(self) -> None:
        self._by: dict[str, tuple[float, float, float]] = {}  # address -> (wrong ones, when that was so, when the last that waits is heard)

    def next(self, address: str) -> float | None:
        """Seconds after which the token that has come from an address may be looked at; None where that is too long.

        It counts as wrong until it is called right, and those who come at once wait one after another: many connections guess no faster
        than one.
        """
        now = time.monotonic()
        wrong, free = self._wrong(address, now), max(now, self._by.get(address, (0.0, 0.0, 0.0))[2])
        until = free + (FIRST * 2 ** (min(wrong, 20.0) - 1) if wrong >= 1 else 0.0)
        if until - now > LONGEST:
            return None
        self._by.pop(address, None)
        self._by[address] = wrong + 1, now, until
        while len(self._by) > MOST:
            self._by.pop(next(iter(self._by)))
        return until - now

    def right(self, address: str) -> None:
        """The token was right: nothing is held against the address any more."""
        self._by.pop(address, None)

    def _wrong(self, address, now):
        """Wrong tokens of an address that are not forgotten yet; a fraction of one counts as it falls."""
        count, since, _ = self._by.get(address, (0.0, now, 0.0))
        return max(0.0, count - (now - since) / FALLS)
