"""What every browser test needs."""

import time


def until(page, condition, seconds=20):
    """Wait for a JavaScript condition.  playwright's own wait evaluates text in the page, which the page's policy forbids."""
    deadline = time.monotonic() + seconds
    while not page.evaluate(condition):
        assert time.monotonic() < deadline, f"never came true: {condition}"
        page.wait_for_timeout(30)
