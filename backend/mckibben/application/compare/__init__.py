"""A model compared with measurements."""
