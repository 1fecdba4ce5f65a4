"""CAD parts that make no sense, and what stands in for the kernel's own poor messages."""

import importlib
import re

import pytest

from drivewright.errors import InputError, MissingExtra
from drivewright.scene import Bar, Part, Prism, circle, polygon
from drivewright.solids import outlines

pytestmark = pytest.mark.error

PLATE = polygon([(0, 0), (0.03, 0), (0.03, 0.02), (0, 0.02)])


def solid(*solids):
    from drivewright.solids import cad

    return cad.cad_solid(Part("plate", solids))


@pytest.mark.needs_fe
@pytest.mark.parametrize(
    "solids, message",
    [
        ((), "part 'plate' is empty; give it a prism or a bar"),
        ((Prism(PLATE, (), 0.0, 0.0),), "part 'plate': a prism of thickness 0 mm; it must be positive"),
        ((Bar((0, 0), (0, 0), 0.0, 0.01),), "part 'plate': a bar of length 0 mm and diameter 10 mm; both must be positive"),
        ((Prism(PLATE, (circle((0.1, 0), 0.004),), 0.0, 0.01),), "part 'plate': hole 0 lies outside the outline or leaves nothing of it"),
    ],
)
def test_impossible_parts_are_refused_by_name(solids, message):
    with pytest.raises(InputError, match=re.escape(message)):
        solid(*solids)


@pytest.mark.parametrize(
    "prism, message",
    [
        (Prism(PLATE, (circle((0.1, 0), 0.004),), 0.0, 0.01), "part 'plate': hole 0 lies outside the outline or leaves nothing of it"),
        (Prism(PLATE, (circle((0.01, 0.01), 0.1),), 0.0, 0.01), "part 'plate': hole 0 lies outside the outline or leaves nothing of it"),
        (
            Prism(PLATE, (circle((0.02, 0.01), 0.002), polygon([(0.01, -1), (0.012, -1), (0.012, 1), (0.01, 1)])), 0.0, 0.01),
            "part 'plate': hole 1 cuts the outline into 2 pieces; make it smaller",
        ),
        (
            Prism(polygon([(0, 0), (0.02, 0.01), (0.02, 0), (0, 0.01)]), (), 0.0, 0.01),
            "part 'plate': the outline crosses or touches itself",
        ),
        (Prism(PLATE, (polygon([(0, 0), (0.02, 0.01), (0.02, 0), (0, 0.01)]),), 0.0, 0.01), "hole 0 of part 'plate': the outline crosses"),
    ],
)
def test_impossible_holes_are_refused_without_a_kernel(prism, message):
    with pytest.raises(InputError, match=re.escape(message)):
        outlines.prism_region(prism, "part 'plate'")


@pytest.mark.needs_fe
def test_failures_of_the_kernel_name_part_and_step():
    from netgen.occ import Box

    from drivewright.solids import cad

    box = Box((0, 0, 0), (1, 1, 1))
    with pytest.raises(InputError, match=r"part 'cam': the CAD kernel failed at rounding \(.*command not done"):  # noqa: SIM117
        with cad._kernel("part 'cam'", "rounding"):
            box.MakeFillet(box.edges, 5.0)


@pytest.mark.needs_fe
def test_an_assembly_wants_parts_with_different_names(tmp_path):
    from drivewright.report.cad import write_step

    part = Part("rod", (Bar((0, 0), (0.1, 0), 0.0, 0.01),))
    with pytest.raises(InputError, match="different names; 'rod' comes 2 times"):
        write_step([part, part], tmp_path / "x.step")
    with pytest.raises(InputError, match="at least one part"):
        write_step([], tmp_path / "x.step")
    assert not list(tmp_path.iterdir())


def fail(error):
    def load(name):
        raise error

    return load


def test_without_the_extra_the_message_names_it(monkeypatch):
    from drivewright.solids.engine import fe_module

    monkeypatch.setattr(importlib, "import_module", fail(ModuleNotFoundError("No module named 'netgen'")))
    with pytest.raises(
        MissingExtra,
        match=re.escape(
            "STEP export needs the extra 'fe', which is not installed (No module named 'netgen'); try: pip install 'drivewright[fe]'"
        ),
    ):
        fe_module("netgen.occ", "STEP export")


def test_a_missing_system_library_is_named_where_the_loader_hides_it(monkeypatch):
    from drivewright.solids.engine import fe_module

    monkeypatch.setattr(importlib, "import_module", fail(ImportError("libopenblas.so.0: cannot open shared object file")))
    with pytest.raises(MissingExtra, match=r"libopenblas\.so\.0.*libquadmath; try: apt-get install libquadmath0"):
        fe_module("ngsolve", "a shaft as a solid")
