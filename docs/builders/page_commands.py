"""Pages whose commands run: files written, commands executed, pictures collected, the shown output compared with the real one.

A page is Markdown. In its order,

* a fenced block with a title (```toml title="my_cam.toml") is written as that file;
* a ```console block has commands behind "$ " and, below each, what it prints. A line "..." stands for any lines;
  a command without lines below is run and its output not compared;
* `<!-- picture: out/my_cam/figures/plot-motion.svg -->` names the file of the run that the next image shows.

Commands are `drivewright`, `python`, `pip install -e`, `dask`, `cd`, `cat`, `head`, `ls`, `mkdir`, `rm`, `cp` and `echo $?`; one that
ends in "&" runs until the page ends, and "> FILE" keeps what is printed to stdout.
A command that fails is an error unless `echo $?` follows it.
"""

import contextlib
import io
import os
import re
import shlex
import shutil
import socket
import subprocess
import sys
import time
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).parents[2]
SHOWN_FOLDER = "~/drives"  # what stands for the folder in which the commands run
COLUMNS = "110"  # width of the terminal that the pages show
FENCE = re.compile(r"^(?P<indent> *)```(?P<language>\w+)?(?P<attributes>[^\n]*)\n(?P<text>.*?)^(?P=indent)```$", re.M | re.S)
PICTURE = re.compile(r"<!-- picture: (?P<source>\S+) -->\s*\n!\[[^\]]*\]\((?P<target>[^)\s]+)\)")
TITLE = re.compile(r'title="([^"]+)"')
NUMBER = re.compile(r"[-+−]?\d[\d,]*(?:\.\d+)?(?:[eE][-+]?\d+)?")
INTERVAL = re.compile(r"\([^()]*\d[^()]* to [^()]*\d[^()]*\)")
TIME = r"\d+(\.\d+)? ?(s|min|h)\b"
CHANGING = re.compile(
    rf"(\bin|about|evaluations,|left) {TIME}|{TIME} left|per second|compil|^\s*(\d+%|━)"
)  # lines that tell a time, or progress
READY = re.compile(r"Scheduler at|Registered to")  # what a process in the background says when it can be used
PATIENCE = 120.0  # seconds that it may take
PORT = "8911"  # what pages write; each run takes one that is free
ANY_LINES = "..."
UNKNOWN = "???"  # below a command: `--refresh` puts what it prints in its place, or of that the lines in which the pattern behind occurs
RELATIVE = 0.01


@dataclass(frozen=True)
class File:
    """A titled block: written into the folder."""

    name: str
    text: str


@dataclass
class Command:
    """One command of a console block and the lines shown below it."""

    text: str
    shown: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Picture:
    """An image of the page, and the file of the run that it shows."""

    source: str
    target: str


@dataclass(frozen=True)
class Outcome:
    """What a command printed, both streams, and its exit code."""

    command: Command
    printed: list[str]
    code: int


def page_steps(text: str) -> list[File | Command | Picture]:
    """Files, commands and pictures of a page in its order."""
    found: list[tuple[int, list[File | Command | Picture]]] = []
    for fence in FENCE.finditer(text):
        title = TITLE.search(fence["attributes"] or "")
        inside = _dedented(fence["text"], fence["indent"])
        if title:
            found.append((fence.start(), [File(title[1], inside)]))
        elif fence["language"] == "console":
            found.append((fence.start(), list(_commands(inside.splitlines()))))
    found += [(each.start(), [Picture(each["source"], each["target"])]) for each in PICTURE.finditer(text)]
    return [step for _, steps in sorted(found, key=lambda each: each[0]) for step in steps]


def _dedented(text: str, indent: str) -> str:
    return "".join(line.removeprefix(indent) for line in text.splitlines(keepends=True))


