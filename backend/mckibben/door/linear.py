"""The linear view of a drive: matrices, responses, loop, controller design."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from mckibben.application.linear.matlab import mat_file, matrices_of
from mckibben.application.linear.result import LinearResult, ModelResult
from mckibben.door.frames import frame_of
from mckibben.door.problem import reported
from mckibben.door.result import ResultOf
from mckibben.door.stepper import python_control
from mckibben.door.values import FloatArray
from mckibben.facts.result import read_only
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.report.summary import Summary
from mckibben.report.summary.linear import summary_of

if TYPE_CHECKING:
    import pandas as pd
    from plotly.graph_objects import Figure
    from scipy.signal import StateSpace


class LinearView(ResultOf[LinearResult], LinearResult):
    """Linear models of a drive at an operating point, from `Drive.linearise`; SI, angles in rad.

    One model where the equations are smooth, several where something sticks or switches. The methods take one
    of `models`, or its name; without it they take `primary`, the one that loop and design use.
    """

    @property
    def states(self) -> Sequence[str]:
        """Names of the states of the main model, in the order of its matrices."""
        return tuple(state.name for state in self.primary.states)

    @property
    def inputs(self) -> Sequence[str]:
        """Names of the inputs, in the order of the matrices."""
        return tuple(port.name for port in self.primary.inputs)

    @property
    def outputs(self) -> Sequence[str]:
        """Names of the outputs, in the order of the matrices."""
        return tuple(port.name for port in self.primary.outputs)

    @property
    def position(self) -> float:
        """Position of the load at the operating point [m]."""
        return self.point.position

    @property
    def pressure(self) -> float:
        """Gauge pressure in the (first) muscle at the operating point [Pa]."""
        return self.point.pressure

    @reported
    def matrices(
        self, model: str | ModelResult | None = None
    ) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """A, B, C and D of a model, for deviations from the operating point in SI.

        Raises:
            Problem: there is no model of this name, with the nearest match.
        """
        found = self._model(model)
        return found.a, found.b, found.c, found.d

    @reported
    def response(self, model: str | ModelResult | None = None) -> FloatArray:
        """Complex response of the chosen channel over `frequency`, with the dead time, shape (n,).

        Raises:
            Problem: there is no model of this name, with the nearest match.
        """
        found = self._model(model)
        return read_only(found.gain * np.exp(1j * found.phase))

    @reported
    def to_scipy(self, model: str | ModelResult | None = None) -> StateSpace:
        """A model as ``scipy.signal.StateSpace``, with all inputs and outputs; without the dead time.

        Raises:
            Problem: there is no model of this name, with the nearest match.
        """
        from scipy import signal

        found = self._model(model)
        return cast(Any, signal).StateSpace(found.a, found.b, found.c, found.d)

    @reported
    def to_control(self, model: str | ModelResult | None = None) -> Any:
        """A model as ``control.StateSpace`` of python-control, with all names; without the dead time.

        Raises:
            Problem: python-control is not installed, or there is no model of this name.
        """
        found = self._model(model)
        control = python_control()
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
        if self.design is None:
            raise InputError("no controller was designed", hint='linearise(design="overshoot 5 %")')
        return dict(self.design.trials[-1].controller.document)

    def _model(self, wanted: str | ModelResult | None) -> ModelResult:
        if wanted is None:
            return self.primary
        name = wanted.name if isinstance(wanted, ModelResult) else wanted
        known = {model.name: model for model in self.models}
        if name not in known:
            raise InputError(f"there is no model '{name}'", hint=did_you_mean(name, known))
        return known[name]

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
            Path(path).write_bytes(mat_file(matrices_of(self.primary)))
        except OSError as error:
            raise InputError(f"{fspath(path)}: cannot be written: {error.strerror or error}") from error

    def to_frame(self) -> pd.DataFrame:
        """One row for each frequency: frequency_Hz, and of each model gain and phase_rad."""
        columns: dict[str, Any] = {"frequency_Hz": self.frequency}
        for model in self.models:
            suffix = "" if len(self.models) == 1 else f" {model.name}"
            columns[f"gain{suffix}"] = model.gain
            columns[f"phase_rad{suffix}"] = model.phase
        return frame_of(columns)

    def plot(self) -> Figure:
        """Bode diagram of all models, with the points of the nonlinear drive."""
        from mckibben.door.figures import bode_figure

        return bode_figure(self, self._title())

    def plot_design(self) -> Figure:
        """Steps of the controllers of a design on the nonlinear drive, and their commands.

        Raises:
            Problem: no design was asked for.
        """
        self._controller()
        from mckibben.door.figures import design_figure

        return design_figure(self, f"Controllers of {self._name}")

    def _summary(self) -> Summary:
        return summary_of(self, self._name)

    def _title(self) -> str:
        point = self.point
        return f"Linear view of {self._name} at {point.position * 1e3:.4g} mm, {point.pressure / 1e5:.3g} bar"
