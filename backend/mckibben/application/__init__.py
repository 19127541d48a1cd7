"""The use cases, the same for HTTP, command line and Python: a typed question in, a result out."""
