"""Measurements against the model: reading, predicting, fitting, comparing."""
