"""mckibben: a design studio for pneumatic-muscle drives.

Layers, each importing only those to its left:
``physics <- presets <- simulation <- identification <- api, cli``.
"""

__version__ = "0.1.0"
