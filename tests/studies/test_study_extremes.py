"""Which inputs give the least and the greatest of a value, and what linear theory's worst corner gives when it is computed."""

import numpy as np
import pytest
from study_toy import Toy, install
from test_study_answers import FORCE, LEVELS, PRIME, RANDOM, ROLLER, STEEL, made, spec_of, straight

import drivewright as dw
from drivewright.cli import main
from drivewright.report.study import study_content
from drivewright.result import Answer
from drivewright.studies.answers import analyse_study
from drivewright.studies.answers.extremes import inputs_text, kind_of
from drivewright.studies.sweeps import rerun_cases
from drivewright.studies.variation import linspace, tolerance, with_variation

pytestmark = pytest.mark.property


def rows(result, table):
    return result.table(table).to_pylist()


def of(result, name):
    return {row["end"]: row for row in rows(result, "extremes") if row["value"] == name}


def test_corners_of_a_straight_value_are_the_ones_that_its_signs_say():
    """3 roller - 2 prime: greatest with the largest roller and the smallest prime circle."""
    result, _ = analyse_study(made(spec_of(RANDOM, method="tolerance", samples=50), y=straight, check_a=lambda c: 0.045 - c[PRIME]))
    ends = of(result, "y")
    assert (ends["greatest"][ROLLER], ends["greatest"][PRIME]) == pytest.approx((8.6e-3, 38e-3))
    assert (ends["least"][ROLLER], ends["least"][PRIME]) == pytest.approx((7.4e-3, 42e-3))
    assert ends["greatest"]["number"] == pytest.approx(3 * 8.6e-3 - 2 * 38e-3) and {each["kind"] for each in ends.values()} == {"corner"}
    assert of(result, "check.a")["least"][PRIME] == pytest.approx(42e-3)
    table = {row["key"]: row for row in rows(result, "extremes.y")}
    assert table[ROLLER]["greatest"] == pytest.approx(8.6e-3) and table[PRIME]["least"] == pytest.approx(42e-3)
    assert "in case" in result.tables["extremes.y"].title


def test_the_case_of_an_end_is_the_case_that_has_it():
    study = made(spec_of([*RANDOM, LEVELS], method="random", samples=40), y=lambda c: straight(c) + 1e-5 * c[FORCE])
    result, _ = analyse_study(study)
    for end, row in of(result, "y").items():
        assert row["case"] == (np.argmin if end == "least" else np.argmax)(study["y"]) and row["kind"] == "sample"
        assert (row[ROLLER], row[FORCE]) == (study[ROLLER][row["case"]], study[FORCE][row["case"]])


def test_of_a_grid_with_a_text_the_inputs_are_texts():
    study = made(spec_of([LEVELS, STEEL]), y=lambda c: c[FORCE] * np.where(np.array(c["material"]) == "42CrMo4", 2.0, 1.0), unit="N")
    result, _ = analyse_study(study)
    assert of(result, "y")["greatest"]["material"] == "42CrMo4" and of(result, "y")["greatest"]["kind"] == "levels"
    table = {row["key"]: row for row in rows(result, "extremes.y")}
    assert (
        table[FORCE]["greatest"] == "40\u00a0N" and table["material"]["greatest"] == "42CrMo4" and table["material"]["least"] == "16MnCr5"
    )
    assert "42CrMo4" in inputs_text(study, of(result, "y")["greatest"]["case"])


def test_a_case_without_the_value_is_no_end_and_a_value_that_no_case_has_no_row():
    study = made(spec_of(RANDOM, method="corners"), y=lambda c: np.where(c[PRIME] > 0.04, np.nan, straight(c)), nothing=None)
    result, _ = analyse_study(study)
    assert of(result, "y")["least"][PRIME] == pytest.approx(38e-3) and not of(result, "nothing")


def test_kinds_of_cases():
    plan = made(spec_of(RANDOM, method="tolerance", samples=5), y=straight).plan
    assert [kind_of(plan, case) for case in (0, 1, 4, 5, 8, 9)] == ["nominal", "step", "step", "corner", "corner", "sample"]


# -- linear theory ---------------------------------------------------------------------------------------------------------------


def test_a_straight_value_is_at_its_corner_what_linear_theory_says():
    result, _ = analyse_study(made(spec_of(RANDOM, method="tolerance", samples=20), y=straight))
    for row in rows(result, "linear_corners"):
        assert row["computed"] == pytest.approx(row["linear"], rel=1e-9) and abs(row["difference"]) < 1e-12
    assert result["linear.greatest.y.computed"] == pytest.approx(result["linear.greatest.y"])
    assert not any("not linear in the keys" in text for text in result.findings)


