"""STEP and STL files of parts, in millimetres; the bytes depend on the parts alone.

STEP, and STL of parts that are fused of several solids, need the extra `fe`.
"""

import re
from collections.abc import Iterable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from drivewright._typing import Floats, Ints
from drivewright.atomic import replacing, write_text
from drivewright.errors import InputError
from drivewright.scene import Part
from drivewright.solids import cad, facets

FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def write_step(parts: Iterable[Part], path: str | Path, tolerance: float = cad.TOLERANCE) -> None:
    """STEP file (AP214, millimetres) of parts as one assembly of named, coloured solids; splines within `tolerance` [m] of their knots."""
    shape = cad.cad_assembly(list(parts), tolerance)
    with replacing(path) as temporary:
        shape.WriteStep(str(temporary))
        if not temporary.stat().st_size:
            raise InputError(f"the CAD kernel could not write {path}; is the folder writable and the name plain?")
        text = temporary.read_text(encoding="utf-8", errors="replace")
    write_text(path, _reproducible(text, Path(path).name))


def write_stl(parts: Iterable[Part], path: str | Path, tolerance: float = 1e-5) -> None:
    """Binary STL [mm] of parts, every one a closed surface with outward normals, chords within about `tolerance` [m] of the surface."""
    surface = np.concatenate([_facets(*facets.surface_triangles(part, tolerance)) for part in parts])
    with replacing(path) as temporary:
        temporary.write_bytes(b"drivewright: millimetres".ljust(80) + np.uint32(len(surface)).tobytes() + surface.tobytes())


def _facets(points: Floats, corners: Ints) -> NDArray[np.void]:
    triangle = cad.MM * points[corners]
    normal = np.cross(triangle[:, 1] - triangle[:, 0], triangle[:, 2] - triangle[:, 0])
    surface = np.zeros(len(corners), FACET)
    surface["normal"], surface["corners"] = normal / np.linalg.norm(normal, axis=1, keepdims=True), triangle
    return surface


def _reproducible(text: str, name: str) -> str:
    """STEP text without time stamp, placeholder author and the writer's running number, in ASCII as the format wants it."""
    plain = name.replace("'", "''")
    header = f"FILE_NAME('{plain}','',(''),(''),'Open CASCADE','drivewright','');"
    text = re.sub(r"FILE_NAME\(.*?\);", lambda _: header, text, count=1, flags=re.S)
    text = re.sub(r"PRODUCT\('Open CASCADE[^']*',\s*'Open CASCADE[^']*'", lambda _: f"PRODUCT('{plain}','{plain}'", text)
    return re.sub(r"[^\x00-\x7f]+", lambda match: f"\\X2\\{match.group().encode('utf-16-be').hex().upper()}\\X0\\", text)
