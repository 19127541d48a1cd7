"""Measurements: read from files, their kind, sweeps, faults and motion, reduced and kept. No model needed."""
