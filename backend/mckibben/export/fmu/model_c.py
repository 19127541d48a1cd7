"""The C between the equations of a model and the fixed part of an FMU: sizes, starts, courses, calls."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from mckibben.export.c_static import RESULT_MEMBERS
from mckibben.export.code import wrapped
from mckibben.export.fmu.variables import Plant
from mckibben.simulation.integrate import coefficients

_STATE = "const double *y, const double *k, const double *u, const double *w"
_CALLS = {
    "prepare": "const double *p, double *k",
    "rates": f"{_STATE}, double *rates",
    "guards": f"{_STATE}, double *guards",
    "jacobian": f"{_STATE}, double *matrix",
    "input_jacobian": f"{_STATE}, double *matrix",
    "change": "int number, const double *p, const double *k, const double *u, double *y, double *w",
}
_ARGUMENTS = {
    "prepare": "p, k",
    "rates": "y, k, u, w, rates",
    "guards": "y, k, u, w, guards",
    "jacobian": "y, k, u, w, matrix",
    "input_jacobian": "y, k, u, w, matrix",
    "change": "number, p, k, u, y, w",
}
_OUTPUTS = "const double *y, const double *p, const double *k, const double *u, const double *w, double *out"


def header(plant: Plant, guid: str) -> Iterator[str]:
    """``model.h``."""
    equations = None if plant.drive is None else plant.drive.equations
    speed = -1 if equations is None else list(equations.state_symbols).index("speed")
    constants = len(plant.parameters) if equations is None else len(equations.constants)
    least = 1e-5 if equations is None else equations.switches[0].least
    yield "/* Sizes and values of one model, and its equations under the names that plant.c knows. */"
    yield "#ifndef MODEL_H"
    yield "#define MODEL_H"
    yield ""
    yield f'#define MODEL_GUID "{guid}"'
    yield f"#define MODEL_LEAST {least!r}"
    yield f"#define MODEL_SPEED {speed}"
    yield f"#define MODEL_EXACT_DERIVATIVES {int(equations is not None)}"
    for name, count in (
        ("STATES", len(plant.states)),
        ("PARAMETERS", len(plant.parameters)),
        ("CONSTANTS", constants),
        ("INPUTS", len(plant.inputs)),
        ("OUTPUTS", len(plant.outputs)),
        ("SWITCHES", len(plant.switches)),
        ("PIECES", len(plant.pieces)),
    ):
        yield f"#define MODEL_{name} {count}"
    yield ""
    yield from (f"extern {declared};" for declared, _ in _arrays(plant))
    yield f"extern const double model_pieces[{len(plant.pieces)}][{1 + 2 * len(plant.inputs)}];"
    for name, arguments in _CALLS.items():
        if equations is not None or "jacobian" not in name:
            yield f"void model_{name}({arguments});"
    yield f"void model_outputs({_OUTPUTS});"
    yield ""
    yield "#endif"


def source(plant: Plant) -> Iterator[str]:
    """``model.c``."""
    yield "/* Values of one model, and calls of its equations. */"
    yield '#include "model.h"'
    yield f'#include "{plant.prefix}.h"'
    yield ""
    for declared, values in _arrays(plant):
        yield f"{declared} = {{"
        yield from wrapped(f"    {', '.join(values)}", "")
        yield "};"
    yield "/* Courses of the document: time, then value and slope of each input. */"
    yield f"const double model_pieces[{len(plant.pieces)}][{1 + 2 * len(plant.inputs)}] = {{"
    for row in plant.pieces.tolist():
        yield from wrapped(f"    {{{', '.join(map(repr, row))}}},", "")
    yield "};"
    yield from _of_muscle(plant) if plant.drive is None else _of_drive(plant)


def rodas4() -> Iterator[str]:
    """``rodas4.h``: the coefficients of the solver."""
    yield "/* Coefficients of Rodas4: Hairer and Wanner, Solving Ordinary Differential Equations II, IV.7. */"
    yield "#ifndef RODAS4_H"
    yield "#define RODAS4_H"
    yield ""
    yield f"#define RODAS_GAMMA {coefficients.GAMMA!r}"
    for name in ("A", "C"):
        yield f"static const double RODAS_{name}[6][5] = {{"
        for row in getattr(coefficients, name).tolist():
            yield from wrapped(f"    {{{', '.join(map(repr, row))}}},", "")
        yield "};"
    for name in ("ALPHA", "DELTA", "DENSE_2", "DENSE_3"):
        values = getattr(coefficients, name).tolist()
        yield f"static const double RODAS_{name}[{len(values)}] = {{"
        yield from wrapped(f"    {', '.join(map(repr, values))}", "")
        yield "};"
    yield ""
    yield "#endif"


def _arrays(plant: Plant) -> Iterator[tuple[str, list[str]]]:
    """Declaration and values of each array; one without values has a zero."""
    for name, values in (
        ("start", [each.start for each in plant.states]),
        ("scales", [each.nominal for each in plant.states]),
        ("start_switches", [each.start for each in plant.switches]),
        ("parameters", [each.start for each in plant.parameters]),
        ("start_inputs", [each.start for each in plant.inputs]),
    ):
        texts = [repr(float(value or 0.0)) for value in values] or ["0.0"]
        yield f"const double model_{name}[{len(texts)}]", texts
    switches = [] if plant.drive is None else plant.drive.equations.switches
    for name, flags in (
        ("played", plant.played),
        ("is_stop", [each.stop is not None for each in switches]),
        ("slides", [each.slides for each in switches]),
    ):
        texts = [str(int(flag)) for flag in flags] or ["0"]
        yield f"const int model_{name}[{len(texts)}]", texts


def _of_drive(plant: Plant) -> Iterator[str]:
    for name, arguments in _CALLS.items():
        yield from _function(
            f"void model_{name}({arguments})", [f"{plant.prefix}_{name}({_ARGUMENTS[name]});"]
        )
    drive = plant.drive
    assert drive is not None  # noqa: S101 - of a drive
    states = {state.name: f"y[{place}]" for place, state in enumerate(drive.equations.states)}
    parameters = {name: f"p[{place}]" for place, name in enumerate(drive.equations.parameters)}
    own = [each.key for each in plant.outputs][: -len(drive.equations.output_names)]
    lever = f" / {parameters['lever_ratio']}" if "lever_ratio" in parameters else ""
    lines = [f"{plant.prefix}_outputs(y, k, u, w, out + {len(own)});"]
    for place, key in enumerate(own):
        if key in ("position", "velocity"):
            text = f"{states['stroke' if key == 'position' else 'speed']}{lever}"
        else:
            text = f"{states[key]} - {parameters['ambient_pressure']}"
        lines.append(f"out[{place}] = {text};")
    yield from _function(f"void model_outputs({_OUTPUTS})", lines)


def _of_muscle(plant: Plant) -> Iterator[str]:
    name, states = plant.prefix, len(plant.states)
    yield ""
    yield f"static void input_of({name}_input *in, const double *y, const double *k, const double *u)"
    yield "{"
    yield f"    {name}_rest(in);"
    for place, member in enumerate(("length", "velocity", "pressure")):
        yield f"    in->{member} = u[{place}];"
    yield "    in->temperature = u[4];"
    yield f"    in->direction = {name}_direction(u[1]);"
    yield from (f"    in->states[{place}] = y[{place}];" for place in range(states))
    yield f"    for (int i = 0; i < {len(plant.parameters)}; ++i) {{"
    yield "        in->constants[i] = k[i];"
    yield "    }"
    yield from [] if states else ["    (void)y;"]
    yield "}"
    copied = [f"for (int i = 0; i < {len(plant.parameters)}; ++i) {{", "    k[i] = p[i];", "}"]
    yield from _function(f"void model_prepare({_CALLS['prepare']})", copied)
    rates = [
        f"{name}_input in;",
        "input_of(&in, y, k, u);",
        f"{name}_state_rates(&in, u[3], rates);",
        "(void)w;",
    ]
    unused = [f"(void){each};" for each in ("y", "k", "u", "w", "rates")]
    yield from _function(f"void model_rates({_CALLS['rates']})", rates if states else unused)
    unused = [f"(void){each};" for each in ("y", "k", "u", "w", "guards")]
    yield from _function(f"void model_guards({_CALLS['guards']})", unused)
    unused = [f"(void){each};" for each in ("number", "p", "k", "u", "y", "w")]
    yield from _function(f"void model_change({_CALLS['change']})", unused)
    lines = [
        f"{name}_input in;",
        f"{name}_result result;",
        "input_of(&in, y, k, u);",
        f"{name}_at(&in, &result);",
    ]
    lines += [f"out[{place}] = result.{member};" for place, member in enumerate(RESULT_MEMBERS)]
    yield from _function(f"void model_outputs({_OUTPUTS})", [*lines, "(void)p;", "(void)w;"])


def _function(prototype: str, lines: Iterable[str]) -> Iterator[str]:
    yield ""
    yield prototype
    yield "{"
    yield from (f"    {line}" for line in lines)
    yield "}"
