"""The command line.  `main` is the only way out: one message and one exit code for every error a user can cause."""

import sys


def main(arguments=None):
    """Run the command line; exits with 0 done, 1 failed check, 2 bad input, 3 strict, 4 solver gave up, 130 interrupted."""
    from drivewright.errors import DrivewrightError

    try:
        from drivewright.cli.app import app

        app(args=arguments, prog_name="drivewright")
    except DrivewrightError as error:
        sys.exit(_complain(error))
    except KeyboardInterrupt:
        print("interrupted; what was finished is on disk, the same command starts again", file=sys.stderr)
        sys.exit(130)
    except BrokenPipeError:
        sys.stderr.close()
        sys.exit(0)


def _complain(error):
    print(f"drivewright: {error}", file=sys.stderr)
    return error.exit_code
