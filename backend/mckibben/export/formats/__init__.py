"""One file is one format: it declares ``FORMAT``, and its name is what ``--as`` takes."""
