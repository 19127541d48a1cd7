"""Summary of the check of an effect."""

from __future__ import annotations

from mckibben.application.effect.check import EffectCheck
from mckibben.report.summary import Summary, Table, figure


def summary_of(result: EffectCheck) -> Summary:
    """Claims, where it is seen, trials, and one sentence."""
    claims = [[each.claim, "holds" if each.holds else "broken"] for each in result.claims]
    broken = [f"broken: {each.claim} {each.message}" for each in result.claims if not each.holds]
    seen = [[each.kind, f"{figure(each.rms)} {each.unit} of {each.quantity}"] for each in result.seen]
    tried = [
        [
            each.kind,
            ", ".join(f"{name} {figure(value)}" for name, value in each.values.items()),
            figure(each.error_over_noise),
            each.outcome,
            ", ".join(each.named) or "nothing",
        ]
        for each in result.trials
    ]
    summary: Summary = [
        Table(f"{result.title} ({result.effect})", ["claim", ""], claims),
        *broken,
        Table("Seen in the tests of a DMSP-20 of 300 mm, rms", ["kind", "leaves"], seen),
        *(f"not seen in {kind} tests, which it names" for kind in result.unseen),
    ]
    if tried:
        columns = ["kind", "hidden", "error over noise", "outcome", "the diagnosis named"]
        summary.append(Table("Hidden in simulated readings", columns, tried))
    verdict = "everything it claims is so" if result.passed else "not everything it claims is so"
    return [*summary, f"{result.effect}: {verdict}"]
