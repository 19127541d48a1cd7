"""The use cases for HTTP, command line and Python: each takes a typed question and returns a result."""
