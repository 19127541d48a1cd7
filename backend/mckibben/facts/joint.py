"""Figures of a joint at rest: the paths of its muscles, torque and stiffness over the angle."""

from __future__ import annotations

from mckibben.facts.figure import Condition, Figure, Group

_REACHED = Condition(
    "no muscle is longer than its braid allows at this angle",
    "a muscle would be longer than its braid allows at this angle",
)
_HELD = Condition(
    "pressures up to the stated highest one hold the joint at this angle",
    "no pressures up to the stated highest one hold the joint at this angle",
)

#: Each muscle along the angle.
JOINT_MUSCLE = Group(
    "joint_muscle",
    "Muscles of the joint",
    Figure(
        "lever", "r", "m", "Lever of the muscle",
        "−dL/dφ, positive where the muscle turns to greater angles.",
    ),
    Figure("length", "L", "m", "Length along the path", "Length of the muscle at the angle φ of the joint."),
    Figure(
        "contraction", "ε", "1", "Contraction along the path", "1 − L/L₀ at the angle φ of the joint.",
        quantity="ratio",
    ),
)  # fmt: skip

#: The joint over its angle at stated pressures.
JOINT_STATICS = Group(
    "joint_statics",
    "Statics of the joint",
    Figure("angle", "φ", "rad", "Angle of the joint", "Angle between the stops."),
    Figure(
        "torque", "M", "N*m", "Torque of the joint",
        "Σ rᵢ Fᵢ of the muscles, with spring and weight; what holds the joint at the angle takes it up.",
        _REACHED,
    ),
    Figure(
        "stiffness", "K", "N*m/rad", "Stiffness of the joint, valves open",
        "−dM/dφ at constant pressures: Σ (rᵢ² dFᵢ/dL − Fᵢ drᵢ/dφ), with spring and weight.", _REACHED,
    ),
    Figure(
        "stiffness_closed", "K", "N*m/rad", "Stiffness of the joint, valves closed",
        "−dM/dφ at constant gas masses in the muscles (adiabatic), with spring and weight.", _REACHED,
    ),
    Figure(
        "least_stiffness", "K_min", "N*m/rad", "Least stiffness at the angle",
        "Least stiffness with the valves open, of all pressures that hold the joint at the angle.", _HELD,
    ),
    Figure(
        "most_stiffness", "K_max", "N*m/rad", "Largest stiffness at the angle",
        "Largest stiffness with the valves open, of all pressures that hold the joint at the angle.", _HELD,
    ),
)  # fmt: skip
