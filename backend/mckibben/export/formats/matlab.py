"""MATLAB and Octave: one function file."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from mckibben.export.code import Code, indented, wrapped
from mckibben.export.language import MATLAB, names_for
from mckibben.export.registry import ExportedFile, Format
from mckibben.export.static_equations import PRESSURE_RATE
from mckibben.export.subject import RunnableDrive, Subject
from mckibben.physics.drive_terms import GUARD_STIFFNESS
from mckibben.physics.errors import InputError
from mckibben.physics.model import ROOM_TEMPERATURE
from mckibben.simulation.command.segments import Segments
from mckibben.simulation.integrate.problem import LOWEST_REBOUND, SLOWEST_REBOUND

_ARGUMENTS = "c, length, pressure, velocity, direction, temperature, s"
_USAGE = """\
m = NAME() returns a structure:
  r = m.evaluate(pressure, contraction) gives r.force [N], r.stiffness [N/m], r.force_by_pressure [N/Pa],
  r.force_by_contraction [N], r.volume [m^3], r.volume_by_pressure, r.volume_by_contraction, r.tension [N]
  (true, unclipped), r.diameter, r.outer_diameter, r.muscle_length [m], r.braid_angle [rad], r.slack.
  r = m.evaluate(pressure, contraction, motion) takes fields of motion that differ from a muscle at rest:
  velocity dL/dt [m/s], direction (-1 shortening, 0, 1 lengthening), temperature [K], states (columns in the
  order of m.states), length [m] instead of the contraction.
  m.force(pressure, contraction) and the like give one of them. m.constants are the numbers, m.rest the
  states at rest."""
_EVALUATE = """\
function given = motion_of(c, contraction, motion)
  given = struct('velocity', 0.0, 'direction', 0.0, 'temperature', ROOM, 'states', REST, ...
                 'length', c.nominal_length .* (1.0 - contraction));
  names = fieldnames(motion);
  for k = 1:numel(names)
    if ~isfield(given, names{k})
      error('motion has no field %s', names{k});
    end
    given.(names{k}) = motion.(names{k});
  end
end

function r = evaluate(c, pressure, contraction, motion)
  if nargin < 4
    motion = struct();
  end
  given = motion_of(c, contraction, motion);
  r = settled(c, given.length, pressure, given.velocity, given.direction, given.temperature, given.states);
  flat = zeros(size(r.tension + pressure + given.length));
  slack = ~(r.tension + flat > 0.0);
  force = pick(slack, r.slack_force + flat, r.force + flat);
  stiffness = pick(slack, flat, r.force_by_length + flat);
  by_pressure = pick(slack, flat, r.force_by_pressure + flat);
  r = struct('force', force, 'stiffness', stiffness, 'force_by_pressure', by_pressure, ...
             'force_by_contraction', -c.nominal_length .* stiffness, 'volume', r.volume + flat, ...
             'volume_by_pressure', r.volume_by_pressure + flat, ...
             'volume_by_contraction', -c.nominal_length .* (r.volume_by_length + flat), ...
             'tension', r.tension + flat, 'diameter', r.diameter + flat, ...
             'outer_diameter', r.outer_diameter + flat, 'braid_angle', r.braid_angle + flat, ...
             'muscle_length', r.true_length + flat, 'slack', slack);
end

function value = figure_of(c, name, pressure, contraction)
  r = evaluate(c, pressure, contraction);
  value = r.(name);
end
"""
_RIGID = """
function [r, length] = settled(c, length, pressure, velocity, direction, temperature, s)
  r = raw(c, length, pressure, velocity, direction, temperature, s);
end
"""
_NEWTON = """
function [r, length] = settled(c, length, pressure, velocity, direction, temperature, s)
  % Parts in series stretch: the length of the muscle alone by Newton's method.
  r = raw(c, length, pressure, velocity, direction, temperature, s);
  wanted = r.true_length;
  for k = 1:12
    yields = pick(r.tension > 0.0, r.compliance, 0.0);
    slope = r.true_length_by_length + yields .* r.tension_by_length;
    change = (r.true_length + yields .* r.tension - wanted) ./ slope;
    length = length - change;
    r = raw(c, length, pressure, velocity, direction, temperature, s);
    if max(abs(change(:))) < 1e-12
      break;
    end
  end
  yields = pick(r.tension > 0.0, r.compliance, 0.0);
  slope = r.true_length_by_length + yields .* r.tension_by_length;
  by_length = r.true_length_by_length ./ slope;
  by_pressure = -yields .* r.tension_by_pressure ./ slope;
  r.force_by_pressure = r.force_by_pressure + r.force_by_length .* by_pressure;
  r.volume_by_pressure = r.volume_by_pressure + r.volume_by_length .* by_pressure;
  r.force_by_length = r.force_by_length .* by_length;
  r.volume_by_length = r.volume_by_length .* by_length;
end
"""
#: Functions that stay real where those of the language become complex, and the choice between two values.
HELPERS = """
function y = pick(condition, a, b)
  flat = zeros(size(condition + a + b));
  y = b + flat;
  a = a + flat;
  chosen = logical(condition + flat);
  y(chosen) = a(chosen);
end

function y = real_sqrt(x)
  y = sqrt(max(x, 0.0));
  y(x < 0.0) = NaN;
end

function y = real_log(x)
  y = log(max(x, 0.0));
  y(x < 0.0) = NaN;
end

function y = real_asin(x)
  y = asin(min(max(x, -1.0), 1.0));
  y(abs(x) > 1.0) = NaN;
end

function y = real_acos(x)
  y = acos(min(max(x, -1.0), 1.0));
  y(abs(x) > 1.0) = NaN;
end

