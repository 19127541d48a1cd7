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

In an antagonist pair the first muscle contracts by s0 + s and the second by s0 - s. The second has its own
gas, and its tension acts against the first.

The equations are built on symengine symbols, because they contain derivatives of the volume.
"""

from __future__ import annotations

from collections.abc import Mapping

import symengine as se

from mckibben.physics import ops
from mckibben.physics.chamber import SIGN_SPEED, Motion, Side, muscle_side, sign_of, with_energy_balance
from mckibben.physics.drive_terms import (
    CONSTANTS,
    COUNTER,
    COUNTER_OUTPUTS,
    GUARD_STIFFNESS,
    HIGH_STOP,
    INPUTS,
    LEAST_GUARD,
    LOW_STOP,
    OUTPUTS,
    SLACK,
    DriveStructure,
    StateInfo,
    Switch,
)
from mckibben.physics.model import Model
from mckibben.physics.muscle import GEOMETRY, Muscle
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
        sign_speed: of the smooth sign in the friction (`mckibben.physics.chamber.sign_of`): a number, or a
            symbol for a caller that sets it, as the linearisation of a sliding muscle does.
    """

    def __init__(self, structure: DriveStructure, sign_speed: Value = SIGN_SPEED) -> None:
        model = Model(structure.effects)
        self._sign_speed = sign_speed
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
        constants = {name: se.Symbol(name) for name in CONSTANTS}
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
        for suffix, sense, opening in (("", 1.0, "opening"), (COUNTER, -1.0, "counter_opening")):
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
                    motion=Motion(y["stroke"], y["speed"], c["precontraction"], sense),
                    command=u[opening] + u[f"{opening}_slope"] * passed,
                    sign_speed=self._sign_speed,
                )
            )
            excess = GUARD_STIFFNESS * (own["length"] - sides[-1].distance)
            guard = hanging * excess + (1.0 - hanging) * sides[-1].resting_tension
            name = f"{SLACK}{suffix}"
            slack.append(Switch(name, hanging, guard, LEAST_GUARD, follows=f"length{suffix}"))
        main = sides[0]
        pull = main.force - (sides[1].force if structure.pair else 0.0)
        values = self._values(model, y)
        net, inertia = self._net_force(model, muscle, values, pull, external)
        stops = stop_switches(constants=c, stroke=y["stroke"], net_force=net)
        self.switches = [*stops, *slack]
        low, high = (switch.symbol for switch in stops)
        acceleration = (1.0 - low - high) * net / inertia
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
            "contact": high - low,
            "net_force": net,
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
        return rates, outputs

    def _net_force(
        self,
        model: Model,
        muscle: Muscle,
        values: Mapping[str, Mapping[str, Value]],
        pull: Value,
        external: Value,
    ) -> tuple[Value, Value]:
        """Force along the stroke without that of the stops [N], and the mass it moves [kg]."""
        c, stroke, speed = self._constants, self.symbols["stroke"], self.symbols["speed"]
        factor = model.product("load_factor", values, {})
        inertia = factor * c["mass"] + c["own_mass"] + model.sum("inertia", values, {"muscle": muscle})
        direction = sign_of(velocity=speed, sign_speed=self._sign_speed)
        lever = c["lever_ratio"]
        hung = model.sum("hung_mass", values, {}) * c["gravity"]
        load = factor * (c["mass"] * c["gravity"] + external) + hung
        guided = {"stroke": stroke, "speed": speed, "direction": direction, "load": ops.absolute(load)}
        resisting = load + model.sum("guide", values, guided)
        return lever**2 * pull - lever * resisting - c["spring"] * stroke, inertia

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


def stop_switches(*, constants: Mapping[str, Value], stroke: Value, net_force: Value) -> list[Switch]:
    """The lower and the upper end stop; each holds the load while the net force presses it there."""
    stops = []
    for name, ahead, pressing in (
        (LOW_STOP, stroke - constants["stop_low"], -net_force),
        (HIGH_STOP, constants["stop_high"] - stroke, net_force),
    ):
        holds = se.Symbol(f"w_{name}")
        guard = holds * pressing + (1.0 - holds) * GUARD_STIFFNESS * ahead
        stop = "stop_low" if name == LOW_STOP else "stop_high"
        stops.append(Switch(name, holds, guard, LEAST_GUARD, stop=stop))
    return stops