def test_a_bent_value_is_not_and_that_is_told():
    def bent(cases):
        return (cases[ROLLER] - 7.4e-3) ** 2 * 1e3 + 1e-6 * cases[PRIME]

    result, _ = analyse_study(made(spec_of(RANDOM, method="tolerance", samples=20), y=bent))
    row = next(row for row in rows(result, "linear_corners") if row["end"] == "greatest")
    assert row[ROLLER] == pytest.approx(8.6e-3) and row[PRIME] == pytest.approx(42e-3)
    assert row["computed"] == pytest.approx(1.2e-3**2 * 1e3 + 42e-9) and row["difference"] == pytest.approx(row["computed"] - row["linear"])
    (told,) = [text for text in result.findings if text.startswith("not linear in the keys between their ends")]
    assert "y (greatest" in told


@pytest.fixture
def _toy(monkeypatch):
    install(monkeypatch.setattr)


@pytest.mark.usefixtures("_toy")
def test_where_a_study_has_no_corners_they_are_run():
    """area = size^2, its greatest at the largest size; the corner is no case of the study."""
    vary = {"size": tolerance("1 mm"), "ratio": tolerance(0.1)}
    study = dw.sweep(with_variation(Toy(), vary, method="one-at-a-time"), None, on="serial")
    without, _ = analyse_study(study)
    assert np.isnan([row["computed"] or np.nan for row in rows(without, "linear_corners")]).all()
    result, _ = analyse_study(study, rerun=rerun_cases(study))
    found = {(row["value"], row["end"]): row for row in rows(result, "linear_corners")}
    assert found["area", "greatest"]["computed"] == pytest.approx(121e-6, rel=1e-12)
    assert found["area", "greatest"]["linear"] == pytest.approx(120e-6, rel=1e-9)
    assert found["root", "least"]["computed"] == pytest.approx(np.sqrt(0.15)) and found["root", "least"]["ratio"] == pytest.approx(0.15)


@pytest.mark.usefixtures("_toy")
def test_keys_that_follow_go_along_to_the_corner():
    vary = {"size": tolerance("1 mm"), "offset": dw.studies.linked("size + 1 mm")}
    study = dw.sweep(with_variation(Toy(), vary, method="one-at-a-time"), None, on="serial")
    asked = []

    def rerun(columns):
        asked.append({key: column.tolist() for key, column in columns.items()})
        return rerun_cases(study)(columns)

    analyse_study(study, rerun=rerun)
    assert asked[0]["offset"] == pytest.approx([size + 1e-3 for size in asked[0]["size"]])


# -- page and terminal -----------------------------------------------------------------------------------------------------------


@pytest.mark.interface
@pytest.mark.usefixtures("_toy")
def test_page_and_terminal_name_the_inputs(tmp_path, capsys):
    (tmp_path / "toy.toml").write_text('mechanism = "toy"\n')
    vary = ["--vary", "size=8 mm:12 mm:5", "--vary", "ratio=1,4"]
    with pytest.raises(SystemExit) as end:
        main(["sweep", str(tmp_path / "toy.toml"), *vary, "--out", str(tmp_path / "S"), "--on", "serial"])
    assert not end.value.code
    printed = " ".join(capsys.readouterr().out.replace("\u00a0", " ").split())
    assert "area least: 64 mm² with size 8 mm, ratio 1 (case 0)" in printed
    assert "area greatest: 144 mm² with size 12 mm, ratio 1 (case 8)" in printed
    study = dw.open_study(tmp_path / "S")
    content = study_content(study, analyse_study(study))
    table = next(each for each in content["tables"] if each["name"] == "extremes.area")
    assert [list(row) for row in table["printed"]][0][0] == "size"
    page = (tmp_path / "S" / "report.html").read_text()
    assert "Size squared: inputs of the least" in page


def test_an_answer_of_nothing_has_no_extremes():
    study = made(spec_of(RANDOM, method="corners"), nothing=None)
    result, _ = analyse_study(study)
    assert "extremes" not in result.tables and Answer().tables == ()


@pytest.mark.usefixtures("_toy")
def test_the_ends_of_a_chaotic_value_carry_the_interval_of_their_case():
    spec = with_variation(Toy(), {"size": linspace("8 mm", "12 mm", 3)})
    assert "number.low" not in analyse_study(dw.sweep(spec, None, on="serial"))[0].tables["extremes"].arrow().column_names
