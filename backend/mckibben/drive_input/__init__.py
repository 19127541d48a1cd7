"""What a caller says about a drive, made complete: one reading for command line and HTTP."""

from mckibben.drive_input.build import GivenDrive, drive_of

__all__ = ["GivenDrive", "drive_of"]
