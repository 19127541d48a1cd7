"""Figures of the linear view: operating point, models, poles, margins of a loop, controllers, their steps."""

from __future__ import annotations

from mckibben.facts.figure import Condition, Figure, Group

#: Of the step: the position has settled when it stays within.
SETTLING_BAND = 0.02
#: Share of the static gain, or of full following, at which a bandwidth ends: -3 dB.
FALLEN = 0.5**0.5

_PAIR = Condition("the drive is an antagonist pair", "the drive has one muscle")
_SETTLED = Condition(
    "the channel does not integrate", "the channel integrates: its gain has no value at 0 Hz"
)
_FALLS = Condition(
    "the channel has a static gain and falls by 3 dB between 0.0001 Hz and 10 kHz",
    "the gain does not fall by 3 dB between 0.0001 Hz and 10 kHz",
)
_NO_INTEGRATOR = Condition("the pole is no integrator", "an integrator has no damping")
_SWINGS = Condition("the pole oscillates", "this motion does not oscillate")
_DECAYS = Condition("the motion decays", "this motion does not decay")
_CONTROLLED = Condition("the drive has a controller", "the drive has no controller")
_UNSTABLE = "the closed loop is unstable, or"
_TURNS = Condition(
    "the closed loop is stable and the open loop crosses the negative real axis",
    f"{_UNSTABLE} the phase of the loop never reaches −180°",
)
_CROSSES = Condition(
    "the closed loop is stable and the gain of the loop is 1 at some frequency",
    f"{_UNSTABLE} the gain of the loop is never 1",
)
_STABLE = Condition("the closed loop is stable", "the closed loop is unstable")
_FOLLOWS = Condition(
    "the closed loop is stable, follows at the lowest frequency and falls by 3 dB",
    f"{_UNSTABLE} does not follow at the lowest frequency, or never falls by 3 dB",
)
_COMPLETED = Condition("the run is complete", "the run did not complete")
_STAYS = Condition(
    "the position settles within twice the time asked for",
    "the position does not stay within 2 % of the step within twice the settling time asked for",
)
_RISES = Condition("the position reaches 90 % of the step", "the position does not reach 90 % of the step")
_ULTIMATE = Condition("the loop has an ultimate gain", "the loop has no ultimate gain")
_SWEPT = Condition("the drive under this sine swings", "there is no run of this sine")

#: Where a drive is linearised.
LINEAR_POINT = Group(
    "linear_point",
    "Operating point",
    Figure(
        "position", "x", "m", "Position",
        "Position of the load, positive towards a shorter muscle; 0 at the rest length, of a pair in the"
        " middle.",
    ),
    Figure(
        "contraction", "ε", "1", "Contraction", "Contraction of the muscle; of a pair of the first one.",
        quantity="ratio",
    ),
    Figure("pressure", "p", "Pa", "Pressure", "Gauge pressure in the muscle; of a pair in the first one."),
    Figure(
        "counter_pressure", "p₂", "Pa", "Pressure in the second muscle",
        "Gauge pressure in the second muscle.", _PAIR,
    ),
    Figure("command", "u", "1", "Command", "Command that holds the load there.", quantity="ratio"),
    Figure("force", "F", "N", "Force", "Tension of the muscle; of a pair of the first one."),
    Figure(
        "load_force", "F_e", "N", "External force",
        "Force on the load besides gravity and spring, against the contraction.",
    ),
    Figure("supply_pressure", "p_s", "Pa", "Supply pressure", "Gauge pressure of the supply."),
)  # fmt: skip

#: A linear model and the response of its channel.
LINEAR_MODEL = Group(
    "linear_model",
    "Linear model",
    Figure("pressure", "p", "Pa", "Pressure", "Gauge pressure at which it is linearised."),
    Figure(
        "dead_time", "τ", "s", "Dead time",
        "Dead time of the command: in gain and phase, not in the matrices.", quantity="lapse",
    ),
    Figure(
        "static_gain", "K₀", "", "Static gain",
        "Real part of the response at 0 Hz, in the unit of the output per unit of the input.", _SETTLED,
    ),
    Figure(
        "bandwidth", "f_b", "Hz", "Bandwidth (−3 dB below 0\u00a0Hz)",
        "First frequency at which the gain is below 0.707 of that at 0 Hz.", _FALLS,
    ),
    Figure(
        "gain", "|G|", "", "Gain",
        "Magnitude of the response, in the unit of the output per unit of the input.", quantity="level",
    ),
    Figure("phase", "φ", "rad", "Phase", "Phase of the response with the dead time, turns counted."),
    Figure("frequency", "f", "Hz", "Frequency", "Frequency of the responses."),
)  # fmt: skip

