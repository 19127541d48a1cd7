"""One muscle at rest: curves, limits, inverse questions, compiled from the symbolic model."""
