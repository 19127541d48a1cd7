"""The static model in MATLAB's language, elementwise on arrays."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mckibben.export.code import Code, indented
from mckibben.export.language import MATLAB, names_for
from mckibben.export.static_equations import PRESSURE_RATE
from mckibben.export.subject import Subject
from mckibben.physics.model import ROOM_TEMPERATURE

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
