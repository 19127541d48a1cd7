"""Gas, valve, tube and load alone, in transients."""

from __future__ import annotations

import numpy as np

from tests.truth import elastomer, oddities, sensors
from tests.truth.cases import BOOK, Case
from tests.truth.commands import PARTIAL, PULSES, RESTS
from tests.truth.composition import Hidden, accept
from tests.truth.elastic_cases import known_wall, size
from tests.truth.muscle import Muscle, made
from tests.truth.rig import Setup, Test, setup, transient_case


def _volume(muscle: Muscle) -> float:
    return float(muscle.volume(np.array(0.9 * muscle.nominal)))


def hidden_dead_volume(rig: Setup) -> Hidden:
    """Fittings that give a little under pressure."""
    size = 0.12 * _volume(rig.muscle)
    return Hidden("giving dead volume", accept("dead_volume"), air={"extra_dead": size, "dead_give": 2e-7})


def hidden_wall(rig: Setup) -> Hidden:
    """Rubber in the bore that the stated geometry of the braid does not know; it gives a little."""
    size = -0.2 * _volume(rig.muscle)
    return Hidden("rubber in the bore", accept("wall_volume"), air={"extra_dead": size, "dead_give": -2e-8})


def hidden_heat() -> Hidden:
    """Free convection to a wall that warms, instead of the polytropic exponent."""
    return Hidden(
        "convection to a wall node", accept("heat_exchange"), air={"heat": 25.0, "wall_capacity": 60.0}
    )


def hidden_leak(rig: Setup) -> Hidden:
    """A laminar leak: some 0.25 bar/s at 4 bar."""
    rate = 0.1e5 * _volume(rig.muscle) / (287.05 * 293.15)
    return Hidden("laminar leak", accept("leak"), air={"leak_laminar": rate / (4e5**2)})


def hidden_delay() -> Hidden:
    """A pilot stage that switches on and off at other times."""
    air = {"delay_on": 0.010, "delay_off": 0.016, "delay_blur": 0.002}
    return Hidden("pilot dead time", accept("valve_delay"), air=air)


def hidden_spool(frequency: float = 14.0) -> Hidden:
    """A slow spool whose speed is limited."""
    return Hidden("slew-limited spool", accept("spool_lag"), air={"spool": frequency, "spool_speed": 25.0})


def hidden_overlap(half_width: float = 0.05) -> Hidden:
    """Rounded metering edges with overlap."""
    return Hidden("rounded overlap", accept("valve_deadband"), air={"overlap": half_width})


def hidden_flow(factor: float = 0.93) -> Hidden:
    """A nozzle after Saint-Venant and Wantzel that passes less than the data sheet says."""
    return Hidden("small nozzle", accept("flow_coefficient"), air={"flow_factor": factor, "orifice": 1.0})


def hidden_silencer(rig: Setup, share: float = 1.1) -> Hidden:
    """A clogged silencer with a volume of its own."""
    right = accept("silencer", "exhaust_restriction")
    return Hidden("clogged silencer", right, air={"silencer": share * rig.plant.vent})


def hidden_supply(rig: Setup) -> Hidden:
    """A small reservoir behind a regulator whose droop grows with the square of the flow."""
    flow = rig.plant.fill * 1.185 * rig.plant.supply
    air = {"reservoir": 4.0 * _volume(rig.muscle), "droop": 0.9e5 / flow**2 * 1e-3}
    return Hidden("drooping supply", accept("supply_droop"), air=air)


def hidden_drag(rig: Setup) -> Hidden:
    """Damping with the power 0.8 of the speed, less on lengthening."""
    stiffness = 3.0 * rig.muscle.nominal * 3e5 / (2.0 * np.pi * rig.muscle.turns**2)
    size = 0.5 * np.sqrt(stiffness * rig.plant.mass) * 0.1**0.2
    air = {"drag": float(size), "drag_power": 0.8, "drag_pressure": 5e-7, "drag_ratio": 0.8}
    return Hidden("power-law damping", accept("viscous_damping"), air=air)


def hidden_guide(rig: Setup, share: float = 0.05, *ids: str) -> Hidden:
    """A guide with Stribeck friction."""
    air = {"guide": share * rig.plant.weight, "guide_rise": 0.25, "guide_way": 1.5e-4}
    return Hidden("Stribeck guide", accept("guide_friction", *ids), air=air)


def hidden_rub(rig: Setup, share: float = 0.05) -> Hidden:
    """Bristle friction in the muscle."""
    air = {"rub": share * rig.plant.weight, "rub_way": 2e-4}
    return Hidden(
        "bristle friction", accept("coulomb_friction", "guide_friction", "dahl", "bouc_wen"), air=air
    )


def hidden_carriage(rig: Setup) -> Hidden:
    """A carriage and pulleys that do not weigh on the muscle; their share changes along the stroke."""
    air = {"extra_mass": 0.2 * rig.plant.mass, "extra_mass_slope": 0.6}
    return Hidden("carriage", accept("moving_mass"), air=air)


def hidden_load(factor: float = 1.04) -> Hidden:
    """A load that was never weighed."""
    return Hidden("wrong load", accept("load_scale"), air={"load_factor": factor})


@BOOK.recipe("dead-volume-steps")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed), rng))
    return transient_case("dead-volume-steps", seed, rig, (hidden_dead_volume(rig),), rng)


@BOOK.recipe("wall-volume-steps")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed, 1), rng))
    return transient_case("wall-volume-steps", seed, rig, (hidden_wall(rig),), rng)


@BOOK.recipe("heat-rests")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed, 1), rng))
    return transient_case("heat-rests", seed, rig, (hidden_heat(),), rng, Test(RESTS))


