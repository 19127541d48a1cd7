"""Which run of the model predicts which channel of a measurement, with exact derivatives where they exist.

| kind | given | predicted |
|---|---|---|
| isobaric, isometric, static | pressure, length | force |
| isotonic | pressure, load | length |
| diameter | length, or pressure of a free muscle | diameter |
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mckibben.identification.measurement import FORCE_KINDS, Measurement, lengths
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError
from mckibben.physics.model import ROOM_TEMPERATURE
from mckibben.physics.muscle import GEOMETRY, Muscle
from mckibben.simulation.compile import compiled_state
from mckibben.simulation.inverse import contraction_at
from mckibben.simulation.static import EffectValues, StaticModel, settle

GRAVITY = 9.80665  # m/s2
_STILL = 1e-4  # of the nominal length per sample interval: slower counts as no motion


@dataclass(frozen=True)
class Task:
    """The rows of a measurement that can be compared, and what the model needs for them.

    Attributes:
        kind: kind of the measurement.
        channel: name of the predicted channel.
        unit: its SI unit.
        measured: its values, shape (rows used,).
        state: inputs of the model, each of the same shape.
        groups: group label of each row.
        rows: index of each row in the measurement.
        excluded: why rows were left out -> how many.
        messages: what was assumed.
    """

    kind: str
    channel: str
    unit: str
    measured: np.ndarray
    state: Mapping[str, np.ndarray]
    groups: np.ndarray
    rows: np.ndarray
    excluded: Mapping[str, int]
    messages: tuple[str, ...]

    def without_group(self, label: int) -> Task:
        """The task without the rows of one group."""
        return self._rows(self.groups != label)

    def only_group(self, label: int) -> Task:
        """The rows of one group."""
        return self._rows(self.groups == label)

    def _rows(self, keep: np.ndarray) -> Task:
        return replace(
            self,
            measured=self.measured[keep],
            state={name: values[keep] for name, values in self.state.items()},
            groups=self.groups[keep],
            rows=self.rows[keep],
        )


def task_of(measurement: Measurement, muscle: Muscle) -> Task:
    """The comparison that a measurement allows.

    Rows without pulling force (slack) and rows longer than the braid allows are excluded, with a count.

    Raises:
        InputError: the kind cannot be compared yet, a condition is missing, or no row is left.
    """
    columns = measurement.columns
    kind = measurement.kind
    messages = list(measurement.messages)
    zeros = np.zeros(measurement.rows)
    if kind == "transient":
        raise InputError(
            f"{measurement.name} is a transient measurement; only static ones can be compared yet",
            field="measurement",
            hint="a '# kind: static' line says that the rows are quasi-static",
            code="not_supported",
        )
    state: dict[str, np.ndarray] = {
        "temperature": columns.get("temperature", np.full(measurement.rows, ROOM_TEMPERATURE)),
        "pressure": columns.get("pressure", zeros),
    }
    stroked = any(name in columns for name in ("length", "contraction", "displacement"))
    length = lengths(measurement, muscle.nominal_length) if stroked else None
    state["direction"], known = _directions(columns, length, muscle.nominal_length)
    if not known:
        messages.append("direction of motion unknown: friction cannot show in these rows")
    state["velocity"] = columns.get("velocity", zeros)
    keep = ~measurement.slack
    excluded = {"slack": int(np.count_nonzero(measurement.slack))}
    if kind in FORCE_KINDS:
        channel, unit, measured = "force", "N", columns["force"]
    elif kind == "isotonic":
        channel, unit = "length", "m"
        measured = _required(length, "length", measurement)
        state["load"] = _load(measurement)
    else:
        channel, unit, measured = "diameter", "m", columns["diameter"]
    if length is not None:
        too_long = length >= 0.9999 * float(muscle.braid.thread_length)
        excluded["beyond the braid lock"] = int(np.count_nonzero(too_long & keep))
        keep = keep & ~too_long
        if kind != "isotonic":
            state["length"] = length
    elif kind == "diameter":
        state["load"] = zeros
    if not np.any(keep):
        raise InputError(
            f"{measurement.name}: no row can be compared ({measurement.rows} rows, "
            + ", ".join(f"{count} {reason}" for reason, count in excluded.items() if count)
            + ")",
            field="measurement",
        )
    return Task(
        kind,
        channel,
        unit,
        np.asarray(measured, dtype=float)[keep],
        {name: np.asarray(values, dtype=float)[keep] for name, values in state.items()},
        columns["group"][keep],
        np.flatnonzero(keep),
        {reason: count for reason, count in excluded.items() if count},
        tuple(messages),
    )


def predict(task: Task, model: StaticModel, *, clipped: bool = True) -> np.ndarray:
    """The model's value of the predicted channel for each row; a slack muscle reads zero unless unclipped.

    A load that would stretch the muscle past its braid lock is predicted at the lock.
    """
    state = dict(task.state)
    load = state.pop("load", None)
    if load is not None:
        contraction = contraction_at(
            model,
            load=load,
            pressures=state["pressure"],
            direction=state["direction"],
            temperature=state["temperature"],
        )
        length = model.muscle.nominal_length * (1.0 - contraction)
        state["length"] = np.where(np.isnan(length), model.longest, length)
    if task.channel == "force":
        return model.force(**state, clipped=clipped)
    if task.channel == "length":
        return state["length"]
    return model.outputs(**state)["diameter"]


def force_gradient(
    task: Task, muscle: Muscle, effects: Sequence[Effect], values: EffectValues, names: tuple[str, ...]
) -> np.ndarray:
    """Exact derivatives of the unclipped force by the named parameters, shape (rows, names).

    Geometry is named by its field, a parameter by "effect.parameter". With a series compliance c the muscle
    settles where L(x) + c T(x) is the measured length, so by the implicit function theorem
    dF = F_theta - F_x (c T_theta + T c_theta)/(L_x + c T_x); an offset of the length sensor cancels.
    """
    compiled = compiled_state(tuple(effects), names)
    out, gradients = settle(compiled, compiled.pack(muscle, values), dict(task.state))
    force, tension, _, compliance = (gradients[index::4] for index in range(4))
    pulling = out["tension"] > 0.0
    c = np.where(pulling, out["compliance"], 0.0)
    slope = out["length_by_length"] + c * out["tension_by_length"]
    # settle() gives dF/dL as seen at the measured length; here the slope at the muscle itself is needed.
    by_length = out["force_by_length"] * slope / out["length_by_length"]
    stretch = c * tension + np.where(pulling, out["tension"], 0.0) * compliance
    return (force - by_length * stretch / slope).T


def with_values(
    muscle: Muscle, values: EffectValues, names: Sequence[str], numbers: Sequence[float] | np.ndarray
) -> tuple[Muscle, dict[str, dict[str, float]]]:
    """The muscle and effect values with some of them replaced, by the names of `force_gradient`."""
    changed = {effect: dict(own) for effect, own in values.items()}
    geometry: dict[str, Any] = {}
    for name, number in zip(names, numbers, strict=True):
        if name in GEOMETRY:
            geometry[name] = float(number)
        else:
            effect, parameter = name.split(".")
            changed[effect][parameter] = float(number)
    return muscle._replace(**geometry), changed


def _directions(
    columns: Mapping[str, np.ndarray], length: np.ndarray | None, nominal_length: float
) -> tuple[np.ndarray, bool]:
    # Sign of dL/dt: as given, else of the velocity, else from the order in time.
    rows = len(columns["group"])
    if "direction" in columns:
        return np.sign(columns["direction"]), bool(np.any(columns["direction"]))
    if "velocity" in columns:
        return np.sign(columns["velocity"]), True
    if "time" in columns and length is not None and rows > 2:
        change = np.gradient(length)
        return np.where(np.abs(change) > _STILL * nominal_length, np.sign(change), 0.0), True
    return np.zeros(rows), False


def _load(measurement: Measurement) -> np.ndarray:
    if "force" in measurement.columns:
        return measurement.columns["force"]
    conditions = measurement.conditions
    force, mass = conditions.get("load_force"), conditions.get("load_mass")
    if force is None and mass is None:
        raise InputError(
            f"{measurement.name}: the load of an isotonic measurement is not given",
            field="load_force",
            hint="add a line '# load_force: 60 N' or '# load_mass: 6 kg' before the header",
        )
    return np.full(measurement.rows, float(force or 0.0) + float(mass or 0.0) * GRAVITY)


def _required(values: np.ndarray | None, name: str, measurement: Measurement) -> np.ndarray:
    if values is None:
        raise InputError(f"{measurement.name}: no {name} was measured", field=name)
    return values
