"""Models without physics beside the best one, and the sentence that names the best of them."""

from __future__ import annotations

from collections.abc import Sequence

from mckibben.application.diagnose.result import Rival
from mckibben.identification.diagnose.diagnosis import Diagnosis
from mckibben.identification.residual.digits import brief
from mckibben.identification.residual.rivals import rivals_of

_SURFACE = "free surface"


def rivals_beside(diagnosis: Diagnosis) -> list[Rival]:
    """The rivals of the best model, the best on left-out groups first."""
    if diagnosis.judgement is None:
        return []
    return [
        Rival(rival.kind, rival.numbers, rival.left, rival.left_out, rival.model_left_out)
        for rival in rivals_of(diagnosis.best, diagnosis.predictor, diagnosis.judgement.surface)
    ]


def rival_sentence(diagnosis: Diagnosis, rivals: Sequence[Rival]) -> str:
    """What the best rival leaves, under a verdict that is not adequate and has not said it; else empty."""
    if diagnosis.status in ("adequate", "unfinished") or not rivals:
        return ""
    best, unit = rivals[0], diagnosis.predictor.unit
    if best.kind == _SURFACE and diagnosis.judgement is not None and diagnosis.judgement.undecided:
        return ""  # the sentence of what the data cannot tell has named it
    unit, scale = {"1": ("times the noise", 1.0), "m": ("mm", 1e3)}.get(unit, (unit, 1.0))
    model, left = diagnosis.best, brief(scale * best.rmse)
    where = " on what the model leaves" if best.kind == _SURFACE else ", without physics,"
    text = (
        f"A {best.kind} with {best.numbers} numbers{where} would leave {left} {unit}, the "
        f"model with its {len(model.free)} leaves {brief(scale * model.rmse)} {unit}"
    )
    if best.holdout_rmse is None or best.model_holdout_rmse is None:
        return f"{text}; too few groups can be left out to tell which predicts better."
    both = f"{brief(scale * best.holdout_rmse)} against {brief(scale * best.model_holdout_rmse)} {unit}"
    if best.holdout_rmse < best.model_holdout_rmse:
        return f"{text}; on groups that were left out, {both}."
    return f"{text}; on groups that were left out no such description is better: {both}."
