"""The linear view from Python: matrices, scipy, frames, figures, files, sentences."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.io import loadmat
from scipy.signal import StateSpace

import mckibben as mk
from mckibben.door.linear import LinearView

LIFT = {
    "valve": "VPPM-6",
    "load": {"mass": "10 kg"},
    "effects": {"bladder_elasticity": {}, "viscous_damping": {"coefficient": "120 N*s/m"}},
}


@pytest.fixture(scope="module")
def view() -> LinearView:
    """A drive with a regulator, with a sweep and a design."""
    drive = mk.Drive("DMSP-20:300mm", **LIFT, command={"shape": "step"})
    return drive.linearise("position 40 mm", amplitudes=["5 %"], design="overshoot 5 %, settling 1 s")


def test_it_is_what_scipy_makes_of_it(view: LinearView) -> None:
    system = view.to_scipy()
    assert isinstance(system, StateSpace)
    a, b, c, d = view.matrices()
    row, column = view.outputs.index("position"), view.inputs.index("command")
    at = 2j * np.pi * view.frequency[100]
    expected = c[row] @ np.linalg.solve(at * np.eye(len(a)) - a, b[:, column]) + d[row, column]
    assert view.response()[100] == pytest.approx(expected, rel=1e-6)
    assert system.A.shape == (len(view.states),) * 2


def test_print_notebook_frame_and_figures(view: LinearView) -> None:
    text = str(view)
    for words in ("operating point", "40 mm", "Poles and zeros", "refined", "not in the model: saturation"):
        assert words in text
    assert "<table" in view._repr_html_()
    frame = view.to_frame()
    assert list(frame.columns) == ["frequency_Hz", "gain", "phase_rad"]
    assert [trace.name for trace in view.plot().data][:1] == ["mean of both sides"]
    assert any("5 %" in (trace.name or "") for trace in view.plot().data)
    assert len(view.plot_design().data) == 5


def test_files(view: LinearView, tmp_path: Path) -> None:
    for name in ("view.json", "view.csv", "view.mat"):
        view.save(tmp_path / name)
    assert json.loads((tmp_path / "view.json").read_text())["schema"] == 1
    stored = loadmat(tmp_path / "view.mat")
    assert stored["A"] == pytest.approx(view.matrices()[0])
    assert [str(name[0]) for name in stored["states"].ravel()] == list(view.states)
    with pytest.raises(mk.Problem, match="known ending"):
        view.save(tmp_path / "view.txt")


def test_the_designed_controller_runs_in_the_drive(view: LinearView) -> None:
    reference = {"shape": "step", "at": "2 s", "level": "45 mm", "initial": "40 mm"}
    drive = mk.Drive(
        "DMSP-20:300mm", **LIFT, controller={**view.controller(), "reference": reference}, duration="4 s",
        start_pressure=view.pressure,
    )  # fmt: skip
    run = drive.run()
    assert run.position[-1] == pytest.approx(0.045, abs=0.02 * 0.005)


def test_where_it_switches_each_model_has_a_name() -> None:
    view = mk.Drive.preset("propneu-20").linearise(amplitudes=())
    assert [model.name for model in view.models] == ["filling", "venting", "mean of filling and venting"]
    assert not view.smooth
    filling, venting = (view.matrices(name)[1][2, 0] for name in ("filling", "venting"))
    assert [view.matrices(model)[1][2, 0] for model in view.models[:2]] == [filling, venting]
    assert f"{view.models[0]}" == "filling"
    assert view.matrices()[1][2, 0] == pytest.approx(filling, rel=0.1)
    assert filling != venting
    with pytest.raises(mk.Problem, match="no model 'fillin'"):
        view.matrices("fillin")
    with pytest.raises(mk.Problem, match="no controller was designed"):
        view.controller()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"at": "position 400 mm"}, "not between the ends"),
        ({"at": "somewhere"}, "states no operating point"),
        ({"at": "position"}, "has no value"),
        ({"at": "position 3 bar"}, "position"),
        ({"input": "voltage"}, "no input 'voltage'"),
        ({"design": "speed 3"}, "no goal 'speed 3'"),
        ({"design": "overshoot 400 %"}, "not between 0 and 100 %"),
        ({"amplitudes": [-0.1]}, "not positive"),
    ],
)
def test_problems_are_sentences(arguments: dict, message: str) -> None:
    with pytest.raises(mk.Problem, match=message):
        mk.Drive.preset("propneu-20").linearise(**arguments)


def test_python_control_gets_matrices_and_names(view: LinearView, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of python-control only its constructor is used: `StateSpace(A, B, C, D, states=..., ...)`."""
    given: dict[str, object] = {}

    def state_space(*matrices: object, **names: object) -> str:
        given.update(names, matrices=matrices)
        return "made"

    monkeypatch.setitem(sys.modules, "control", SimpleNamespace(StateSpace=state_space))
    assert view.to_control() == "made"
    assert (given["states"], given["outputs"]) == (list(view.states), list(view.outputs))
    assert len(given["matrices"]) == 4  # type: ignore[arg-type]
    monkeypatch.setitem(sys.modules, "control", None)
    with pytest.raises(mk.Problem, match="needs control, which is not installed"):
        view.to_control()
