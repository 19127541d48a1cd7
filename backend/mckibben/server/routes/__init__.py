"""One module per noun; every function converts, calls, converts."""
