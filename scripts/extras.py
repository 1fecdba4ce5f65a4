"""Print the extras that an extra such as `test` is made of, one per line."""

import re
import sys
import tomllib
from pathlib import Path

extras = tomllib.loads((Path(__file__).parent.parent / "pyproject.toml").read_text())["project"]["optional-dependencies"]
inside = [m[1] for entry in extras[sys.argv[1]] if (m := re.fullmatch(r"drivewright\[(.+)\]", entry))]
print("\n".join(inside[0].split(",") if inside else [sys.argv[1]]))
