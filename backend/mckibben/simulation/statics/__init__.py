"""Statics of one muscle: curves, limits and inverse questions, compiled from the symbolic model."""
