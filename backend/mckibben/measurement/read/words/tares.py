"""Words of sentences on the tare of a load cell, folded, parted by blanks."""

from __future__ import annotations

#: The reading of a load cell without pull.
TARE = "tare tara tarra tarage taragewicht tarawert"
#: A reading with nothing on the load cell: what reads, and phrases for nothing.
READS = "reads read reading shows showed indicates zeigt anzeige affiche indique segna marca leitura lectura"
EMPTY = (
    "nothing attached", "nothing hung", "nothing on it", "without load", "with no load", "no load attached",
    "ohne last", "ohne kraft", "sans charge", "senza carico", "sin carga", "sem carga",
)  # fmt: skip
#: Negations.
NOT = "not non nicht ohne without uncorrected unsubtracted no nao pas nie niet inte ikke ej ne"
#: Phrases that something has not been done.
NOT_YET = ("not yet", "noch nicht", "still in")
#: Phrases that something has to be done.
MUST = ("to be ", "must be", "should be", "shall be", "muss ", "ist abzu", "doit etre", "deve essere")
#: It has been taken off the readings.
DONE = (
    "subtracted deducted removed compensated corrected tared zeroed abgezogen subtrahiert korrigiert "
    "kompensiert deduite soustraite deduit soustrait retiree sottratta sottratto detratta restada restado "
    "descontada descontado sustraida substraida subtraida subtraido odjeta odjeto odectena afgetrokken "
    "subtraherad fratrukket"
)
#: It is to be taken off.
TO_DO = "subtract deduct remove abziehen abzuziehen soustraire deduire sottrarre restar subtrair"
#: The readings contain it.
INCLUDED = (
    "included includes include contains contained enthalten enthalt inklusive inbegriffen incluse inclus "
    "comprise inclusa incluso incluida incluido contenue"
)
