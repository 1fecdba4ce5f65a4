"""A wheel with kernels is for Linux x86-64; one without is for every machine."""

from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

SHIPPED = "src/drivewright/_jit/shipped"


class Kernels(BuildHookInterface):
    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Tag the wheel by what is in it."""
        if version == "standard" and (Path(self.root) / SHIPPED).is_dir():
            build_data["pure_python"], build_data["tag"] = False, "py3-none-manylinux_2_17_x86_64"
            build_data["artifacts"].append(f"/{SHIPPED}/**")
