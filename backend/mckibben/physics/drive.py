r"""A drive as one symbolic model: supply, valve, tube, muscle, load and any choice of effects.

.. math::
   M \ddot s &= r^2 F - r\,(m g\sin\psi + F_{ext} + F_{guide}) - k s \\
   \dot p\,(V + \gamma p\,\partial_p V) &= (\gamma - 1)\,(\dot Q + c_p T_0 \dot m_{in} -
   c_p T \dot m_{out}) - \gamma p\,\partial_l V\,\dot l, \quad T = p V / (m R)

with the stroke s of the muscle (positive = shorter), the lever ratio r (muscle stroke per load stroke) and
the volume V and tension F of `mckibben.physics.model` at the length l of the muscle. A document may state a
polytropic exponent n instead of the energy balance: n in place of gamma, and n R T_0 m' in place of the heat
and enthalpy flows.

**End stops** are rigid. A switch holds the load on a stop while the net force presses it there; the
integrator finds impact and release as events.

**A slack muscle** cannot push. Its length is then not the distance d of the fittings but the length at which
it carries no tension: :math:`\dot l = \dot d - F_0/c` with the tension F_0 at rest and a small damping c.
While it is taut, l = d. Slack is a switch as well.

**Dry friction** is set-valued (Filippov): all its laws enter the net force N through one direction d, which
is the sign of the speed of a load that slides, and any number between -1 and 1 for one that sticks. Two
switches say so: *slides up* and *slides down*, d = up - down. A load that slides sticks where its speed is
zero; one that sticks breaks away upwards where :math:`N(d = 1) > 0` and downwards where :math:`N(d = -1) <
0`. As N is that of the whole model, ranges of several laws add up, grow with pressure and act on both
muscles of a pair; static friction above the kinetic is what a law gives at zero speed, and what grows with
the time at rest is a state of its effect. A stop that holds the load carries all that N(0) presses on it.

In an antagonist pair the first muscle contracts by s0 + s and the second by s0 - s. The second has its own
gas, and its tension acts against the first.

At a joint whose levers change with its angle :math:`\varphi`, s is the way :math:`R\varphi` of a rim of the
radius R, the muscles have the lengths :math:`L_i(\varphi)`, and their forces act along s with the shares
:math:`r_i/R`, :math:`r_i = -dL_i/d\varphi`: the equation above is then that of the torques,
:math:`J\ddot\varphi = \sum r_i F_i - \dots`, with :math:`M = J/R^2`.

The equations are built on symengine symbols, because they contain derivatives of the volume.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import symengine as se

from mckibben.physics import joint, ops
from mckibben.physics.chamber import Motion, Side, muscle_side, with_energy_balance
from mckibben.physics.drive_terms import (
    COUNTER,
    COUNTER_OUTPUTS,
    GUARD_DAMPING,
    GUARD_STIFFNESS,
    HIGH_STOP,
    INPUTS,
    LEAST_GUARD,
    LOW_STOP,
    OUTPUTS,
    PATH_DEGREE,
    SLACK,
    SLIDES_DOWN,
    SLIDES_UP,
    DriveStructure,
    StateInfo,
    Switch,
)
from mckibben.physics.model import Model
from mckibben.physics.muscle import GEOMETRY, Muscle
from mckibben.physics.muscle_path import MusclePath
from mckibben.physics.ops import Value


class DriveModel:
    """The equations of a structure on symbols.

    Attributes:
        states: in their order; ``initial`` is None where the run has to set it.
        symbols: state name -> symbol.
        parameters: constants of a run: `CONSTANTS`, geometry, "effect.parameter"; name -> symbol.
        inputs: name -> symbol of `INPUTS`.
        rates: d/dt of the states.
        switches: what is 0 or 1 during a step.
        outputs: expressions of ``output_names``: `OUTPUTS`, of a pair `COUNTER_OUTPUTS` too.

    Args:
        structure: features that determine the equations.
    """

    def __init__(self, structure: DriveStructure) -> None:
        model = Model(structure.effects)
        suffixes = ("", COUNTER) if structure.pair else ("",)
        self.output_names = (*OUTPUTS, *COUNTER_OUTPUTS) if structure.pair else OUTPUTS
        self.states = [
            StateInfo("stroke", None, 0.1),
            StateInfo("speed", 0.0, 1.0),
            StateInfo("clock", 0.0, 1.0),
        ]
        for suffix in suffixes:
            self.states += _side_states(structure, model, suffix)
        # Nothing depends on these states; placed last, they make the linear systems smaller.
        for suffix in suffixes:
            self.states += [StateInfo(f"{name}{suffix}", 0.0, 1e-3) for name in ("supplied", "vented")]
        self.symbols = {state.name: se.Symbol(f"y_{state.name}") for state in self.states}
        constants = {name: se.Symbol(name) for name in structure.constants}
        geometry = {name: se.Symbol(name) for name in GEOMETRY}
        numbers = {
            f"{effect.id}.{p.name}": se.Symbol(f"{effect.id}.{p.name}")
            for effect in model.effects
            for p in effect.parameters
        }
        self.parameters = {**constants, **geometry, **numbers}
        self.inputs = {name: se.Symbol(f"u_{name}") for name in INPUTS}
        self._constants, self._numbers = constants, numbers
        self.switches: list[Switch] = []
        rates, outputs = self._equations(structure, model, Muscle(**geometry))
        self.rates = [se.sympify(rates[state.name]) for state in self.states]
        self.outputs = [se.sympify(outputs[name]) for name in self.output_names]

    def _equations(
        self, structure: DriveStructure, model: Model, muscle: Muscle
    ) -> tuple[dict[str, Value], dict[str, Value]]:
        y, u, c = self.symbols, self.inputs, self._constants
        passed = y["clock"] - u["begin"]
        external = u["external_force"] + u["external_force_slope"] * passed
        sides: list[Side] = []
        slack: list[Switch] = []
        direction = se.Symbol("direction")
        effects = self._values(model, y)
        motions, shares = self._motions(structure, model, effects, direction)
        for suffix, opening in (("", "opening"), (COUNTER, "counter_opening")):
            if suffix and not structure.pair:
                continue
            own = {name.removesuffix(suffix): symbol for name, symbol in y.items() if name.endswith(suffix)}
            hanging = se.Symbol(f"w_{SLACK}{suffix}")
            sides.append(
                muscle_side(
                    structure=structure,
                    slack=hanging,
                    model=model,
                    muscle=muscle,
                    values=self._values(model, own),
                    constants=c,
                    states=own,
                    motion=motions[suffix],
                    command=u[opening] + u[f"{opening}_slope"] * passed,
                )
            )
            excess = GUARD_STIFFNESS * (own["length"] - sides[-1].distance)
            guard = hanging * excess + (1.0 - hanging) * sides[-1].resting_tension
            name = f"{SLACK}{suffix}"
            slack.append(Switch(name, hanging, guard, LEAST_GUARD, follows=f"length{suffix}"))
        main = sides[0]
        pull = main.force * shares[""]
        if structure.pair:
            pull = pull + sides[1].force * shares[COUNTER]
        values = effects
        net, inertia = self._net_force(structure, model, muscle, values, pull, external, direction)
        self.switches, dry = motion_switches(
            constants=c, stroke=y["stroke"], speed=y["speed"], net_force=net, direction=direction
        )
        self.switches += slack
        contact = self.switches[1].symbol - self.switches[0].symbol
        acceleration = dry.moves * dry.net_force / inertia
        rates = {"clock": 1.0, "stroke": y["speed"], "speed": acceleration, **main.rates}
        outputs = {
            "acceleration": acceleration,
            "force": main.force,
            "mass_flow": main.inflow,
            "supply_flow": main.flows["supply"],
            "exhaust_flow": main.flows["exhaust"],
            "opening": main.flows["opening"],
            "fill_pressure_ratio": main.flows["fill_pressure_ratio"],
            "exhaust_pressure_ratio": main.flows["exhaust_pressure_ratio"],
            "gas_temperature": main.temperature,
            "volume": main.volume,
            "diameter": main.state.diameter,
            "contact": contact,
            "net_force": dry.net_force,
            "friction": dry.friction / c["lever_ratio"],
            "friction_share": dry.share,
            "friction_left_up": dry.left[0] / c["lever_ratio"],
            "friction_left_down": dry.left[1] / c["lever_ratio"],
            "external_force": external,
            **main.readings,
        }
        if structure.pair:
            other = sides[1]
            rates |= {f"{name}{COUNTER}": rate for name, rate in other.rates.items()}
            figures = (
                other.force,
                other.inflow,
                other.flows["supply"],
                other.flows["exhaust"],
                other.volume,
                other.state.diameter,
            )
            outputs |= dict(zip(COUNTER_OUTPUTS, figures, strict=True))
        return dry.resolved(rates), dry.resolved(outputs)

    def _net_force(
        self,
        structure: DriveStructure,
        model: Model,
        muscle: Muscle,
        values: Mapping[str, Mapping[str, Value]],
        pull: Value,
        external: Value,
        direction: Value,
    ) -> tuple[Value, Value]:
        """Force along the stroke without that of the stops [N], and the mass it moves [kg]."""
        c, stroke, speed = self._constants, self.symbols["stroke"], self.symbols["speed"]
        factor = model.product("load_factor", values, {})
        inertia = factor * c["mass"] + c["own_mass"] + model.sum("inertia", values, {"muscle": muscle})
        lever = c["lever_ratio"]
        hung = model.sum("hung_mass", values, {}) * c["gravity"]
        load = factor * (c["mass"] * c["gravity"] + external) + hung
        guided = {"stroke": stroke, "speed": speed, "direction": direction, "load": ops.absolute(load)}
        resisting = load + model.sum("guide", values, guided)
        if not structure.path:
            return lever**2 * pull - lever * resisting - c["spring"] * stroke, inertia
        against = joint.torque_against(
            model=model, values=values, angle=stroke / c["rim"], direction=direction
        )
        return pull - resisting - c["spring"] * (stroke - c["spring_rest"]) - against / c["rim"], inertia

    def _motions(
        self,
        structure: DriveStructure,
        model: Model,
        values: Mapping[str, Mapping[str, Value]],
        direction: Value,
    ) -> tuple[dict[str, Motion], dict[str, Value]]:
        """Of each muscle its motion, and the share of its force along the coordinate; by its suffix.

        The coordinate of a joint is its angle times the radius of its rim, and the share of a force its lever
        over that radius; both are constant on a pulley.
        """
        c, stroke, speed = self._constants, self.symbols["stroke"], self.symbols["speed"]
        suffixes = {"": 1.0, COUNTER: -1.0} if structure.pair else {"": 1.0}
        if not structure.path:
            motions = {
                suffix: Motion(
                    c["precontraction"] + sense * stroke, sense * speed, sense * direction, sense * stroke
                )
                for suffix, sense in suffixes.items()
            }
            return motions, dict(suffixes)
        motions, shares = {}, {}
        for suffix, sense in suffixes.items():
            begin = "counter_" if suffix else ""
            held = joint.held(model=model, values=values, angle=stroke / c["rim"], path=self._path(begin))
            share = held.lever / c["rim"]
            motions[suffix] = Motion(
                se.Symbol("nominal_length") - held.length, share * speed, sense * direction, stroke
            )
            shares[suffix] = share
        return motions, shares

    def _path(self, begin: str) -> MusclePath:
        """The path of a muscle by its constants."""
        c = self._constants

        def polynomial(name: str, degree: int) -> Callable[[Value], Value]:
            def at(angle: Value) -> Value:
                x = (angle - c["path_middle"]) / c["path_half"]
                value: Value = c[f"{begin}{name}_{degree}"]
                for power in range(degree - 1, -1, -1):
                    value = value * x + c[f"{begin}{name}_{power}"]
                return value

            return at

        length, lever = polynomial("path_length", PATH_DEGREE), polynomial("path_lever", PATH_DEGREE - 1)
        return MusclePath(length=length, lever=lever, lever_slope=lever)

    def _values(self, model: Model, states: Mapping[str, Value]) -> dict[str, dict[str, Value]]:
        """Parameters and states of each effect."""
        return {
            effect.id: {p.name: self._numbers[f"{effect.id}.{p.name}"] for p in effect.parameters}
            | {state.name: states[f"{effect.id}.{state.name}"] for state in effect.states}
            for effect in model.effects
        }


def _side_states(structure: DriveStructure, model: Model, suffix: str) -> list[StateInfo]:
    states = [StateInfo("length", None, 0.1), StateInfo("pressure", None, 1e5)]
    if structure.tube:
        states.append(StateInfo("tube_pressure", None, 1e5))
    if structure.regulator:
        states.append(StateInfo("regulator_pressure", None, 1e5))
    if structure.regulator and structure.second_order:
        states.append(StateInfo("regulator_rate", 0.0, 1e6))
    if with_energy_balance(structure=structure, model=model):
        states.append(StateInfo("gas_mass", None, 1e-3))
    for effect in model.effects:
        states += [StateInfo(f"{effect.id}.{s.name}", s.initial, s.scale, s.settled) for s in effect.states]
    return [StateInfo(f"{s.name}{suffix}", s.initial, s.scale, s.settled) for s in states]


class DryFriction:
    """The dry friction of a load, by the direction d that its net force contains.

    Attributes:
        net_force: N(d) of the switches: d is 0 while the load sticks [N].
        moves: 1 while the load slides, 0 while it sticks or rests on a stop.
        friction: force of the friction along the stroke [N]: N(d) - N(0); sticking it carries -N(0), as far
            as its range allows. 0 on a stop.
        share: its share of the range that it has, 0 to 1; 1 sliding, 0 without dry friction.
        left: force upwards and downwards that it still takes before the load breaks away [N]; 0 sliding.
    """

    def __init__(
        self, *, net_force: Value, direction: Value, slides: tuple[Value, Value] | None, contact: Value
    ) -> None:
        net = se.sympify(net_force)
        self._direction = direction
        if slides is None:
            self.net_force, self.moves = net, 1.0 - contact
            self.friction = self.share = self._reached = se.Integer(0)
            self.left = self.friction, self.friction
            return
        up, down = slides
        self.moves = (1.0 - contact) * (up + down)
        middle, upwards, downwards = (net.subs({direction: value}) for value in (0.0, 1.0, -1.0))
        # Sticking: the part of the range that balances the load, on the side where the friction has to act.
        sticks = (1.0 - contact) * (1.0 - up - down)
        side = ops.where(ops.greater(middle, 0.0), middle - upwards, downwards - middle)
        share = ops.minimum(ops.absolute(middle) / ops.maximum(side, LEAST_GUARD), 1.0)
        balanced = sticks * ops.where(ops.greater(middle, 0.0), share, -share)
        self._reached = up - down + balanced
        self.net_force = net.subs({direction: up - down})
        self.friction = net.subs({direction: self._reached}) - middle
        resists = ops.greater(ops.absolute(downwards - upwards), LEAST_GUARD)
        self.share = ops.where(resists, (1.0 - contact) * (up + down) + sticks * share, 0.0)
        self.left = sticks * ops.positive_part(-upwards), sticks * ops.positive_part(downwards)

    def resolved(self, expressions: Mapping[str, Value]) -> dict[str, Value]:
        """Expressions of the direction as those of the switches; sticking, it is what balances the load."""
        return {
            name: each.subs({self._direction: self._reached})
            if self._direction in (each := se.sympify(expression)).free_symbols
            else each
            for name, expression in expressions.items()
        }


def motion_switches(
    *, constants: Mapping[str, Value], stroke: Value, speed: Value, net_force: Value, direction: Value
) -> tuple[list[Switch], DryFriction]:
    """The end stops, each of which holds the load while the net force presses it there, and the friction.

    The directions of sliding follow the stops where the net force depends on the symbol ``direction``. Where
    the friction has no force for the moment (of a muscle without pressure, of a law that is off) a direction
    does not end: there is nothing that could stick.
    """
    up, down = (se.Symbol(f"w_{name}") for name in (SLIDES_UP, SLIDES_DOWN))
    low, high = (se.Symbol(f"w_{name}") for name in (LOW_STOP, HIGH_STOP))
    net = se.sympify(net_force)
    slides = (up, down) if direction in net.free_symbols else None
    dry = DryFriction(net_force=net, direction=direction, slides=slides, contact=low + high)
    switches = []
    for name, holds, ahead, pressing in (
        ("stop_low", low, stroke - constants["stop_low"], -dry.net_force),
        ("stop_high", high, constants["stop_high"] - stroke, dry.net_force),
    ):
        guard = holds * pressing + (1.0 - holds) * GUARD_STIFFNESS * ahead
        switches.append(Switch(str(holds)[2:], holds, guard, LEAST_GUARD, stop=name))
    if slides is None:
        return switches, dry
    upwards, downwards = net.subs({direction: 1.0}), net.subs({direction: -1.0})
    sticks = (1.0 - low - high) * (1.0 - up - down)
    resists = ops.greater(ops.absolute(downwards - upwards), LEAST_GUARD)
    for own, sense, holding in ((up, 1.0, -upwards), (down, -1.0, downwards)):
        ahead = ops.where(resists, sense * GUARD_DAMPING * speed, 0.0)
        guard = own * ahead + sticks * holding
        switches.append(Switch(str(own)[2:], own, guard, LEAST_GUARD, slides=sense))
    return switches, dry
