r"""The length at which a muscle with memory carries a load while the pressure changes.

The states z of friction, creep and lags follow the muscle's own way, not a measured one:

.. math:: F(L_k, P_k, \dot L_k, z_k) = W_k, \qquad
   z_k = z_{k-1} + \int \dot z(L, P, \dot L, z)\,dt, \qquad \dot L_k = \frac{L_k - L_{k-1}}{t_k - t_{k-1}}

with length and pressure linear from row to row. Friction that opposes any motion holds the length until the
load exceeds it. There is no inertia: the motion is slow.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
import symengine as se

from mckibben.physics import ops
from mckibben.physics.custom import blamed_on_the_term
from mckibben.physics.effect import Effect
from mckibben.physics.model import Model
from mckibben.physics.muscle import GEOMETRY
from mckibben.simulation.integrate.compiling import one_at_a_time
from mckibben.simulation.integrate.lane_buffers import lane_kernels
from mckibben.simulation.integrate.machine_code import Function, machine_code
from mckibben.simulation.statics.model import StaticModel
from mckibben.simulation.statics.symbolic import symbolic_state, values_of

_CREEP = 1e-9  # m/s; speed of a guide that is about to move
_SHORTEST = 0.35  # shortest length of the search, share of the nominal length
_LONGEST = 0.9999  # longest length over the thread length, at which the braid locks
_LARGEST_STEP = 0.02  # of the search, share of the nominal length
_STIFFNESS = 2e4  # N/m; a first guess


class IsotonicCode(NamedTuple):
    """A structure as machine code.

    Attributes:
        states: "effect.state" in their order.
        constants: names of geometry and parameters in their order.
        balance: -> force over the load, and the length shown by it.
        rates: -> rates of the states, and the diagonal of their Jacobian.
    """

    states: tuple[str, ...]
    constants: tuple[str, ...]
    balance: Function
    rates: Function


@one_at_a_time
@lru_cache(maxsize=256)
def isotonic_code(effects: tuple[Effect, ...]) -> IsotonicCode:
    """The compiled structure of some effects, built once and kept.

    Raises:
        InputError: a typed term among the effects cannot be compiled.
    """
    with blamed_on_the_term(effects):
        symbolic = symbolic_state(effects, memory=True)
        inputs, fields = symbolic.inputs, symbolic.fields
        pressure_rate, load = se.Symbol("pressure_rate"), se.Symbol("load")
        given = [*inputs.values(), pressure_rate, load, *symbolic.states.values()]
        arguments = [*given, *symbolic.constants.values()]
        stretch = fields.compliance * ops.positive_part(fields.tension)
        shown = inputs["length"] + stretch / symbolic.by("length", "length")
        rates = symbolic.rates(pressure_rate) if symbolic.states else {}
        steps = [rates[name] for name in symbolic.states]
        by_themselves = [se.sympify(rates[name]).diff(state) for name, state in symbolic.states.items()]
        codes = machine_code(
            {
                "balance": (arguments, [fields.force - load - _guide(symbolic, load), shown]),
                "rates": (arguments, [*steps, *by_themselves]),
            },
            level=1,
        )
    return IsotonicCode(tuple(symbolic.states), tuple(symbolic.constants), codes["balance"], codes["rates"])


def _guide(symbolic: Any, load: Any) -> Any:
    """Friction of a guide [N], whose states have their values while it slides."""
    guides = [effect for effect in symbolic.model.effects if "guide" in effect.slots]
    inputs = symbolic.inputs
    context = {
        "stroke": symbolic.geometry["nominal_length"] - inputs["length"],
        "speed": -(inputs["velocity"] + _CREEP * inputs["direction"]),
        "direction": -inputs["direction"],
        "load": ops.absolute(load),
    }
    values = values_of(symbolic.model, symbolic.parameters)
    for effect in guides:
        values[effect.id] |= sliding(effect, values[effect.id], context)
    return Model(guides).sum("guide", values, context)


def sliding(effect: Effect, values: Mapping[str, Any], context: Mapping[str, Any]) -> dict[str, Any]:
    """Steady-state values of a guide's states while it slides; their rates are linear in the states."""
    if not effect.states:
        return {}
    empty, full = (
        effect.call("drive_rates", context, {**values, **dict.fromkeys((s.name for s in effect.states), z)})
        for z in (0.0, 1.0)
    )
    return {s.name: low / (low - high) for s, low, high in zip(effect.states, empty, full, strict=True)}


