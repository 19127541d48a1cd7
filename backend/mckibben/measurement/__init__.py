"""Measurements: reading, kind, sweeps, sensor faults, motion, reduction and storage. No model is needed."""
