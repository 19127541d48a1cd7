"""Transient simulation of a drive: its parts, rest position, and open-loop, controlled and driven runs."""
