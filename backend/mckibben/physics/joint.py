r"""What effects change of a joint: its angle, its levers, and the torque that does not come from the muscles.

Measured or stated are the angle :math:`\varphi_m`, and for each muscle its path: lengths L and levers r over
the angle, or both in each row. With the true angle :math:`\varphi` and the factor f of the levers

.. math::
   r_t = f\,r(\varphi), \qquad L_t = L(0) + f\,(L(\varphi) - L(0)), \qquad
   \tau = \sum_i r_{t,i}\,F_i(L_{t,i}) - \tau_{against}

so that lever and length obey virtual work for every angle and factor. Where they were measured in each row,
an error of the angle changes neither, and the length is what it is.
"""

from __future__ import annotations

from typing import NamedTuple

from mckibben.physics.model import Model, Values
from mckibben.physics.muscle_path import MusclePath
from mckibben.physics.ops import Value

#: Slots of effects that act on a joint and on nothing else.
JOINT_SLOTS = frozenset({"joint_angle", "joint_lever", "joint_torque"})


class Held(NamedTuple):
    """Length [m] of a muscle and its lever [m] as they truly are."""

    length: Value
    lever: Value


def true_angle(*, model: Model, values: Values, angle: Value) -> Value:
    """The angle [rad] that a measured one stands for."""
    return model.chain("joint_angle", angle, values, {}, name="angle")


def held(
    *,
    model: Model,
    values: Values,
    angle: Value,
    path: MusclePath | None,
    length: Value = 0.0,
    lever: Value = 0.0,
) -> Held:
    """The true length and lever of a muscle.

    Args:
        model: with the effects of the joint.
        values: of their parameters.
        angle: measured [rad].
        path: stated; None where length and lever were measured in each row:
        length, lever: as they were measured [m].
    """
    factor = model.product("joint_lever", values, {})
    if path is None:
        return Held(length, factor * lever)
    at = true_angle(model=model, values=values, angle=angle)
    begin = path.length(0.0)
    return Held(begin + factor * (path.length(at) - begin), factor * path.lever(at))


def torque_against(*, model: Model, values: Values, angle: Value, direction: Value) -> Value:
    """Torque that muscles overcome besides what is measured [N m].

    Args:
        model, values: as `held`.
        angle: measured [rad].
        direction: sign of the motion of the joint, 0 at rest.
    """
    at = true_angle(model=model, values=values, angle=angle)
    return model.sum("joint_torque", values, {"angle": at, "direction": direction})
