"""Words of sentences on the tare of a load cell, folded."""

from __future__ import annotations

#: The reading of a load cell without pull.
TARE = frozenset(["tare", "tara", "tarra", "tarage", "taragewicht", "taravalue", "tarawert"])
#: Negations.
NOT = frozenset(
    [
        "not",
        "non",
        "nicht",
        "ohne",
        "without",
        "uncorrected",
        "unsubtracted",
        "no",
        "nao",
        "pas",
        "nie",
        "niet",
        "inte",
        "ikke",
        "ej",
        "ne",
    ]
)
#: Phrases that something is still to be done.
NOT_YET = ("not yet", "noch nicht", "still in")
#: Phrases that something has to be done.
MUST = ("to be ", "must be", "should be", "shall be", "muss ", "ist abzu", "doit etre", "deve essere")
#: It has been taken off the readings.
DONE = frozenset(
    [
        "subtracted",
        "deducted",
        "removed",
        "compensated",
        "corrected",
        "tared",
        "zeroed",
        "abgezogen",
        "subtrahiert",
        "korrigiert",
        "kompensiert",
        "deduite",
        "soustraite",
        "deduit",
        "soustrait",
        "retiree",
        "sottratta",
        "sottratto",
        "detratta",
        "restada",
        "restado",
        "descontada",
        "descontado",
        "sustraida",
        "substraida",
        "subtraida",
        "subtraido",
        "odjeta",
        "odjeto",
        "odecten",
        "odectena",
        "odectena",
        "afgetrokken",
        "subtraherad",
        "fratrukket",
    ]
)
#: It is to be taken off.
TO_DO = frozenset(
    [
        "subtract",
        "deduct",
        "remove",
        "abziehen",
        "abzuziehen",
        "soustraire",
        "deduire",
        "sottrarre",
        "restar",
        "subtrair",
    ]
)
#: The readings contain it.
INCLUDED = frozenset(
    [
        "included",
        "includes",
        "include",
        "includ",
        "contains",
        "contained",
        "enthalten",
        "inklusive",
        "inbegriffen",
        "incluse",
        "inclus",
        "comprise",
        "inclusa",
        "incluso",
        "incluida",
        "incluido",
        "incluindo",
        "contenu",
        "contenue",
    ]
)
