"""Conversion of request bodies to the questions of the use cases."""
