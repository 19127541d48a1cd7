"""Summary of a measurement as it was read."""

from __future__ import annotations

from mckibben.measurement.experiment import Experiment, place_of, shown_value, title_of
from mckibben.measurement.measurement import Measurement
from mckibben.report.figures import variable
from mckibben.report.summary.parts import Summary, Table, figure


def summary_of(measurement: Measurement, experiment: Experiment) -> Summary:
    """The channels, the experiment, what was assumed, columns that are not read.

    Args:
        measurement: the data.
        experiment: what is said about the test.
    """
    rows = []
    for channel in measurement.channels:
        scale = variable(channel.name)[1]
        low, high = (figure(scale.of(value)) for value in (channel.minimum, channel.maximum))
        rows.append(
            [channel.name, channel.column, channel.source_unit, f"{low} to {high} {scale.unit}".strip()]
        )
    title = f"{measurement.name}: {measurement.kind}, {measurement.rows} rows in {measurement.groups} groups"
    summary: Summary = [Table(title, ["channel", "column", "in", "range"], rows)]
    if experiment:
        said = [
            [title_of(name), shown_value(name, value), place_of(value)] for name, value in experiment.items()
        ]
        summary.append(Table(f"Experiment of {measurement.name}", ["", "value", "who says it"], said))
    summary += measurement.messages
    summary += [f"column '{column}' is not read: {why}" for column, why in measurement.unread]
    return summary
