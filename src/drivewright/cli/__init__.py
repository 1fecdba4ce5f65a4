"""The command line.  `main` is the only way out: one message and one exit code for every error a user can cause.

app              the commands; they know no kind of drive by name
compared         specs run for a comparison, and what the terminal says of it
doctor           what is installed, what each extra adds, the kernel cache, a self-test
editors          a folder set up for editors that know TOML schemas
gallery          the worked examples: listed, copied, run
interruption     how the command line ends early
long_work        how far a command with many cases or evaluations is
plugin_commands  commands of mechanisms, from plug-ins too
records          what commands print with --json
reproduced       reproduced papers: listed, and written with progress
show             what the command line prints: results to stdout, everything else to stderr
"""

import _thread
import errno
import io
import os
import signal
import sys
import threading
from typing import NoReturn

from drivewright._garbage import collect_rarely
from drivewright.cli.interruption import ending_signals, exit_code
from drivewright.errors import DrivewrightError, InputError

INTERRUPTED = 130
COMPLETION = "_DRIVEWRIGHT_COMPLETE"  # set by the shell where it asks for words: eval "$(_DRIVEWRIGHT_COMPLETE=source_bash drivewright)"
RESUMABLE = frozenset({"sweep", "optimise", "reproduce"})  # commands that keep each part as soon as it is finished
GRACE = 2.0  # seconds in which a command may find out by itself that memory is used up

_ended, _starved = threading.Event(), threading.Event()  # the command; a thread of it, for want of memory


def main(arguments: list[str] | None = None) -> NoReturn:
    """Run the command line; exits with 0 done, 1 failed check, 2 bad input, 3 strict, 4 solver gave up, 130 interrupted, 128 and its number
    after another signal that ends a process."""
    collect_rarely()
    _never_fail_to_print()
    threading.excepthook = _end_of_a_thread
    _ended.clear()
    _starved.clear()
    with ending_signals() as received:
        try:
            _run(arguments, received)
        finally:
            _ended.set()


def _never_fail_to_print() -> None:
    """A letter that the encoding of a pipe does not have, as on Windows, is printed as a question mark."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper) and stream.errors == "strict":
            stream.reconfigure(errors="replace")


def _run(arguments: list[str] | None, received: list[int]) -> NoReturn:
    try:
        from drivewright.cli.app import app, usage_errors

        if COMPLETION in os.environ:
            from typer.completion import get_completion_inspect_parameters

            get_completion_inspect_parameters()
        try:
            code = app(args=arguments, prog_name="drivewright", standalone_mode=False) or 0
        except usage_errors as error:
            error.show()
            sys.exit(error.exit_code)
        if code == INTERRUPTED:  # some versions of the library swallow Ctrl-C and answer with its exit code
            raise KeyboardInterrupt
        sys.exit(code)
    except (KeyboardInterrupt, *_aborts()):
        _interrupted(arguments, received)
    except Exception as error:
        if received:  # libraries make errors of their own of an interrupt that comes while they compute
            _interrupted(arguments, received)
        sys.exit(_failed(error))


def _interrupted(arguments: list[str] | None, received: list[int]) -> NoReturn:
    """Leave a command that a person, a system, or a thread of it without memory has interrupted."""
    if _starved.is_set():
        sys.exit(_no_memory())
    print(f"interrupted; {_kept(sys.argv[1:] if arguments is None else arguments)}", file=sys.stderr)
    _leave(exit_code(received))


def _failed(error: Exception) -> int:
    """The exit code for an error, told; a fault of the program is raised again."""
    if isinstance(error, DrivewrightError):
        return _complain(error)
    if isinstance(error, BrokenPipeError):
        sys.stderr.close()
        return 0
    if isinstance(error, (MemoryError, ImportError, OSError)) and _wants_memory(error):
        return _no_memory()
    raise error


def _kept(arguments: list[str]) -> str:
    """What is left of an interrupted command."""
    if next((each for each in arguments if not each.startswith("-")), "") in RESUMABLE:
        return "what was finished before is kept, and the same command continues"
    return "what was not written yet is lost, and the same command starts again"


def _leave(code: int) -> NoReturn:
    """Exit, also while the engine of the finite elements is in a call, for whose end the interpreter would wait."""
    engine = sys.modules.get("drivewright.solids.engine")
    if engine and engine.is_computing():
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)
    sys.exit(code)


def _aborts() -> tuple[type[BaseException], ...]:
    """What the command-line library makes of Ctrl-C."""
    typer = sys.modules.get("typer")
    return (typer.Abort,) if typer else ()


def _wants_memory(error: BaseException) -> bool:
    """Whether an error, also of the loader of shared libraries, says that memory is used up."""
    words = ("failed to map segment", "cannot allocate memory", "cannot create shared object", "cannot apply additional memory protection")
    return (
        isinstance(error, MemoryError)
        or getattr(error, "errno", None) == errno.ENOMEM
        or str(error) == "can't start new thread"
        or (isinstance(error, ImportError) and any(text in str(error).lower() for text in words))
    )


def _no_memory() -> int:
    print("drivewright: there is no memory left for this; take fewer points, cases or workers, or allow more memory", file=sys.stderr)
    return InputError.exit_code


def _end_of_a_thread(end: threading.ExceptHookArgs) -> None:
    """A thread that memory did not suffice for takes the command with it, lest that waits for it for ever."""
    if end.exc_value is None or not _wants_memory(end.exc_value):
        threading.__excepthook__(end)
    elif not _ended.wait(GRACE):
        _starved.set()
        if os.name == "nt":  # where os.kill ends the process at once
            _thread.interrupt_main()
        else:
            os.kill(os.getpid(), signal.SIGINT)  # also wakes what waits in the main thread


def _complain(error: DrivewrightError) -> int:
    print(f"drivewright: {error}", file=sys.stderr)
    return error.exit_code
