"""Calls for a worker process: importable there."""

import os
import time

from drivewright.errors import SpecError


def double(tell, value):
    tell(("half way", value))
    return 2 * value


def process(tell):
    return os.getpid()


def refuse(tell):
    raise SpecError("must be greater than 0 mm, got -1 mm", key="drive.radius")


def bug(tell):
    return {}["no such key"]


def die(tell):
    os._exit(7)


def wait_politely(tell, seconds):
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        tell("waiting")
        time.sleep(0.01)


def wait_deaf(tell, seconds):
    tell("deaf")
    time.sleep(seconds)
