"""Python: one file that needs numpy alone."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from mckibben.export.code import Code, indented, wrapped
from mckibben.export.language import PYTHON, names_for
from mckibben.export.registry import ExportedFile, Format
from mckibben.export.static_equations import PRESSURE_RATE
from mckibben.export.subject import RunnableDrive, Subject
from mckibben.physics.drive_terms import GUARD_STIFFNESS
from mckibben.simulation.command.segments import Segments
from mckibben.simulation.integrate.problem import LOWEST_REBOUND, SLOWEST_REBOUND

_HEAD = """\
# The drive: dy/dt = rates(y, k, u, w), with states y, constants k = prepare(p), inputs u, switches w.
# Pressures of states and inputs are absolute, strokes positive towards shorter. A switch is 0 or 1 during a
# step. Where its guard falls below -LEAST, end the step there and call change(): a stop catches the load or
# lets it go, a muscle goes slack or taut."""
_SIGNAL = """\
def _signal(rows, time):
    row = np.searchsorted(rows[:, 0], time, side="right") - 1
    begin, value, slope = rows[max(row, 0)]
    return value + slope * (time - begin)
"""
_ODE = '''\
def ode(time, y, w=None):
    """Right-hand side with the inputs and parameters of the document, for an ODE solver."""
    return rates(y, CONSTANTS, inputs(time), START_SWITCHES if w is None else w)
'''


class DrivePython:
    """The Python of a drive."""

    def __init__(self, runnable: RunnableDrive) -> None:
        self._drive, self._equations = runnable, runnable.equations
        equations = self._equations
        self._operands = {
            **{symbol: f"y[{place}]" for place, symbol in enumerate(equations.state_symbols.values())},
            **{symbol: f"k[{place}]" for place, symbol in enumerate(equations.constants)},
            **{symbol: f"u[{place}]" for place, symbol in enumerate(equations.inputs.values())},
            **{symbol: f"w[{place}]" for place, symbol in enumerate(equations.switch_symbols)},
        }

    def lines(self) -> Iterator[str]:
        """Data and functions."""
        equations, drive = self._equations, self._drive
        yield from _HEAD.splitlines()
        for name, kind in (
            ("DRIVE_STATES", "state"), ("INPUTS", "input"), ("OUTPUTS", "output"), ("SWITCHES", "switch")
        ):  # fmt: skip
            yield f"{name} = ["
            for each, words in drive.words(kind).items():
                yield from indented(list(PYTHON.remarks([words.shown])), 4)
                yield f'    "{each}",'
            yield "]"
        yield "PARAMETERS = {"
        for each, words in drive.words("parameter").items():
            yield from indented(list(PYTHON.remarks([words.shown])), 4)
            yield f'    "{each}": {drive.parameters[each]!r},'
        yield "}"
        yield from wrapped(f"START = np.array([{_numbers(drive.start)}])", "")
        yield f"START_SWITCHES = np.array([{_numbers(drive.switches)}])"
        yield f"LEAST = {equations.switches[0].least!r}"
        yield "# Rows of time, value, slope; the command is that after all dead times."
        for name in equations.inputs:
            if (signal := drive.written(name)) is not None:
                yield from _rows(f"{name.upper()}_ROWS", signal)
        symbols = {symbol: f"p[{place}]" for place, symbol in enumerate(equations.parameters.values())}
        yield from self._function(
            "prepare(p)", "Constants of a run from the values of `PARAMETERS`.", equations.prepare, symbols
        )
        for name, text, expressions in (
            ("rates", "d/dt of the states.", equations.rates),
            ("outputs", "The outputs, in the order of `OUTPUTS`.", equations.outputs),
            ("guards", "Guards of the switches, in the order of `SWITCHES`.", equations.guards),
        ):
            yield from self._function(f"{name}(y, k, u, w)", text, expressions, self._operands)
        for name, text, entries, width in (
            ("jacobian", "d rates / d states.", equations.jacobian, len(equations.states)),
            ("input_jacobian", "d rates / d inputs.", equations.input_jacobian, len(equations.inputs)),
        ):
            yield from ("", "", f"def {name}(y, k, u, w):", f'    """{text}"""')
            yield f"    r = np.zeros(({len(equations.states)}, {width}))"
            placed = [(f"r[{row}, {column}]", each) for row, column, each in entries]
            yield from self._body(placed, self._operands)
        yield from self._change()
        yield from ("", "", *_SIGNAL.splitlines(), "", "", "def inputs(time):")
        yield '    """Inputs of the document at a time [s]: command after all dead times, force, supply."""'
        yield "    return np.array("
        yield "        ["
        for name in equations.inputs:
            yield f"            {self._input(name)},"
        yield "        ]"
        yield "    )"
        yield from ("", "", "CONSTANTS = prepare(list(PARAMETERS.values()))", "", "", *_ODE.splitlines())

    def _input(self, name: str) -> str:
        if self._drive.written(name) is not None:
            return f"_signal({name.upper()}_ROWS, time)"
        if name == "supply_pressure":
            return repr(self._drive.supply)
        return "0.0"  # not in this file

    def _function(
        self, head: str, text: str, expressions: Sequence[Any], operands: dict[Any, str]
    ) -> Iterator[str]:
        yield from ("", "", f"def {head}:", f'    """{text}"""')
        yield f"    r = np.zeros({len(expressions)})"
        yield from self._body([(f"r[{place}]", each) for place, each in enumerate(expressions)], operands)

    def _body(self, results: list[tuple[str, Any]], operands: dict[Any, str]) -> Iterator[str]:
        yield '    with np.errstate(all="ignore"):'
        yield from indented(Code(PYTHON, operands).lines(results) or ["pass"], 8)
        yield "    return r"

    def _change(self) -> Iterator[str]:
        """The rules of `mckibben.simulation.integrate.switching.change_switch`."""
        equations = self._equations
        states = list(equations.state_symbols)
        stroke, speed = states.index("stroke"), states.index("speed")
        bounce = float(self._drive.drive.restitution)
        yield from ("", "", "def change(number, p, k, u, y, w):")
        yield '    """Changes a switch; returns the new states and switches. p: values of `PARAMETERS`."""'
        yield "    y, w = np.array(y, float), np.array(w, float)"
        yield "    to = 1.0 - w[number]"
        for number, switch in enumerate(equations.switches):
            if switch.stop is not None:
                place = list(equations.parameters).index(switch.stop)
                yield f"    if number == {number} and to == 1.0:  # {switch.name}"
                yield f"        hit, pressing = y[{speed}], rates(y, k, u, w)[{speed}]"
                yield f"        y[{stroke}], y[{speed}] = p[{place}], 0.0"
                yield f"        left, pressing = {bounce!r} * abs(hit), pressing if hit > 0.0 else -pressing"
                yield f"        high = left * left > {2.0 * LOWEST_REBOUND!r} * pressing"
                yield f"        if left > {SLOWEST_REBOUND!r} and high:"
                yield f"            y[{speed}], to = -{bounce!r} * hit, 0.0"
                for place, other in enumerate(equations.switches):
                    if other.slides:
                        yield f"        w[{place}] = float({other.slides!r} * y[{speed}] > 0.0)"
            elif switch.slides:
                opposite = [other.slides for other in equations.switches].index(-switch.slides)
                yield f"    if number == {number} and to == 0.0:  # {switch.name}: at rest it sticks"
                yield f"        if abs(y[{speed}]) > {SLOWEST_REBOUND!r}:  # friction sets in as it moves"
                yield f"            w[{opposite}] = 1.0"
                yield "        else:"
                yield f"            y[{speed}] = 0.0"
            else:
                follows = states.index(switch.follows or "length")
                yield f"    if number == {number}:  # {switch.name}: the length follows the fittings again"
                yield f"        w[{number}] = 1.0"
                yield f"        y[{follows}] -= guards(y, k, u, w)[{number}] / {GUARD_STIFFNESS!r}"
        yield "    w[number] = to"
        yield "    return y, w"