#: A pole of a model; a zero has the first three.
POLE = Group(
    "pole",
    "Poles and zeros",
    Figure("real", "σ", "rad/s", "Real part", "Re s; negative where the motion decays."),
    Figure("imaginary", "ω", "rad/s", "Imaginary part", "Im s; of a complex pair the positive one."),
    Figure(
        "frequency", "f₀", "Hz", "Natural frequency",
        "|s|/2π: of a pair of poles that of the undamped oscillation, of a real pole its corner.",
    ),
    Figure(
        "oscillation_frequency", "f_d", "Hz", "Oscillation",
        "|Im s|/2π = f₀ √(1 − ζ²), with which a damped motion swings.", _SWINGS,
    ),
    Figure(
        "damping", "ζ", "1", "Damping ratio", "−Re s/|s|; 1 of a real pole that decays.", _NO_INTEGRATOR,
        quantity="number",
    ),
    Figure(
        "time_constant", "T", "s", "Time constant", "−1/Re s, in which the motion decays to 37 %.", _DECAYS,
        quantity="lapse",
    ),
)  # fmt: skip

#: The nonlinear drive under a sine.
DESCRIBING = Group(
    "describing",
    "Nonlinear drive under a sine",
    Figure("frequency", "f", "Hz", "Frequency", "Frequency of the sine."),
    Figure("amplitude", "a", "", "Amplitude", "Amplitude of the sine of the input, in its unit."),
    Figure(
        "gain", "|N|", "", "Gain",
        "Fundamental of the output over the sine, in the unit of the output per unit of the input.", _SWEPT,
        quantity="level",
    ),
    Figure(
        "phase", "φ", "rad", "Phase",
        "Phase of the fundamental after the sine, within half a turn of the linear response.", _SWEPT,
    ),
    Figure(
        "distortion", "", "1", "Distortion",
        "RMS of all but the fundamental over that of the output; drift and an oscillation of the drive "
        "itself that does not decay are taken off.",
        _SWEPT, quantity="ratio",
    ),
)  # fmt: skip

#: Margins of the open loop L of a sampled controller, and its closed loop T.
MARGINS = Group(
    "margins",
    "Loop",
    Figure(
        "gain_margin", "A_m", "1", "Gain margin",
        "1/|L| at the crossing of the negative real axis that is nearest to 1: the factor of the gain up to"
        " the limit of stability; below 1 (negative dB) the gain must not fall.",
        _TURNS, quantity="level",
    ),
    Figure(
        "gain_margin_at", "f_180", "Hz", "Frequency of the gain margin", "Frequency of that crossing.",
        _TURNS,
    ),
    Figure(
        "phase_margin", "φ_m", "rad", "Phase margin",
        "Angle from L to −1 where |L| = 1, at the crossing with the least magnitude of it.",
        _CROSSES,
    ),
    Figure(
        "crossover", "f_c", "Hz", "Crossover frequency", "Frequency of the phase margin, where |L| = 1.",
        _CROSSES,
    ),
    Figure(
        "delay_margin", "τ_m", "s", "Delay margin",
        "Further dead time up to the limit of stability: the least (φ mod 2π)/(2π f) of all frequencies "
        "with |L| = 1.",
        _CROSSES, quantity="lapse",
    ),
    Figure(
        "modulus_margin", "s_m", "1", "Modulus margin",
        "Least distance of the open loop from −1, min |1 + L|.", _STABLE, quantity="number",
    ),
    Figure(
        "bandwidth", "f_b", "Hz", "Bandwidth of the closed loop (−3 dB of 1)",
        "First frequency with |T| < 0.707, T from the reference to the reading of the position, with "
        "feed-forward.",
        _FOLLOWS,
    ),
)  # fmt: skip

