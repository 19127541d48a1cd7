"""Measurements from files, frames and arrays are the same measurement."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import mckibben as mk
from tests.stopping import SECONDS, record, stop_runs

RNG = np.random.default_rng(7)
PRESSURE = RNG.uniform(0.5, 6.0, 40)  # bar, with all their digits
LENGTH = RNG.uniform(240.0, 300.0, 40)
FORCE = RNG.uniform(10.0, 900.0, 40)


IN_BAR = {"units": {"pressure": "bar", "length": "mm"}}


def frame() -> pd.DataFrame:
    """A table as a laboratory writes it."""
    return pd.DataFrame({"p [bar]": PRESSURE, "L [mm]": LENGTH, "F [N]": FORCE})


def test_a_frame_keeps_every_digit() -> None:
    data = mk.Measurement.from_frame(frame(), kind="static")
    assert data.kind == "static"
    assert data.columns["force"].tolist() == FORCE.tolist()
    assert data.columns["pressure"] == pytest.approx(PRESSURE * 1e5, rel=1e-15)
    again = mk.Measurement.from_frame(data.to_frame(), kind="static")
    for channel in ("pressure", "length", "force"):
        assert again.columns[channel].tolist() == data.columns[channel].tolist()
    with pytest.raises(ValueError, match="read-only"):
        data.columns["force"][0] = 0.0


def test_a_file_a_frame_and_arrays_are_the_same() -> None:
    frame().to_csv("lab.csv", index=False)
    files = mk.read("lab.csv", rest_length="300 mm")
    frames = mk.Measurement.from_frame(frame(), rest_length=0.3)
    arrays = mk.Measurement.from_arrays(
        {"pressure": PRESSURE, "length": LENGTH, "force": FORCE},
        units={"pressure": "bar", "length": "mm"},
        rest_length="300 mm",
    )
    model = mk.Model(inside_diameter="20 mm", braid_angle="25 deg")
    errors = [model.compare(data).rmse for data in (files, frames, arrays)]
    assert errors[0] == errors[1] == errors[2]
    assert files.experiment["rest_length"].value == 0.3


@pytest.mark.parametrize(("unit", "one"), [(None, 9.80665), ("kg", 9.80665), ("g", 9.80665e-3), ("N", 1.0)])
def test_a_load_of_each_row_is_a_force(unit: str | None, one: float) -> None:
    loads = np.tile([1.0, 2.0, 5.0, 8.0], 5)
    pressure = np.repeat([1e5, 2e5, 3e5, 4e5, 5e5], 4)
    length = 0.3 - 5e-8 * pressure + 1e-3 * loads
    units = {} if unit is None else {"load": unit}
    channels = {"pressure": pressure, "length": length, "load": loads}
    data = mk.Measurement.from_arrays(channels, units=units, kind="isotonic", rest_length=0.3)
    assert data.columns["force"] == pytest.approx(one * loads, rel=1e-12)


def test_columns_say_what_heads_do_not() -> None:
    table = pd.DataFrame({"p [bar]": PRESSURE, "L [mm]": LENGTH, "Kraft": -FORCE / 1e3, "Traverse": LENGTH})
    by_name = mk.Measurement.from_frame(table, columns={"force": "-Kraft [kN]"}, ignore="Traverse")
    as_text = mk.Measurement.from_frame(table, columns=["force=-Kraft [kN]"], ignore=["Traverse"])
    assert by_name.columns["force"] == pytest.approx(FORCE)
    assert as_text.columns["force"].tolist() == by_name.columns["force"].tolist()


def test_a_named_index_is_a_column() -> None:
    seconds = np.arange(200) * 0.01
    table = pd.DataFrame(
        {"p [bar]": 3.0 + np.sin(seconds), "x [mm]": 20.0 + 5.0 * np.sin(seconds)},
        index=pd.Index(seconds, name="t [s]"),
    )
    data = mk.Measurement.from_frame(table, kind="transient", load="10 kg")
    assert data.columns["time"] == pytest.approx(seconds)


def test_more_can_be_said_later_and_the_canonical_file_keeps_the_numbers() -> None:
    data = mk.Measurement.from_frame(frame(), name="lab", kind="static")
    said = data.stating(rest_length="300 mm", accuracy="length 1 mm")
    assert "rest_length" not in data.experiment
    assert said.experiment["rest_length"].value == 0.3
    assert said.experiment["accuracy_length"].value == 1e-3
    data.save("clean.csv")
    again = mk.read("clean.csv")
    assert again.columns["force"].tolist() == FORCE.tolist()


def test_several_measurements_are_several_specimens() -> None:
    one, other = mk.read("martens-dmsp-10-250"), mk.read("martens-dmsp-20-300")
    compared = mk.Model.preset("DMSP-20").compare([one, other])
    assert compared.rows == one.rows + other.rows
    assert "martens-dmsp-10-250" in repr(compared)
    assert "martens-dmsp-20-300" in repr(compared)


@pytest.mark.parametrize(
    ("channels", "options", "words"),
    [
        ({"presure": [1.0]}, {}, ["presure", "pressure"]),
        ({"pressure": [1.0, 2.0], "force": [1.0]}, {}, ["pressure 2", "force 1"]),
        ({"pressure": 3.0}, {}, ["pressure", "array"]),
        ({"pressure": PRESSURE, "length": LENGTH, "force": FORCE}, {"units": {"force": "bar"}}, ["force"]),
        ({"pressure": PRESSURE, "length": LENGTH, "force": FORCE}, {"kind": "isobar", **IN_BAR}, ["isobar"]),
        ({"pressure": PRESSURE, "length": LENGTH, "force": FORCE}, {"load": "3 m"}, ["load"]),
        ({"pressure": PRESSURE, "length": LENGTH, "force": FORCE}, {"experiment": {"zero": 1}}, ["zero"]),
        ({"temperature": [1.0, 2.0]}, {}, ["temperature"]),
        ({"pressure": PRESSURE, "length": LENGTH, "force": FORCE, "load": FORCE}, {}, ["load", "force"]),
    ],
)
def test_bad_arrays_are_one_sentence(channels: dict, options: dict, words: list[str]) -> None:
    with pytest.raises(mk.Problem) as caught:
        mk.Measurement.from_arrays(channels, **options)
    assert "\n" not in str(caught.value)
    for word in words:
        assert word in str(caught.value)


def test_what_is_no_frame_is_refused() -> None:
    with pytest.raises(mk.Problem, match="list is no data frame"):
        mk.Measurement.from_frame([1, 2])  # type: ignore[arg-type]


def test_a_list_of_files_is_to_be_read_one_by_one() -> None:
    mk.read("martens-dmsp-20-300").save("a.csv")
    Path("list.json").write_text('[{"file": "a.csv"}, {"file": "a.csv"}]', "utf-8")
    with pytest.raises(mk.Problem, match="list of 2 measurements"):
        mk.read("list.json")


def test_a_run_of_the_model_that_stops_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    stop_runs(monkeypatch)
    Path("record.csv").write_text(record())
    data = mk.read("record.csv", load="5 kg", rest_length="400 mm")
    found = mk.Model.preset("hand-made", length="400 mm").compare(data)
    (run,) = found.stopped
    assert 0.0 < run.reached < run.duration == pytest.approx(SECONDS)
    assert run.sentence in " ".join(str(found).split())
    assert run.sentence in found.sentences
    assert found.to_frame()["time"].max() == pytest.approx(run.reached)
    with pytest.raises(ValueError, match="no diagnosis can be made"):
        mk.Model.preset("hand-made", length="400 mm").diagnose(data)
