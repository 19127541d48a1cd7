"""Models that the tests of the formats write: every effect of the muscle alone, and some together."""

from __future__ import annotations

from functools import cache

import numpy as np

from mckibben.documents.start_model import StatedMuscle
from mckibben.documents.studio import Studio
from mckibben.export.static_equations import STATIC_SLOTS
from mckibben.export.subject import Stated, Subject, subject_of
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.muscle import Muscle
from mckibben.simulation.statics.compiled import OUTPUTS, compiled_state
from mckibben.simulation.statics.model import settle
from tests.shipped import shipped_studio

COMBINATIONS = (
    ("bladder_elasticity", "prestress", "end_caps", "wall_thickness", "coulomb_friction", "viscous_damping"),
    ("thread_extensibility", "rig_compliance", "length_offset", "force_scale", "pressure_offset", "dahl"),
    ("bladder_elasticity", "temperature", "creep", "maxwell_slip", "threshold_pressure", "effectiveness"),
)
TERM = {
    "custom": {"term": "-c*sign(v)*P^1.5 + d*exp(-kappa)*tanh(5*v) + abs(v)*f", "c": 1e-6, "d": 3.0, "f": 7.0}
}


@cache
def studio() -> Studio:
    """The built-in presets and effects."""
    return shipped_studio()


def cases() -> dict[str, dict[str, dict[str, float | str]]]:
    """Name -> effects: each effect that acts in the muscle alone, with parameters that are not those of
    nothing, then the combinations and a typed term.
    """
    found: dict[str, dict[str, dict[str, float | str]]] = {}
    for effect in default_catalogue().values():
        if STATIC_SLOTS & set(effect.slots):
            found[effect.id] = {effect.id: {}}
    for number, names in enumerate(COMBINATIONS):
        found[f"together_{number}"] = {name: {} for name in names}
    found["typed"] = dict(TERM)
    found["typed_over_time"] = {"custom": {"term": "c*P*t - d*(1 - exp(-t))", "c": 1e-6, "d": 4.0}}
    return found


@cache
def subject(name: str) -> Subject:
    """The muscle of a case, ready to be written."""
    start = studio().start_model(StatedMuscle(preset="DMSP-20"), cases()[name])
    return subject_of(Stated(start, title=name), studio())


def random_inputs(model: Subject, rows: int, seed: int) -> dict[str, np.ndarray]:
    """States of the muscle: its inputs, and the states of its effects by "effect.state"."""
    random, muscle = np.random.default_rng(seed), model.statics.muscle
    longest = min(model.statics.longest, 1.03 * muscle.nominal_length)
    inputs = {
        "length": random.uniform(0.72 * muscle.nominal_length, longest, rows),
        "pressure": random.uniform(0.0, 6e5, rows),
        "velocity": random.uniform(-0.5, 0.5, rows),
        "direction": random.choice([-1.0, 0.0, 1.0], rows),
        "temperature": random.uniform(270.0, 330.0, rows),
    }
    for name, variable in model.equations.state_variables.items():
        spread = random.uniform(-1.0, 1.0, rows)
        inputs[name] = variable.initial + variable.scale * spread
    return inputs


def ours(model: Subject, inputs: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """What the engine's machine code gives: results by the names of the C structure."""
    compiled = compiled_state(model.statics.effects, memory=True)
    constants = compiled.pack(model.statics.muscle, model.statics.values)
    known = {name: inputs.get(name, np.zeros(len(inputs["length"]))) for name in compiled.inputs}
    with np.errstate(all="ignore"):
        out = settle(compiled, constants, known)[0]
    assert set(OUTPUTS) <= set(out)
    pulls, rest = out["tension"] > 0.0, model.statics.muscle.nominal_length
    return {
        "force": np.where(pulls, out["force"], out["slack_force"]),
        "stiffness": np.where(pulls, out["force_by_length"], 0.0),
        "force_by_pressure": np.where(pulls, out["force_by_pressure"], 0.0),
        "force_by_contraction": np.where(pulls, -rest * out["force_by_length"], 0.0),
        "volume": out["volume"],
        "volume_by_pressure": out["volume_by_pressure"],
        "volume_by_contraction": -rest * out["volume_by_length"],
        "tension": out["tension"],
        "diameter": out["diameter"],
        "outer_diameter": out["outer_diameter"],
        "braid_angle": out["braid_angle"],
        "muscle_length": out["length"],
        "slack": np.where(pulls, 0.0, 1.0),
    }


def our_rates(model: Subject, inputs: dict[str, np.ndarray], pressure_rate: np.ndarray) -> np.ndarray:
    """Rates of the states by the physics on numbers, shape (states, rows); of models without compliance."""
    from mckibben.physics.model import Model

    values = {effect: dict(own) for effect, own in model.statics.values.items()}
    for name in model.equations.states:
        effect, _, state = name.partition(".")
        values[effect][state] = inputs[name]
    acting = [effect for effect in model.statics.effects if STATIC_SLOTS & set(effect.slots)]
    muscle: Muscle = model.statics.muscle
    named = ("length", "pressure", "velocity", "direction", "temperature")
    with np.errstate(all="ignore"):
        rates = Model(acting).rates(
            muscle=muscle,
            values=values,
            pressure_rate=pressure_rate,
            **{name: inputs[name] for name in named},
        )
    rows = len(inputs["length"])
    return np.array([np.broadcast_to(rates[name], rows) for name in model.equations.states])


def assert_equal(theirs: np.ndarray, expected: np.ndarray, what: str) -> None:
    """Equal to 1e-9 relative; a value that cancels, to 1e-12 of the largest."""
    floor = 1e-12 * float(np.max(np.abs(expected))) if expected.size else 0.0
    np.testing.assert_allclose(theirs, expected, rtol=1e-9, atol=floor, err_msg=what)
