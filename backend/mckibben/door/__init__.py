"""The Python door: what ``import mckibben as mk`` offers.

A peer of server and command line. It turns arguments into the questions of the use cases, and adds to
their results text, HTML, data frames, figures and files. Nothing below imports it.
"""
