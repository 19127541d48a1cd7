"""The equations of a drive in MATLAB's language."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

from mckibben.export.code import Code, indented, wrapped
from mckibben.export.language import MATLAB
from mckibben.export.matlab_static import quoted
from mckibben.export.subject import RunnableDrive
from mckibben.physics.drive_terms import GUARD_STIFFNESS
from mckibben.simulation.command.segments import Segments
from mckibben.simulation.integrate.problem import LOWEST_REBOUND, SLOWEST_REBOUND

_HEAD = """\
  % The drive: dy/dt = m.rates(y, k, u, w), with states y, constants k = m.prepare(p), inputs u, switches w.
  % Pressures of states and inputs are absolute, strokes positive towards shorter. A switch is 0 or 1 during a
  % step. Where its guard falls below -m.least, end the step there and call [y, w] = m.change(number, p, k, u,
  % y, w): a stop catches the load or lets it go, a muscle goes slack or taut. With ode15s:
  %   k = m.prepare(m.parameters); w = m.start_switches;
  %   ode15s(@(t, y) m.rates(y, k, m.inputs(t), w), [0 1], m.start, ...
  %          odeset('Events', @(t, y) deal(m.guards(y, k, m.inputs(t), w) + m.least, 1, -1)))"""
_SIGNAL = """
function value = signal_at(rows, time)
  row = find(rows(:, 1) <= time, 1, 'last');
  if isempty(row)
    row = 1;
  end
  value = rows(row, 2) + rows(row, 3) * (time - rows(row, 1));
end
"""


class DriveMatlab:
    """The MATLAB of a drive."""

    def __init__(self, runnable: RunnableDrive) -> None:
        self._drive, self._equations = runnable, runnable.equations
        equations = self._equations
        self._operands = {
            **{symbol: f"y({place})" for place, symbol in enumerate(equations.state_symbols.values(), 1)},
            **{symbol: f"k({place})" for place, symbol in enumerate(equations.constants, 1)},
            **{symbol: f"u({place})" for place, symbol in enumerate(equations.inputs.values(), 1)},
            **{symbol: f"w({place})" for place, symbol in enumerate(equations.switch_symbols, 1)},
        }

    def fields(self) -> Iterator[str]:
        """Lines that complete the structure of the main function."""
        equations, drive = self._equations, self._drive
        yield from _HEAD.splitlines()
        for field, kind in (
            ("drive_states", "state"),
            ("parameter_names", "parameter"),
            ("input_names", "input"),
            ("output_names", "output"),
            ("switch_names", "switch"),
        ):
            yield f"  m.{field} = {{ ..."
            for name, words in drive.words(kind).items():
                yield MATLAB.inline(f"    {quoted(name)}, ...", words.shown)
            yield "  };"
        yield from _vector("m.parameters", drive.parameters.values())
        yield from _vector("m.start", drive.start)
        yield from _vector("m.start_switches", drive.switches)
        yield f"  m.least = {equations.switches[0].least!r};"
        for name in (
            "prepare",
            "rates",
            "outputs",
            "guards",
            "jacobian",
            "input_jacobian",
            "change",
            "inputs",
        ):
            yield f"  m.{name} = @{'inputs_at' if name == 'inputs' else name};"

    def functions(self) -> Iterator[str]:
        """The functions of the drive."""
        equations = self._equations
        places = {symbol: f"p({place})" for place, symbol in enumerate(equations.parameters.values(), 1)}
        yield from self._function(
            "prepare(p)", len(equations.prepare), 1, _numbered(equations.prepare), places
        )
        for name, expressions in (
            ("rates", equations.rates), ("outputs", equations.outputs), ("guards", equations.guards)
        ):  # fmt: skip
            yield from self._function(f"{name}(y, k, u, w)", len(expressions), 1, _numbered(expressions))
        for name, entries, width in (
            ("jacobian", equations.jacobian, len(equations.states)),
            ("input_jacobian", equations.input_jacobian, len(equations.inputs)),
        ):
            placed = [(f"r({row + 1}, {column + 1})", each) for row, column, each in entries]
            yield from self._function(f"{name}(y, k, u, w)", len(equations.states), width, placed)
        yield from self._change()
        yield from _SIGNAL.splitlines()
        yield from ("", "function u = inputs_at(time)")
        yield f"  u = zeros({len(equations.inputs)}, 1);"
        for place, name in enumerate(equations.inputs, 1):
            signal = self._drive.written(name)
            if signal is not None:
                yield from _rows(f"{name}_rows", signal)
                yield f"  u({place}) = signal_at({name}_rows, time);"
            elif name == "supply_pressure":
                yield f"  u({place}) = {self._drive.supply!r};"
        yield "end"

    def _function(
        self,
        head: str,
        rows: int,
        columns: int,
        results: list[tuple[str, Any]],
        operands: dict[Any, str] | None = None,
    ) -> Iterator[str]:
        yield from ("", f"function r = {head}")
        yield f"  r = zeros({rows}, {columns});"
        yield from indented(Code(MATLAB, operands or self._operands).lines(results), 2)
        yield "end"

    def _change(self) -> Iterator[str]:
        """The rules of `mckibben.simulation.integrate.switching.change_switch`."""
        equations = self._equations
        states = list(equations.state_symbols)
        stroke, speed = states.index("stroke") + 1, states.index("speed") + 1
        bounce = float(self._drive.drive.restitution)
        yield from ("", "function [y, w] = change(number, p, k, u, y, w)")
        yield "  to = 1.0 - w(number);"
        yield "  switch number"
        for number, switch in enumerate(equations.switches, 1):
            yield f"    case {number} % {switch.name}"
            if switch.stop is not None:
                place = list(equations.parameters).index(switch.stop) + 1
                yield "      if to == 1.0"
                yield f"        hit = y({speed});"
                yield "        before = rates(y, k, u, w);"
                yield f"        y({stroke}) = p({place});"
                yield f"        y({speed}) = 0.0;"
                yield f"        left = {bounce!r} * abs(hit);"
                yield f"        pressing = pick(hit > 0.0, before({speed}), -before({speed}));"
                yield f"        high = left ^ 2 > {2.0 * LOWEST_REBOUND!r} * pressing;"
                yield f"        if left > {SLOWEST_REBOUND!r} && high"
                yield f"          y({speed}) = -{bounce!r} * hit;"
                yield "          to = 0.0;"
                yield "        end"
                yield "      end"
            else:
                follows = states.index(switch.follows or "length") + 1
                yield f"      w({number}) = 1.0;"
                yield "      now = guards(y, k, u, w);"
                yield f"      y({follows}) = y({follows}) - now({number}) / {GUARD_STIFFNESS!r};"
        yield "  end"
        yield "  w(number) = to;"
        yield "end"


def _numbered(expressions: list[Any]) -> list[tuple[str, Any]]:
    return [(f"r({place})", each) for place, each in enumerate(expressions, 1)]


def _vector(name: str, values: Iterable[float]) -> Iterator[str]:
    yield from wrapped(f"  {name} = [{'; '.join(repr(float(value)) for value in values)}];", " ...")


def _rows(name: str, signal: Segments) -> Iterator[str]:
    rows = np.column_stack([signal.times[:-1], signal.start_values, signal.slopes]).tolist()
    yield f"  {name} = [ ..."
    for row in rows:
        yield f"    {', '.join(map(repr, row))};"
    yield "  ];"
