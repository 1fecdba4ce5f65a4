"""Results and studies as frames of pandas and datasets of xarray: the same numbers, in SI, with unit and label."""

import builtins

import numpy as np
import pytest
from places import EXAMPLES
from study_toy import Toy, install

import drivewright as dw
from drivewright import frames
from drivewright.errors import InputError, MissingExtra, UnknownName
from drivewright.result import Array
from drivewright.studies import study_frames, uniform, with_variation

pytestmark = [pytest.mark.interface, pytest.mark.needs_frames]


@pytest.fixture(scope="module")
def shaft():
    return dw.run(dw.load(EXAMPLES / "gearbox_shaft.toml"))


@pytest.fixture
def grid(monkeypatch):
    """size x colour, the offset twice the size; every case with black fails."""
    install(monkeypatch.setattr)
    vary = {"size": ["8 mm", "9 mm", "13 mm"], "colour": ["red", "black"], "offset": dw.studies.linked("2 * size")}
    return dw.sweep(with_variation(Toy(), vary), on="serial")


def test_values_of_a_result_as_a_frame(shaft):
    frame = shaft.to_pandas()
    assert list(frame.columns) == ["value", "low", "high", "unit", "label"] and frame.index.name == "name"
    assert {name: row.value for name, row in frame.iterrows()} == {name: value.value for name, value in shaft.values.items()}
    row = frame.loc["gears.wheel.deflection"]
    assert (row.unit, row.label) == ("m", "Deflection of the shaft at gear 'wheel'") and row.value == shaft["gears.wheel.deflection"]
    assert frame.attrs["digest"] == shaft.digest and np.isnan(frame.loc["gears.wheel.deflection", "low"])


def test_a_table_as_a_frame_and_as_a_dataset(shaft):
    name, table = next(iter(shaft.tables.items()))
    frame, dataset = shaft.to_pandas(name), shaft.to_xarray(name)
    axis = table.columns[0].name
    assert dataset.sizes == {axis: len(table.columns[0].data)} and set(dataset.data_vars) == {c.name for c in table.columns[1:]}
    for column in table.columns:
        assert frame.attrs["units"][column.name] == column.unit
        assert dataset[column.name].attrs["units"] == ("1" if column.unit == "-" else column.unit)
        assert list(frame[column.name]) == list(dataset[column.name].values) == list(column.data)
    with pytest.raises(UnknownName, match="no table is called"):
        shaft.to_xarray("deflektion")


def test_arrays_of_a_result_as_a_dataset():
    spindle = dw.run(dw.load(EXAMPLES / "spindle.toml"))
    dataset = spindle.to_xarray()
    assert set(dataset.data_vars) == set(spindle.arrays)
    array = spindle.arrays["flexibility.shares"]
    part, station = str(array.labels[0][1]), str(array.labels[2][-1])
    labelled = dataset["flexibility.shares"]
    assert labelled.attrs["units"] == "m/N" and labelled.dims == ("part", "station", "station_2")
    assert labelled.sel(part=part, station=str(array.labels[1][0]), station_2=station) == np.asarray(array.values)[1, 0, -1]


def test_axes_of_one_name_with_other_labels_stand_apart():
    arrays = {"a": Array("m", ("x",), ((1, 2),), np.ones(2)), "b": Array("m", ("x",), ((1, 2, 3),), np.ones(3))}
    dataset = frames.labelled({name: (each.axes, each.labels, each.values, each.unit) for name, each in arrays.items()})
    assert dataset["a"].dims == ("x",) and dataset["b"].dims == ("b.x",)


def test_a_study_as_a_frame(grid):
    frame = grid.to_pandas()
    assert len(frame) == 6 and frame.index.name == "case" and list(frame.index) == list(range(6))
    assert frame.attrs["units"]["size"] == "m" and frame.attrs["units"]["area"] == "m^2" and frame.attrs["labels"]["size"] == "Size"
    done = frame[frame.colour == "red"]
    assert np.allclose(done.area, done["size"] ** 2) and frame[frame.colour == "black"].area.isna().all()


