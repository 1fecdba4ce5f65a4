"""Torsion tests that cannot be: each is refused in words that name the file, the line, the column and the remedy."""

import numpy as np
import pytest

from drivewright.errors import InputError, SpecError
from drivewright.indexing.torsion_test import (
    Readings,
    SeriesSpring,
    TorsionTestSettings,
    evaluate_loop,
    evaluate_positions,
    fit_line,
    read_test,
)

pytestmark = pytest.mark.error

TORQUE = np.concatenate([np.linspace(-500, 500, 30), np.linspace(500, -500, 30)])
ANGLE = TORQUE / 1e5 + np.repeat([-2e-4, 2e-4], 30)


def file(tmp_path, text):
    path = tmp_path / "test.csv"
    path.write_text(text)
    return path


def rows(header="torque [N m],angle [arcmin]", count=10):
    return header + "\n" + "".join(f"{n},{0.5 * n}\n" for n in range(count))


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("", r"test.csv: is empty; the first line must name the columns, e.g. torque \[N m\],angle \[arcmin\]"),
        ("# only words\n\n", "is empty"),
        (rows("torque,angle [arcmin]"), r"test.csv: column 'torque': has no unit; write 'torque \[N m\]'"),
        (rows("torque [N],angle [arcmin]"), r"column 'torque': wants a torque, got 'N' \(force\)"),
        (rows("torque [N m/rad],angle [arcmin]"), r"column 'torque': wants a torque, got 'N m/rad' \(rotational stiffness\); write N m"),
        (rows("torque [N m],angle [mm]"), "column 'angle': wants an angle, got 'mm'"),
        (rows("torque [N m,angle [arcmin]"), r"no column 'torque \[N m\]'.*the bracket of 'torque \[N m' is not closed"),
        (rows("torque [N m],angle [furlong]"), "column 'angle': 'furlong' is no unit known here"),
        (rows("torque [N m],angel [arcmin]"), r"no column 'angle \[arcmin\]' in the first line .*did you mean 'angel'"),
        (rows("load [N m],angle [arcmin]"), r"no column 'torque \[N m\]' or 'force \[N\]'"),
        (rows("torque [N m],angle [rad],angle [arcmin]"), "column 'angle' is there twice"),
        ("torque [N m],force [N],angle [deg]\n1,2,3\n", "has both a torque and a force; keep one"),
        (rows("force [N],angle [deg]"), "test.csv: the load is a force; give the length of its arm as well"),
        (rows() + "nan,3\n", "test.csv: line 12: the torque is 'nan', not a finite number"),
        ("# note\n\n" + rows() + "3,inf\n", "test.csv: line 14: the angle is 'inf', not a finite number"),
        (rows() + "3\n", "line 12: the angle is missing"),
        ("cycle,torque [N m],angle [deg]\n1.5,2,3\n", "line 2: the cycle is '1.5', not a whole number"),
        ("branch,torque [N m],angle [deg]\nup,2,3\n", "line 2: the branch is 'up', not 'loading' or 'unloading'"),
    ],
)
def test_a_file_that_is_no_torsion_test_is_refused(tmp_path, text, wanted):
    with pytest.raises(SpecError, match=wanted):
        read_test(file(tmp_path, text))


def test_an_arm_and_a_torque_contradict_each_other(tmp_path):
    with pytest.raises(SpecError, match=r"the load is a torque already; an arm belongs to a column 'force \[N\]'"):
        read_test(file(tmp_path, rows()), arm=0.5)
    with pytest.raises(SpecError, match="nothing.csv: cannot be read: No such file"):
        read_test(tmp_path / "nothing.csv")