def _commands(lines: list[str]) -> Iterator[Command]:
    """The commands of a console block; a backslash at the end of a line goes on in the next one."""
    command: Command | None = None
    for line in lines:
        if command and command.text.endswith("\\"):
            command.text += "\n" + line
        elif line.startswith("$ "):
            if command:
                yield command
            command = Command(line[2:])
        elif command:
            command.shown.append(line)
    if command:
        yield command


class PageRun:
    """Runs the steps of a page in a folder, one after the other."""

    def __init__(self, page: Path, folder: Path) -> None:
        self.page, self.folder, self.current = page, folder.resolve(), folder.resolve()
        self.last_code, self.port = 0, _free_port() if "dask scheduler" in page.read_text(encoding="utf-8") else PORT
        self.background: list[subprocess.Popen[bytes]] = []
        self.pictures: dict[str, Path] = {}
        self.paths: list[Path] = []  # of packages that the page installs
        self.missing: list[str] = []  # pictures that the run did not make
        self.by_subprocess = "pip install" in page.read_text(encoding="utf-8")  # a plug-in is seen by a new process only

    def outcomes(self) -> Iterator[Outcome]:
        """Every command with what it printed; files and pictures on the way."""
        steps = page_steps(self.page.read_text(encoding="utf-8"))
        try:
            for step, following in zip(steps, [*steps[1:], None], strict=True):
                if isinstance(step, File):
                    path = self.current / step.name
                    path.parent.mkdir(parents=True, exist_ok=True)
                    path.write_text(step.text, encoding="utf-8")
                elif isinstance(step, Picture):
                    self._keep(step)
                else:
                    outcome = self._run(step)
                    expected = isinstance(following, Command) and following.text == "echo $?"
                    if outcome.code and not expected:
                        printed = "\n".join(outcome.printed)
                        raise AssertionError(f"{self.page.name}: `{step.text}` ends with {outcome.code}:\n{printed}")
                    yield outcome
        finally:
            for process in self.background:
                process.terminate()
                process.wait(timeout=30)

    def _keep(self, picture: Picture) -> None:
        """A copy of the picture as it is at this place of the page: a later run may write it anew."""
        source = self.current / picture.source
        if not source.is_file():
            there = sorted(each.name for each in source.parent.glob("*")) if source.parent.is_dir() else []
            self.missing.append(f"the run made no {picture.source}; there are {there}")
            return
        copy = self.folder / ".pictures" / Path(picture.target).name
        copy.parent.mkdir(exist_ok=True)
        self.pictures[picture.target] = Path(shutil.copyfile(source, copy))

    def _run(self, command: Command) -> Outcome:
        words = shlex.split(command.text.replace("\\\n", " ").replace(PORT, self.port), comments=True)
        if command.text == "echo $?":
            return Outcome(command, [str(self.last_code)], 0)
        if words[:3] == ["pip", "install", "-e"]:
            self._install(self.current / words[3])
            return Outcome(command, [], 0)
        if words[0] == "cd":
            self.current = (self.current / words[1]).resolve()
            return Outcome(command, [], 0)
        if words[-1] == "&":
            return self._start(command, words[:-1])
        target = words[words.index(">") + 1] if ">" in words else None
        words = words[: words.index(">")] if ">" in words else words
        printed, errors, code = self._execute(words, separate=target is not None)
        if target:
            (self.current / target).write_text(printed, encoding="utf-8")
            printed = errors
        self.last_code = code
        return Outcome(command, self._as_shown(printed), code)

    def _install(self, package: Path) -> None:
        """What `pip install -e` does for a package with a folder src, without a network or a change of this Python: its metadata
        and its sources on the path of the processes of this page."""
        project = tomllib.loads((package / "pyproject.toml").read_text(encoding="utf-8"))["project"]
        about = self.folder / ".installed" / f"{project['name'].replace('-', '_')}-{project['version']}.dist-info"
        about.mkdir(parents=True)
        (about / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: {project['version']}\n")
        lines = [
            f"[{group}]\n" + "".join(f"{name} = {place}\n" for name, place in points.items())
            for group, points in project["entry-points"].items()
        ]
        (about / "entry_points.txt").write_text("\n".join(lines), encoding="utf-8")
        self.paths += [about.parent, package / "src"]

    def _start(self, command: Command, words: list[str]) -> Outcome:
        """A process beside the others; returns when it says that it is ready."""
        path = self.folder / f".background-{len(self.background)}"
        with path.open("w", encoding="utf-8") as log:
            process = subprocess.Popen(_argv(words), cwd=self.current, env=_environment(self.paths), stdout=log, stderr=log)
        self.background.append(process)
        end = time.monotonic() + PATIENCE
        while not READY.search(said := path.read_text(encoding="utf-8")):
            if process.poll() is not None or time.monotonic() > end:
                raise AssertionError(f"{self.page.name}: `{command.text}` is not ready:\n{said}")
            time.sleep(0.1)
        return Outcome(command, [], 0)

    def _execute(self, words: list[str], separate: bool) -> tuple[str, str, int]:
        """(stdout, stderr, exit code); both streams in one where not `separate`."""
        if words[0] == "drivewright" and not (self.by_subprocess or self.background):
            return _in_this_process(words[1:], self.current, separate)
        done = subprocess.run(
            _argv(words),
            cwd=self.current,
            env=_environment(self.paths),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE if separate else subprocess.STDOUT,
            text=True,
            encoding="utf-8",
            timeout=300,
        )
        return done.stdout, done.stderr or "", done.returncode

    def _as_shown(self, printed: str) -> list[str]:
        text = printed.replace(str(self.folder), SHOWN_FOLDER).replace(self.port, PORT).replace("\x1b[0m", "")
        return [line.rstrip() for line in text.splitlines()]


def _free_port() -> str:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        return str(taken.getsockname()[1])


def _argv(words: list[str]) -> list[str]:
    """The words of a command as this Python's own programs."""
    python = {"drivewright": ["-m", "drivewright"], "python": [], "dask": ["-m", "dask"]}
    if words[0] in python:
        return [sys.executable, *python[words[0]], *words[1:]]
    if words[0] in {"cat", "ls", "mkdir", "rm", "cp", "head"}:
        return words
    raise ValueError(f"a page may not run {words[0]!r}")


def _environment(more: list[Path]) -> dict[str, str]:
    paths = [*map(str, more), str(ROOT / "src"), os.environ.get("PYTHONPATH", "")]
    names = {
        "PYTHONPATH": os.pathsep.join(filter(None, paths)),
        "OPENBLAS_NUM_THREADS": "1",
        "PYTHONIOENCODING": "utf-8",
        "PYTHONUNBUFFERED": "1",
    }
    return {**os.environ, **_plain_terminal(), **names}


def _plain_terminal() -> dict[str, str]:
    return {"COLUMNS": COLUMNS, "NO_COLOR": "1", "TERM": "dumb"}


def _in_this_process(arguments: list[str], folder: Path, separate: bool) -> tuple[str, str, int]:
    """The command line, without the start of another interpreter."""
    from drivewright.cli import main

    out = io.StringIO()
    errors = io.StringIO() if separate else out
    before, there = dict(os.environ), Path.cwd()
    os.environ.update(_plain_terminal())
    os.chdir(folder)
    code: object = 0
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
            main(arguments)
    except SystemExit as end:
        code = end.code or 0
    finally:
        os.chdir(there)
        os.environ.clear()
        os.environ.update(before)
    return out.getvalue(), errors.getvalue() if separate else "", int(code) if isinstance(code, int) else 1


# -- shown against printed -----------------------------------------------------------------------------------------------------


def difference(shown: list[str], printed: list[str]) -> str:
    """The first shown line that the command did not print in this order, or that has other numbers; "" where there is none."""
    rest = _telling(printed)
    gap = bool(shown) and shown[0].strip() == ANY_LINES
    for line in _telling(shown):
        if line.strip() == ANY_LINES:
            gap = True
            continue
        found = next((at for at, real in enumerate(rest) if skeleton(real) == skeleton(line)), None)
        while found is not None and numbers_differ(line, rest[found]):
            again = next((at for at in range(found + 1, len(rest)) if skeleton(rest[at]) == skeleton(line)), None)
            if again is None:
                return f"other numbers\n  shown:   {line.strip()}\n  printed: {rest[found].strip()}"
            found = again
        if found is None:
            return f"not printed: {line.strip()}\nprinted:\n" + "\n".join(printed)
        if found and not gap:
            return f"printed before {line.strip()!r} and not shown: {rest[0].strip()!r}"
        rest, gap = rest[found + 1 :], False
    ends_open = not (wanted := _telling(shown)) or wanted[-1].strip() == ANY_LINES
    return "" if ends_open or not rest else f"printed and not shown: {rest[0].strip()!r}"


def _telling(lines: list[str]) -> list[str]:
    """Lines that say the same at every run."""
    return [line for line in lines if line.strip() and not CHANGING.search(line)]


def skeleton(line: str) -> str:
    """A line without its numbers, with one blank for many and one stroke for a rule."""
    return re.sub(r"([─━═┄-])\1+", r"\1", " ".join(NUMBER.sub("#", line).split()))


def numbers_differ(shown: str, printed: str) -> bool:
    """Whether a number of one line is not that of the other: beyond the last digit shown, 1 %, or its interval."""
    pairs = list(zip(NUMBER.findall(shown), NUMBER.findall(printed), strict=True))
    if INTERVAL.search(shown):
        return any(_are_apart(*ends) for ends in zip(INTERVAL.findall(shown), INTERVAL.findall(printed), strict=True))
    return not all(_is_near(one, other) for one, other in pairs)


def _are_apart(shown: str, printed: str) -> bool:
    """Whether two intervals, "(8.1 to 10.1)" each, have no number in common."""
    (low, high), (other_low, other_high) = ([_number(each) for each in NUMBER.findall(text)[:2]] for text in (shown, printed))
    return low > other_high or other_low > high


def _is_near(shown: str, printed: str) -> bool:
    one, other = _number(shown), _number(printed)
    if shown.isdecimal() and printed.isdecimal() and one < 100:
        return one == other  # a count
    mantissa, _, exponent = shown.lower().partition("e")
    last_digit = 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
    return abs(one - other) <= max(1.001 * last_digit, RELATIVE * abs(one))


def _number(text: str) -> float:
    return float(text.replace(",", "").replace("−", "-"))


def refreshed(command: Command, printed: list[str]) -> tuple[list[str], list[str]]:
    """(lines to show, complaints): the shown lines with the numbers of today; for "??? PATTERN" the printed lines that have it."""
    if command.shown and command.shown[0].startswith(UNKNOWN):
        return _chosen([line for line in printed if line.strip()], command.shown[0].removeprefix(UNKNOWN).strip()), []
    lines, complaints, at = [], [], 0
    for line in command.shown:
        found = next((n for n in range(at, len(printed)) if _says_again(printed[n], line)), None) if line.strip() else None
        if found is None:
            lines.append(line)
            if line.strip() and line.strip() != ANY_LINES and not CHANGING.search(line):
                complaints.append(f"`{command.text}` no longer prints: {line.strip()}")
        else:
            lines.append(printed[found])
            at = found + 1
    return lines, complaints


def _says_again(printed: str, shown: str) -> bool:
    """Whether a printed line is that of the page, or goes on in a further column where that ends."""
    now, before = skeleton(printed), skeleton(shown)
    return now == before or (now.startswith(f"{before} ") and "  " in printed.strip() and "  " in shown.strip())


def _chosen(printed: list[str], pattern: str) -> list[str]:
    """The lines in which a pattern occurs, "..." for those between."""
    lines: list[str] = []
    for line in printed:
        if re.search(pattern, line):
            lines.append(line)
        elif not lines or lines[-1] != ANY_LINES:
            lines.append(ANY_LINES)
    return lines
