"""``python -m mckibben``: the command line, where the console script is not on the PATH."""

from mckibben.cli import main

if __name__ == "__main__":
    main()
