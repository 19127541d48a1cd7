"""From the symbolic model to numbers: compiled evaluation, curves, operating points, inverse questions."""