function y = real_power(x, n)
  flat = zeros(size(x + n));
  x = x + flat;
  n = n + flat;
  impossible = x < 0.0 & n ~= round(n);
  x(impossible) = NaN;
  y = x .^ n;
end
"""


def static_matlab(subject: Subject, stem: str, more: Sequence[str]) -> Iterator[str]:
    """The main function, with ``more`` lines that complete its structure, and those that it hands out."""
    equations = subject.equations
    constants = names_for(equations.constants, MATLAB)
    operands = {
        **{symbol: member for member, symbol in equations.inputs.items()},
        **{symbol: f"s(:, {place})" for place, symbol in enumerate(equations.states.values(), 1)},
        **{symbol: f"c.{constants[full]}" for full, symbol in equations.constants.items()},
    }
    yield f"function m = {stem}()"
    yield from MATLAB.remarks([*subject.about.lines(), "", *_USAGE.replace("NAME", stem).splitlines()])
    yield "  c = struct();"
    for full, own in constants.items():
        yield f"  c.{own} = {subject.value(full)!r};"
    yield "  m.constants = c;"
    yield f"  m.states = {{{', '.join(quoted(name) for name in equations.states)}}};"
    rest = ", ".join(repr(float(v.initial)) for v in equations.state_variables.values())
    sliding = ", ".join(repr(float(v.sliding)) for v in equations.state_variables.values())
    yield f"  m.rest = [{rest}];"
    yield "  % States in a long slow motion: these times the direction."
    yield f"  m.sliding = [{sliding}];"
    yield "  m.evaluate = @(varargin) evaluate(c, varargin{:});"
    for name in ("force", "stiffness", "volume"):
        yield f"  m.{name} = @(pressure, contraction) figure_of(c, '{name}', pressure, contraction);"
    if equations.states:
        yield "  % m.state_rates(pressure, contraction, motion, pressure_rate): d/dt of the states, columns."
        yield "  m.state_rates = @(varargin) state_rates(c, varargin{:});"
    yield from more
    yield "end"
    yield ""
    yield from _EVALUATE.replace("ROOM", repr(ROOM_TEMPERATURE)).replace("REST", f"[{rest}]").splitlines()
    yield from (_NEWTON if equations.compliant else _RIGID).splitlines()
    yield from ("", f"function r = raw({_ARGUMENTS})")
    results = [(f"r.{name}", each) for name, each in equations.results.items()]
    yield from indented(elementwise(Code(MATLAB, operands).lines(results)), 2)
    yield "end"
    if equations.states:
        yield from ("", f"function rates = state_rates(c, pressure, contraction, motion, {PRESSURE_RATE})")
        yield "  given = motion_of(c, contraction, motion);"
        yield "  velocity = given.velocity; direction = given.direction; temperature = given.temperature;"
        yield "  s = given.states;"
        yield "  [r, length] = settled(c, given.length, pressure, velocity, direction, temperature, s);"
        yield "  flat = zeros(size(r.tension + pressure + pressure_rate + length + velocity));"
        yield f"  rates = zeros(numel(flat), {len(equations.rates)});"
        rates = [(f"rates(:, {k})", each) for k, each in enumerate(equations.rates.values(), 1)]
        yield from indented(elementwise(Code(MATLAB, operands).lines(rates)), 2)
        yield "end"


def quoted(text: str) -> str:
    """A text in single quotes."""
    return "'" + text.replace("'", "''") + "'"


def elementwise(lines: Sequence[str]) -> list[str]:
    """Products and quotients of elements instead of matrices; names hold neither operator."""
    return [line.replace(" * ", " .* ").replace(" / ", " ./ ") for line in lines]


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
                for place, other in enumerate(equations.switches, 1):
                    if other.slides:
                        yield f"        w({place}) = double({other.slides!r} * y({speed}) > 0.0);"
                yield "      end"
            elif switch.slides:
                opposite = [other.slides for other in equations.switches].index(-switch.slides) + 1
                yield "      % At rest it sticks; where friction sets in it may move the other way."
                yield f"      if to == 0.0 && abs(y({speed})) > {SLOWEST_REBOUND!r}"
                yield f"        w({opposite}) = 1.0;"
                yield "      elseif to == 0.0"
                yield f"        y({speed}) = 0.0;"
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


_FUNCTION = re.compile(r"@(\w+)|\b([A-Za-z]\w*)\(")  # handles, calls and indices


def write(subject: Subject, stem: str) -> tuple[ExportedFile, ...]:
    """A function that returns the model as a structure of data and function handles.

    Raises:
        InputError: the name is one of a function that the file itself needs. Field "name".
    """
    drive = None if subject.runnable is None else DriveMatlab(subject.runnable)
    lines = [*static_matlab(subject, stem, [] if drive is None else list(drive.fields()))]
    if drive is not None:
        lines += drive.functions()
    lines += HELPERS.splitlines()
    if stem.lower() in _functions(lines[1:]):
        raise InputError(
            f"'{stem}' cannot be the name of the file: it uses a function or variable of that name itself",
            field="name",
            hint=f"e.g. {stem}_model",
        )
    text = "\n".join(lines)
    return (ExportedFile.of_text(f"{stem}.m", text, "text/x-matlab; charset=utf-8"),)


def _functions(lines: Iterable[str]) -> set[str]:
    """Names, in lower case, of what lines of code call or index."""
    code = (line for line in lines if not line.lstrip().startswith(MATLAB.comment))
    return {(handle or call).lower() for line in code for handle, call in _FUNCTION.findall(line)}


FORMAT = Format(
    title="MATLAB/Octave",
    note="one function file; of a drive its right-hand side, Jacobian and events too",
    write=write,
    identifier=True,
    reserved=MATLAB.reserved,
)