def test_a_study_over_a_grid_as_a_dataset(grid):
    dataset = grid.to_xarray()
    assert dict(dataset.sizes) == {"size": 3, "colour": 2} and dataset["offset"].dims == ("size",)
    assert np.allclose(dataset["offset"], 2 * dataset["size"]) and dataset["size"].attrs == {"units": "m", "long_name": "Size"}
    assert dataset["area"].attrs == {"units": "m^2", "long_name": "Size squared", "description": "size squared"}
    assert np.allclose(dataset["area"].sel(colour="red"), dataset["size"] ** 2) and dataset["area"].sel(colour="black").isnull().all()
    assert dataset["status"].sel(colour="black").values.tolist() == ["failed"] * 3
    back = dataset["area"].to_dataframe().reset_index()
    assert np.array_equal(back["area"].to_numpy(), grid["area"], equal_nan=True) and list(back["colour"]) == list(grid["colour"])


def test_cases_that_are_not_there_are_nan(grid):
    from dataclasses import replace

    part = replace(grid, rows=grid.table.slice(2, 3)).to_xarray()
    assert np.isfinite(part["area"].values).tolist() == [[False, False], [True, False], [True, False]]
    assert part["status"].values.tolist() == [["", ""], ["complete", "failed"], ["complete", ""]]


def test_sampled_points_lie_along_an_axis_of_their_own(monkeypatch):
    install(monkeypatch.setattr)
    spec = with_variation(Toy(), {"count": [1, 3], "size": uniform("8 mm", "12 mm")}, samples=5)
    dataset = dw.sweep(spec, on="serial").to_xarray()
    assert dict(dataset.sizes) == {"count": 2, "sample": 5} and dataset["size"].dims == ("sample",)
    assert np.allclose(dataset["area"], dataset["size"] ** 2)


def test_a_study_that_is_too_large_says_what_to_do(grid, monkeypatch):
    monkeypatch.setattr(study_frames, "LARGEST", 10)
    for convert in (grid.to_pandas, grid.to_xarray):
        with pytest.raises(InputError, match=r"study\.batches"):
            convert()


@pytest.mark.parametrize("library", ["pandas", "xarray"])
def test_without_the_library_the_extra_is_named(shaft, library, monkeypatch):
    real = builtins.__import__
    monkeypatch.setattr("importlib.import_module", lambda name: (_ for _ in ()).throw(ImportError(name)) if name == library else real(name))
    with pytest.raises(MissingExtra, match=r"needs the extra 'frames'.*pip install 'drivewright\[frames\]'"):
        getattr(shaft, f"to_{library}")()


def test_axes_of_equal_length_with_other_labels_stand_apart_and_equal_ones_are_shared():
    numbers = np.arange(2.0)
    arrays = {"a.b_c": (("x",), ((1, 2),), numbers, "-"), "b": (("x",), ((1, 3),), numbers, "m"), "c": (("x",), ((1, 2),), numbers, "m")}
    dataset = frames.labelled(arrays)
    assert {name: dataset[name].dims for name in arrays} == {"a.b_c": ("x",), "b": ("b.x",), "c": ("x",)}
    assert dataset["x"].values.tolist() == [1, 2] and dataset["b.x"].values.tolist() == [1, 3]
    assert dataset["a.b_c"].attrs == {"units": "1", "long_name": "A · b c"}, "a pure number has the unit 1 of the CF conventions"


def test_a_third_axis_of_one_name_has_the_number_three():
    assert frames.distinct_axes(["a", "b", "a", "a"]) == ("a", "b", "a_2", "a_3")


def test_a_column_without_a_label_has_the_first_phrase_of_its_meaning():
    import pyarrow as pa

    about = [{"unit": "m", "meaning": "lift, above the base"}, {"unit": "-", "label": "ratio", "meaning": "one over the other"}]
    fields = [pa.field(name, pa.float64(), metadata=each) for name, each in zip("ab", about, strict=True)]
    frame = frames.frame(pa.table([[1.0], [2.0]], schema=pa.schema(fields)), source="here")
    assert frame.attrs == {"source": "here", "units": {"a": "m", "b": "-"}, "labels": {"a": "Lift", "b": "Ratio"}}
