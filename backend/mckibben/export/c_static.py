"""The static model in C99: declarations for the header, and the functions."""

from __future__ import annotations

from collections.abc import Iterator

from mckibben.export.code import Code, indented
from mckibben.export.language import C, names_for
from mckibben.export.static_equations import PRESSURE_RATE, RESULTS
from mckibben.export.subject import Subject
from mckibben.physics.model import ROOM_TEMPERATURE

# Members of the input: name -> unit and meaning.
_INPUTS = {
    "length": "m, between the fittings, as a length sensor reads it",
    "pressure": "Pa, gauge, as a pressure sensor reads it",
    "velocity": "m/s, dL/dt, positive = lengthening",
    "direction": "sign of the velocity: -1 shortening, 0 at rest, 1 lengthening",
    "temperature": "K, of the elastomer",
}
# Members of the result: name -> unit and meaning.
RESULT_MEMBERS = {
    "force": "N, as a force sensor reads it; of a slack muscle that of no tension",
    "stiffness": "N/m, d force / d length at constant pressure",
    "force_by_pressure": "N/Pa",
    "force_by_contraction": "N, d force / d contraction",
    "volume": "m^3, of the gas in the muscle",
    "volume_by_pressure": "m^3/Pa",
    "volume_by_contraction": "m^3",
    "tension": "N, true and unclipped: a negative one would push",
    "diameter": "m, of the braid at mid-span",
    "outer_diameter": "m, of the wall at mid-span",
    "braid_angle": "rad",
    "muscle_length": "m, of the muscle alone, without parts in series",
    "slack": "1 = slack",
}
_RAW = tuple(RESULTS)
_NEWTON = """\
    const double wanted = r.true_length;
    for (int step = 0; step < 12; ++step) {
        const int pulls = r.tension > 0.0;
        const double stretch = pulls ? r.compliance * r.tension : 0.0;
        const double slope = r.true_length_by_length + (pulls ? r.compliance * r.tension_by_length : 0.0);
        const double change = (r.true_length + stretch - wanted) / slope;
        at.length -= change;
        NAME_raw(&at, &r);
        if (fabs(change) < 1e-12) {
            break;
        }
    }
    {
        const double yielding = r.tension > 0.0 ? r.compliance : 0.0;
        const double slope = r.true_length_by_length + yielding * r.tension_by_length;
        const double by_length = r.true_length_by_length / slope;
        const double by_pressure = -yielding * r.tension_by_pressure / slope;
        r.force_by_pressure += r.force_by_length * by_pressure;
        r.volume_by_pressure += r.volume_by_length * by_pressure;
        r.force_by_length *= by_length;
        r.volume_by_length *= by_length;
    }"""