@BOOK.recipe("leak-rests")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed, 2), rng))
    return transient_case("leak-rests", seed, rig, (hidden_leak(rig),), rng, Test(RESTS))


@BOOK.recipe("delay-pulses")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed), rng))
    return transient_case("delay-pulses", seed, rig, (hidden_delay(),), rng, Test(PULSES, every=20))


@BOOK.recipe("spool-pulses")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed, 1), rng))
    return transient_case("spool-pulses", seed, rig, (hidden_spool(),), rng, Test(PULSES, every=20))


@BOOK.recipe("deadband-partial")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed, 2), rng), flow=2.0)
    return transient_case("deadband-partial", seed, rig, (hidden_overlap(),), rng, Test(PARTIAL))


@BOOK.recipe("valve-hysteresis-partial")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed), rng), flow=2.0)
    loop = Hidden("Preisach valve", accept("valve_hysteresis"), air={"hysteresis": 0.05})
    return transient_case("valve-hysteresis-partial", seed, rig, (loop,), rng, Test(PARTIAL))


@BOOK.recipe("flow-steps")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed, 1), rng), ratio=0.5)
    return transient_case("flow-steps", seed, rig, (hidden_flow(),), rng)


@BOOK.recipe("silencer-steps")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed, 2), rng))
    return transient_case("silencer-steps", seed, rig, (hidden_silencer(rig),), rng, Test(forced=seed == 0))


@BOOK.recipe("tube-resistance-steps")
def _(rng: np.random.Generator, seed: int) -> Case:
    bore, loss = ((4e-3, 25.0), (2.6e-3, 80.0), (4e-3, 25.0))[seed % 3]
    rig = setup(made((20, 10, 20)[seed % 3], rng), tube=(bore, 1.0), flow=1.5)
    kinks = Hidden("kinked tube", accept("tube_resistance"), air={"tube_lumped": 0.0, "tube_loss": loss})
    return transient_case("tube-resistance-steps", seed, rig, (kinks,), rng, Test(every=20))


@BOOK.recipe("tube-delay-pulses")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made((20, 40, 20)[seed % 3], rng), tube=(5.7e-3, 4.0))
    air = {"travel": 4.0 / 343.0, "travel_spread": 0.004}
    wave = Hidden("flow that travels along the tube", accept("tube_delay", "valve_delay"), air=air)
    return transient_case("tube-delay-pulses", seed, rig, (wave,), rng, Test(PULSES, every=20))


@BOOK.recipe("tube-waves-pulses")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made((20, 40, 20)[seed % 3], rng), tube=(6e-3, 5.0))
    wave = Hidden("waves in the tube", accept("tube_delay", "valve_delay"), air={"tube_lumped": 0.0})
    return transient_case("tube-waves-pulses", seed, rig, (wave,), rng, Test(PULSES, every=20))


@BOOK.recipe("supply-droop-steps")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed), rng))
    return transient_case("supply-droop-steps", seed, rig, (hidden_supply(rig),), rng)


@BOOK.recipe("drag-partial")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed, 1), rng), damped=False)
    return transient_case("drag-partial", seed, rig, (hidden_drag(rig),), rng, Test(PARTIAL))


@BOOK.recipe("guide-force-steps")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed, 2), rng))
    return transient_case("guide-force-steps", seed, rig, (hidden_guide(rig),), rng, Test(forced=True))


@BOOK.recipe("carriage-pulses")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed), rng))
    return transient_case("carriage-pulses", seed, rig, (hidden_carriage(rig),), rng, Test(PULSES))


@BOOK.recipe("load-steps")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed, 1), rng))
    return transient_case("load-steps", seed, rig, (hidden_load(),), rng)


@BOOK.recipe("pressure-lag-pulses")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed, 2), rng))
    slow = sensors.slow_amplifier("pressure", 9.0, 1.1, "sensor_lag")
    return transient_case("pressure-lag-pulses", seed, rig, (slow,), rng, Test(PULSES))


@BOOK.recipe("drag-driven")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed), rng), damped=False, flow=0.3)
    return transient_case("drag-driven", seed, rig, (hidden_drag(rig),), rng, Test(PARTIAL, commanded=False))


@BOOK.recipe("bladder-driven")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    rig = setup(m, share=0.25)
    stiff = 0.0027 * m.blocked * m.nominal / m.rubber
    wall = elastomer.bladder(m, elastomer.yeoh(stiff, -0.04 * stiff, 0.0))
    return transient_case("bladder-driven", seed, rig, (wall,), rng, Test(commanded=False))


@BOOK.recipe("rub-driven")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed, 2), rng))
    return transient_case("rub-driven", seed, rig, (hidden_rub(rig),), rng, Test(RESTS, commanded=False))


@BOOK.recipe("nothing-steps")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed), rng))
    return transient_case("nothing-steps", seed, rig, (), rng, Test(forced=seed == 1))


@BOOK.recipe("nothing-known-wall-driven")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    rig = setup(m, wall=known_wall(m, 0.15e6))
    return transient_case("nothing-known-wall-driven", seed, rig, (), rng, Test(PULSES, commanded=False))


@BOOK.recipe("unknown-shaken-rig-steps")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed, 2), rng))
    shaken = oddities.moving_frame(0.03 * rig.plant.weight, 3.3)
    return transient_case(
        "unknown-shaken-rig-steps", seed, rig, (shaken,), rng, unknown="a force at one frequency"
    )


@BOOK.recipe("unknown-inertance-pulses")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed), rng))
    swing = oddities.swinging_mass(6.0 * rig.plant.mass / rig.muscle.nominal)
    return transient_case(
        "unknown-inertance-pulses", seed, rig, (swing,), rng, Test(PULSES), unknown="a force with v squared"
    )
