"""Folders of the checkout that tests read."""

from pathlib import Path

ROOT = Path(__file__).parents[2]
SOURCE = ROOT / "src" / "drivewright"
EXAMPLES = ROOT / "examples"
SUPPORT = ROOT / "tests" / "support"  # what tests share; a child process of a test finds it through its path
