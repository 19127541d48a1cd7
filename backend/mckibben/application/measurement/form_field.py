"""A field of the experiment on a form."""

from __future__ import annotations

from mckibben.facts.result import result_class
from mckibben.measurement.experiment import Origin


@result_class
class FormField:
    """A field of a form; see `mckibben.measurement.experiment.ExperimentField` and ``ExperimentValue``."""

    field: str
    """Name: the key of 'experiment' in a request. 'accuracy_length' and the like are parts of its 'accuracy'.
    """
    title: str
    """In words."""
    value: float | str | None
    """In SI, or a text; None = nobody states it."""
    unit: str
    """SI unit; "" of a text."""
    units: tuple[str, ...]
    """Units for a form."""
    origin: Origin | None
    """Who says it; None with value."""
    where: str
    """Place in the file, or the preset."""
    required: bool
    """This kind of test needs it."""
    unanswered: bool
    """Required, and neither the file nor the user says it: ask before the first diagnosis. With origin
    'assumed' a diagnosis goes on with the value; with value None it does not.
    """
    question: str
    """The question of the field."""
    why: str
    """What it is needed for."""
    proposed: float | str | None
    """A value that the data suggest, SI; never used unasked."""
    least: float | None
    """Smallest allowed value, SI."""
    most: float | None
    """Largest allowed value, SI."""
    choices: tuple[str, ...]
    """Allowed texts, or proposals of texts; empty = any."""
    closed: bool
    """Only the choices are allowed."""
    example: str
    """A valid value, as a text."""
    option: str
    """What says it on the command line."""
