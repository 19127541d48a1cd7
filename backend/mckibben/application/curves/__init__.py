"""Curves of a muscle, and the inverse questions."""
