"""Calls for a worker process: importable there."""

import os
import time

from drivewright.errors import SpecError


def double(send, value):
    send(("half way", value))
    return 2 * value


def process(send):
    return os.getpid()


def refuse(send):
    raise SpecError("must be greater than 0 mm, got -1 mm", key="drive.radius")


def bug(send):
    return {}["no such key"]


def die(send):
    os._exit(7)


def wait_politely(send, seconds):
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        send("waiting")
        time.sleep(0.01)


def wait_deaf(send, seconds):
    send("deaf")
    time.sleep(seconds)


def length(send, text):
    return len(text)


def niceness(send):
    return os.getpriority(os.PRIO_PROCESS, 0)


def fill(send, size):
    return len(bytearray(size))
