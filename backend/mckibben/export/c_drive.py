"""The equations of a drive in C99: rates, outputs, guards, change of a switch, Jacobians, start, signals."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from mckibben.export.code import Code, indented, wrapped
from mckibben.export.drive_equations import Entry
from mckibben.export.language import C, names_for
from mckibben.export.subject import RunnableDrive
from mckibben.physics.drive_terms import GUARD_STIFFNESS
from mckibben.simulation.command.segments import Segments
from mckibben.simulation.integrate.problem import LOWEST_REBOUND, SLOWEST_REBOUND

_ARGUMENTS = "const double *y, const double *k, const double *u, const double *w"
_CHANGED = "const double *p, const double *k, const double *u, double *y, double *w"
_SIGNAL = """\
static double NAME_signal(const double (*rows)[3], int count, double time)
{
    int row = 0;
    while (row + 1 < count && time >= rows[row + 1][0]) {
        ++row;
    }
    return rows[row][1] + rows[row][2] * (time - rows[row][0]);
}"""


class DriveC:
    """The C of a drive.

    Args:
        runnable: the drive.
        prefix: of all public names, an identifier.
    """

    def __init__(self, runnable: RunnableDrive, prefix: str) -> None:
        self.prefix, self._drive, self._equations = prefix, runnable, runnable.equations
        equations = self._equations
        self.states = names_for(equations.state_symbols, C)
        self.parameters = names_for(equations.parameters, C)
        self.inputs = names_for(equations.inputs, C)
        self.outputs = names_for(equations.output_names, C)
        self.switches = names_for([switch.name for switch in equations.switches], C)
        self._operands = {
            **{symbol: f"y[{place}]" for place, symbol in enumerate(equations.state_symbols.values())},
            **{symbol: f"k[{place}]" for place, symbol in enumerate(equations.constants)},
            **{symbol: f"u[{place}]" for place, symbol in enumerate(equations.inputs.values())},
            **{symbol: f"w[{place}]" for place, symbol in enumerate(equations.switch_symbols)},
        }

    def _counts(self) -> dict[str, int]:
        return {
            "DRIVE_STATES": len(self.states),
            "DRIVE_PARAMETERS": len(self.parameters),
            "DRIVE_CONSTANTS": len(self._equations.constants),
            "DRIVE_INPUTS": len(self.inputs),
            "DRIVE_OUTPUTS": len(self.outputs),
            "DRIVE_SWITCHES": len(self.switches),
        }

    def header(self) -> Iterator[str]:
        """Sizes, indices and prototypes."""
        name = self.prefix
        yield "/*"
        yield " * The drive: y' = rates(y, k, u, w), with y states, p parameters, k = prepare(p), u inputs,"
        yield " * w switches."
        yield " * Pressures of states and inputs are absolute. Strokes are positive towards shorter."
        yield " * A switch is 0 or 1 during a step. Where its guard falls below -DRIVE_LEAST, end the step"
        yield " * there and call change(): a stop catches the load or lets it go, a muscle goes slack or"
        yield " * taut, a load with dry friction sticks or breaks away. Several may change at one instant."
        yield " */"
        yield "enum {"
        yield from (f"    {name.upper()}_{count} = {value}," for count, value in self._counts().items())
        for mark, kind, names in (
            ("Y", "state", self.states),
            ("P", "parameter", self.parameters),
            ("U", "input", self.inputs),
            ("OUT", "output", self.outputs),
            ("W", "switch", self.switches),
        ):
            words = self._drive.words(kind)
            for place, (full, own) in enumerate(names.items()):
                line = f"    {name.upper()}_{mark}_{own.upper()} = {place},"
                yield C.inline(line, words[full].shown)
        yield f"    {name.upper()}_DRIVE_END = 0"
        yield "};"
        yield f"#define {name.upper()}_DRIVE_LEAST {self._equations.switches[0].least!r}"
        yield ""
        yield "/* Values of the document: parameters, states and switches at t = 0. */"
        yield f"extern const double {name}_parameters[{len(self.parameters)}];"
        yield f"extern const double {name}_start[{len(self.states)}];"
        yield f"extern const double {name}_start_switches[{len(self.switches)}];"
        yield "/* Names, in the order of the arrays. */"
        for kind, names in self._named():
            yield f"extern const char *const {name}_{kind}_names[{len(names)}];"
        yield ""
        yield f"void {name}_prepare(const double *p, double *k);"
        for function, result in (("rates", "rates"), ("outputs", "out"), ("guards", "guards")):
            yield f"void {name}_{function}({_ARGUMENTS}, double *{result});"
        yield "/* d rates / d states and d rates / d inputs, by rows; all entries are written. */"
        yield f"void {name}_jacobian({_ARGUMENTS}, double *jacobian);"
        yield f"void {name}_input_jacobian({_ARGUMENTS}, double *jacobian);"
        yield "/* Changes switch number; y and w are overwritten. p: for the places of the stops. */"
        yield f"void {name}_change(int number, {_CHANGED});"
        yield "/* Inputs of the document at a time [s]: the command after all dead times, force, supply. */"
        yield f"void {name}_inputs(double time, double *u);"

    def _named(self) -> list[tuple[str, list[str]]]:
        equations = self._equations
        return [
            ("state", [state.name for state in equations.states]),
            ("parameter", list(equations.parameters)),
            ("input", list(equations.inputs)),
            ("output", list(equations.output_names)),
            ("switch", [switch.name for switch in equations.switches]),
        ]

    def source(self) -> Iterator[str]:
        """The functions."""
        name, equations, drive = self.prefix, self._equations, self._drive
        yield from _array(
            f"const double {name}_parameters[{len(self.parameters)}]", drive.parameters.values()
        )
        yield from _array(f"const double {name}_start[{len(self.states)}]", drive.start)
        yield from _array(f"const double {name}_start_switches[{len(self.switches)}]", drive.switches)
        for kind, names in self._named():
            yield f"const char *const {name}_{kind}_names[{len(names)}] = {{"
            yield from (f'    "{each}",' for each in names)
            yield "};"
        yield ""
        yield f"void {name}_prepare(const double *p, double *k)"
        yield "{"
        places = {symbol: f"p[{place}]" for place, symbol in enumerate(equations.parameters.values())}
        yield from indented(
            Code(C, places).lines([(f"k[{place}]", each) for place, each in enumerate(equations.prepare)]), 4
        )
        yield "}"
        for function, result, expressions in (
            ("rates", "rates", equations.rates),
            ("outputs", "out", equations.outputs),
            ("guards", "guards", equations.guards),
        ):
            yield from self._function(
                f"void {name}_{function}({_ARGUMENTS}, double *{result})",
                [(f"{result}[{place}]", each) for place, each in enumerate(expressions)],
            )
        for function, entries, width in (
            ("jacobian", equations.jacobian, len(self.states)),
            ("input_jacobian", equations.input_jacobian, len(self.inputs)),
        ):
            yield from self._function(
                f"void {name}_{function}({_ARGUMENTS}, double *jacobian)",
                _placed(entries, width),
                [
                    f"for (int place = 0; place < {len(self.states) * width}; ++place) {{",
                    "    jacobian[place] = 0.0;",
                    "}",
                ],
            )
        yield from self._change()
        yield from self._inputs()

    def _function(
        self, prototype: str, results: Sequence[tuple[str, Any]], first: Sequence[str] = ()
    ) -> Iterator[str]:
        yield ""
        yield prototype
        yield "{"
        yield from indented(first, 4)
        lines = Code(C, self._operands).lines(results)
        yield from indented(lines, 4)
        text = "\n".join(lines)
        yield from (f"    (void){argument};" for argument in "ykuw" if f"{argument}[" not in text)
        yield "}"

    def _change(self) -> Iterator[str]:
        """The rules of `mckibben.simulation.integrate.switching.change_switch`."""
        name, equations = self.prefix, self._equations
        stroke, speed = (list(equations.state_symbols).index(state) for state in ("stroke", "speed"))
        yield ""
        yield f"void {name}_change(int number, {_CHANGED})"
        yield "{"
        yield f"    double guards[{len(self.switches)}];"
        yield f"    double rates[{len(self.states)}];"
        yield "    double to = 1.0 - w[number];"
        yield "    switch (number) {"
        bounce = float(self._drive.drive.restitution)
        for number, switch in enumerate(equations.switches):
            yield f"    case {number}: /* {switch.name} */"
            if switch.stop is not None:
                place = list(equations.parameters).index(switch.stop)
                yield "        if (to == 1.0) {"
                yield f"            const double hit = y[{speed}];"
                yield f"            {name}_rates(y, k, u, w, rates);"
                yield f"            y[{stroke}] = p[{place}];"
                yield f"            y[{speed}] = 0.0;"
                yield f"            const double left = {bounce!r} * fabs(hit);"
                yield f"            const double pressing = hit > 0.0 ? rates[{speed}] : -rates[{speed}];"
                yield (
                    f"            if (left > {SLOWEST_REBOUND!r} && "
                    f"left * left > {2.0 * LOWEST_REBOUND!r} * pressing) {{"
                )
                yield f"                y[{speed}] = -{bounce!r} * hit;"
                yield "                to = 0.0;"
                yield "            }"
                for place, other in enumerate(equations.switches):
                    if other.slides:
                        yield f"            w[{place}] = {other.slides!r} * y[{speed}] > 0.0 ? 1.0 : 0.0;"
                yield "        }"
            elif switch.slides:
                opposite = [other.slides for other in equations.switches].index(-switch.slides)
                yield "        /* At rest it sticks; where friction sets in it may move the other way. */"
                yield f"        if (to == 0.0 && fabs(y[{speed}]) > {SLOWEST_REBOUND!r}) {{"
                yield f"            w[{opposite}] = 1.0;"
                yield "        } else if (to == 0.0) {"
                yield f"            y[{speed}] = 0.0;"
                yield "        }"
            else:
                follows = list(equations.state_symbols).index(switch.follows or "length")
                yield "        /* The length follows the distance of the fittings again. */"
                yield f"        w[{number}] = 1.0;"
                yield f"        {name}_guards(y, k, u, w, guards);"
                yield f"        y[{follows}] -= guards[{number}] / {GUARD_STIFFNESS!r};"
            yield "        break;"
        yield "    default:"
        yield "        return;"
        yield "    }"
        yield "    w[number] = to;"
        yield "}"

    def _inputs(self) -> Iterator[str]:
        name, drive = self.prefix, self._drive
        tables = {own: drive.written(full) for full, own in self.inputs.items()}
        yield ""
        for own, signal in tables.items():
            if signal is not None:
                yield f"/* {own}: rows of time, value, slope. */"
                yield from _rows(f"static const double {name}_{own}_rows[{len(signal.slopes)}][3]", signal)
        if any(signal is not None for signal in tables.values()):
            yield ""
            yield from _SIGNAL.replace("NAME", name).splitlines()
        yield ""
        yield f"void {name}_inputs(double time, double *u)"
        yield "{"
        yield "    (void)time;"
        for place, (full, own) in enumerate(self.inputs.items()):
            signal = tables[own]
            if signal is not None:
                yield f"    u[{place}] = {name}_signal({name}_{own}_rows, {len(signal.slopes)}, time);"
            elif full == "supply_pressure":
                yield f"    u[{place}] = {drive.supply!r};"
            else:
                yield f"    u[{place}] = 0.0; /* not in this file */"
        yield "}"


def _placed(entries: list[Entry], width: int) -> list[tuple[str, Any]]:
    return [(f"jacobian[{row * width + column}]", each) for row, column, each in entries]


def _array(declaration: str, values: Any) -> Iterator[str]:
    numbers = ", ".join(repr(float(value)) for value in values)
    yield f"{declaration} = {{"
    yield from wrapped(f"    {numbers}", "")
    yield "};"


def _rows(declaration: str, signal: Segments) -> Iterator[str]:
    yield f"{declaration} = {{"
    for row in np.column_stack([signal.times[:-1], signal.start_values, signal.slopes]).tolist():
        yield f"    {{{', '.join(map(repr, row))}}},"
    yield "};"
