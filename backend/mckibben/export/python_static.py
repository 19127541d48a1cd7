"""The static model in Python with numpy."""

from __future__ import annotations

from collections.abc import Iterator

from mckibben.export.code import Code, indented
from mckibben.export.language import PYTHON, names_for
from mckibben.export.static_equations import PRESSURE_RATE
from mckibben.export.subject import Subject

_ARGUMENTS = "length, pressure, velocity, direction, temperature, s"
_NEWTON = '''\
def _settled(length, pressure, velocity, direction, temperature, s):
    """The model where parts in series stretch: the length of the muscle alone by Newton's method."""
    r = _raw(length, pressure, velocity, direction, temperature, s)
    wanted = r["true_length"]
    for _ in range(12):
        yields = np.where(r["tension"] > 0.0, r["compliance"], 0.0)
        slope = r["true_length_by_length"] + yields * r["tension_by_length"]
        change = (r["true_length"] + yields * r["tension"] - wanted) / slope
        length = length - change
        r = _raw(length, pressure, velocity, direction, temperature, s)
        if np.max(np.abs(change)) < 1e-12:
            break
    yields = np.where(r["tension"] > 0.0, r["compliance"], 0.0)
    slope = r["true_length_by_length"] + yields * r["tension_by_length"]
    by_length = r["true_length_by_length"] / slope
    by_pressure = -yields * r["tension_by_pressure"] / slope
    for name in ("force", "volume"):
        r[f"{name}_by_pressure"] = r[f"{name}_by_pressure"] + r[f"{name}_by_length"] * by_pressure
        r[f"{name}_by_length"] = r[f"{name}_by_length"] * by_length
    return r, length
'''
_RIGID = """\
def _settled(length, pressure, velocity, direction, temperature, s):
    return _raw(length, pressure, velocity, direction, temperature, s), length
"""
_EVALUATE = '''\
def evaluate(
    pressure, contraction=0.0, velocity=0.0, direction=0.0, temperature=293.15, states=None, length=None
):
    """All results at a gauge pressure [Pa] and a contraction 1 - L/L0, or a length [m].

    velocity is dL/dt [m/s], direction its sign (-1 shortening, 0 at rest, 1 lengthening), temperature that of
    the elastomer [K], states those of `STATES` in their order. Arguments broadcast as numpy arrays do.

    Returns a dict: force [N], stiffness [N/m], force_by_pressure [N/Pa], force_by_contraction [N], volume
    [m^3], volume_by_pressure [m^3/Pa], volume_by_contraction [m^3], tension [N] (true, unclipped: a negative
    one would push), diameter, outer_diameter, muscle_length [m], braid_angle [rad], slack.
    """
    given = (pressure, contraction, velocity, direction, temperature)
    pressure, contraction, velocity, direction, temperature = (np.asarray(x, float) for x in given)
    at = REST * (1.0 - contraction) if length is None else np.asarray(length, float)
    s = list(STATES.values()) if states is None else [np.asarray(x, float) for x in states]
    with np.errstate(all="ignore"):
        r, _ = _settled(at, pressure, velocity, direction, temperature, s)
    slack = ~(r["tension"] > 0.0)
    by_length = np.where(slack, 0.0, r["force_by_length"])
    result = {
        "force": np.where(slack, r["slack_force"], r["force"]),
        "stiffness": by_length,
        "force_by_pressure": np.where(slack, 0.0, r["force_by_pressure"]),
        "force_by_contraction": -REST * by_length,
        "volume": r["volume"],
        "volume_by_pressure": r["volume_by_pressure"],
        "volume_by_contraction": -REST * r["volume_by_length"],
        "tension": r["tension"],
        "diameter": r["diameter"],
        "outer_diameter": r["outer_diameter"],
        "braid_angle": r["braid_angle"],
        "muscle_length": r["true_length"],
        "slack": slack,
    }
    return dict(zip(result, np.broadcast_arrays(*result.values())))


def force(pressure, contraction):
    """Force [N] at rest, of gauge pressure [Pa] and contraction."""
    return evaluate(pressure, contraction)["force"]


def stiffness(pressure, contraction):
    """Stiffness d force / d length [N/m] at rest."""
    return evaluate(pressure, contraction)["stiffness"]


def volume(pressure, contraction):
    """Volume of the gas [m^3] at rest."""
    return evaluate(pressure, contraction)["volume"]
'''
_RATES = '''\
def state_rates(length, pressure, velocity, direction, temperature, states, pressure_rate):
    """d/dt of the states; pressure_rate: of the gauge pressure [Pa/s]."""
    given = (length, pressure, velocity, direction, temperature, pressure_rate)
    length, pressure, velocity, direction, temperature, pressure_rate = (np.asarray(x, float) for x in given)
    s = [np.asarray(x, float) for x in states]
    with np.errstate(all="ignore"):
        _, length = _settled(length, pressure, velocity, direction, temperature, s)
        return _raw_rates(length, pressure, velocity, direction, temperature, s, pressure_rate)


def direction_of(velocity):
    """A smooth direction for simulations: a muscle that creeps instead of sticking."""
'''


def static_python(subject: Subject) -> Iterator[str]:
    """Constants and functions."""
    equations = subject.equations
    reserved = {"states", "rest", "start", "parameters", "inputs", "outputs", "switches"}
    constants = {full: own.upper() for full, own in names_for(equations.constants, PYTHON, reserved).items()}
    for full, own in constants.items():
        yield f"{own} = {subject.value(full)!r}"
    yield f"REST = {constants['nominal_length']}"
    yield "# States of effects with memory, and their values at rest."
    yield "STATES = {"
    for full, variable in equations.state_variables.items():
        text = f"{variable.unit}: {variable.description}"
        yield f'    "{full}": {float(variable.initial)!r},'
        yield from (f"    {line}" for line in PYTHON.remarks([text]))
    yield "}"
    sliding = {full: v.sliding for full, v in equations.state_variables.items() if v.sliding}
    if sliding:
        yield "# States of friction in a long slow motion: these times the direction."
        yield "SLIDING = {"
        yield from (f'    "{full}": {float(value)!r},' for full, value in sliding.items())
        yield "}"
    operands = {
        **{symbol: member for member, symbol in equations.inputs.items()},
        **{symbol: f"s[{place}]" for place, symbol in enumerate(equations.states.values())},
        **{symbol: constants[full] for full, symbol in equations.constants.items()},
    }
    yield from ("", "", f"def _raw({_ARGUMENTS}):")
    yield "    r = {}"
    results = [(f'r["{name}"]', each) for name, each in equations.results.items()]
    yield from indented(Code(PYTHON, operands).lines(results), 4)
    yield "    return r"
    yield from ("", "", *(_NEWTON if equations.compliant else _RIGID).splitlines())
    yield from ("", "", *_EVALUATE.splitlines())
    if equations.states:
        yield from ("", "", f"def _raw_rates({_ARGUMENTS}, {PRESSURE_RATE}):")
        yield f"    r = [0.0] * {len(equations.rates)}"
        rates = [(f"r[{place}]", each) for place, each in enumerate(equations.rates.values())]
        yield from indented(Code(PYTHON, operands).lines(rates), 4)
        yield "    return r"
        yield from ("", "", *_RATES.splitlines())
        velocity = {equations.inputs["velocity"]: "velocity"}
        yield from indented(Code(PYTHON, velocity).lines([("return", equations.direction)]), 4)