def isotonic_lengths(
    models: Sequence[StaticModel],
    *,
    time: np.ndarray,
    pressure: np.ndarray,
    load: np.ndarray,
    temperature: np.ndarray,
    records: np.ndarray,
    first: np.ndarray,
    begins: Sequence[Mapping[int, Mapping[str, float]]],
) -> np.ndarray:
    """Length of each row [m] as a tape beside the muscle shows it, shape (models, rows); NaN once it is lost.

    Args:
        models: with the same effects; all but the first must differ little from it, as for a difference.
        time: ascending within a record [s], shape (rows,).
        pressure, temperature: gauge [Pa] and [K], same shape.
        load: of each model and row [N], shape (models, rows).
        records: label of the record of each row; one begins where the label changes.
        first: length of each model at the first row of a record [m], where friction holds it, shape
            (models, rows); other rows are ignored.
        begins: of each model row -> states that begin anew there, by "effect.state".
    """
    code = isotonic_code(models[0].effects)
    rows, count = len(time), len(code.states)
    new = np.concatenate([[True], np.diff(records) != 0])
    steps = np.where(new, 0.0, np.diff(time, prepend=time[0]))
    constants = np.array([_constants(model, code.constants) for model in models])
    table = np.empty((len(models), rows, 3))
    table[:, :, 0], table[:, :, 1], table[:, :, 2] = pressure, load, temperature
    anew = sorted({*np.flatnonzero(new).tolist(), *(row for of_model in begins for row in of_model)})
    places = np.full(rows, -1, np.int64)
    places[anew] = np.arange(len(anew))
    rest = {f"{e.id}.{state.name}": state.initial or 0.0 for e in models[0].effects for state in e.states}
    starts = np.full((len(models), len(anew), count), np.nan)
    for model, of_model in enumerate(begins):
        if model and of_model is begins[0]:
            starts[model] = starts[0]
            continue
        for place, row in enumerate(anew):
            stated = {**(rest if new[row] else {}), **of_model.get(row, {})}
            starts[model, place] = [stated.get(name, np.nan) for name in code.states]
    muscle = models[0].muscle
    limits = np.array([
        _SHORTEST * muscle.nominal_length, _LONGEST * float(muscle.braid.thread_length),
        _LARGEST_STEP * muscle.nominal_length, _STIFFNESS, float(_rubs(models[0].effects)),
        float(Model(models[0].effects).has("compliance")),
    ])  # fmt: skip
    farthest = {
        f"{e.id}.{state.name}": abs(state.sliding) or np.inf for e in models[0].effects for state in e.states
    }
    bounds = np.array([farthest[name] for name in code.states])
    lengths = np.empty((len(models), rows))
    carry = lane_kernels.awaited().carry
    room = np.empty(max(2, 2 * count))
    carry(
        code.balance.address, code.rates.address, constants, table, np.zeros((len(models), count)), steps,
        np.ascontiguousarray(first), limits, places, starts, bounds, lengths, room,
    )  # fmt: skip
    return lengths


def _rubs(effects: Sequence[Effect]) -> bool:
    """Whether something opposes any motion, however slow."""
    return any("guide" in e.slots or "direction" in e.wanted(slot) for e in effects for slot in e.slots)


def _constants(model: StaticModel, names: tuple[str, ...]) -> list[float]:
    values = model.values
    numbers = [float(getattr(model.muscle, name)) for name in GEOMETRY]
    return numbers + [values[effect][parameter] for effect, parameter in _places(names)]


@lru_cache(maxsize=256)
def _places(names: tuple[str, ...]) -> tuple[tuple[str, str], ...]:
    """Effect and parameter of each name after the geometry."""
    return tuple((name.partition(".")[0], name.partition(".")[2]) for name in names[len(GEOMETRY) :])