def _numbers(values: Iterable[float]) -> str:
    return ", ".join(repr(float(value)) for value in values)


def _rows(name: str, signal: Segments) -> Iterator[str]:
    yield f"{name} = np.array("
    yield "    ["
    for row in np.column_stack([signal.times[:-1], signal.start_values, signal.slopes]).tolist():
        yield f"        [{', '.join(map(repr, row))}],"
    yield "    ]"
    yield ")"


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
    """The sign of a velocity: at rest 0, the mean of both directions."""
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


def write(subject: Subject, stem: str) -> tuple[ExportedFile, ...]:
    """One module."""
    lines = [
        *PYTHON.remarks(subject.about.lines()),
        "",
        '"""A pneumatic muscle, or a drive with one: functions of numbers and numpy arrays."""',
        "",
        "import numpy as np",
        "",
        *static_python(subject),
    ]
    if subject.runnable is not None:
        lines += ["", "", *DrivePython(subject.runnable).lines()]
    return (ExportedFile.of_text(f"{stem}.py", "\n".join(lines), "text/x-python; charset=utf-8"),)


FORMAT = Format(
    title="Python",
    note="one file, numpy only; of a drive its equations too",
    write=write,
    identifier=True,  # `import` knows no other names
    # A file of such a name would be imported in place of the module, by numpy too.
    reserved=PYTHON.reserved | {name.lower() for name in sys.stdlib_module_names},
)