class StaticC:
    """The C of a static model.

    Args:
        subject: the model.
        prefix: of all public names, an identifier.
        tunable: whether the constants are members of the input, so that a caller may change them.
    """

    def __init__(self, subject: Subject, prefix: str, *, tunable: bool = False) -> None:
        self.prefix, self._subject, self._equations = prefix, subject, subject.equations
        self._states = names_for(self._equations.states, C)
        self._tunable = tunable
        self._constants = names_for(self._equations.constants, C, _INPUTS)
        if tunable:
            self._constants = {full: f"in->constants[{k}]" for k, full in enumerate(self._constants)}

    def header(self) -> Iterator[str]:
        """Types and prototypes."""
        name, states = self.prefix, self._states
        if states:
            yield f"/* States of effects with memory: members of {name}_input.states. */"
            yield "enum {"
            for place, (full, own) in enumerate(states.items()):
                variable = self._equations.state_variables[full]
                yield C.inline(
                    f"    {name.upper()}_{own.upper()} = {place},", f"{variable.unit}: {variable.description}"
                )
            yield f"    {name.upper()}_STATES = {len(states)}"
            yield "};"
            yield ""
        yield "typedef struct {"
        for member, meaning in _INPUTS.items():
            yield C.inline(f"    double {member};", meaning)
        if states:
            yield f"    double states[{len(states)}];"
        if self._tunable:
            yield f"    double constants[{len(self._constants)}];"
        yield f"}} {name}_input;"
        yield ""
        yield "typedef struct {"
        for member, meaning in RESULT_MEMBERS.items():
            yield C.inline(f"    {'int' if member == 'slack' else 'double'} {member};", meaning)
        yield f"}} {name}_result;"
        yield ""
        yield "/* A muscle at rest at its rest length, without pressure, at 293.15 K; states at rest. */"
        yield f"void {name}_rest({name}_input *in);"
        if any(state.sliding for state in self._equations.state_variables.values()):
            yield "/* States of friction as a long slow motion in in->direction leaves them. */"
            yield f"void {name}_sliding({name}_input *in);"
        yield "/* Everything at one input. in and out may not overlap. */"
        yield f"void {name}_at(const {name}_input *in, {name}_result *out);"
        yield "/* Force [N], stiffness [N/m], volume [m^3] at rest, of gauge pressure [Pa], contraction. */"
        for figure in ("force", "stiffness", "volume"):
            yield f"double {name}_{figure}(double pressure, double contraction);"
        if states:
            yield "/* d/dt of the states; pressure_rate: of the gauge pressure [Pa/s]. */"
            yield f"void {name}_state_rates(const {name}_input *in, double pressure_rate, double *rates);"
        if states or self._tunable:
            yield "/* The sign of a velocity: at rest 0, the mean of both directions. */"
            yield f"double {name}_direction(double velocity);"

    def source(self) -> Iterator[str]:
        """The functions."""
        name, equations = self.prefix, self._equations
        if not self._tunable:
            for full, own in self._constants.items():
                yield f"static const double {own} = {self._subject.value(full)!r};"
            yield ""
        yield "typedef struct {"
        yield from (f"    double {member};" for member in _RAW)
        yield f"}} {name}_raw_result;"
        yield ""
        operands = {
            **{
                symbol: f"in->{member}"
                for member, symbol in equations.inputs.items()
                if member != PRESSURE_RATE
            },
            equations.inputs[PRESSURE_RATE]: "pressure_rate",
            **{symbol: f"in->states[{place}]" for place, symbol in enumerate(equations.states.values())},
            **{symbol: self._constants[full] for full, symbol in equations.constants.items()},
        }
        yield "/* At the length that a sensor on the muscle reads. */"
        yield f"static void {name}_raw(const {name}_input *in, {name}_raw_result *out)"
        yield "{"
        yield from indented(
            Code(C, operands).lines([(f"out->{member}", each) for member, each in equations.results.items()]),
            4,
        )
        yield "}"
        yield from self._rest()
        yield from self._at()
        yield from self._figures()
        if equations.states:
            yield from self._rates(operands)
        if equations.states or self._tunable:
            yield from self._direction()

    def _rest(self) -> Iterator[str]:
        name = self.prefix
        yield ""
        yield f"void {name}_rest({name}_input *in)"
        yield "{"
        if self._tunable:
            for full, own in self._constants.items():
                yield f"    {own} = {self._subject.value(full)!r};"
        yield f"    in->length = {self._constants['nominal_length']};"
        yield "    in->pressure = 0.0;"
        yield "    in->velocity = 0.0;"
        yield "    in->direction = 0.0;"
        yield f"    in->temperature = {ROOM_TEMPERATURE!r};"
        variables = list(self._equations.state_variables.values())
        for place, variable in enumerate(variables):
            yield f"    in->states[{place}] = {float(variable.initial)!r};"
        yield "}"
        if any(variable.sliding for variable in variables):
            yield ""
            yield f"void {name}_sliding({name}_input *in)"
            yield "{"
            for place, variable in enumerate(variables):
                if variable.sliding:
                    yield f"    in->states[{place}] = {float(variable.sliding)!r} * in->direction;"
            yield "}"

    def _settled(self) -> Iterator[str]:
        """Lines that leave the result in ``r``, at the input ``at`` with the length of the muscle alone."""
        name = self.prefix
        yield (
            f"    {name}_input at = *in;"
            if self._equations.compliant
            else f"    const {name}_input at = *in;"
        )
        yield f"    {name}_raw_result r;"
        yield f"    {name}_raw(&at, &r);"
        if self._equations.compliant:
            yield "    /* The parts in series stretch: the length of the muscle alone, by Newton's method. */"
            yield from _NEWTON.replace("NAME", name).splitlines()

    def _at(self) -> Iterator[str]:
        name, rest = self.prefix, self._constants["nominal_length"]
        yield ""
        yield f"void {name}_at(const {name}_input *in, {name}_result *out)"
        yield "{"
        yield from self._settled()
        yield "    out->slack = !(r.tension > 0.0);"
        yield "    out->force = out->slack ? r.slack_force : r.force;"
        yield "    out->stiffness = out->slack ? 0.0 : r.force_by_length;"
        yield "    out->force_by_pressure = out->slack ? 0.0 : r.force_by_pressure;"
        yield f"    out->force_by_contraction = out->slack ? 0.0 : -{rest} * r.force_by_length;"
        yield "    out->volume = r.volume;"
        yield "    out->volume_by_pressure = r.volume_by_pressure;"
        yield f"    out->volume_by_contraction = -{rest} * r.volume_by_length;"
        yield "    out->tension = r.tension;"
        yield "    out->diameter = r.diameter;"
        yield "    out->outer_diameter = r.outer_diameter;"
        yield "    out->braid_angle = r.braid_angle;"
        yield "    out->muscle_length = r.true_length;"
        yield "}"

    def _figures(self) -> Iterator[str]:
        name, rest = self.prefix, self._constants["nominal_length"]
        for figure in ("force", "stiffness", "volume"):
            yield ""
            yield f"double {name}_{figure}(double pressure, double contraction)"
            yield "{"
            yield f"    {name}_input in;"
            yield f"    {name}_result out;"
            yield f"    {name}_rest(&in);"
            yield "    in.pressure = pressure;"
            yield f"    in.length = {rest.replace('in->', 'in.')} * (1.0 - contraction);"
            yield f"    {name}_at(&in, &out);"
            yield f"    return out.{figure};"
            yield "}"

    def _rates(self, operands: dict[object, str]) -> Iterator[str]:
        name, equations = self.prefix, self._equations
        inner = f"static void {name}_raw_rates(const {name}_input *in, double pressure_rate, double *rates)"
        yield ""
        yield inner if equations.compliant else inner.removeprefix("static ").replace("raw", "state")
        yield "{"
        rates = list(equations.rates.values())
        yield from indented(
            Code(C, operands).lines([(f"rates[{k}]", each) for k, each in enumerate(rates)]), 4
        )
        used = set().union(*(each.free_symbols for each in rates))
        yield from (f"    (void){argument};" for argument in _unused(used, operands))
        yield "}"
        if equations.compliant:
            yield ""
            yield f"void {name}_state_rates(const {name}_input *in, double pressure_rate, double *rates)"
            yield "{"
            yield from self._settled()
            yield "    (void)r;"
            yield f"    {name}_raw_rates(&at, pressure_rate, rates);"
            yield "}"

    def _direction(self) -> Iterator[str]:
        name, equations = self.prefix, self._equations
        yield ""
        yield f"double {name}_direction(double velocity)"
        yield "{"
        yield from indented(
            Code(C, {equations.inputs["velocity"]: "velocity"}).lines([("return", equations.direction)]), 4
        )
        yield "}"


def _unused(used: set[object], operands: dict[object, str]) -> Iterator[str]:
    """Arguments of the rates that they do not depend on."""
    texts = {operands[symbol] for symbol in used}
    if not any(text.startswith("in->") for text in texts):
        yield "in"
    if "pressure_rate" not in texts:
        yield "pressure_rate"
