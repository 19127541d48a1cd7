"""The public interface of effects: all that the file of an effect imports.

An effect is one Python file, or a module of an installed package that offers it as an entry point of the
group ``mckibben.effects``. It holds plain functions for the slots (`SLOTS`) and one ``EFFECT = Effect(...)``.
Functions take keywords only, in SI, and compute with plain operators and `ops`, so that the same text runs on
numbers, arrays and symbols. ``mckibben effect new NAME`` writes a file to begin with, ``mckibben effect check
FILE`` evaluates everything that it claims.

`INTERFACE` is the version of this interface. What is written for it keeps loading as long as the number
stays; names and fields may be added to it. A change that breaks a file raises it, in a minor version of
mckibben at the earliest, after a minor version that warns.
"""

from __future__ import annotations

from mckibben.physics import ops
from mckibben.physics.effect import (
    FAMILIES,
    INTERFACE,
    KINDS,
    TYPES,
    ZERO_STATES,
    Effect,
    Example,
    Prior,
    Signature,
    StateVariable,
    Twin,
)
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source
from mckibben.physics.slots import SLOTS

__all__ = [
    "FAMILIES", "INTERFACE", "KINDS", "SLOTS", "TYPES", "ZERO_STATES", "Effect", "Example", "Muscle",
    "Parameter", "Prior", "Signature", "Source", "StateVariable", "Twin", "Value", "ops",
]  # fmt: skip