def test_a_file_is_read_in_its_units_whatever_the_order_of_its_columns(tmp_path):
    text = "# a test\n Angle [deg] , branch, time, CYCLE, Force [kN], crank [rev]\n0.5,loading,9,1,2,0.25\n\n-0.5,Unloading,x,2,-3,0.5\n"
    found = read_test(file(tmp_path, text), arm=0.25)
    np.testing.assert_allclose(found.torque, [500, -750])
    np.testing.assert_allclose(found.angle, np.radians([0.5, -0.5]))
    np.testing.assert_allclose(found.crank, [np.pi / 2, np.pi])
    assert found.cycle.tolist() == [1, 2] and found.branch.tolist() == [1, -1]
    plain = read_test(file(tmp_path, "torque [N cm],angle [arcsec]\n100,3600\n2,1\n"))
    assert plain.torque[0] == pytest.approx(1) and plain.angle[0] == pytest.approx(np.radians(1)) and plain[2:] == (None, None, None)


@pytest.mark.parametrize(
    ("torque", "angle", "wanted"),
    [
        (TORQUE[:7], ANGLE[:7], "7 samples are too few for a stiffness with an uncertainty; give at least 8"),
        (TORQUE, ANGLE[:-1], r"torque \(60,\) and angle \(59,\) must be rows of the same length"),
        (np.full(60, 300.0), ANGLE, "the torque is 300 N m in all samples; a stiffness needs a torque that changes"),
        (TORQUE, np.full(60, 0.25), "the angle is 0.25 rad in all samples"),
        (np.where(TORQUE > 400, np.nan, TORQUE), ANGLE, "must be finite"),
        (TORQUE, -ANGLE, "the angle falls by 1e-05 rad per N·m of rising torque.*change the sign of one of the columns"),
    ],
)
def test_readings_without_a_stiffness_are_refused(torque, angle, wanted):
    with pytest.raises(InputError, match=wanted):
        evaluate_loop(Readings(torque, angle))


def test_a_position_that_is_refused_is_named():
    crank = np.repeat([0.0, np.pi / 4], 60)
    readings = Readings(np.tile(TORQUE, 2), np.concatenate([ANGLE, -ANGLE]), crank=crank)
    with pytest.raises(InputError, match="^crank angle 45°: torsion test: the angle falls"):
        evaluate_positions(readings)


def test_a_rig_softer_than_the_test_is_refused():
    with pytest.raises(InputError, match="is not positive: the rig would be softer.*loading bar's stiffness .*above 100000 N·m/rad"):
        evaluate_loop(Readings(TORQUE, ANGLE), TorsionTestSettings(parts=(SeriesSpring("loading bar's", 9e4),)))


def test_a_rated_torque_beyond_the_data_leaves_the_secant_out():
    test = evaluate_loop(Readings(TORQUE, ANGLE), TorsionTestSettings(rated_torque=800.0))
    assert np.isnan(test.shape.secant) and np.isfinite(test.shape.lost_motion)
    wanted = "secant from 50 to 100 % of the rated torque 800 N·m is absent"
    assert any(wanted in text and "ends at 500 N·m" in text for text in test.findings)
    assert np.isfinite(evaluate_loop(Readings(TORQUE, ANGLE), TorsionTestSettings(rated_torque=500.0)).shape.secant)


def test_a_loop_that_does_not_close_is_remarked():
    slipped = ANGLE + np.where(np.arange(60) > 45, 1e-3, 0)
    texts = evaluate_loop(Readings(TORQUE, slipped)).findings
    assert any("the loop does not close: at the same torque the angle ends 0.0014 rad from where it began" in text for text in texts)
    texts = evaluate_loop(Readings(TORQUE[:48], ANGLE[:48])).findings
    assert any("does not close: it begins at -500 N·m and ends at -86.21 N·m" in text for text in texts)
    assert not any("close" in text for text in evaluate_loop(Readings(TORQUE, ANGLE)).findings)


def test_a_loop_that_runs_backwards_is_remarked():
    texts = evaluate_loop(Readings(TORQUE, 2 * TORQUE / 1e5 - ANGLE)).findings
    assert any("the loop runs in the wrong direction and would gain 0.4 J in each cycle" in text for text in texts)


def test_a_line_through_one_place_is_refused():
    with pytest.raises(InputError, match="a line through 5 samples in 1 groups has no slope"):
        fit_line(np.ones(5), np.arange(5.0))
