"""All figures, by group and by key."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from mckibben.facts.comparison import (
    CHANNELS,
    CHECK,
    COMPARISON,
    MEASURED,
    NOISE,
    PARAMETER,
    READING_ERROR,
    RESIDUAL,
    REVERSALS,
    SPECIMEN,
    WINDOWS,
)
from mckibben.facts.diagnosis import DIAGNOSIS
from mckibben.facts.figure import Figure, Group
from mckibben.facts.joint import JOINT_MUSCLE, JOINT_STATICS
from mckibben.facts.linear import (
    CONTROLLER,
    DESCRIBING,
    DESIGN,
    LINEAR_MODEL,
    LINEAR_POINT,
    LOOP_RESPONSE,
    MARGINS,
    POLE,
    STEP_DESIGN,
)
from mckibben.facts.muscle import (
    CHARACTERISTICS,
    CURVES,
    FORCE_INTERVAL,
    GEOMETRY,
    INVERSE,
    INVERSE_DETAILS,
    LIFT,
    LOOP,
    OPERATING_POINT,
    OVER_PRESSURE,
)
from mckibben.facts.muscle import (
    LIMITS as MUSCLE_LIMITS,
)
from mckibben.facts.run import EVENT, JOINT, RUN, STEP, TRACKING
from mckibben.facts.sizing import LIMITS, SEARCH, SIZING
from mckibben.facts.study import INFLUENCE, STUDY, SUMMARY, WATCHED
from mckibben.facts.task import TASK
from mckibben.facts.timing import TIMING

#: Name of a group -> its figures.
GROUPS: Mapping[str, Group] = MappingProxyType(
    {
        group.name: group
        for group in (
            *(
                TIMING,
                RUN,
                EVENT,
                TRACKING,
                STEP,
                JOINT,
                TASK,
                SIZING,
                LIMITS,
                SEARCH,
                WATCHED,
                SUMMARY,
                INFLUENCE,
            ),
            *(
                STUDY,
                CHANNELS,
                COMPARISON,
                REVERSALS,
                WINDOWS,
                CHECK,
                SPECIMEN,
                PARAMETER,
                RESIDUAL,
                READING_ERROR,
                MEASURED,
            ),
            *(NOISE, DIAGNOSIS),
            *(CURVES, FORCE_INTERVAL, CHARACTERISTICS, OPERATING_POINT, LIFT, LOOP, OVER_PRESSURE),
            *(MUSCLE_LIMITS, GEOMETRY, INVERSE, INVERSE_DETAILS),
            *(JOINT_MUSCLE, JOINT_STATICS),
            *(LINEAR_POINT, LINEAR_MODEL, POLE, DESCRIBING, MARGINS, LOOP_RESPONSE),
            *(CONTROLLER, STEP_DESIGN, DESIGN),
        )
    }
)

#: Key -> figure: "timing.rise_time".
FIGURES: Mapping[str, Figure] = MappingProxyType(
    {figure.key: figure for group in GROUPS.values() for figure in group.values()}
)
