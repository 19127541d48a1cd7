"""Values of a sizing as its report shows them."""

from __future__ import annotations

from mckibben.application.size.size import ProposedDrive, RejectedParts
from mckibben.facts.figure import Figure
from mckibben.facts.sizing import SIZING
from mckibben.facts.task import TASK
from mckibben.facts.units import Scale
from mckibben.report.figures import figure, percent, plain, pretty
from mckibben.report.html import Html, html
from mckibben.report.sizing.material import Entry

BAR, MILLIMETRES, NEWTON = (SIZING[name].scale for name in ("pressure", "nominal_length", "peak_force"))
SHARE = SIZING["contraction"].scale
#: Ratio of force to load from which it is shown as "ample": the load is practically zero.
AMPLE = 100.0


def field_name(path: str) -> str:
    """A field of the task in words."""
    return TASK[path].label if path in TASK else path.rpartition(".")[2].replace("_", " ").capitalize()


def shown(value: float | None, each: Figure, digits: int = 4, *, exact: bool = False) -> Html:
    """An SI value of a figure in its unit."""
    scale = each.scale
    if scale == SHARE and not exact:
        return percent(value, digits)
    return figure(value, Scale(pretty(scale.unit), *scale[1:]), digits, exact=exact)


def of_proposal(proposal: ProposedDrive, name: str) -> Html:
    """A figure of a proposal in its unit."""
    return shown(getattr(proposal, name), SIZING[name], 3)


def entry_value(entry: Entry) -> Html:
    """The value of a field; "none" where nothing is demanded."""
    if entry.value is None:
        return html("none")
    if isinstance(entry.value, str):
        return html(entry.value)
    return shown(entry.value, TASK[entry.path], exact=True)


def drive_words(proposal: ProposedDrive) -> str:
    """The muscles of a proposal in words."""
    number = f"{proposal.muscles} × " if proposal.muscles > 1 else ""
    return f"{number}{proposal.muscle}, {MILLIMETRES.of(proposal.nominal_length):.4g} mm"


def pressure_words(proposal: ProposedDrive) -> str:
    """The supply pressure of a proposal."""
    return f"{plain(BAR.of(proposal.pressure), 3)} {BAR.unit}"


def parts_words(item: ProposedDrive | RejectedParts) -> str:
    """Valve and tube of a proposal or rejected choice in words."""
    names = [item.valve, item.tube]
    return ", ".join(name for name in names if name) or "any valve and tube"
