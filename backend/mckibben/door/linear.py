"""The linear view of a drive: matrices, responses, loop, controller design."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from mckibben.application.linear.matlab import mat_file, matrices_of
from mckibben.application.linear.result import DesignResult, LinearResult, LoopResult, ModelResult
from mckibben.door.frames import frame_of
from mckibben.door.problem import reported
from mckibben.door.result import Result
from mckibben.door.values import FloatArray, read_only
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.report.summary import Summary
from mckibben.report.summary.linear import summary_of

if TYPE_CHECKING:
    import pandas as pd
    from plotly.graph_objects import Figure
    from scipy.signal import StateSpace

_ENDINGS = (".json", ".csv", ".mat")


class LinearView(Result):
    """Linear models of a drive at an operating point, from `Drive.linearise`; SI, angles in rad.

    One model where the equations are smooth, several where something sticks or switches; without a name the
    methods take the one that loop and design use.
    """

    __slots__ = ("_name", "_result")

    _result: LinearResult
    _name: str

    def __init__(self, result: LinearResult, name: str) -> None:
        self._set(_result=result, _name=name)

    @property
    def models(self) -> Sequence[str]:
        """Names of the models: "smooth", "mean of both sides", or "held", "filling" and the like."""
        return tuple(model.name for model in self._result.models)

    @property
    def smooth(self) -> bool:
        """Whether nothing sticks or switches at the operating point in a way that the motion shows."""
        return self._result.smooth

    @property
    def lost(self) -> Sequence[str]:
        """What the linear models do not contain, as sentences."""
        return tuple(self._result.lost)

    @property
    def states(self) -> Sequence[str]:
        """Names of the states of the main model, in the order of its matrices."""
        return tuple(state.name for state in self._result.primary.states)

    @property
    def inputs(self) -> Sequence[str]:
        """Names of the inputs, in the order of the matrices."""
        return tuple(port.name for port in self._result.primary.inputs)

    @property
    def outputs(self) -> Sequence[str]:
        """Names of the outputs, in the order of the matrices."""
        return tuple(port.name for port in self._result.primary.outputs)

    @property
    def position(self) -> float:
        """Position of the load at the operating point [m]."""
        return self._result.point.position

    @property
    def pressure(self) -> float:
        """Gauge pressure in the (first) muscle at the operating point [Pa]."""
        return self._result.point.pressure

    @property
    def frequency(self) -> FloatArray:
        """Frequencies of the responses [Hz], shape (n,)."""
        return read_only(self._result.frequency)

    @property
    def loop(self) -> LoopResult | None:
        """The loop with the drive's controller: ``loop.margins.phase_margin`` and the like; None without."""
        return self._result.loop

    @property
    def design(self) -> DesignResult | None:
        """The designed controller: ``design.trials[-1].controller``; None unless it was asked for."""
        return self._result.design

    @property
    def details(self) -> LinearResult:
        """Everything else: poles, zeros, describing points, values at the operating point."""
        return self._result

    @reported
    def matrices(self, model: str | None = None) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """A, B, C and D of a model, for deviations from the operating point in SI.

        Raises:
            Problem: there is no model of this name, with the nearest match.
        """
        found = self._model(model)
        return read_only(found.a), read_only(found.b), read_only(found.c), read_only(found.d)

    @reported
    def response(self, model: str | None = None) -> FloatArray:
        """Complex response of the chosen channel over `frequency`, with the dead time, shape (n,).

        Raises:
            Problem: there is no model of this name, with the nearest match.
        """
        found = self._model(model)
        return read_only(found.gain * np.exp(1j * found.phase))

    @reported
    def to_scipy(self, model: str | None = None) -> StateSpace:
        """A model as ``scipy.signal.StateSpace``, with all inputs and outputs; without the dead time.

        Raises:
            Problem: there is no model of this name, with the nearest match.
        """
        from scipy import signal

        found = self._model(model)
        return cast(Any, signal).StateSpace(found.a, found.b, found.c, found.d)

    @reported
    def to_control(self, model: str | None = None) -> Any:
        """A model as ``control.StateSpace`` of python-control, with all names; without the dead time.

        Raises:
            Problem: python-control is not installed, or there is no model of this name.
        """
        found = self._model(model)
        try:
            control = cast(Any, import_module("control"))
        except ImportError as error:
            raise InputError("python-control is not installed", hint="pip install control") from error
        names = {
            kind: [port.name for port in getattr(found, kind)] for kind in ("states", "inputs", "outputs")
        }
        return control.StateSpace(found.a, found.b, found.c, found.d, **names)

    def controller(self) -> dict[str, str]:
        """The designed controller for ``Drive.changed(controller={**..., "reference": {...}})``.

        Raises:
            Problem: no design was asked for.
        """
        return self._controller()

    @reported
    def _controller(self) -> dict[str, str]:
        if self._result.design is None:
            raise InputError("no controller was designed", hint='linearise(design="overshoot 5 %")')
        return dict(self._result.design.trials[-1].controller.document)

    def _model(self, name: str | None) -> ModelResult:
        if name is None:
            return self._result.primary
        for model in self._result.models:
            if model.name == name:
                return model
        raise InputError(f"there is no model '{name}'", hint=did_you_mean(name, self.models))

    @reported
    def save(self, path: str | PathLike[str]) -> None:
        """Write the result: ``.json``, ``.csv`` (the responses), ``.mat`` (A, B, C, D, names, dead time).

        Raises:
            Problem: the file cannot be written, or its ending is none of these.
        """
        if Path(path).suffix.lower() != ".mat":
            super().save(path)
            return
        try:
            Path(path).write_bytes(mat_file(matrices_of(self._result.primary)))
        except OSError as error:
            raise InputError(f"{fspath(path)}: cannot be written: {error.strerror or error}") from error

    def to_frame(self) -> pd.DataFrame:
        """One row for each frequency: frequency_Hz, and of each model gain and phase_rad."""
        columns: dict[str, Any] = {"frequency_Hz": self._result.frequency}
        for model in self._result.models:
            suffix = "" if len(self._result.models) == 1 else f" {model.name}"
            columns[f"gain{suffix}"] = model.gain
            columns[f"phase_rad{suffix}"] = model.phase
        return frame_of(columns)

    def plot(self) -> Figure:
        """Bode diagram of all models, with the points of the nonlinear drive."""
        from mckibben.door.figures.linear import bode_figure

        return bode_figure(self._result, self._title())

    def plot_design(self) -> Figure:
        """Steps of the controllers of a design on the nonlinear drive, and their commands.

        Raises:
            Problem: no design was asked for.
        """
        self._controller()
        from mckibben.door.figures.linear import design_figure

        return design_figure(self._result, f"Controllers of {self._name}")

    def _answer(self) -> object:
        return self._result

    def _summary(self) -> Summary:
        return summary_of(self._result, self._name)

    def _title(self) -> str:
        point = self._result.point
        return f"Linear view of {self._name} at {point.position * 1e3:.4g} mm, {point.pressure / 1e5:.3g} bar"
