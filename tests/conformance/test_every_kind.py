"""The conformance suite over the registry: every kind, every preset, every subject."""

import pytest

from drivewright.testing import cases

pytestmark = pytest.mark.conformance


# Long runs of a chain with hinged plates: the example hyvo_classical runs it, too.
LONG = ("silent-chain-classical-record", "silent-chain-classical-balances")


@pytest.mark.parametrize("case", [pytest.param(case, marks=pytest.mark.slow) if str(case) in LONG else case for case in cases()], ids=str)
def test_conformance(case):
    if reason := case.check():
        pytest.skip(reason)
