"""The experiment behind a measurement, in previews, requests and answers.

1. *Before a file is stored.* ``POST /api/measurements/preview?name=...&muscle=DMSP-20`` answers
   ``experiment``: every field that matters for this kind of test, see `FormField`. ``muscle`` is the
   id of the preset that the user has chosen (may be left out).
2. *For stored measurements and presets.* ``POST /api/experiments`` takes the body of a diagnosis
   (``DiagnosisRequest``) and answers the same per measurement, with what the request says included: call it
   again after each change of muscle, drive or value. ``problem`` holds a conflict, or a missing value.
3. *In comparisons, diagnoses and reports* a request states, additions only:

   - ``measurements: [{"id": ..., "use": "fit", "experiment": {"rest_length": "250 mm", "load": "3 kg"}}]``;
   - ``experiment: {...}`` beside ``measurement`` or ``measurements``: for every measurement that does not say
     it itself;
   - ``accuracy: "length 1 mm, force 0.5 %, pressure 20 mbar"`` for all measurements;
   - ``strict: true``: refuse instead of assuming.

   A value is a text with unit (or an SI number), or ``{"value": "250 mm", "origin": "suggested"}`` for a
   proposal that the user took over. ``muscle.nominal_length`` of the request counts as said by the user,
   unless it is the default of the preset. A file with another rest length (by more than 2 %) is then a
   conflict (422, ``field`` "measurements.0.experiment.rest_length") that ``experiment.rest_length`` decides.
4. *Answers* hold ``experiment`` (fields in which all measurements agree), ``assumptions`` (sentences; they
   also begin ``messages`` and the sentence of the verdict), ``specimens`` (one per measurement, with its own
   ``experiment``) and ``absorbed`` (what the stated accuracy took up).
"""

from __future__ import annotations

from typing import Literal

OriginName = Literal["file", "you", "preset", "suggested", "assumed"]
