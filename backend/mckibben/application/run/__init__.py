"""A run of a drive."""
