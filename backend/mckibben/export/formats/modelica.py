"""Modelica: the equations as text. There is no Modelica compiler here, and the file says so."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from mckibben.export.code import Code, indented
from mckibben.export.language import MODELICA, names_for, plain, words_of
from mckibben.export.registry import ExportedFile, Format
from mckibben.export.static_equations import PRESSURE_RATE
from mckibben.export.subject import RunnableDrive, Subject
from mckibben.physics.drive_terms import GUARD_STIFFNESS
from mckibben.physics.errors import InputError
from mckibben.physics.model import ROOM_TEMPERATURE
from mckibben.simulation.integrate.problem import SLOWEST_REBOUND

_LABEL = "NOT COMPILED: no Modelica compiler has read this text. Its numbers are those of the other formats."


def write(subject: Subject, stem: str) -> tuple[ExportedFile, ...]:
    """One model."""
    name = words_of(stem).capitalize()
    drive = subject.runnable
    if drive is not None and drive.drive.restitution > 0.0:
        raise InputError(
            f"Modelica text cannot carry the restitution of the end stops ({drive.drive.restitution:g}): "
            "whether a load rebounds or rests depends on its speed at the impact",
            field="stops.restitution",
            hint="state a restitution of 0, or take C, Python or MATLAB, whose function change() does it",
        )
    lines = [
        *MODELICA.remarks([_LABEL, "", *subject.about.lines(list(_left_out(subject)))]),
        f'model {name} "{_text(subject.about.title)}"',
        *indented(list(_muscle(subject) if drive is None else _drive(drive)), 2),
        f"end {name};",
    ]
    return (ExportedFile.of_text(f"{stem}.mo", "\n".join(lines)),)


def _left_out(subject: Subject) -> Iterator[str]:
    drive = subject.runnable
    if drive is None and subject.equations.compliant:
        yield "The parts in series with the muscle: the length is that of the muscle alone."
    if drive is not None and any(drive.written(name) for name in drive.signals):
        yield "The command and force of the document: connect sources to the inputs."


def _text(text: str) -> str:
    """A text in double quotes."""
    return plain(text).replace('"', "'")


def _muscle(subject: Subject) -> Iterator[str]:
    """A muscle between a length and a pressure that are inputs."""
    equations = subject.equations
    taken = [*equations.inputs, *equations.results]
    constants = names_for(equations.constants, MODELICA, taken)
    states = names_for(equations.states, MODELICA, [*taken, *constants.values()])
    rest = constants["nominal_length"]
    for full, own in constants.items():
        yield f"parameter Real {own} = {subject.value(full)!r};"
    yield f'input Real length(start = {rest}) "m, as a sensor reads it";'
    yield 'input Real pressure(start = 0.0) "Pa, gauge";'
    yield f'parameter Real temperature = {ROOM_TEMPERATURE!r} "K, of the elastomer";'
    yield 'Real velocity "m/s";'
    yield 'Real direction "the sign of the velocity";'
    yield 'Real pressure_rate "Pa/s";'
    yield 'output Real pull "N, force of the muscle; 0 when slack";'
    for name in equations.results:
        yield f"Real {name};"
    for full, own in states.items():
        variable = equations.state_variables[full]
        start = f"start = {float(variable.initial)!r}, fixed = true"
        yield f'Real {own}({start}) "{_text(variable.description)}";'
    operands = {
        **{symbol: name for name, symbol in equations.inputs.items()},
        **{symbol: constants[full] for full, symbol in equations.constants.items()},
        **{symbol: states[full] for full, symbol in equations.states.items()},
    }
    code = Code(MODELICA, operands)
    results = [(name, each) for name, each in equations.results.items()]
    rates = [(f"der({states[full]})", each) for full, each in equations.rates.items()]
    lines = code.lines([*results, *rates, ("direction", equations.direction)])
    yield from (f"{kind} {variable};" for variable, kind in code.variables.items())
    yield "equation"
    yield "  velocity = der(length);"
    yield f"  {PRESSURE_RATE} = der(pressure);"
    yield "  pull = if tension > 0.0 then force else slack_force;"
    yield from indented(lines, 2)


def _drive(runnable: RunnableDrive) -> Iterator[str]:
    """A drive between its inputs and the motion of its load."""
    equations, drive = runnable.equations, runnable
    inputs = names_for(equations.inputs, MODELICA)
    taken = list(inputs.values())
    parameters = names_for(equations.parameters, MODELICA, taken)
    taken += parameters.values()
    states = names_for(equations.state_symbols, MODELICA, taken)
    taken += states.values()
    outputs = names_for([f"out {name}" for name in equations.output_names], MODELICA, taken)
    switches = names_for([f"switch {switch.name}" for switch in equations.switches], MODELICA, taken)
    guards = {name: f"guard_{own}" for name, own in switches.items()}
    for full, own in parameters.items():
        words = drive.words("parameter")[full]
        yield f'parameter Real {own} = {drive.parameters[full]!r} "{_text(words.shown)}";'
    for (full, own), words in zip(inputs.items(), drive.words("input").values(), strict=True):
        start = drive.supply if full == "supply_pressure" else 0.0
        yield f'input Real {own}(start = {start!r}) "{_text(words.shown)}";'
    of_states = zip(states.values(), drive.words("state").values(), drive.start.tolist(), strict=True)
    for own, words, start in of_states:
        yield f'Real {own}(start = {start!r}, fixed = true) "{_text(words.shown)}";'
    of_switches = zip(switches.values(), drive.words("switch").values(), drive.switches.tolist(), strict=True)
    for own, words, start in of_switches:
        yield f'discrete Real {own}(start = {start!r}, fixed = true) "{_text(words.shown)}";'
    for own, words in zip(outputs.values(), drive.words("output").values(), strict=True):
        yield f'Real {own} "{_text(words.shown)}";'
    yield from (f"Real {own};" for own in guards.values())
    constants = [f"k_{place}" for place in range(len(equations.constants))]
    yield from (f"Real {own};" for own in constants)
    operands = {
        **{symbol: parameters[full] for full, symbol in equations.parameters.items()},
        **{symbol: inputs[full] for full, symbol in equations.inputs.items()},
        **{symbol: states[full] for full, symbol in equations.state_symbols.items()},
        # Their values before an event: a guard must not depend on what its own event sets.
        **{
            symbol: f"pre({own})"
            for symbol, own in zip(equations.switch_symbols, switches.values(), strict=True)
        },
        **dict(zip(equations.constants, constants, strict=True)),
    }
    code = Code(MODELICA, operands)
    lines = code.lines(
        [
            *zip(constants, equations.prepare, strict=True),
            *((f"der({own})", rate) for own, rate in zip(states.values(), equations.rates, strict=True)),
            *zip(outputs.values(), equations.outputs, strict=True),
            *zip(guards.values(), equations.guards, strict=True),
        ]
    )
    yield from (f"{kind} {variable};" for variable, kind in code.variables.items())
    yield "equation"
    yield from indented(lines, 2)
    least = equations.switches[0].least
    slides = [own for switch, own in zip(equations.switches, switches.values(), strict=True) if switch.slides]
    yield from indented([*_sliding(runnable, states["speed"], switches, guards)], 2)
    for switch, own, guard in zip(equations.switches, switches.values(), guards.values(), strict=True):
        if switch.slides:
            continue
        yield f"  when {guard} < -{least!r} then"
        yield f"    {own} = 1.0 - pre({own});"
        yield "  end when;"
        if switch.follows is not None:
            yield f"  // {switch.name}: the length follows the fittings; while the switch is 1 its guard is"
            yield f"  // their distance times {GUARD_STIFFNESS!r} N/m: zero where the muscle becomes taut."
    # One clause: a state may be set in one only.
    word = "when"
    for switch, own in zip(equations.switches, switches.values(), strict=True):
        if switch.stop is not None:
            yield f"  {word} {own} > 0.5 then"
            yield f"    reinit({states['speed']}, 0.0);"
            yield f"    reinit({states['stroke']}, {parameters[switch.stop]});"
            word = "elsewhen"
    if slides:
        yield f"  {word} {' + '.join(slides)} < 0.5 then"
        yield f"    reinit({states['speed']}, 0.0);"
    yield "  end when;"


def _sliding(
    runnable: RunnableDrive, speed: str, switches: Mapping[str, str], guards: Mapping[str, str]
) -> Iterator[str]:
    """When the load slides: on a stop it rests; a direction also ends where it moves the other way."""
    named = {f"switch {switch.name}": switch for switch in runnable.equations.switches}
    least = runnable.equations.switches[0].least
    slides = [name for name, switch in named.items() if switch.slides]
    stops = [f"{switches[name]} > 0.5" for name, switch in named.items() if switch.stop]
    for name, other in zip(slides, reversed(slides), strict=True):
        ends = [f"{guards[each]} < -{least!r}" for each in slides]
        yield f"when {{{', '.join([*ends, *stops])}}} then"
        yield f"  {switches[name]} = if {' or '.join(stops)} then 0.0"
        yield f"    elseif {guards[name]} < -{least!r} then 1.0 - pre({switches[name]})"
        moving = f"{named[name].slides!r} * {speed} > {SLOWEST_REBOUND!r}"
        yield f"    elseif pre({switches[other]}) > 0.5 and {moving} then 1.0"
        yield f"    else pre({switches[name]});"
        yield "end when;"


FORMAT = Format(
    title="Modelica",
    note="the equations as text, not compiled here",
    write=write,
    # The class has the name of the file with a capital: these are types and libraries of the language.
    reserved=frozenset({"real", "integer", "boolean", "string", "complex", "clock", "modelica"}),
)
