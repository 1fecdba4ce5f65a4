"""Pictures on the pages of worked examples: figures of today's runs of these examples, kept in the tree."""

import tempfile
from collections.abc import Callable
from pathlib import Path

import drivewright as dw
from drivewright.report.folder import write_run_folder
from drivewright.report.worked_examples import examples

from .tutorials import compact

FOLDER = "img"
PICTURES = {  # {example: {picture of the pages: figure of the run}}
    "dial_table": {"dial-table-cam": "scene-cam", "dial-table-torque": "plot-drive_torque"},
    "five_bar": {"five-bar-torque": "plot-drive"},
    "gearbox_shaft": {"gearbox-shaft-forces": "plot-force_vectors", "gearbox-shaft-haigh": "plot-haigh"},
    "press_worn_pin": {"press-wrist-force": "plot-force.wrist", "press-wrist-orbit": "plot-orbit.wrist"},
    "two_disc_rotor": {"two-disc-rotor-campbell": "plot-campbell", "two-disc-rotor-unbalance": "plot-unbalance_response"},
    "valve_train": {
        "valve-train-scene": "scene-machine",
        "valve-train-spring": "plot-surge",
        "valve-train-harmonics": "plot-surge_harmonics",
        "valve-train-film": "plot-film",
    },
}


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Run the examples and write docs/img/*.svg."""
    known = examples()
    for name, pictures in PICTURES.items():
        progress(name)
        with tempfile.TemporaryDirectory(prefix="pictures-") as folder:
            run = write_run_folder(dw.run(dw.load(known[name])), Path(folder) / name)
            copy_pictures(run / "figures", docs / FOLDER, pictures)


def copy_pictures(figures: Path, target: Path, pictures: dict[str, str]) -> None:
    """The figures that the pages show, with coordinates of a hundredth of a pixel."""
    for picture, figure in pictures.items():
        (target / f"{picture}.svg").write_bytes(compact((figures / f"{figure}.svg").read_bytes()))
