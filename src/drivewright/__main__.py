"""python -m drivewright."""

from drivewright.cli import main

main()
