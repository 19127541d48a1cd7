"""Measurement files, and the experiment behind each."""
