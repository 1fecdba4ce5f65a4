"""The conformance suite over the registry: every kind, every preset, every subject."""

import pytest

from drivewright.testing import cases

pytestmark = pytest.mark.conformance


@pytest.mark.parametrize("case", cases(), ids=str)
def test_conformance(case):
    if reason := case.check():
        pytest.skip(reason)
