"""A second run replaces what the first one wrote and nothing else."""

import pytest
from places import EXAMPLES

from drivewright.cli import main

pytestmark = pytest.mark.interface

DISC = EXAMPLES / "disc_cam.toml"


def command(*arguments):
    with pytest.raises(SystemExit) as left:
        main([str(a) for a in arguments])
    return left.value.code


def test_exports_and_own_notes_survive_the_next_run(tmp_path):
    folder = tmp_path / "run"
    assert command("export", DISC, "--to", "dxf,csv", "--out", folder) == 0
    assert command("run", DISC, "--out", folder, "--no-figures") == 0, "a folder with nothing but exports may become a run folder"
    (folder / "my_notes.txt").write_text("keep me")
    (folder / "tables" / "stale.parquet").write_text("an older run's")
    assert command("run", DISC, "--out", folder, "--no-figures", "--set", "follower.roller_radius=7 mm") == 0
    assert (folder / "my_notes.txt").read_text() == "keep me"
    assert (folder / "cad" / "cam.dxf").is_file()
    assert not (folder / "tables" / "stale.parquet").exists()
    assert 'roller_radius = "7 mm"' in (folder / "spec.toml").read_text()
    assert not list(tmp_path.glob("*.tmp-*")) and not list(tmp_path.glob("*.old-*"))


def test_the_spec_of_a_run_folder_can_move_to_another_machine(tmp_path):
    """The oscillating cam's lift table goes along; the moved spec gives the same digest."""
    import drivewright as dw

    example = DISC.with_name("oscillating_cam.toml")
    assert command("run", example, "--out", tmp_path / "run", "--no-figures") == 0
    (tmp_path / "run").rename(tmp_path / "elsewhere")
    assert (tmp_path / "elsewhere" / "data" / "lift.csv").is_file()
    assert dw.load(tmp_path / "elsewhere" / "spec.toml").digest() == dw.load(example).digest()


def test_gcode_of_a_rejected_design_says_so(tmp_path):
    bad = ["--set", "follower.prime_radius=12 mm", "--set", "follower.roller_radius=11 mm", "--set", "manufacture.bore=1 mm"]
    assert command("export", DISC, "--to", "gcode", "--out", tmp_path, *bad) == 2
    assert command("export", DISC, "--to", "gcode", "--out", tmp_path, "--anyway", *bad) in (0, 2)
    for program in tmp_path.rglob("*.nc"):
        assert "(WARNING:" in program.read_text()[:600]


def test_a_follower_that_has_left_the_cam_gives_no_torque(tmp_path):
    import numpy as np

    import drivewright as dw

    found = dw.run(dw.load(DISC, ["spring.stiffness=0.1 N/mm", "spring.preload=0 N", "drive.speed=900 rpm"]))
    load = found.tables["load"]
    flying = load["required_force"].data < 0
    assert flying.any() and not flying.all()
    assert np.all(load["torque"].data[flying] == 0) and np.any(load["torque"].data[~flying] != 0)
    assert any("leaves the cam" in finding for finding in found.findings)


def test_ctrl_c_keeps_the_best_design_so_far(monkeypatch):
    import drivewright as dw
    from drivewright.studies import optimisation as optimise

    spec = dw.load(DISC.with_name("seedling_pusher.toml"))
    evaluate = optimise.Evaluator.__call__

    def interrupted(self, x):
        if len(self.designs) >= 20:
            raise KeyboardInterrupt
        return evaluate(self, x)

    monkeypatch.setattr(optimise.Evaluator, "__call__", interrupted)
    found = dw.optimise(spec)
    assert found.interrupted and found.evaluations == sum(len(x) for x in [found.history["generation"]])
    violation = found.history["violation"]
    assert found.problem.violations(found.front_values).clip(0).sum() <= violation.min() + 1e-12
