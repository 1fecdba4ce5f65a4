"""Data files with faults in them, and what is no file at all."""

import os

SPECIAL = ("missing", "loop", "pipe", "device", "folder", "unreadable name")


def damaged_file(content, rng):
    """The bytes of a data file with a fault, or the name of something `SPECIAL` in its place."""
    if rng.random() < 0.3:
        return SPECIAL[int(rng.integers(len(SPECIAL)))]
    lines = content.split(b"\n")
    n = int(rng.integers(1, max(len(lines) - 1, 2)))
    kinds = (
        lambda: b"",
        lambda: b"\xef\xbb\xbf" + content,
        lambda: content.replace(b",", b";"),
        lambda: content[: len(content) // 2],
        lambda: lines[0] + b"\n",
        lambda: b"\n".join(lines[1:]),
        lambda: b"\n".join([lines[0], *lines[:0:-1]]),
        lambda: b"\n".join([*lines[:n], lines[n], *lines[n:]]),
        lambda: b"\n".join([*lines[:n], b"nan,nan", *lines[n + 1 :]]),
        lambda: b"\n".join([*lines[:n], b"1e300,-1e300", *lines[n + 1 :]]),
        lambda: b"\n".join([*lines[:n], b"inf,0", *lines[n + 1 :]]),
        lambda: b"\n".join([*lines[:n], b"\x00,\x00", *lines[n + 1 :]]),
        lambda: b"\n".join([*lines[:n], b"1" * 200_000 + b",1", *lines[n + 1 :]]),
        lambda: b"\n".join([*lines[:n], b'"' + b"1\n" * 1000, *lines[n + 1 :]]),
        lambda: content.replace(b"mm", b"kg"),
        lambda: content.replace(b"deg", b"furlong"),
        lambda: content.replace(b"[", b"").replace(b"]", b""),
        lambda: content.decode(errors="replace").encode("utf-16"),
        lambda: b"\xff\xfe\x00" * 100,
        lambda: lines[0] + b"\n" + b"".join(b"%d,%d\n" % (k, k % 7) for k in range(300_000)),
        lambda: lines[0] + b"," * 200_000 + b"\n" + b"\n".join(lines[1:]),
        lambda: b"\n".join([lines[0], *(b"=1+1,@x" for _ in lines[1:])]),
    )
    return kinds[int(rng.integers(len(kinds)))]()


def write_file(path, content):
    """A file of that content, or something special in its place."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if isinstance(content, bytes):
        path.write_bytes(content)
    elif content == "loop":
        path.symlink_to(path)
    elif content == "pipe":
        os.mkfifo(path)
    elif content == "device":
        path.symlink_to("/dev/zero")
    elif content == "folder":
        path.mkdir()
    elif content == "unreadable name":
        path.symlink_to("x" * 250)