#: Open and closed loop over the frequency.
LOOP_RESPONSE = Group(
    "loop_response",
    "Response of the loop",
    Figure("frequency", "f", "Hz", "Frequency", "Frequencies up to half the sampling frequency."),
    Figure(
        "gain", "|L|", "1", "Gain of the open loop", "|L| of controller, hold and drive.", quantity="level",
    ),
    Figure("phase", "φ", "rad", "Phase of the open loop", "Phase of L, turns counted."),
    Figure(
        "closed_gain", "|T|", "1", "Gain of the closed loop",
        "|T| from the reference to the reading of the position, with feed forward.", quantity="level",
    ),
)  # fmt: skip

#: Gains of a position controller.
CONTROLLER = Group(
    "controller",
    "Controller",
    Figure("kp", "K_p", "1/m", "Proportional gain", "Command per error of the position."),
    Figure("ki", "K_i", "1/(m*s)", "Integral gain", "Rate of the command per error of the position."),
    Figure("kd", "K_d", "s/m", "Derivative gain", "Command per rate of the position."),
    Figure("feed_forward", "K_f", "1/m", "Feed forward", "Command per reference."),
    Figure(
        "derivative_filter", "T_f", "s", "Filter time of the derivative",
        "Time constant of the filter of the derivative.", quantity="lapse",
    ),
    Figure("sample_time", "h", "s", "Sample time", "Time from sample to sample.", quantity="lapse"),
    Figure("output_min", "", "1", "Lowest command", "Lower limit of the command.", quantity="ratio"),
    Figure("output_max", "", "1", "Highest command", "Upper limit of the command.", quantity="ratio"),
)  # fmt: skip

#: A step of the position and back on the nonlinear drive: the worse of both.
STEP_DESIGN = Group(
    "step_design",
    "Step of a controller",
    Figure(
        "overshoot", "o", "1", "Overshoot",
        "Largest travel beyond the step over the step, the worse of step and return.", _COMPLETED,
        quantity="ratio",
    ),
    Figure(
        "settling", "t_s", "s", "Settling time (2 %)",
        "Time from which the position stays within 2 % of the step, the worse of step and return.", _STAYS,
    ),
    Figure(
        "rise", "t_r", "s", "Rise time (10–90 %)",
        "Time from 10 to 90 % of the step, the worse of step and return.", _RISES,
    ),
    Figure(
        "saturated",
        "", "1", "Time at the limits", "Share of the time from the step on with the command at its limits.",
        quantity="ratio",
    ),
    Figure(
        "error", "", "1", "RMS error of the step",
        "Root mean square of the error over the step, the worse of step and return.", _COMPLETED,
        quantity="ratio",
    ),
    Figure(
        "late_error", "", "1", "RMS error of the second half", "The same over the second half of its time.",
        _COMPLETED, quantity="ratio",
    ),
)  # fmt: skip

#: A design of a controller.
DESIGN = Group(
    "design",
    "Controller design",
    Figure("step", "Δr", "m", "Height of the step", "Height of the step of the position, and back."),
    Figure(
        "ultimate_gain", "K_u", "1/m", "Ultimate gain",
        "Gain at which a proportional loop of the linear model oscillates for ever.", _ULTIMATE,
    ),
    Figure("ultimate_period", "P_u", "s", "Ultimate period", "Period of that oscillation.", _ULTIMATE),
    Figure("begins", "", "s", "Begin of the step", "When the step begins."),
    Figure("returns", "", "s", "Begin of the return", "When the step back begins."),
    Figure(
        "mass", "", "1", "Mass", "Factor of the mass: 80, 100 and 120 %, with each supply.",
        quantity="ratio",
    ),
    Figure(
        "supply", "", "1", "Supply", "Factor of the supply pressure: 80, 100 and 120 %, with each mass.",
        quantity="ratio",
    ),
    Figure(
        "evaluations", "", "1", "Runs",
        "Runs of the nonlinear drive, with those of the other masses and supplies.", quantity="number",
    ),
)  # fmt: skip
