"""Evaluation of a run: trace, phases, timing figures, tracking of a reference."""
