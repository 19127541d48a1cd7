"""The equations of a drive in Python with numpy."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from mckibben.export.code import Code, indented, wrapped
from mckibben.export.language import PYTHON
from mckibben.export.subject import RunnableDrive
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
